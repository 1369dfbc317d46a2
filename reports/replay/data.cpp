// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/replay/data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "reports/encoding/data_files.hpp"
#include "reports/encoding/json.hpp"
#include "reports/model/view_model.hpp"
#include "reports/replay/events.hpp"
#include "reports/replay/frames.hpp"
#include "validation/results/array_bundle.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;
using results::TrajectoryFile;
using Indices = std::vector<std::size_t>;

/// Thinnings from all frames to the marked ones alone: the first that fits the allowance is taken.
constexpr std::array<Thinning, 12> kThinnings{{{kMostReplayFrames, 20, 16, true, 1},
                                               {kMostReplayFrames, 17, 14, true, 1},
                                               {200, 16, 13, true, 1},
                                               {150, 16, 13, true, 1},
                                               {120, 15, 12, false, 1},
                                               {100, 15, 12, false, 2},
                                               {75, 15, 11, false, 2},
                                               {50, 14, 11, false, 4},
                                               {30, 14, 10, false, 6},
                                               {16, 13, 10, false, 0},
                                               {8, 13, 10, false, 0},
                                               {2, 13, 10, false, 0}}};
/// A thinning that would need more than this part of what is allowed too much, judged by how well the one
/// before was compressed, is not tried: compressing costs far more time than encoding.
constexpr double kHopeless = 1.35;
/// Compression level for estimates: a few percent larger than the strongest and several times faster.
constexpr int kQuick = 4;

struct CaseFrames {
    const CaseRow* row = nullptr;
    TrajectoryFile file;
    double length = 0.0;
    std::vector<ReplayEvent> events;
};

Json eventJson(const ReplayEvent& e) {
    Json json{{"time", number(e.time)}, {"kind", e.kind}};
    if (!e.what.empty()) json["what"] = e.what;
    if (!e.subject.empty()) json["subject"] = e.subject;
    if (!std::isnan(e.value)) {
        json["value"] = number(e.value);
        json["unit"] = e.unit;
    }
    if (e.threshold > 0.0) json["threshold"] = number(e.threshold);
    if (!e.text.empty()) json["text"] = e.text;
    if (e.contact >= 0) json["contact"] = e.contact;
    return json;
}

/// Estimated size in the data file, without the savings by bodies that are equal in other cases.
std::size_t compressedSize(const EncodedFrames& frames) {
    std::string all;
    for (const Bytes* bytes :
         {&frames.steps, &frames.position, &frames.orientation, &frames.velocity, &frames.angularVelocity,
          &frames.contactCounts, &frames.contactIds, &frames.contactNumbers})
        all.append(bytes->begin(), bytes->end());
    return gzip(all, kQuick).size();
}

Indices marksOf(const std::vector<ReplayEvent>& events) {
    Indices marks;
    for (const auto& event : events) marks.push_back(event.frame);
    std::sort(marks.begin(), marks.end());
    marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
    return marks;
}

/// Frames of one case within the allowance.
struct Thinned {
    EncodedFrames frames;
    Indices kept;
    double bytes = 0.0;
};

Thinned thinned(const CaseFrames& c, double allowance) {
    const Indices marks = marksOf(c.events);
    const auto multiple = static_cast<std::size_t>(std::max(1, c.file.contactStride));
    Thinned out;
    double ratio = 0.04;  // gzip does no better on such bytes
    for (const Thinning& thinning : kThinnings) {
        const bool last = &thinning == &kThinnings.back();
        out.kept = keptFrames(c.file.times.size(), thinning.frames, multiple, marks);
        out.frames = encodeFrames(c.file, false, c.length, out.kept, marks, thinning);
        const auto raw = static_cast<double>(out.frames.size());
        if (!last && raw * ratio > kHopeless * allowance) continue;
        out.bytes = compressedSize(out.frames);
        ratio = out.bytes / std::max(1.0, raw);
        if (last || out.bytes <= allowance) break;
    }
    return out;
}

void addArrays(results::ArrayBundle& bundle, const std::string& prefix, const EncodedFrames& frames) {
    const auto add = [&](const char* name, const Bytes& bytes) {
        if (!bytes.empty()) bundle.add(prefix + name, std::span<const std::uint8_t>(bytes));
    };
    add(".steps", frames.steps);
    add(".position", frames.position);
    add(".orientation", frames.orientation);
    add(".velocity", frames.velocity);
    add(".angularVelocity", frames.angularVelocity);
    add(".contactCounts", frames.contactCounts);
    add(".contactIds", frames.contactIds);
    add(".contactNumbers", frames.contactNumbers);
}

std::string labelOf(const ViewModel& view, const std::string& spec) {
    for (const auto& column : view.columns())
        if (column.spec == spec) return column.label;
    return spec;
}

Json caseJson(const ViewModel& view, const CaseRow& row) {
    return {{"id", row.id},
            {"spec", row.spec},
            {"engine", row.engine},
            {"label", labelOf(view, row.spec)},
            {"outcome", results::outcomeName(row.outcome)},
            {"reason", row.reason}};
}

/// Poses of all bodies at the start: those of bodies that never move are nowhere else.
std::vector<double> firstPoses(const TrajectoryFile& file) {
    std::vector<double> out;
    for (const auto& body : file.bodies) {
        for (std::size_t k = 0; k < 3; ++k)
            out.push_back(k < body.position.values.size() ? body.position.values[k] : 0.0);
        for (std::size_t k = 0; k < 4; ++k)
            out.push_back(k < body.orientation.values.size() ? body.orientation.values[k]
                                                             : (k == 0 ? 1.0 : 0.0));
    }
    return out;
}

/// The exact states at all times that a case has, from the first one that has them.
void addReference(const std::vector<CaseFrames>& cases, const Indices& times, results::ArrayBundle& bundle,
                  ReplayBudget& budget, Json& meta) {
    meta["reference"] = nullptr;
    for (const auto& c : cases) {
        if (c.file.reference.empty() || c.row->outcome != results::Outcome::Completed) continue;
        Indices kept;
        for (const std::size_t f : times)
            if (f < c.file.times.size()) kept.push_back(f);
        EncodedFrames frames = encodeFrames(c.file, true, c.length, kept, {}, kThinnings.front());
        frames.meta["stride"] = c.file.stride;
        budget.spendBeside(compressedSize(frames));
        addArrays(bundle, "reference", frames);
        meta["reference"] = std::move(frames.meta);
        return;
    }
}

void addEngineDivergences(std::vector<CaseFrames>& cases) {
    for (auto& c : cases)
        for (const auto& other : cases) {
            if (&c == &other || c.file.times.empty()) continue;
            ReplayEvent event = engineDivergenceOf(c.file, other.file, kDivergenceFraction * c.length);
            if (event.frame < c.file.times.size()) c.events.push_back(std::move(event));
        }
    for (auto& c : cases)
        std::stable_sort(c.events.begin(), c.events.end(),
                         [](const auto& a, const auto& b) { return a.frame < b.frame; });
}

std::vector<CaseFrames> loadCases(const ViewModel& view, std::size_t scenario, double dt,
                                  const FullTrajectoryLoader& load) {
    std::vector<CaseFrames> out;
    for (std::size_t column = 0; column < view.columns().size(); ++column)
        for (const auto* row : view.cell(scenario, column).cases) {
            if (row->dt != dt) continue;
            CaseFrames c;
            c.row = row;
            if (auto file = load(*row)) c.file = std::move(*file);
            c.length = sceneLength(c.file);
            c.events = replayEvents(c.file, *row);
            out.push_back(std::move(c));
        }
    addEngineDivergences(out);
    return out;
}

}  // namespace

ReplayBudget::ReplayBudget(std::size_t cases)
    : perCase_(std::min(kReplayBytesPerCase, kReplayBytesOfRun / std::max<std::size_t>(cases, 1))) {}

double ReplayBudget::allowance() const {
    return std::clamp(perCase_ + saved_ / 4.0, perCase_ / 4.0, kReplayBytesAtMost);
}

std::string replayBundle(const ViewModel& view, std::size_t scenario, std::size_t step,
                         const FullTrajectoryLoader& load, ReplayBudget& budget) {
    const auto& shown = view.run().scenarios[scenario];
    const double dt = replaySteps(view, scenario).at(step);
    const auto cases = loadCases(view, scenario, dt, load);
    const auto fullest = std::max_element(cases.begin(), cases.end(), [](const auto& a, const auto& b) {
        return a.file.bodies.size() < b.file.bodies.size();
    });
    if (fullest == cases.end() || fullest->file.bodies.empty()) return "";

    results::ArrayBundle bundle;
    Json names = Json::array(), list = Json::array();
    for (const auto& body : fullest->file.bodies) names.push_back(body.name);
    const auto poses = firstPoses(fullest->file);
    bundle.add("first", std::span<const double>(poses));
    Json meta{{"kind", "replay"}, {"scenario", shown.name}, {"dt", dt}, {"bodies", names}};
    Indices times;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto& c = cases[i];
        Json entry = caseJson(view, *c.row);
        entry["frames"] = 0;
        if (!c.file.times.empty()) {
            const Thinned kept = thinned(c, budget.allowance());
            budget.spend(kept.bytes);
            entry.update(kept.frames.meta);
            entry["stored"] = c.file.times.size();  // frames of the HDF5 file
            entry["stride"] = c.file.stride;
            entry["events"] = Json::array();
            for (const auto& event : c.events) entry["events"].push_back(eventJson(event));
            addArrays(bundle, std::to_string(i), kept.frames);
            times.insert(times.end(), kept.kept.begin(), kept.kept.end());
        }
        list.push_back(std::move(entry));
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    addReference(cases, times, bundle, budget, meta);
    meta["cases"] = std::move(list);
    return bundle.bytes(meta);
}

std::vector<double> replaySteps(const ViewModel& view, std::size_t scenario) {
    std::set<double, std::greater<>> steps;
    for (std::size_t column = 0; column < view.columns().size(); ++column)
        for (const auto* row : view.cell(scenario, column).cases) steps.insert(row->dt);
    return {steps.begin(), steps.end()};
}

std::string replayName(std::size_t scenario, std::size_t step) {
    return "replay-" + std::to_string(scenario) + "-" + std::to_string(step);
}

ReplayBudget replayBudget(const ViewModel& view) {
    const auto& cases = view.run().cases;
    return ReplayBudget(std::count_if(cases.begin(), cases.end(),
                                      [](const CaseRow& row) { return !row.trajectoryFile.empty(); }));
}

void replayFiles(const ViewModel& view, std::size_t scenario, const FullTrajectoryLoader& load,
                 ReplayBudget& budget,
                 const std::function<void(const std::string& name, const std::string& bundle)>& write) {
    for (std::size_t step = 0; step < replaySteps(view, scenario).size(); ++step)
        if (const std::string bundle = replayBundle(view, scenario, step, load, budget); !bundle.empty())
            write(replayName(scenario, step), bundle);
}

}  // namespace rigor::report
