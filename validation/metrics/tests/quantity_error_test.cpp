// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Errors of forces between bodies at rest: runs that report no impulses have none, runs without contacts are wrong.
#include <gtest/gtest.h>

#include <optional>

#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

TEST(QuantityError, ForcesThatAreNotReportedAreNoErrors) {
    Scenario scenario = emptyScene(2, {0, -9.81, 0}, 2);
    scenario.materials[0].friction = 0.5;
    setReference(scenario, "static_equilibrium");
    addFloor(scenario);
    addBox(scenario, "box", {0.5, 0.25, 0}, 2, {0, 0.25, 0});
    const auto reference = makeReference(scenario);
    Trajectory run = exactRun(scenario, *reference, 0.01, 40);
    const auto errorOf = [&](const char* name) -> std::optional<double> {
        const MetricInput input{scenario, run, reference.get(), adapter::Scheme::Unknown};
        for (const auto& row : findMetric("quantity_error")->evaluate(input))
            if (row.subject == name) return row.value;
        return std::nullopt;
    };
    EXPECT_EQ(errorOf("force_floor_box"), 1.0);
    adapter::ContactPoint contact;
    contact.bodyB = 1;
    for (auto& contacts : run.contacts) contacts.push_back(contact);
    EXPECT_EQ(errorOf("force_floor_box"), std::nullopt);
    EXPECT_EQ(errorOf("moves"), 0.0);
    for (auto& contacts : run.contacts) {
        contacts[0].hasImpulse = true;
        contacts[0].normalImpulse = 0.75 * 0.01 * 2 * 9.81;
    }
    EXPECT_NEAR(errorOf("force_floor_box").value_or(-1.0), 0.25, 1e-9);
}

}  // namespace
}  // namespace rigor::validation::testing
