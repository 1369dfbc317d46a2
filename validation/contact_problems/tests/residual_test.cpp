// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The natural map where the solution is known by hand, and its projection against a search.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/contact_problems/residual.hpp"
#include "validation/contact_problems/tests/small_problems.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::FrictionModel;

TEST(Residual, VanishesWhereAContactOpensSticksOrSlides) {
    const double m = 2.0, mu = 0.5;
    // leaves: nothing acts
    EXPECT_EQ(contactResidual(massPoint(m, mu, {1, 3, -4}).problem, {0, 0, 0}).absolute, 0.0);
    // sticks: |v_t| < mu |v_n|
    EXPECT_NEAR(contactResidual(massPoint(m, mu, {-2, 0.3, 0.4}).problem, {4, -0.6, -0.8}).absolute, 0,
                1e-15);
    // slides: mu m |v_n| against v_t / |v_t|
    EXPECT_NEAR(contactResidual(massPoint(m, mu, {-2, 3, -4}).problem, {4, -1.2, 1.6}).absolute, 0, 1e-15);
    EXPECT_NEAR(contactResidual(massPoint(m, mu, {-2, 5}).problem, {4, -2}).absolute, 0, 1e-15);
    EXPECT_NEAR(contactResidual(massPoint(m, mu, {-2, -0.5}).problem, {4, 1}).absolute, 0, 1e-15);
}

TEST(Residual, WrongAnswersHaveTheSizeOfTheirError) {
    const auto p = massPoint(1, 0.5, {-2, 3, -4}).problem;
    // Nothing done: r - u - mu |u| e = (2 - 2.5, -3, 4); projected on the cone: n = (2.5 - 0.5)/1.25 = 1.6
    const ContactResidual idle = contactResidual(p, {0, 0, 0});
    EXPECT_NEAR(idle.absolute, std::hypot(1.6, 0.8), 1e-14);
    EXPECT_NEAR(idle.relative, std::hypot(1.6, 0.8) / std::sqrt(29.0), 1e-14);
    EXPECT_NEAR(idle.penetration, 2.0, 1e-15);
    EXPECT_EQ(idle.cone, 0.0);
    // Friction of 3 where 1 is allowed.
    const ContactResidual glue = contactResidual(p, {2, -1.8, 2.4});
    EXPECT_NEAR(glue.cone, (3.0 - 1.0) / 2.0, 1e-14);
    EXPECT_NEAR(glue.penetration, 0.0, 1e-15);
    EXPECT_GT(glue.relative, 0.1);
    EXPECT_EQ(contactResidual(p, {std::nan(""), 0, 0}).relative, std::numeric_limits<double>::infinity());
}

/// The residual of both pyramids' exact solutions vanishes; their residual for the cone is the model error.
TEST(Residual, APerfectPyramidIsSeenAsSuch) {
    const auto p = massPoint(1, 0.5, {-2, 3, -4}).problem;
    const ContactResidual box = contactResidual(p, {2, -1, 1}, {FrictionModel::Kind::Box});
    EXPECT_NEAR(box.own, 0.0, 1e-15);
    EXPECT_GT(box.relative, 0.01);
    EXPECT_NEAR(box.cone, (std::sqrt(2.0) - 1.0) / 2.0, 1e-14);
    // All of a square's friction along the faster component.
    const ContactResidual square = contactResidual(p, {2, 0, 1}, {FrictionModel::Kind::Polygon, 4});
    EXPECT_NEAR(square.own, 0.0, 1e-15);
    EXPECT_GT(square.relative, 0.01);
    EXPECT_EQ(square.cone, 0.0);
    const auto plane = massPoint(1, 0.5, {-2, 3}).problem;
    for (const auto kind : {FrictionModel::Kind::Box, FrictionModel::Kind::Polygon})
        EXPECT_NEAR(contactResidual(plane, {2, -1}, {kind, 2}).own, 0.0, 1e-15);
}

/// The nearest point of the cone by search over its surface and axis.
TEST(Residual, ProjectsOntoTheConesNearestPoint) {
    for (int k = 0; k < 60; ++k) {
        const double mu = 0.1 + 0.03 * k, n = std::sin(1.7 * k), t1 = std::cos(2.3 * k),
                     t2 = std::sin(3.1 * k);
        // The map for W = 0 and q = 0 is r - P(r).
        ExportedProblem exported = massPoint(1, mu, {0, 0, 0});
        exported.problem.W.assign(9, 0.0);
        const double defect = contactResidual(exported.problem, {n, t1, t2}).absolute;
        const double t = std::hypot(t1, t2);
        double nearest = std::hypot(n, t);
        if (t <= mu * n) nearest = 0.0;
        for (int i = 0; i <= 200000 && nearest > 0.0; ++i) {
            const double pN = 3e-5 * i;
            nearest = std::min(nearest, std::hypot(n - pN, t - mu * pN));
        }
        EXPECT_NEAR(defect, nearest, 1e-8) << k;
    }
}

}  // namespace
}  // namespace rigor::validation::testing
