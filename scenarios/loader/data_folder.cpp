// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/data_folder.hpp"

#include <dlfcn.h>
#include <link.h>

namespace rigor::scenario {
namespace {

namespace fs = std::filesystem;

/// The file that the dynamic linker took this code from.
fs::path ownFile() {
    Dl_info info{};
    link_map* map = nullptr;
    const auto* here = reinterpret_cast<const void*>(&dataFolder);
    const bool found = dladdr1(here, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
    std::error_code error;
    // The program itself has no name in the map.
    if (!found || map == nullptr || map->l_name == nullptr || *map->l_name == '\0')
        return fs::read_symlink("/proc/self/exe", error);
    return fs::canonical(map->l_name, error);
}

}  // namespace

fs::path dataFolder() {
    std::error_code error;
    for (fs::path folder = ownFile().parent_path(); folder.has_relative_path(); folder = folder.parent_path())
        if (fs::path data = folder / "share/rigor"; fs::is_directory(data / "scenarios", error)) return data;
    return {};
}

fs::path templateFile(const fs::path& path) {
    return dataFolder() / "templates" / path;
}

fs::path sourceFolder() {
    std::error_code error;
    const fs::path folder = fs::canonical(templateFile(""), error);
    return fs::exists(folder / "cmake" / "RigorInstall.cmake", error) ? folder : fs::path();
}

std::string programName() {
    const std::string launcher = "./rigor";
    return sourceFolder().empty() ? launcher.substr(2) : launcher;
}

}  // namespace rigor::scenario
