// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of references, from references.def.
#include "validation/references/parts.hpp"
#include "validation/references/reference.hpp"

#include <cstring>

namespace rigor::validation {

#define REFERENCE(name, maker, title, formula, tex, source) \
    std::unique_ptr<Reference> maker(const scenario::Scenario&, const scenario::ReferenceSpec&);
#include "validation/references/references.def"
#undef REFERENCE

const std::vector<ReferenceEntry>& referenceTable() {
    static const std::vector<ReferenceEntry> table{
#define REFERENCE(name, maker, title, formula, tex, source) {#name, title, formula, tex, source, &maker},
#include "validation/references/references.def"
#undef REFERENCE
    };
    return table;
}

const ReferenceEntry* findReference(const std::string& name) {
    for (const auto& entry : referenceTable())
        if (name == entry.name) return &entry;
    return nullptr;
}

std::unique_ptr<Reference> makeReference(const scenario::Scenario& scenario) {
    if (!scenario.reference) return nullptr;
    const ReferenceEntry* entry = findReference(scenario.reference->name);
    if (entry) {
        try {
            auto reference = entry->make(scenario, *scenario.reference);
            requireClearWay(scenario, *reference);
            return reference;
        } catch (const AssumptionViolated&) {
            throw;
        } catch (const std::runtime_error& numerical) {
            throw AssumptionViolated(std::string("no reference to the required accuracy: ") +
                                     numerical.what());
        }
    }
    std::string names;
    for (const auto& known : referenceTable()) names += (names.empty() ? "" : ", ") + std::string(known.name);
    throw std::invalid_argument("unknown reference '" + scenario.reference->name + "'; known: " + names);
}

PartialState Reference::exact(int, double) const {
    return {};
}

std::optional<PartialState> Reference::schemeExact(int, std::size_t, double, adapter::Scheme) const {
    return std::nullopt;
}

std::vector<Quantity> Reference::quantities(double, adapter::Scheme) const {
    return {};
}

std::optional<PartialState> Reference::measured(int, double) const {
    return std::nullopt;
}

}  // namespace rigor::validation
