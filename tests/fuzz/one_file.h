// The readers open files: each input becomes one, always of the same name, in a folder of this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace burnish_fuzz {

class OneFile {
public:
    explicit OneFile(const char* name)
        : folder_(std::filesystem::temp_directory_path() / ("burnish-fuzz-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
        path_ = (folder_ / name).string();
    }
    ~OneFile() {
        std::error_code ignored; // at exit there is nobody left to tell
        std::filesystem::remove_all(folder_, ignored);
    }
    OneFile(const OneFile&) = delete;
    OneFile& operator=(const OneFile&) = delete;

    const std::string& write(const uint8_t* data, size_t size) const {
        std::ofstream stream(path_, std::ios::binary | std::ios::trunc);
        stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
        return path_;
    }

private:
    std::filesystem::path folder_;
    std::string path_;
};

} // namespace burnish_fuzz
