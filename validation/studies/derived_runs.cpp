// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/studies/derived_runs.hpp"

#include <algorithm>
#include <stdexcept>

#include "scenarios/loader/write.hpp"
#include "validation/chaos/perturb.hpp"
#include "validation/hash.hpp"
#include "validation/results/store.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/stored_trajectory.hpp"
#include "validation/symmetry/symmetry.hpp"

namespace rigor::validation {
namespace {

constexpr const char* kPlain = "plain";
constexpr int kThreads[] = {2, 4};

/// A scenario made by a program: named after what was done, and loaded as its text will be.
scenario::LoadedScenario asFile(scenario::Scenario s, const std::string& base, const std::string& tail,
                                const std::string& title) {
    s.name = derivedName(base, tail);
    s.title += " (" + title + ")";
    s.reference.reset();
    s.accept.clear();
    s.knownDeviations.clear();
    s.tags.push_back("derived");  // reports give it no page of its own
    const std::string text = scenario::scenarioText(s);
    return scenario::loadScenarioText(text, s.name);
}

CasePlan casePlan(const scenario::LoadedScenario& loaded, const adapter::EngineSpec& spec, double dt) {
    return planCases({{loaded.scenario, loaded.text}}, {spec}, {dt}).front();
}

/// The pending time reversal of a row, or null.
SymmetricCase* pendingReversal(StudyRow& row) {
    for (SymmetricCase& c : row.symmetric)
        if (findSymmetry(c.symmetry)->rerun == Rerun::Reversed && c.caseId.empty() && c.problem.empty())
            return &c;
    return nullptr;
}

template <class List>
auto byId(const List& list) {
    std::map<std::string, const typename List::value_type*> map;
    for (const auto& one : list) map[one.id] = &one;
    return map;
}

}  // namespace

std::string derivedName(const std::string& base, const std::string& tail) {
    constexpr std::size_t kMost = 64;
    const std::string whole = base + "." + tail;
    if (whole.size() <= kMost) return whole;
    Fnv1a hash;
    hash.text(base);
    const std::string end = "-" + hash.hex().substr(0, 8) + "." + tail;
    return base.substr(0, kMost - std::min(end.size(), kMost - 1)) + end;
}

void DerivedRunPlanner::add(const CasePlan& one) {
    if (planned_.insert(one.id).second) plan_.cases.push_back(one);
}

std::string DerivedRunPlanner::addCase(const Made& made, const adapter::EngineSpec& spec, double dt) {
    const CasePlan one = casePlan(made.loaded, spec, dt);
    add(one);
    return one.id;
}

const DerivedRunPlanner::Made& DerivedRunPlanner::symmetric(const CasePlan& own,
                                                            const std::string& symmetry) {
    const auto [it, isNew] = made_.try_emplace(own.scenario.name + "\n" + symmetry);
    Made& made = it->second;
    if (!isNew) return made;
    if (symmetry == kPlain) {
        made.loaded = asFile(own.scenario, own.scenario.name, kPlain, "written in full");
        return made;
    }
    const SymmetryEntry& entry = *findSymmetry(symmetry);
    made.problem = entry.obstacle(own.scenario);
    if (!made.problem.empty() || entry.rerun == Rerun::Reversed) return made;
    Transformed other = entry.apply(own.scenario, nullptr);
    made.timeFactor = other.timeFactor;
    made.back = std::move(other.back);
    made.loaded = asFile(std::move(other.scenario), own.scenario.name, symmetry, entry.title);
    return made;
}

const DerivedRunPlanner::Made& DerivedRunPlanner::member(const CasePlan& own, const scenario::StudyPart& part,
                                                         int number) {
    const std::string tail = part.name + "-" + std::to_string(number);
    const auto [it, isNew] = made_.try_emplace(own.scenario.name + "\nmember\n" + tail);
    if (!isNew) return it->second;
    const scenario::StudyEnsemble& e = *part.ensemble;
    it->second.loaded =
        asFile(perturbed(own.scenario, {e.position, e.angle, e.velocity, e.spin}, e.seed, number),
               own.scenario.name, tail, "start " + std::to_string(number) + " beside it");
    return it->second;
}

bool DerivedRunPlanner::hasThreads(const std::string& engine) {
    const auto [it, isNew] = threads_.try_emplace(engine, false);
    if (isNew && options_)
        for (const adapter::Option& option : options_(engine)) it->second |= option.key == "threads";
    return it->second;
}

void DerivedRunPlanner::addSymmetric(StudyRow& row, const CasePlan& own, const std::string& symmetry) {
    const Made& made = symmetric(own, symmetry);
    SymmetricCase one{symmetry, "", made.problem, made.back};
    if (findSymmetry(symmetry)->rerun != Rerun::Threads) {
        if (one.problem.empty() && made.back) one.caseId = addCase(made, own.spec, own.dt * made.timeFactor);
        row.symmetric.push_back(std::move(one));
        return;
    }
    if (!hasThreads(own.spec.engine)) {
        one.problem = "the engine has no key 'threads'";
        row.symmetric.push_back(std::move(one));
        return;
    }
    for (const int threads : kThreads) {
        adapter::EngineSpec spec = own.spec;
        spec.options["threads"] = std::to_string(threads);
        one.caseId = addCase(made, spec, own.dt);
        row.symmetric.push_back(one);
    }
}

void DerivedRunPlanner::addTo(StudyRow& row, const scenario::StudyPart& part, const CasePlan& own) {
    if (!part.symmetries.empty()) row.plainCase = addCase(symmetric(own, kPlain), own.spec, own.dt);
    for (const std::string& symmetry : part.symmetries) addSymmetric(row, own, symmetry);
    for (int k = 1; part.ensemble && k <= part.ensemble->members; ++k)
        row.members.push_back(addCase(member(own, part, k), own.spec, own.dt));
}

bool extendPlan(StudyPlan& plan, const results::Run& stored) {
    const auto rows = byId(stored.cases);
    std::vector<CasePlan> more;
    for (StudyRow& row : plan.rows) {
        SymmetricCase* pending = pendingReversal(row);
        const auto it = rows.find(row.plainCase);
        if (pending == nullptr || it == rows.end()) continue;
        if (it->second->trajectoryFile.empty()) {
            pending->problem = "the first run did not end";
            continue;
        }
        const auto first = std::find_if(plan.cases.begin(), plan.cases.end(),
                                        [&](const CasePlan& c) { return c.id == row.plainCase; });
        try {
            const Trajectory forward = trajectoryOf(results::readTrajectory(
                std::filesystem::path(stored.directory) / it->second->trajectoryFile, false));
            Transformed other = findSymmetry(pending->symmetry)->apply(first->scenario, &forward);
            pending->back = std::move(other.back);
            more.push_back(
                casePlan(asFile(std::move(other.scenario), row.scenario,
                                pending->symmetry + "-" + row.plainCase.substr(0, 8), "there and back"),
                         first->spec, first->dt));
            pending->caseId = more.back().id;
        } catch (const std::exception& error) {
            pending->problem = error.what();
        }
    }
    std::set<std::string> known;
    for (const CasePlan& c : plan.cases) known.insert(c.id);
    bool added = false;
    for (CasePlan& c : more)
        if (known.insert(c.id).second) {
            plan.cases.push_back(std::move(c));
            added = true;
        }
    return added;
}

void extendFromFolder(StudyPlan& plan, const std::filesystem::path& folder) {
    try {
        results::Run stored = results::readRun(folder);
        stored.directory = folder.string();
        (void)extendPlan(plan, stored);
    } catch (const std::exception&) {  // killed before anything was stored
    }
}

results::Run runStudyCases(StudyPlan& plan, RunOptions options,
                           const std::function<void(const Progress&)>& onProgress,
                           const std::atomic<bool>& interrupted) {
    results::Run run = runCases(plan.cases, options, onProgress, interrupted);
    while (!interrupted && extendPlan(plan, run)) {
        options.resume = true;
        run = runCases(plan.cases, options, onProgress, interrupted);
    }
    return run;
}

}  // namespace rigor::validation
