// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/studies/derived_columns.hpp"

#include <cstdio>
#include <limits>
#include <map>
#include <memory>

#include "validation/chaos/divergence.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/stored_trajectory.hpp"
#include "validation/statistics/quantile.hpp"
#include "validation/statistics/statistics.hpp"
#include "validation/studies/columns.hpp"
#include "validation/symmetry/symmetry.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}
std::string intervalText(const Interval& i) {
    return "[" + shortNumber(i.low) + ", " + shortNumber(i.high) + "]";
}

struct Stored {
    Trajectory trajectory;
    int contactStride = 1;
};

/// A median over runs with its interval.
StudyValue medianOf(const std::vector<double>& values, const std::string& unit, std::size_t requested) {
    StudyValue v;
    v.unit = unit;
    if (values.empty()) return v;
    v.value = median(values);
    if (const auto interval = medianInterval(values)) {
        v.note = intervalText(*interval);
        v.low = interval->low;
        v.high = interval->high;
    }
    if (values.size() < requested)
        v.note += (v.note.empty() ? "" : " ") + std::string("of ") + std::to_string(values.size()) + "/" +
                  std::to_string(requested);
    return v;
}

class Filler {
  public:
    Filler(StudyResult& result, const StudyPlan& plan, const results::Run& run)
        : result_(result), plan_(plan), run_(run) {
        for (const CaseRow& c : run.cases) cases_[c.id] = &c;
        for (const CasePlan& c : plan.cases) planned_[c.id] = &c;
    }

    void fill(StudyResultRow& row) {
        const auto& part = result_.study.parts[row.row.part];
        divergences_.clear();
        differences_.clear();
        recent_.clear();
        for (std::size_t i = 0; i < part.metrics.size(); ++i) {
            const Column column = columnOf(part.metrics[i]);
            if (column.kind == Column::Kind::Symmetry) row.values[i] = symmetry(row, part, column);
            if (column.kind == Column::Kind::Divergence) row.values[i] = divergence(row, part, column);
            if (column.kind == Column::Kind::Ensemble) row.values[i] = ensemble(row, part, column);
        }
    }

  private:
    const CaseRow* caseOf(const std::string& id) const {
        const auto it = cases_.find(id);
        return it == cases_.end() ? nullptr : it->second;
    }
    /// Null where the case has no trajectory.
    std::shared_ptr<const Stored> stored(const std::string& id) {
        if (const auto it = recent_.find(id); it != recent_.end()) return it->second;
        const CaseRow* row = caseOf(id);
        if (row == nullptr || row->trajectoryFile.empty() || row->outcome != results::Outcome::Completed)
            return nullptr;
        const auto file =
            results::readTrajectory(std::filesystem::path(run_.directory) / row->trajectoryFile);
        auto one = std::make_shared<Stored>(Stored{trajectoryOf(file), file.contactStride});
        return recent_[id] = one;
    }
    /// Value of a case without a number, with the reason; a run that broke is infinitely far.
    StudyValue without(const std::string& id, const std::string& unit) const {
        const CaseRow* row = caseOf(id);
        StudyValue v{std::nullopt, unit, row == nullptr ? "not run" : results::outcomeName(row->outcome)};
        if (row != nullptr && row->outcome != results::Outcome::Unsupported &&
            row->outcome != results::Outcome::Completed)
            v.value = std::numeric_limits<double>::infinity();
        if (row != nullptr && !row->reason.empty()) v.note += ": " + row->reason.substr(0, 120);
        return v;
    }

    // ------------------------------------------------------------------------------------ symmetries
    struct Compared {
        Difference difference;
        std::optional<double> divergenceTime;
        std::string body;
    };
    const Compared* compared(const StudyResultRow& row, const SymmetricCase& one, double threshold) {
        const auto [it, isNew] = differences_.try_emplace(one.caseId);
        if (!isNew) return it->second ? &*it->second : nullptr;
        const auto plain = stored(row.row.plainCase), other = stored(one.caseId);
        if (plain == nullptr || other == nullptr) return nullptr;
        const scenario::Scenario& s = planned_.at(row.row.plainCase)->scenario;
        const Trajectory back = one.back(other->trajectory);
        Compared c;
        c.difference = differenceOf(s, plain->trajectory, back);
        // A film that runs backwards has diverged before it begins.
        if (plain->trajectory.frames() == back.frames() &&
            findSymmetry(one.symmetry)->rerun != Rerun::Reversed)
            c.divergenceTime = divergenceOf(s, plain->trajectory, back, {threshold, 1, 1}).divergenceTime;
        c.body = s.bodies[c.difference.body].name;
        it->second = std::move(c);
        return &*it->second;
    }
    static StudyValue aspectOf(const Compared& c, const std::string& aspect) {
        if (aspect == "angle") return {c.difference.angle, "rad", ""};
        if (aspect == "frames") return {static_cast<double>(c.difference.differing), "1", ""};
        if (aspect == "from")
            return {c.difference.firstDiffering, "s", c.difference.firstDiffering ? "" : "never"};
        if (aspect == kDivergenceTime) return {c.divergenceTime, "s", c.divergenceTime ? "" : "never"};
        std::string note = c.difference.position > 0.0 ? c.body : "";
        if (c.divergenceTime) note += "; diverged at " + shortNumber(*c.divergenceTime) + " s";
        return {c.difference.position, "m", note};
    }
    StudyValue symmetry(const StudyResultRow& row, const scenario::StudyPart& part, const Column& column) {
        StudyValue worst;
        bool any = false;
        for (const SymmetricCase& one : row.row.symmetric) {
            if (one.symmetry != column.name) continue;
            const std::string unit = aspectOf({}, column.aspect).unit;
            StudyValue v{std::nullopt, unit, one.problem};
            if (!one.caseId.empty()) {
                const Compared* c = compared(row, one, part.divergenceThreshold);
                v = c != nullptr ? aspectOf(*c, column.aspect) : without(one.caseId, unit);
            }
            // The worst: the largest distance, the earliest time.
            const bool earliest = column.aspect == "from" || column.aspect == kDivergenceTime;
            if (!any ||
                (v.value && (!worst.value || (earliest ? *v.value < *worst.value : *v.value > *worst.value))))
                worst = v;
            any = true;
        }
        return worst;
    }

    // -------------------------------------------------------------------------------------- divergence
    struct Divergences {
        std::vector<Divergence> all;
        std::size_t requested = 0;
        const scenario::Scenario* scenario = nullptr;
    };
    /// The row's own case against the members of its ensemble, or against the case of a variant.
    const Divergences& divergencesOf(const StudyResultRow& row, const scenario::StudyPart& part,
                                     const std::string& variant) {
        const auto [it, isNew] = divergences_.try_emplace(variant);
        Divergences& p = it->second;
        if (!isNew) return p;
        p.scenario = &planned_.at(row.row.caseId)->scenario;
        std::vector<std::string> others = row.row.members;
        if (!variant.empty()) {
            others.clear();
            if (const StudyRow* other = sameplace(row.row, variant)) others.push_back(other->caseId);
        }
        p.requested = others.size();
        const auto own = stored(row.row.caseId);
        for (const std::string& id : others) {
            const auto other = stored(id);
            if (own == nullptr || other == nullptr || own->trajectory.frames() != other->trajectory.frames())
                continue;
            p.all.push_back(
                divergenceOf(*p.scenario, own->trajectory, other->trajectory,
                             {part.divergenceThreshold, own->contactStride, other->contactStride}));
            recent_.erase(id);
        }
        return p;
    }
    const StudyRow* sameplace(const StudyRow& row, const std::string& variant) const {
        for (const StudyRow& other : plan_.rows)
            if (other.part == row.part && other.scenario == row.scenario && other.dt == row.dt &&
                other.parameters == row.parameters && other.variant == variant)
                return &other;
        return nullptr;
    }
    StudyValue divergence(const StudyResultRow& row, const scenario::StudyPart& part, const Column& column) {
        const std::string unit = column.name == "growth" ? "1/s" : "s";
        if (caseOf(row.row.caseId) == nullptr || column.variant == row.row.variant)
            return {std::nullopt, unit, ""};
        const Divergences& p = divergencesOf(row, part, column.variant);
        std::vector<double> values;
        for (const Divergence& d : p.all) {
            if (column.name == kDivergenceTime && d.divergenceTime) values.push_back(*d.divergenceTime);
            if (column.name == "growth" && d.growth) values.push_back(d.growth->rate);
            if (column.name == "split" && d.split) values.push_back(d.split->time);
        }
        StudyValue v = medianOf(values, unit, p.requested);
        if (p.all.size() == 1 && p.requested == 1)
            v.note = divergenceNote(*p.scenario, p.all.front(), column.name);
        if (!v.value && v.note.empty() && !p.all.empty()) v.note = "never";
        return v;
    }
    static std::string divergenceNote(const scenario::Scenario& s, const Divergence& d,
                                      const std::string& name) {
        const auto body = [&](int i) { return s.bodies[i].name; };
        if (name == kDivergenceTime && d.divergenceTime) return body(d.body);
        if (name == "growth" && d.growth) return intervalText({d.growth->low, d.growth->high});
        if (name == "split" && d.split)
            return body(d.split->bodyA) + " on " + body(d.split->bodyB) +
                   (d.split->inFirst ? ", here alone" : ", there alone");
        return "never";
    }

    // ------------------------------------------------------------------------------------- ensembles
    std::vector<double> memberValues(const StudyRow& row, const std::string& metric,
                                     std::string* unit) const {
        std::vector<double> values;
        for (const std::string& id : row.members) {
            const CaseRow* member = caseOf(id);
            if (member == nullptr) continue;
            const StudyValue v = studyValue(*member, metric);
            if (unit != nullptr && unit->empty()) *unit = v.unit;
            if (v.value && std::isfinite(*v.value)) values.push_back(*v.value);
        }
        return values;
    }
    StudyValue ensemble(const StudyResultRow& row, const scenario::StudyPart&, const Column& column) {
        std::string unit;
        const auto values = memberValues(row.row, column.name, &unit);
        if (column.aspect == "p") {
            const StudyRow* other = sameplace(row.row, column.variant);
            if (other == nullptr || column.variant == row.row.variant) return {std::nullopt, "1", ""};
            const auto others = memberValues(*other, column.name, nullptr);
            if (values.empty() || others.empty()) return {std::nullopt, "1", "no members"};
            const KolmogorovSmirnov test = kolmogorovSmirnov(values, others);
            return {test.p, "1", "D " + shortNumber(test.distance)};
        }
        StudyValue v = medianOf(values, unit, row.row.members.size());
        if (column.aspect.empty()) return v;
        const auto interval = medianInterval(values);
        v.value.reset();
        v.note.clear();
        if (interval) v.value = column.aspect == "low" ? interval->low : interval->high;
        return v;
    }

    StudyResult& result_;
    const StudyPlan& plan_;
    const results::Run& run_;
    std::map<std::string, const CaseRow*> cases_;
    std::map<std::string, const CasePlan*> planned_;
    // Stored cases of the row that is being filled.
    std::map<std::string, std::shared_ptr<const Stored>> recent_;
    std::map<std::string, std::optional<Compared>> differences_;
    std::map<std::string, Divergences> divergences_;
};

}  // namespace

void fillDerivedColumns(StudyResult& result, const StudyPlan& plan, const results::Run& run) {
    Filler filler(result, plan, run);
    for (StudyResultRow& row : result.rows) filler.fill(row);
}

}  // namespace rigor::validation
