// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/environment.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

#include "validation/hash.hpp"

namespace rigor::validation {
namespace {

/// The value after `separator` of the first line that starts with `key`.
std::string valueIn(const char* file, const std::string& key, char separator) {
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {
        if (!line.starts_with(key)) continue;
        const auto at = line.find(separator);
        if (at == std::string::npos) continue;
        std::string value = line.substr(line.find_first_not_of(" \t\"", at + 1));
        value.erase(value.find_last_not_of(" \t\"") + 1);
        return value;
    }
    return "unknown";
}

/// "unknown" where there is no such file: virtual machines do not report their clock.
std::string firstWord(const char* file) {
    std::ifstream in(file);
    std::string word;
    return in >> word ? word : "unknown";
}

/// Caches of the first processor: "L1d 48K, L2 1024K, L3 32768K".
std::string caches() {
    std::string text;
    for (int i = 0; i < 8; ++i) {
        const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(i) + "/";
        const std::string type = firstWord((folder + "type").c_str());
        if (type == "unknown" || type == "Instruction") continue;
        text += (text.empty() ? "L" : ", L") + firstWord((folder + "level").c_str()) +
                (type == "Data" ? "d " : " ") + firstWord((folder + "size").c_str());
    }
    return text.empty() ? "unknown" : text;
}

/// A hash by which machines differ, without their names.
std::string machine(const char* name) {
    Fnv1a hash;
    hash.text(name);
    hash.text(firstWord("/etc/machine-id"));
    return hash.hex();
}

std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#else
    return "unknown";
#endif
}

}  // namespace

std::map<std::string, std::string> describeEnvironment() {
    struct utsname system {};
    uname(&system);
    const long pages = sysconf(_SC_PHYS_PAGES), pageSize = sysconf(_SC_PAGESIZE);
    return {{"cpu", valueIn("/proc/cpuinfo", "model name", ':')},
            {"cores", std::to_string(sysconf(_SC_NPROCESSORS_ONLN))},
            {"caches", caches()},
            {"memory", std::to_string(pages / 1024 * pageSize / 1024) + " MiB"},
            {"kernel", std::string(system.sysname) + " " + system.release + " " + system.machine},
            {"system", valueIn("/etc/os-release", "PRETTY_NAME", '=')},
            {"compiler", compiler()},
            {"build_type", RIGOR_BUILD_TYPE},
            {"flags", RIGOR_BUILD_FLAGS},
            {"libraries", RIGOR_LIBRARIES},
            {"governor", firstWord("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")},
            {"load", firstWord("/proc/loadavg")},
            {"machine", machine(system.nodename)},
            {"rigor", RIGOR_VERSION},
            {"date", isoTime()}};
}

std::string isoTime() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

}  // namespace rigor::validation
