// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Any step of any run as a contact problem, from what the engine said of it: the states before the step and
// the contacts it acted upon, with the scenario's masses, forces and coefficients.
//     M      mass and inertia, world axes, of each dynamic body in the order of the scenario
//     f      M v + h (m g + F),  I w + h (T - w x I w), F and T the scenario's forces; damping times that
//     H      of each contact the normal, then the tangents: -d, -(rA x d) on A and d, rB x d on B
//     w      what static and kinematic surfaces move by; normal: s/h for a gap s, or e times the velocity
//            before the step where the surfaces touch and approach
//     mu     of sliding
// Known limits: gyroscopic torque is that of explicit Euler (an error of h^2 for spinning bodies without
// symmetry); what an engine does to remove overlap is no part of the problem; static friction above that of
// sliding has no place in the form (and is refused). Joints that hold are bilateral constraints; limits,
// motors and springs are none (refused).
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "validation/contact_problems/problem.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// Wrench on a body during a step, gravity not included.
struct AppliedLoad {
    scenario::Vec3 force, torque;
};

/// One step as an engine reported it.
struct RecordedStep {
    double dt = 0.0;
    std::vector<BodyState> before, after;  ///< states by scenario index
    std::vector<ContactPoint> contacts;
    adapter::ContactInstant contactInstant = adapter::ContactInstant::StepStart;
    /// The states that the contacts belong to.
    const std::vector<BodyState>& atContacts() const {
        return contactInstant == adapter::ContactInstant::StepEnd ? after : before;
    }
    std::vector<AppliedLoad> loads;  ///< loads by scenario index
};

/// The problem of a step, complete, with the engine's own solution as the stored one (r if it reported all
/// impulses, v and u from its states after the step). Throws Unsupported for what the form has no place for,
/// BadInput where there are no contacts.
ExportedProblem exportStep(const scenario::Scenario& scenario, const RecordedStep& step);

/// Loads of the scenario's forces and events during the step from step * dt.
std::vector<AppliedLoad> loadsOf(const scenario::Scenario& scenario, std::size_t step, double dt,
                                 std::span<const BodyState> states);

struct ExportRequest {
    std::string scenarioText, scenarioName;  ///< JSON, overrides applied
    adapter::EngineSpec spec;
    double dt = 0.0;
    std::size_t step = 1;  ///< the first is 1
};
/// Runs the engine in this process up to that step.
RecordedStep runToStep(const scenario::Scenario& scenario, const ExportRequest& request);

struct ExportSummary {
    std::size_t contacts = 0, bodies = 0;
    double time = 0.0;           ///< time at which the step ends
    double storedResidual = -1;  ///< relative natural map of the engine's own solution; -1: no impulses
                                 ///< reported
};
/// The same in a child process, to `file`. Throws Unsupported, BadInput, and std::runtime_error for a crash.
ExportSummary exportToFile(const ExportRequest& request, const std::filesystem::path& binary,
                           const std::filesystem::path& file);
/// The child's side: `__export <request.json>`.
int exportChild(const std::filesystem::path& request);

}  // namespace rigor::validation
