// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies behind a contact problem: what M and H say where they are those of rigid bodies.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "adapters/interface/contact_problem.hpp"

namespace rigor::adapter {

/// Three velocities [m/s] and three turning velocities in 3D, two and one in 2D; the axes that those are
/// along are the problem's own.
struct ProblemBody {
    double mass = 0.0;
    std::array<std::array<double, 3>, 3> inertia{};  ///< only (0,0) is used in 2D
    std::array<double, 6> freeVelocity{};            ///< M^-1 f
};
/// A contact's rows: row i is lin . (vB - vA) + angA . wA + angB . wB.
struct ProblemContact {
    int a = -1, b = -1;  ///< bodies; a may be none
    struct Row {
        std::array<double, 3> lin{}, angA{}, angB{};
    };
    std::array<Row, 3> rows;
};
struct ProblemBodies {
    std::vector<ProblemBody> bodies;
    std::vector<ProblemContact> contacts;
};

/// Throws Unsupported saying where M or H are not those of rigid bodies: M consists of blocks of one mass and
/// one inertia, each contact touches one or two bodies, and pushes them equally and oppositely.
ProblemBodies readBodies(const ContactProblem& problem);

}  // namespace rigor::adapter
