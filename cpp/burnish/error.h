// The project's exceptions and the one way to write a message: "name: expected rule, got value".
//   std::invalid_argument   the caller's mistake          (Python: ValueError)
//   FileError               a file is missing or broken   (Python: burnish.FileError, an OSError)
//   VulkanError             the driver said no            (Python: burnish.VulkanError, a RuntimeError)
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace burnish {

/// Joins its arguments as text: message("size: expected 1..16384, got ", width).
template <typename... Parts>
std::string message(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

/// A file that cannot be used. The text starts with the path.
class FileError : public std::runtime_error {
public:
    FileError(const std::string& path, const std::string& reason)
        : std::runtime_error(path + ": " + reason) {}
};

/// A Vulkan call that failed, or a device that lacks what is asked of it.
class VulkanError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Memory that the device does not have, or not in one piece.
class OutOfMemoryError : public VulkanError {
public:
    using VulkanError::VulkanError;
};

/// Runs `work`; if memory is lacking the error also says what it was for.
template <typename Work>
auto needing_memory_for(const std::string& what, const Work& work) {
    try {
        return work();
    } catch (const OutOfMemoryError& error) {
        throw OutOfMemoryError(what + ": " + error.what());
    }
}

} // namespace burnish
