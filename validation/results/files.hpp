// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Reading and writing of whole files. What the system refuses (no space, no permission, no file handles, a
// missing folder) is an EnvironmentError, which says nothing about an engine.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rigor::results {

/// The environment of the program failed: its disk, its permissions, its limits, or a signal from outside. It is
/// never a result of a case: a run stops, and `--resume` goes on once the cause is gone.
class EnvironmentError : public std::runtime_error {
  public:
    /// `code`: errno, 0 if there is none. The message is "PATH: WHAT: No space left on device (ENOSPC)".
    EnvironmentError(const std::filesystem::path& path, const std::string& what, int code);
    /// A message that is complete as it stands.
    explicit EnvironmentError(const std::string& message) : std::runtime_error(message) {}
    int code() const { return code_; }

  private:
    int code_ = 0;
};

/// "No space left on device (ENOSPC)"; "" for 0.
std::string errorText(int code);

/// Throws EnvironmentError, also where there is no such file.
std::string readFile(const std::filesystem::path& file);

/// Replaces `file` at once: it is the old one or the whole new one, never a part, and the new one is on the disk
/// when this returns. Throws EnvironmentError and leaves no part behind.
void replaceFile(const std::filesystem::path& file, std::string_view content);

/// As replaceFile, for files that need not outlive the system: nothing waits for the disk.
void replaceScratchFile(const std::filesystem::path& file, std::string_view content);

/// Makes a folder and those above it. Throws EnvironmentError.
void createFolders(const std::filesystem::path& folder);

/// Adds to the content of a file the line by which `unsealed` recognises it.
std::string sealed(std::string content);
/// Length of the line that sealed() adds.
std::size_t sealLength();

enum class Seal { Absent, Good, Bad };
/// Checks the last line of `content` and removes it if it is a seal.
Seal removeSeal(std::string& content);

}  // namespace rigor::results
