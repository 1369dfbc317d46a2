// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files that a model refers to. They must lie in the folder of the model or in one that the user names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/exchange/common/report.hpp"

namespace rigor::models {

class AssetFolders {
  public:
    AssetFolders(const std::filesystem::path& model, std::vector<std::filesystem::path> others);
    /// The file that a reference names: a path from `base` (inside the folders), "package://NAME/PATH" or
    /// "model://NAME/PATH" (found below one of the folders), "file://PATH". Throws Refusal for files that do
    /// not exist, lie elsewhere or are to be fetched from a network.
    std::filesystem::path find(const std::string& reference, const Place& place,
                               const std::filesystem::path& base = {}) const;

  private:
    bool isInside(const std::filesystem::path& file) const;
    std::vector<std::filesystem::path> folders_;  ///< absolute and without links; the model's own first
};

/// A file of this text that goes away with this object.
class TemporaryFile {
  public:
    /// Throws std::runtime_error where none can be written.
    TemporaryFile(const std::string& prefix, const std::string& text);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

/// A licence file beside a model or in a folder above it, and the SPDX name that its text shows; "" where none
/// is found or known.
struct Licence {
    std::string name, file;
};
Licence findLicence(const std::filesystem::path& model);

}  // namespace rigor::models
