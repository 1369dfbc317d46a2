// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The end of a finished run of `validate` or `merge`: its exit code, and what could not be run at all.
#include <cstdio>
#include <map>
#include <string>

#include "cli/command.hpp"
#include "scenarios/model/printable.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::cli {

int endOfRun(const results::Run& run) {
    if (validation::judgesNothing(run)) {
        std::fprintf(stderr,
                     "rigor: nothing was judged: every case is unsupported, the first because of %s\n",
                     scenario::printable(run.cases.front().reason).c_str());
        return kUnsupported;
    }
    if (validation::lacksReferencesAlone(run)) return kNoReference;
    return validation::runIsGreen(run) ? kOk : kRed;
}

void sayIdleEngines(const results::Run& run) {
    if (validation::judgesNothing(run)) return;
    std::map<std::string, const results::CaseRow*>
        idle;  // the first case of each engine; null: another one ran
    for (const auto& c : run.cases) {
        const auto [entry, isFirst] = idle.try_emplace(c.engine, &c);
        if (c.verdict != results::Verdict::Unsupported) entry->second = nullptr;
    }
    for (const auto& [engine, first] : idle)
        if (first != nullptr)
            std::fprintf(stderr, "note: no case of %s was judged, all are unsupported: %s\n",
                         scenario::printable(engine).c_str(), scenario::printable(first->reason).c_str());
}

}  // namespace rigor::cli
