// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engines that a study names and that are not installed.
#include <algorithm>
#include <map>

#include "adapters/interface/registry.hpp"
#include "validation/studies/study.hpp"

namespace rigor::validation {
namespace {

/// The reason why a variant's engine can not be had; empty if it can.
std::string absence(const scenario::StudyVariant& variant) {
    try {
        (void)adapter::moduleFor(adapter::parseSpec(variant.engine));
        return "";
    } catch (const adapter::BadInput& error) {
        const std::string why = error.what();
        return why.substr(0, why.find("; known engines"));
    }
}

void removeVariants(scenario::StudyPart& part, const std::vector<std::string>& names) {
    const auto isGone = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    std::erase_if(part.variants, [&](const auto& variant) { return isGone(variant.name); });
    std::erase_if(part.findings, [&](const auto& finding) { return isGone(finding.variant); });
    if (part.symptom && (isGone(part.symptom->fault) || isGone(part.symptom->cure))) part.symptom.reset();
}

}  // namespace

std::vector<std::string> leaveOutAbsent(scenario::Study& study) {
    if (!study.leaveOutAbsent) return {};
    std::map<std::string, std::string> reasons;  // key: the engine
    for (scenario::StudyPart& part : study.parts) {
        std::vector<std::string> gone;
        for (const scenario::StudyVariant& variant : part.variants)
            if (const std::string why = absence(variant); !why.empty()) {
                gone.push_back(variant.name);
                reasons.emplace(adapter::parseSpec(variant.engine).engine, why);
            }
        removeVariants(part, gone);
    }
    std::erase_if(study.parts, [](const auto& part) { return part.variants.empty(); });
    std::vector<std::string> lines;
    for (const auto& [engine, why] : reasons) lines.push_back(engine + " is left out: " + why);
    return lines;
}

}  // namespace rigor::validation
