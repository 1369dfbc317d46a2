// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/studies/columns.hpp"

#include <algorithm>
#include <stdexcept>

#include "validation/metrics/metric.hpp"
#include "validation/runner/cost.hpp"
#include "validation/studies/audit_columns.hpp"
#include "validation/symmetry/symmetry.hpp"

namespace rigor::validation {
namespace {

/// Cuts the last of `aspects` that the text ends with, with its dot.
std::string cutAspect(std::string& text, std::initializer_list<const char*> aspects) {
    for (const std::string aspect : aspects)
        if (text.ends_with("." + aspect)) {
            text.resize(text.size() - aspect.size() - 1);
            return aspect;
        }
    return "";
}

std::string cutVariant(std::string& text, std::size_t colon) {
    if (colon == std::string::npos) return "";
    const std::string variant = text.substr(colon + 1);
    text.resize(colon);
    return variant;
}

bool isDivergence(const std::string& name) {
    return name == kDivergenceTime || name == kOldDivergenceTime || name == "growth" || name == "split";
}

std::string auditFieldNames() {
    std::string names;
    for (const std::string& field : auditFields()) names += (names.empty() ? "" : ", ") + field;
    return names;
}

bool isOfCase(const std::string& metric) {
    if (metric.starts_with("time.") || metric.starts_with("quantity.")) return true;
    if (metric.starts_with(kAuditPrefix)) {
        const auto fields = auditFields();
        return std::find(fields.begin(), fields.end(), metric.substr(std::string(kAuditPrefix).size())) !=
               fields.end();
    }
    const std::string name = metric.substr(0, metric.find(':'));
    return isCostMetric(name) || findMetric(name) != nullptr;
}

/// Problem of a column of the part; "" if there is none.
std::string columnProblem(const scenario::StudyPart& part, const Column& column) {
    const auto listed = [](const auto& list, const auto& is) {
        return std::any_of(list.begin(), list.end(), is);
    };
    if (!column.variant.empty() && column.kind != Column::Kind::OfCase &&
        !listed(part.variants, [&](const auto& v) { return v.name == column.variant; }))
        return "the name of a variant behind the colon";
    switch (column.kind) {
        case Column::Kind::Symmetry:
            return listed(part.symmetries, [&](const auto& s) { return s == column.name; })
                       ? ""
                       : "one of the part's symmetries";
        case Column::Kind::Divergence:
            return part.ensemble || !column.variant.empty() ? "" : "an ensemble, or a variant behind a colon";
        case Column::Kind::Ensemble:
            if (!part.ensemble) return "an ensemble in this part";
            [[fallthrough]];
        default:
            return isOfCase(column.name) ? ""
                                         : "a name of `rigor list metrics`, " + costMetricNames() +
                                               ", order.METRIC, quantity.NAME, time.PHASE, symmetry.NAME, "
                                               "divergence_time, growth, split, "
                                               "ensemble.METRIC or audit. and one of " +
                                               auditFieldNames();
    }
}

}  // namespace

Column columnOf(const std::string& text) {
    Column column{Column::Kind::OfCase, text, "", ""};
    const auto rest = [&](const std::string& prefix) { return text.substr(prefix.size()); };
    if (text.starts_with(kOrderPrefix)) {
        column.kind = Column::Kind::Order;
        column.name = rest(kOrderPrefix);
    } else if (text.starts_with("symmetry.")) {
        column.kind = Column::Kind::Symmetry;
        column.name = rest("symmetry.");
        column.aspect =
            cutAspect(column.name, {"angle", "frames", "from", kDivergenceTime, kOldDivergenceTime});
        if (column.aspect == kOldDivergenceTime) column.aspect = kDivergenceTime;
    } else if (text.starts_with("ensemble.")) {
        column.kind = Column::Kind::Ensemble;
        column.name = rest("ensemble.");
        const auto p = column.name.find(".p:");
        column.variant = cutVariant(column.name, p == std::string::npos ? p : p + 2);
        column.aspect = cutAspect(column.name, {"low", "high", "p"});
    } else if (isDivergence(text.substr(0, text.find(':')))) {
        column.kind = Column::Kind::Divergence;
        column.variant = cutVariant(column.name, column.name.find(':'));
        if (column.name == kOldDivergenceTime) column.name = kDivergenceTime;
    }
    return column;
}

void checkColumn(const scenario::StudyPart& part, const std::string& column) {
    if (const std::string expected = columnProblem(part, columnOf(column)); !expected.empty())
        throw std::invalid_argument("study part '" + part.name + "': found metric '" + column +
                                    "', expected " + expected);
}

void nameSymmetries(scenario::StudyPart& part) {
    std::vector<std::string> names;
    for (const std::string& requested : part.symmetries) {
        if (requested != "*" && findSymmetry(requested) == nullptr)
            throw std::invalid_argument("study part '" + part.name + "': found symmetry '" + requested +
                                        "', expected one of " + symmetryNames() + ", or *");
        for (const SymmetryEntry& entry : symmetryTable())
            if ((requested == "*" || requested == entry.name) &&
                std::find(names.begin(), names.end(), entry.name) == names.end())
                names.push_back(entry.name);
    }
    part.symmetries = names;
    for (const std::string& name : names)
        if (std::find(part.metrics.begin(), part.metrics.end(), "symmetry." + name) == part.metrics.end())
            part.metrics.push_back("symmetry." + name);
}

}  // namespace rigor::validation
