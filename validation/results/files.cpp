// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace rigor::results {
namespace {

namespace fs = std::filesystem;

/// Calls again what a signal has interrupted.
template <class Call>
auto repeated(Call call) {
    for (;;) {
        const auto result = call();
        if (result >= 0 || errno != EINTR) return result;
    }
}

class File {
  public:
    File(const fs::path& path, int flags, const char* what) : path_(path) {
        descriptor_ = repeated([&] { return open(path.c_str(), flags | O_CLOEXEC, 0644); });
        if (descriptor_ < 0) throw EnvironmentError(path, what, errno);
    }
    ~File() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t n = repeated([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
            if (n < 0) throw EnvironmentError(path_, "cannot be written", errno);
            bytes.remove_prefix(static_cast<std::size_t>(n));
        }
    }
    void sync() {
        if (repeated([&] { return fsync(descriptor_); }) < 0)
            throw EnvironmentError(path_, "cannot be brought to the disk", errno);
    }
    /// A network file system may report a full disk only here. After EINTR the descriptor is closed.
    void close() {
        const int result = ::close(std::exchange(descriptor_, -1));
        if (result < 0 && errno != EINTR) throw EnvironmentError(path_, "cannot be written", errno);
    }
    std::string read() {
        struct stat about {};
        std::string content;
        if (fstat(descriptor_, &about) == 0 && about.st_size > 0)
            content.reserve(static_cast<std::size_t>(about.st_size) + 1);
        char buffer[1 << 16];
        for (;;) {
            const ssize_t n = repeated([&] { return ::read(descriptor_, buffer, sizeof buffer); });
            if (n < 0) throw EnvironmentError(path_, "cannot be read", errno);
            if (n == 0) return content;
            content.append(buffer, static_cast<std::size_t>(n));
        }
    }

  private:
    fs::path path_;
    int descriptor_ = -1;
};

void replace(const fs::path& file, std::string_view content, bool isSynced) {
    fs::path part = file;
    part += ".part";
    try {
        File out(part, O_WRONLY | O_CREAT | O_TRUNC, "cannot be written");
        out.write(content);
        if (isSynced) out.sync();
        out.close();
        if (repeated([&] { return std::rename(part.c_str(), file.c_str()); }) < 0)
            throw EnvironmentError(file, "cannot be replaced", errno);
    } catch (const EnvironmentError&) {
        std::error_code ignored;
        fs::remove(part, ignored);
        throw;
    }
}

std::string messageOf(const fs::path& path, const std::string& what, int code) {
    std::string text = path.string() + ": " + what;
    if (code != 0) text += ": " + errorText(code);
    return text;
}

/// The last line of a sealed file: checksum and length of all before it.
std::string sealOf(std::string_view content) {
    const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size());
    char text[64];
    std::snprintf(text, sizeof text, "\nrigor-seal crc32=%08lx bytes=%016zx\n", sum, content.size());
    return text;
}

constexpr std::string_view kSealBegin = "\nrigor-seal crc32=";

}  // namespace

EnvironmentError::EnvironmentError(const fs::path& path, const std::string& what, int code)
    : std::runtime_error(messageOf(path, what, code)), code_(code) {}

std::string errorText(int code) {
    if (code == 0) return "";
    const char* name = strerrorname_np(code);
    return std::string(std::strerror(code)) + " (" + (name != nullptr ? name : std::to_string(code)) + ")";
}

std::string readFile(const fs::path& file) {
    return File(file, O_RDONLY, "cannot be read").read();
}

void replaceFile(const fs::path& file, std::string_view content) {
    replace(file, content, true);
}

void replaceScratchFile(const fs::path& file, std::string_view content) {
    replace(file, content, false);
}

void createFolders(const fs::path& folder) {
    std::error_code error;
    do fs::create_directories(folder, error);
    while (error.value() == EINTR);
    if (error) throw EnvironmentError(folder, "cannot be made", error.value());
}

std::size_t sealLength() {
    static const std::size_t length = sealOf("").size();
    return length;
}

std::string sealed(std::string content) {
    content += sealOf(content);
    return content;
}

Seal removeSeal(std::string& content) {
    if (content.size() < sealLength()) return Seal::Absent;
    const std::string_view body(content.data(), content.size() - sealLength());
    const std::string_view line(content.data() + body.size(), sealLength());
    if (line == sealOf(body)) {
        content.resize(body.size());
        return Seal::Good;
    }
    // A damaged or shortened seal is one as well: no other file has these words near its end.
    const std::size_t tail = std::min(content.size(), 4 * sealLength());
    const bool hasWords = content.find("rigor-seal", content.size() - tail) != std::string::npos ||
                          line.starts_with(kSealBegin.substr(0, 6)) || line.find("bytes=") != line.npos;
    return hasWords ? Seal::Bad : Seal::Absent;
}

}  // namespace rigor::results
