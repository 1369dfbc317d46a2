// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cstdio>

#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/references/reference.hpp"

namespace rigor::cli {

scenario::LoadedScenario loadWithReference(const std::string& nameOrFile,
                                           const std::vector<std::string>& overrides,
                                           bool assumptionsMustHold) {
    const auto path = scenario::findScenario(nameOrFile);
    auto loaded = scenario::loadScenario(path, overrides);
    const auto problem = [&](const char* id, const std::exception& error, const char* expected) {
        return scenario::Problem{id,           path.string(), "/reference", loaded.referenceLine,
                                 error.what(), expected};
    };
    try {
        (void)validation::makeReference(loaded.scenario);
    } catch (const validation::AssumptionViolated& error) {
        const auto violated = problem("reference.assumption", error, "values for which the reference holds");
        if (assumptionsMustHold) throw scenario::LoadError({violated});
        std::fprintf(stderr, "%s; it runs without a reference\n", violated.text().c_str());
    } catch (const std::invalid_argument& error) {
        throw scenario::LoadError(
            {problem("reference.invalid", error, "a reference of `rigor list references`")});
    }
    return loaded;
}

bool setsMoreThanBounds(const std::vector<std::string>& overrides) {
    return std::any_of(overrides.begin(), overrides.end(),
                       [](const std::string& text) { return !text.starts_with("accept"); });
}

}  // namespace rigor::cli
