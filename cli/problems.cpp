// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::cli {

void printProblems(const scenario::LoadError& error, bool json) {
    if (!json) {
        for (const auto& problem : error.problems()) std::fprintf(stderr, "%s\n", problem.text().c_str());
        return;
    }
    auto list = nlohmann::json::array();
    for (const auto& p : error.problems())
        list.push_back({{"id", p.id},
                        {"file", p.file},
                        {"pointer", p.pointer},
                        {"line", p.line},
                        {"found", p.found},
                        {"expected", p.expected}});
    std::printf("%s\n", list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

}  // namespace rigor::cli
