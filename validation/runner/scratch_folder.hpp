// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <filesystem>

namespace rigor::validation {

/// A folder for requests and results that goes away with its owner. Those of owners that were killed go away when the
/// next one is made. Throws results::EnvironmentError.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace rigor::validation
