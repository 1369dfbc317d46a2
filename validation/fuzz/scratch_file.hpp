// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A file of this process in memory, for readers that take a path.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace rigor::fuzz {

class ScratchFolder {
  public:
    explicit ScratchFolder(const std::string& name) {
        const std::filesystem::path memory = "/dev/shm";
        const auto root =
            std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        path_ = root / ("rigor-fuzz-" + std::to_string(getpid()) + "-" + name);
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// A file with this content, the same one at every call.
inline std::filesystem::path scratchFile(const std::string& content, const char* name = "input") {
    static const ScratchFolder folder("inputs");
    const auto file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
}

}  // namespace rigor::fuzz
