// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/scratch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "validation/results/files.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "rigor-scratch-";

/// The lock of a folder stands beside it, so that it goes after the folder.
fs::path lockOf(const fs::path& folder) {
    fs::path lock = folder;
    lock += ".lock";
    return lock;
}

int openLock(const fs::path& file, int flags) {
    int lock = -1;
    do lock = open(file.c_str(), O_RDWR | O_CLOEXEC | flags, 0600);
    while (lock < 0 && errno == EINTR);
    return lock;
}

/// Removes a folder and then its lock. Without a free file handle a folder cannot be read, and only goes if it is empty:
/// one that is left keeps its lock, by which a later run finds it.
void removeWithLock(const fs::path& folder) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    if (!fs::exists(folder, ignored) || fs::remove(folder, ignored)) fs::remove(lockOf(folder), ignored);
}

/// Removes the folders whose owner has ended without removing them: their locks are free.
void removeAbandoned() {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(), ignored)) {
        const fs::path& file = entry.path();
        if (!file.filename().string().starts_with(kPrefix) || file.extension() != ".lock") continue;
        const int lock = openLock(file, 0);
        if (lock < 0) continue;  // The folder belongs to another user.
        if (flock(lock, LOCK_EX | LOCK_NB) == 0) removeWithLock(fs::path(file).replace_extension());
        close(lock);
    }
}

}  // namespace

ScratchFolder::ScratchFolder() {
    removeAbandoned();
    std::string name = (fs::temp_directory_path() / kPrefix).string();
    name += "XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw results::EnvironmentError(name, "cannot be made", errno);
    path_ = name;
    // The lock is held before it has the name under which others look for it.
    fs::path fresh = path_;
    fresh += ".new";
    lock_ = openLock(fresh, O_CREAT | O_EXCL);
    int code = lock_ < 0 ? errno : 0;
    if (code == 0) flock(lock_, LOCK_EX | LOCK_NB);
    if (code == 0 && std::rename(fresh.c_str(), lockOf(path_).c_str()) != 0) code = errno;
    if (code == 0) return;
    std::error_code ignored;
    for (const fs::path& file : {fresh, path_}) fs::remove(file, ignored);
    if (lock_ >= 0) close(lock_);
    throw results::EnvironmentError(lockOf(path_), "cannot be made", code);
}

ScratchFolder::~ScratchFolder() {
    removeWithLock(path_);
    close(lock_);
}

}  // namespace rigor::validation
