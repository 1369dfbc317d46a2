// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs with known errors and times, to be compared.
#pragma once

#include <string>

#include "validation/comparison/compare.hpp"

namespace rigor::validation {

/// Eight scenarios, one engine, an error of 0.1 and a step of 1 us in each.
inline results::Run exampleRun() {
    results::Run run;
    run.environment = {{"cpu", "one"}, {"date", "today"}};
    run.engines = {{"ode", "ODE", "0.16", "f64", "", ""}};
    for (int i = 0; i < 8; ++i) {
        results::ScenarioRow s;
        s.name = "s" + std::to_string(i);
        s.text = "{}";
        s.metrics = {"position_max"};
        run.scenarios.push_back(s);
        results::CaseRow c;
        c.scenario = s.name;
        c.spec = "ode";
        c.engine = "ode";
        c.dt = 0.01;
        c.metrics = {{"position_max", "", "m", "exact", 0.1, -1.0, {}, {}, {}, ""},
                     {"position_max", "block", "m", "exact", 0.1, -1.0, {}, {}, {}, ""},
                     {"mean_contacts", "", "1", "cost", 4.0, -1.0, {}, {}, {}, ""}};
        c.timings = {{"step", 1e-6, 1e-6, 1e-6, 1e-4, 100, 0.0}};
        run.cases.push_back(c);
    }
    return run;
}

/// exampleRun() with Bullet beside ODE in two presets, at two steps, Bullet's errors half of ODE's.
inline results::Run fourWays() {
    results::Run run = exampleRun();
    run.cases.resize(1);
    const results::CaseRow one = run.cases[0];
    run.cases.clear();
    for (const double dt : {0.02, 0.01, 0.005})
        for (const char* engine : {"ode", "bullet"})
            for (const char* preset : {"default", "matched"}) {
                results::CaseRow c = one;
                c.engine = engine;
                c.preset = preset;
                c.spec = std::string(engine) + ":preset=" + preset;
                c.dt = dt;
                c.position = run.cases.size();
                c.metrics[0].value = (c.engine == "ode" ? 1.0 : 0.5) * dt;
                run.cases.push_back(c);
            }
    return run;
}

inline CompareOptions by(PairBy pairBy) {
    CompareOptions options;
    options.pairBy = pairBy;
    return options;
}

}  // namespace rigor::validation
