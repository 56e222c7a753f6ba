// What the tests of the Vulkan layer share.
#pragma once

#include "burnish/error.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

#include "spirv/probe_copy_words_comp.h"

namespace burnish::vulkan {

/// Sets an environment variable until the end of the scope.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value, 1);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;
    ~ScopedVariable() {
        if (before_) {
            setenv(name_, before_->c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::optional<std::string> before_;
};

/// The text of the exception of type `Error` that `action` throws; fails the test if there is none.
template <typename Error>
std::string error_text(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "expected an exception, got none";
    return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "in: " << text << "\nexpected: " << part;
}

inline std::vector<uint32_t> counting_words(std::size_t count) {
    std::vector<uint32_t> words(count);
    std::iota(words.begin(), words.end(), 1u);
    return words;
}

inline std::vector<std::byte> counting_bytes(std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i)
        bytes[i] = static_cast<std::byte>((i * 2654435761u) >> 13);
    return bytes;
}

inline std::vector<uint32_t> words_of(const Buffer& buffer) {
    const std::vector<std::byte> bytes = read_back(buffer);
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
    return words;
}

inline Buffer storage_buffer(const DevicePointer& device, std::span<const uint32_t> words) {
    return make_buffer(device, std::as_bytes(words), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

/// The probe that copies words, with its buffers; 64 invocations per group.
struct CopyWords {
    struct Push {
        uint32_t word_count = 0, first_value = 0;
    };

    explicit CopyWords(const DevicePointer& on, std::size_t count = 1000,
                       const SpecializationConstants& constants = SpecializationConstants{}.set(0, 64u))
        : device(on), shader(device, "probe/copy_words.comp", probe_copy_words_comp_spv),
          pipeline(device, shader, constants), source(storage_buffer(device, counting_words(count))),
          target(device, count * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
          set(pipeline), push{static_cast<uint32_t>(count), 0} {
        set.bind(0, source).bind(1, target);
    }

    void record(Commands& commands) const {
        const uint32_t groups = (push.word_count + pipeline.local_size()[0] - 1) / pipeline.local_size()[0];
        commands.dispatch(pipeline, set, push_bytes(push), groups);
    }
    std::vector<uint32_t> run() const {
        Commands commands(device);
        record(commands);
        commands.submit();
        return words_of(target);
    }

    DevicePointer device;
    Shader shader;
    ComputePipeline pipeline;
    Buffer source, target;
    DescriptorSet set;
    Push push;
};

/// Bytes of this process that are in memory.
inline long resident_bytes() {
    std::ifstream file("/proc/self/statm");
    long total = 0, resident = 0;
    file >> total >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

} // namespace burnish::vulkan
