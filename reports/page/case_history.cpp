// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/page/case_history.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "reports/encoding/text.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::PairBy;
using results::PairKey;
using results::Run;

/// Key of a history: pairKey, and the preset where a run has several specs of it.
using Key = std::pair<PairKey, std::string>;

/// Keys of which a run has several specs.
std::set<PairKey> severalSpecs(const std::vector<Run>& runs, PairBy by) {
    std::set<PairKey> several;
    if (by != PairBy::Spec) return several;
    for (const Run& run : runs) {
        std::set<PairKey> seen;
        for (const CaseRow& c : run.cases)
            if (!seen.insert(results::pairKey(c, by)).second) several.insert(results::pairKey(c, by));
    }
    return several;
}

[[noreturn]] void refuseSeveral(const Run& run, const CaseRow& one, const CaseRow& other, PairBy by) {
    const std::string name = results::pairByName(by);
    const auto caseText = [](const CaseRow& c) { return "\n  " + c.spec + " dt=" + fullNumber(c.dt); };
    const std::string option = by == PairBy::TimeStep
                                   ? "--dt " + fullNumber(one.dt)
                                   : "--engines " + (by == PairBy::Engine ? one.engine : one.spec);
    throw std::invalid_argument("history --pair " + name + ": found several cases of " + one.scenario +
                                " in " + folderName(run) + " that differ in " + name +
                                " alone, expected one in each run" + caseText(one) + caseText(other) +
                                "\n`rigor validate " + one.scenario + " " + option +
                                " --out FOLDER` makes a run of one; `rigor compare --pair " + name + " " +
                                run.directory + "` compares the cases within the run");
}

}  // namespace

const CaseRow& CaseHistory::newest() const {
    return **std::find_if(cases.rbegin(), cases.rend(), [](const CaseRow* c) { return c != nullptr; });
}

std::vector<CaseHistory> historiesOf(const std::vector<Run>& runs, PairBy by) {
    std::vector<CaseHistory> list;
    std::map<Key, std::size_t> known;
    const auto several = severalSpecs(runs, by);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const ViewModel view(runs[r]);
        std::map<std::string, std::size_t> scenarios;
        for (std::size_t i = 0; i < runs[r].scenarios.size(); ++i) scenarios[runs[r].scenarios[i].name] = i;
        for (const CaseRow& c : runs[r].cases) {
            const auto found = scenarios.find(c.scenario);
            if (found == scenarios.end()) continue;
            const PairKey key = results::pairKey(c, by);
            const auto [at, isNew] =
                known.emplace(Key(key, several.contains(key) ? c.preset : ""), list.size());
            if (isNew) list.emplace_back().cases.resize(runs.size());
            CaseHistory& history = list[at->second];
            history.scenario = &runs[r].scenarios[found->second];
            history.metric = view.mainMetric(found->second);
            if (by != PairBy::Nothing && history.cases[r] != nullptr)
                refuseSeveral(runs[r], *history.cases[r], c, by);
            history.cases[r] = &c;
        }
    }
    return list;
}

std::string folderName(const Run& run) {
    const std::filesystem::path folder(run.directory);
    return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

}  // namespace rigor::report
