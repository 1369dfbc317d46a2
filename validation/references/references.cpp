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

namespace {

/// References that know a law beside sliding friction; the others are about contacts without it.
enum Law : unsigned { kRolling = 1, kTorsional = 2, kSurfaces = 4 };
constexpr std::pair<const char*, unsigned> kKnownLaws[] = {
    {"conveyor", kRolling | kTorsional | kSurfaces},
    {"measured_motion", kRolling | kTorsional | kSurfaces},
    {"oblique_rolling", kRolling | kTorsional},
    {"rolling_resistance", kRolling | kTorsional},
    {"spinning_disc", kTorsional},
    {"turntable", kSurfaces}};

/// Throws AssumptionViolated where a contact that may happen has a law that the reference does not know.
void requireKnownLaws(const Scenario& scenario, const std::string& name) {
    unsigned known = 0;
    for (const auto& [reference, laws] : kKnownLaws)
        if (name == reference) known = laws;
    const int count = static_cast<int>(scenario.bodies.size());
    const auto check = [&](const scenario::Shape& x, const scenario::Shape& y) {
        const auto pair = pairCoefficients(scenario, x.material, y.material);
        require(pair.rollingFriction == 0.0 || (known & kRolling), name + " knows no rolling friction");
        require(pair.torsionalFriction == 0.0 || (known & kTorsional), name + " knows no torsional friction");
        const bool moves = x.surfaceVelocity.moves() || y.surfaceVelocity.moves();
        require(!moves || (known & kSurfaces), name + " knows no surfaces that move over their bodies");
    };
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b) {
            if (!mayCollide(scenario, a, b)) continue;
            for (const auto& x : scenario.bodies[a].shapes)
                for (const auto& y : scenario.bodies[b].shapes) check(x, y);
        }
}

}  // namespace

std::unique_ptr<Reference> makeReference(const scenario::Scenario& scenario) {
    if (!scenario.reference) return nullptr;
    const ReferenceEntry* entry = findReference(scenario.reference->name);
    if (entry) {
        try {
            requireKnownLaws(scenario, scenario.reference->name);
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
