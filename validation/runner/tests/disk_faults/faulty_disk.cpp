// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A library for LD_PRELOAD that makes one call fail which writes to the disk. Calls are counted over all processes that
// share RIGOR_FAULT_COUNTER, a file that begins with the number of calls. The call number RIGOR_FAULT_AT fails as
// RIGOR_FAULT_KIND requests: ENOSPC, EIO, EINTR; `full`, ENOSPC for this call and all later ones; `short`, half of the
// bytes are written (then only writes are counted). 0 counts alone. With RIGOR_FAULT_PROCESS only processes with this
// word as their first argument ("__case") are concerned. Only files under RIGOR_FAULT_UNDER (folders with
// colons between) are concerned.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

/// First argument of this program. A process that was forked for a case has that of a case.
std::string firstArgument() {
    char line[4096];
    const long file = syscall(SYS_openat, AT_FDCWD, "/proc/self/cmdline", O_RDONLY | O_CLOEXEC);
    const long count = syscall(SYS_read, file, line, sizeof line - 1);
    syscall(SYS_close, file);
    const std::string all(line, static_cast<std::size_t>(count > 0 ? count : 0));
    const std::size_t from = std::min(all.find('\0'), all.size() - (all.empty() ? 0 : 1)) + 1;
    return from < all.size() ? all.substr(from, all.find('\0', from) - from) : "";
}

struct Faults {
    std::atomic<std::int64_t>* calls = nullptr;  ///< shared by all processes
    std::int64_t at = 0;
    int code = 0;
    bool isShort = false, isFull = false;
    std::vector<std::string> folders;
    std::string process;  ///< first argument of the processes that are concerned; "": all are

    Faults() {
        const char *counter = std::getenv("RIGOR_FAULT_COUNTER"), *number = std::getenv("RIGOR_FAULT_AT"),
                   *kind = std::getenv("RIGOR_FAULT_KIND"), *under = std::getenv("RIGOR_FAULT_UNDER");
        if (counter == nullptr || number == nullptr || kind == nullptr || under == nullptr) return;
        if (const char* only = std::getenv("RIGOR_FAULT_PROCESS")) process = only;
        const long file = syscall(SYS_openat, AT_FDCWD, counter, O_RDWR | O_CLOEXEC);
        if (file < 0) return;
        void* memory =
            mmap(nullptr, sizeof *calls, PROT_READ | PROT_WRITE, MAP_SHARED, static_cast<int>(file), 0);
        syscall(SYS_close, file);
        if (memory == MAP_FAILED) return;
        at = std::atoll(number);
        const std::string name = kind;
        isShort = name == "short";
        isFull = name == "full";
        code = name == "EIO" ? EIO : (name == "EINTR" ? EINTR : ENOSPC);
        const std::string list = under;
        for (std::size_t from = 0; from <= list.size();) {
            const std::size_t to = std::min(list.find(':', from), list.size());
            folders.push_back(list.substr(from, to - from) + "/");
            from = to + 1;
        }
        calls = static_cast<std::atomic<std::int64_t>*>(memory);
    }

    bool concerns(const char* path) const {
        if (path == nullptr || (!process.empty() && firstArgument() != process)) return false;
        for (const std::string& folder : folders)
            if (std::strncmp(path, folder.c_str(), folder.size()) == 0) return true;
        return false;
    }
    bool concerns(int descriptor) const {
        char link[64], path[4096];
        std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
        const ssize_t n = readlink(link, path, sizeof path - 1);
        if (n <= 0) return false;
        path[n] = '\0';
        return concerns(path);
    }
    /// Counts a call; true if it is to fail.
    bool hit() {
        const std::int64_t number = ++*calls;
        return at > 0 && (number == at || (isFull && number > at));
    }
};

Faults& faults() {
    static Faults instance;
    return instance;
}

/// True with errno set if a call on this file or path, which is no write, is to fail.
template <class What>
bool fails(What what) {
    Faults& f = faults();
    if (f.calls == nullptr || f.isShort || !f.concerns(what) || !f.hit()) return false;
    errno = f.code;
    return true;
}

enum class Written { Whole, Half, Nothing };

Written fateOfWrite(int descriptor) {
    Faults& f = faults();
    if (f.calls == nullptr || descriptor <= 2 || !f.concerns(descriptor) || !f.hit()) return Written::Whole;
    errno = f.code;
    return f.isShort ? Written::Half : Written::Nothing;
}

std::size_t halfOf(std::size_t count) {
    return count > 1 ? count / 2 : count;
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool opensForWriting(int flags) {
    return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
}

mode_t modeOf(int flags, va_list arguments) {
    return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

// The C library declares some of these with other attributes.
#pragma GCC diagnostic ignored "-Wattributes"

#define RIGOR_OPEN(name)                                             \
    extern "C" int name(const char* path, int flags, ...) {          \
        va_list arguments;                                           \
        va_start(arguments, flags);                                  \
        const mode_t mode = modeOf(flags, arguments);                \
        va_end(arguments);                                           \
        if (opensForWriting(flags) && fails(path)) return -1;        \
        static auto* real = next<int(const char*, int, ...)>(#name); \
        return real(path, flags, mode);                              \
    }
RIGOR_OPEN(open)
RIGOR_OPEN(open64)

#define RIGOR_FOPEN(name)                                                 \
    extern "C" FILE* name(const char* path, const char* mode) {           \
        if (mode[0] != 'r' && fails(path)) return nullptr;                \
        static auto* real = next<FILE*(const char*, const char*)>(#name); \
        return real(path, mode);                                          \
    }
RIGOR_FOPEN(fopen)
RIGOR_FOPEN(fopen64)

extern "C" ssize_t write(int descriptor, const void* bytes, size_t count) {
    const Written fate = fateOfWrite(descriptor);
    if (fate == Written::Nothing) return -1;
    static auto* real = next<ssize_t(int, const void*, size_t)>("write");
    return real(descriptor, bytes, fate == Written::Half ? halfOf(count) : count);
}

#define RIGOR_PWRITE(name)                                                                 \
    extern "C" ssize_t name(int descriptor, const void* bytes, size_t count, off_t at) {   \
        const Written fate = fateOfWrite(descriptor);                                      \
        if (fate == Written::Nothing) return -1;                                           \
        static auto* real = next<ssize_t(int, const void*, size_t, off_t)>(#name);         \
        return real(descriptor, bytes, fate == Written::Half ? halfOf(count) : count, at); \
    }
RIGOR_PWRITE(pwrite)
RIGOR_PWRITE(pwrite64)

extern "C" ssize_t writev(int descriptor, const struct iovec* parts, int count) {
    const Written fate = fateOfWrite(descriptor);
    if (fate == Written::Nothing) return -1;
    static auto* real = next<ssize_t(int, const struct iovec*, int)>("writev");
    return real(descriptor, parts, fate == Written::Half && count > 1 ? count - 1 : count);
}

#define RIGOR_OF_DESCRIPTOR(name)                  \
    extern "C" int name(int descriptor) {          \
        if (fails(descriptor)) return -1;          \
        static auto* real = next<int(int)>(#name); \
        return real(descriptor);                   \
    }
RIGOR_OF_DESCRIPTOR(fsync)
RIGOR_OF_DESCRIPTOR(fdatasync)

/// A network file system reports here what it could not write; the descriptor is closed all the same.
extern "C" int close(int descriptor) {
    static auto* real = next<int(int)>("close");
    const bool isWritable = (fcntl(descriptor, F_GETFL) & (O_WRONLY | O_RDWR)) != 0;
    const bool hasFailed = isWritable && fails(descriptor);
    const int code = errno;
    const int result = real(descriptor);
    if (!hasFailed) return result;
    errno = code;
    return -1;
}

#define RIGOR_TRUNCATE(name)                                   \
    extern "C" int name(int descriptor, off_t size) noexcept { \
        if (fails(descriptor)) return -1;                      \
        static auto* real = next<int(int, off_t)>(#name);      \
        return real(descriptor, size);                         \
    }
RIGOR_TRUNCATE(ftruncate)
RIGOR_TRUNCATE(ftruncate64)

extern "C" int rename(const char* from, const char* to) noexcept {
    if (fails(to)) return -1;
    static auto* real = next<int(const char*, const char*)>("rename");
    return real(from, to);
}

extern "C" int unlink(const char* path) noexcept {
    if (fails(path)) return -1;
    static auto* real = next<int(const char*)>("unlink");
    return real(path);
}

extern "C" int mkdir(const char* path, mode_t mode) noexcept {
    if (fails(path)) return -1;
    static auto* real = next<int(const char*, mode_t)>("mkdir");
    return real(path, mode);
}

extern "C" char* mkdtemp(char* path) noexcept {
    if (fails(path)) return nullptr;
    static auto* real = next<char*(char*)>("mkdtemp");
    return real(path);
}
