// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/hygiene/tests/source_tree.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace rigor::hygiene {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = RIGOR_SOURCE_DIR;
constexpr std::array<const char*, 8> kFolders{"engine",  "adapters", "scenarios", "validation",
                                              "reports", "cli",      "cmake",     ".ci"};

}  // namespace

std::vector<std::string> sourceFiles(const std::vector<std::string>& endings) {
    std::vector<std::string> files;
    const auto consider = [&](const fs::path& path) {
        const std::string name = fs::relative(path, kRoot).string();
        for (const auto& ending : endings)
            if (name.ends_with(ending)) {
                files.push_back(name);
                return;
            }
    };
    for (const char* folder : kFolders)
        for (auto it = fs::recursive_directory_iterator(kRoot / folder);
             it != fs::recursive_directory_iterator(); ++it) {
            if (it->path().filename() == "node_modules") it.disable_recursion_pending();
            if (it->is_regular_file()) consider(it->path());
        }
    for (const auto& entry : fs::directory_iterator(kRoot))
        if (entry.is_regular_file()) consider(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string readFile(const std::string& relativePath) {
    std::ifstream in(kRoot / relativePath, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + relativePath);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool exists(const std::string& relativePath) {
    return fs::exists(kRoot / relativePath);
}

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

}  // namespace rigor::hygiene
