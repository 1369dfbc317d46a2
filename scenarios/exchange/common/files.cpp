// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/files.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace rigor::models {
namespace {

namespace fs = std::filesystem;

/// The rest of `text` behind the prefix, or none.
bool cutPrefix(std::string& text, const char* prefix) {
    if (!text.starts_with(prefix)) return false;
    text.erase(0, std::string_view(prefix).size());
    return true;
}

}  // namespace

AssetFolders::AssetFolders(const fs::path& model, std::vector<fs::path> others) {
    std::error_code error;
    folders_.push_back(fs::weakly_canonical(fs::absolute(model), error).parent_path());
    for (const fs::path& other : others) {
        if (!fs::is_directory(other))
            throw std::invalid_argument("--assets: found '" + other.string() + "', expected a folder");
        folders_.push_back(fs::canonical(other));
    }
}

bool AssetFolders::isInside(const fs::path& file) const {
    return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
        const auto end = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
        return end.first == folder.end();
    });
}

fs::path AssetFolders::find(const std::string& reference, const Place& place, const fs::path& base) const {
    std::string path = reference;
    if (path.find('\0') != std::string::npos || path.empty())
        throw Refusal(place, "a reference to a file without a name");
    std::vector<fs::path> candidates;
    if (cutPrefix(path, "package://") || cutPrefix(path, "model://")) {
        const auto slash = path.find('/');
        for (const fs::path& folder : folders_)
            for (const char* sub : {"", "models"}) {
                candidates.push_back(folder / sub / path);
                if (slash != std::string::npos) candidates.push_back(folder / path.substr(slash + 1));
            }
    } else {
        cutPrefix(path, "file://");
        if (path.find("://") != std::string::npos)
            throw Refusal(place, "'" + reference + "' is to be fetched from a network, which is never done");
        if (!base.empty()) candidates.push_back(base / path);
        for (const fs::path& folder : folders_) candidates.push_back(folder / path);
    }
    bool outside = false;
    for (const fs::path& candidate : candidates) {
        std::error_code error;
        const fs::path file = fs::weakly_canonical(candidate, error);
        if (error || !fs::exists(file, error)) continue;
        if (isInside(file)) return file;
        outside = true;
    }
    throw Refusal(
        place,
        outside
            ? "'" + reference + "' lies outside the folder of the model; --assets FOLDER allows another"
            : "there is no file '" + reference + "' beside the model; --assets FOLDER names other places");
}

TemporaryFile::TemporaryFile(const std::string& prefix, const std::string& text) {
    path_ = (std::filesystem::temp_directory_path() / (prefix + "-XXXXXX")).string();
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw std::runtime_error("no temporary file can be made");
    close(descriptor);
    if (!(std::ofstream(path_, std::ios::binary) << text).flush())
        throw std::runtime_error(path_ + " cannot be written");
}

TemporaryFile::~TemporaryFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
}

Licence findLicence(const fs::path& model) {
    static constexpr std::array<std::pair<const char*, const char*>, 7> kTexts{
        {{"Apache License", "Apache-2.0"},
         {"MIT License", "MIT"},
         {"GNU LESSER GENERAL PUBLIC", "LGPL"},
         {"GNU GENERAL PUBLIC", "GPL"},
         {"Redistribution and use in source and binary forms", "BSD-3-Clause"},
         {"This software is provided 'as-is'", "Zlib"},
         {"Permission is hereby granted, free of charge", "MIT"}}};
    fs::path folder = fs::absolute(model).lexically_normal().parent_path();
    for (int level = 0; level < 3; ++level) {
        for (const char* name : {"LICENSE", "LICENSE.txt", "LICENSE.md", "COPYING", "LICENCE"}) {
            std::error_code error;
            if (!fs::is_regular_file(folder / name, error)) continue;
            std::ifstream in(folder / name, std::ios::binary);
            std::string text(20000, '\0');
            in.read(text.data(), static_cast<std::streamsize>(text.size()));
            for (const auto& [part, spdx] : kTexts)
                if (text.find(part) != std::string::npos) return {spdx, name};
            return {"", name};
        }
        folder = folder.parent_path();
    }
    return {};
}

}  // namespace rigor::models
