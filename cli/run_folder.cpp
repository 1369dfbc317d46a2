// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/run_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <set>
#include <stdexcept>
#include <utility>

#include "validation/results/store.hpp"

namespace rigor::cli {

namespace fs = std::filesystem;

fs::path chooseRunFolder(const std::string& out, bool resume, const std::string& title) {
    if (!out.empty()) return out;
    const fs::path runs = "runs";
    if (resume) {
        if (!fs::exists(runs / "latest"))
            throw std::invalid_argument("--resume: there is no runs/latest; name the run with --out");
        return fs::canonical(runs / "latest");
    }
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char stamp[32];
    std::strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", &utc);
    std::string name = title;
    for (char& c : name)
        if (c == ' ' || c == '/') c = '+';
    std::error_code ignored;
    fs::create_directories(runs, ignored);
    // Each of the runs that start in the same second makes a folder of its own.
    const std::string first = name.substr(0, 60) + "-" + stamp;
    fs::path directory = runs / first;
    for (int n = 2; !fs::create_directory(directory, ignored) && fs::exists(directory); ++n)
        directory = runs / (first + "-" + std::to_string(n));
    fs::remove(runs / "latest", ignored);
    fs::create_directory_symlink(directory.filename(), runs / "latest", ignored);
    return directory;
}

void prepareRunFolder(const fs::path& directory, bool resume) {
    if (resume && !results::wasBegun(directory))
        throw std::invalid_argument("--resume: '" + directory.string() + "' holds no run");
    if (!resume && results::holdsStore(directory))
        throw std::invalid_argument("--out: '" + directory.string() +
                                    "' holds a run already; add --resume or choose another folder");
    std::error_code error;
    fs::create_directories(directory, error);
    if (!error && access(directory.c_str(), W_OK) != 0)
        error = std::error_code(errno, std::generic_category());
    if (error)
        throw std::invalid_argument("--out: cannot write '" + directory.string() + "': " + error.message());
}

void checkResumed(const fs::path& directory, const std::vector<validation::CasePlan>& plan) {
    results::RunOutline stored;
    try {
        stored = results::readOutline(directory);
    } catch (const std::exception&) {
        return;  // killed before anything was stored; the runner judges the rest
    }
    std::set<std::pair<std::string, std::string>> planned;
    for (const auto& c : plan) planned.emplace(c.scenario.name, c.spec.text());
    for (const auto& row : stored.cases) {
        if (!planned.contains({row.scenario, row.spec}))
            throw std::invalid_argument(
                "--resume: '" + directory.string() + "' holds " + row.scenario + " on " + row.spec +
                ", which this command does not request; it was started by: " + stored.command);
    }
}

std::string commandToGoOn(std::string command, const fs::path& directory, bool resumed, bool namesFolder) {
    if (!resumed && results::wasBegun(directory)) command += " --resume";
    if (!namesFolder) command += " --out " + directory.string();
    return command;
}

}  // namespace rigor::cli
