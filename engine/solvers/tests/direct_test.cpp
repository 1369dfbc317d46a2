// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Solvers that promise a residual: nsgs on the cone, dantzig and lemke on pyramids.
#include <gtest/gtest.h>

#include "engine/core/tests/counting_new.hpp"
#include "engine/solvers/tests/row_problem.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class Direct : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Direct, Spaces);

template <class S>
std::unique_ptr<Solver<S>> make(const char* name) {
    return findAlgorithm(solverTable<S>(), "solver", name).make();
}
constexpr const char* kPromising[] = {"nsgs", "dantzig", "lemke"};

/// 1e-10 m/s, or some hundred roundings of velocities of a few m/s.
template <class S>
double goal() {
    return sizeof(typename S::Real) == 8 ? 1e-10 : 5e-5;
}

/// Natural map of friction on a pyramid. Box: each tangent by itself. Else the diamond over the tangents.
template <class S>
double pyramidResidual(const RowProblem<S>& p, bool box) {
    double largest = 0;
    for (const Block<S>& block : p.rows.blocks) {
        if (block.kind != BlockKind::Contact || block.rows < 3) continue;
        const Row<S>* rows = p.rows.rows.data() + block.first;
        double r[3], w[3];
        for (int i = 0; i < 3; ++i) {
            r[i] = static_cast<double>(rows[i].impulse);
            w[i] = static_cast<double>(rowVelocity<S>(rows[i], p.velocities[block.a], p.velocities[block.b]));
        }
        const double limit = static_cast<double>(block.friction) * r[0],
                     K = 1 / static_cast<double>(rows[0].invK);
        if (box) {
            for (int t = 1; t < 3; ++t)
                largest = std::max(largest, K * std::abs(r[t] - std::clamp(r[t] - w[t] / K, -limit, limit)));
        } else {
            largest = std::max(largest, K * (std::abs(r[1]) + std::abs(r[2]) - limit));
            // Dissipation is the largest that the diamond allows.
            const double power = -(r[1] * w[1] + r[2] * w[2]),
                         most = limit * std::max(std::abs(w[1]), std::abs(w[2]));
            largest = std::max(largest, (most - power) / std::max(1e-3, std::abs(r[0]) + std::abs(limit)));
        }
    }
    return largest;
}

TYPED_TEST(Direct, KeepTheirPromiseOnRandomProblems) {
    using S = TypeParam;
    for (const char* name : kPromising) {
        const auto solver = make<S>(name);
        const bool cone = std::string(name) == "nsgs" || S::dim == 2;
        int gaveUp = 0;
        for (unsigned seed = 0; seed < 120; ++seed) {
            const double mu = seed % 4 == 0 ? 0 : 0.2 * (seed % 4);
            RowProblem<S> p = randomRowProblem<S>(seed, 2 + static_cast<int>(seed % 3),
                                                  1 + static_cast<int>(seed % 6), mu, seed % 2 == 1);
            p.solve(*solver, 3000);
            ASSERT_TRUE(p.finite()) << name << seed;
            gaveUp += p.gaveUp;
            if (p.gaveUp) continue;
            if (cone || mu == 0) {
                EXPECT_LT(p.residual(), 10 * goal<S>()) << name << " " << seed;
            } else {
                EXPECT_LT(pyramidResidual(p, std::string(name) == "dantzig"), 10 * goal<S>())
                    << name << " " << seed;
            }
        }
        // Some problems with friction have no solution, and neither fixed points nor Gauss-Seidel have a
        // proof of convergence.
        EXPECT_LE(gaveUp, 4) << name;
    }
}

TYPED_TEST(Direct, AgreeWithConvergedGaussSeidelWhereTheSolutionIsUnique) {
    using S = TypeParam;
    for (unsigned seed = 0; seed < 40; ++seed) {
        // Weak friction, one contact on each of two bodies, and joints: the velocities are determined.
        RowProblem<S> reference = randomRowProblem<S>(seed, 3, 0, 0.1, true);
        std::mt19937 random(seed);
        for (std::uint32_t b = 1; b <= 2; ++b)
            reference.addContact(0, b, randomVec<S>(random).normalized(), S::Vec::Zero(),
                                 typename S::Real(0.3) * randomVec<S>(random), 0.1);
        const RowProblem<S> start = reference;
        reference.solve(*make<S>("pgs"), 4000);
        ASSERT_LT(reference.residual(), 10 * goal<S>()) << seed;
        for (const char* name : kPromising) {
            if (S::dim == 3 && std::string(name) != "nsgs") continue;
            RowProblem<S> p = start;
            p.solve(*make<S>(name), 3000);
            ASSERT_FALSE(p.gaveUp) << name << seed;
            for (std::size_t i = 0; i < p.velocities.size(); ++i)
                EXPECT_LT((p.velocities[i].v - reference.velocities[i].v).norm(), 100 * goal<S>())
                    << name << " " << seed << " " << i;
        }
    }
}

/// A block of mass 2 on a slope, pulled by gravity for a step of h: sticks exactly as long as tan a <= mu.
TYPED_TEST(Direct, SlopeHoldsUpToTheCoefficientAndSlidesByTheRest) {
    using S = TypeParam;
    using R = typename S::Real;
    const double h = 0.01, g = 9.81, a = 0.4, little = sizeof(R) == 8 ? 1e-9 : 1e-4;
    std::vector<const char*> solvers{"pgs", "nsgs", "dantzig", "lemke"};
    for (const char* name : solvers) {
        for (const double excess : {-little, little, 0.3, -0.2}) {
            const double mu = std::tan(a) * (1 - excess);
            RowProblem<S> p;
            typename S::Vec v = S::Vec::Zero();
            v[0] = static_cast<R>(h * g * std::sin(a));
            v[1] = static_cast<R>(-h * g * std::cos(a));
            p.addBody(2, 0.3, v);
            // The tangent basis of +y has a tangent along x: pyramids are exact here.
            p.addContact(0, 1, S::Vec::Unit(1), S::Vec::Zero(), S::Vec::Zero(), mu);
            p.solve(*make<S>(name), 100);
            const double expected = std::max(0.0, h * g * (std::sin(a) - mu * std::cos(a)));
            EXPECT_NEAR(p.velocities[1].v[0], expected, sizeof(R) == 8 ? 1e-14 : 1e-7) << name << excess;
            EXPECT_NEAR(p.velocities[1].v[1], 0, sizeof(R) == 8 ? 1e-15 : 1e-7);
            if (excess == 0.3 || excess == -0.2) {
                EXPECT_EQ(std::abs(p.velocities[1].v[0]) > 1e-3, excess > 0) << name;
            }
        }
        // Static friction: holds up to it, slides with the kinetic one beyond.
        for (const double muStatic : {1.02 * std::tan(a), 0.98 * std::tan(a)}) {
            RowProblem<S> p;
            typename S::Vec v = S::Vec::Zero();
            v[0] = static_cast<R>(h * g * std::sin(a));
            v[1] = static_cast<R>(-h * g * std::cos(a));
            p.addBody(2, 0.3, v);
            const double mu = 0.5 * std::tan(a);
            p.addContact(0, 1, S::Vec::Unit(1), S::Vec::Zero(), S::Vec::Zero(), mu, 0, muStatic);
            p.solve(*make<S>(name), 100);
            const double sliding = h * g * (std::sin(a) - mu * std::cos(a));
            EXPECT_NEAR(p.velocities[1].v[0], muStatic > std::tan(a) ? 0 : sliding,
                        sizeof(R) == 8 ? 1e-14 : 1e-7)
                << name << muStatic;
            EXPECT_LT(p.residual(), goal<S>()) << name;
        }
    }
}

TYPED_TEST(Direct, RedundantRowsHaveAFiniteSolution) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const char* name : kPromising) {
        RowProblem<S> p;
        typename S::Vec v = S::Vec::Zero();
        v[0] = R(0.05);
        v[1] = R(-0.1);
        p.addBody(1, 0.2, v);
        for (const double x : {-0.5, 0.5})
            for (const double z : {-0.5, 0.5}) {
                typename S::Vec r = S::Vec::Zero();
                r[0] = R(x);
                r[1] = R(-0.5);
                if (S::dim == 3) r[S::dim - 1] = R(z);
                p.addContact(0, 1, S::Vec::Unit(1), r, r, 0.8);
            }
        // A body held twice by the same joint.
        p.addBody(1, 0.2, v);
        for (int i = 0; i < 2; ++i) p.addBall(0, 2, S::Vec::Unit(1), S::Vec::Zero());
        p.solve(*make<S>(name), 1000);
        // Nsgs in single precision may end a few roundings above its own goal; the residual below still
        // holds.
        EXPECT_FALSE(p.gaveUp && sizeof(R) == 8) << name;
        ASSERT_TRUE(p.finite()) << name;
        const bool box = S::dim == 3 && std::string(name) == "dantzig";
        EXPECT_LT(box ? pyramidResidual(p, true) : static_cast<double>(p.residual()), goal<S>()) << name;
        for (const Row<S>& row : p.rows.rows) EXPECT_LT(std::abs(row.impulse), 1) << name;
    }
}

TYPED_TEST(Direct, ContradictionsAreFlaggedAndFinite) {
    using S = TypeParam;
    for (const char* name : kPromising) {
        RowProblem<S> p;
        p.addBody(1, 0.2, S::Vec::Unit(0));
        p.addBall(0, 1, S::Vec::Zero(), S::Vec::Zero(), 1);
        p.addBall(0, 1, S::Vec::Zero(), S::Vec::Zero(), -1);
        p.solve(*make<S>(name), 50);
        EXPECT_TRUE(p.gaveUp) << name;
        EXPECT_TRUE(p.finite()) << name;
    }
}

TYPED_TEST(Direct, SteadyStepsDoNotAllocateAndRepeatTheirBits) {
    using S = TypeParam;
    for (const char* name : kPromising) {
        const auto solver = make<S>(name);
        const RowProblem<S> start = randomRowProblem<S>(5, 4, 6, 0.4, true);
        RowProblem<S> first = start, second = start;
        first.solve(*solver, 500);
        QuietMonitor<S> monitor;
        const FrictionLaw<S> cone = findAlgorithm(frictionTable<S>(), "friction", "cone").make;
        const long before = allocationCount();
        solver->solve({second.rows, second.velocities, cone, monitor, 500, typename S::Real(0.01), false,
                       typename S::Real(1e-10), 4});
        EXPECT_EQ(allocationCount(), before) << name;
        RowProblem<S> fresh = start;
        fresh.solve(*make<S>(name), 500);
        for (std::size_t i = 0; i < first.rows.rows.size(); ++i)
            EXPECT_EQ(first.rows.rows[i].impulse, fresh.rows.rows[i].impulse) << name;
    }
}

TYPED_TEST(Direct, MorePyramidDirectionsComeCloserToTheCone) {
    using S = TypeParam;
    if constexpr (S::dim == 3) {
        using R = typename S::Real;
        for (const double angle : {0.3, 0.7, 1.1}) {
            double last = 1;
            for (const int directions : {4, 8, 32, 2}) {
                RowProblem<S> p;
                p.addBody(1, 0.2, {R(std::cos(angle)), R(-0.5), R(std::sin(angle))});
                p.addContact(0, 1, S::Vec::Unit(1), S::Vec::Zero(), S::Vec::Zero(), 0.6);
                p.solve(*make<S>("lemke"), 50, "cone", directions);
                ASSERT_FALSE(p.gaveUp);
                const typename S::Vec v = p.velocities[1].v;
                // Coulomb takes 0.3 m/s off, along the slip.
                const double error =
                    std::hypot(double(v[0]) - 0.7 * std::cos(angle), double(v[2]) - 0.7 * std::sin(angle));
                if (directions == 2) {
                    EXPECT_LT(error, goal<S>()) << "the line of the slip is exact here";
                } else {
                    EXPECT_LT(error, last);
                }
                // The nearest direction is off by at most pi / D.
                EXPECT_LT(error, 0.3 * 2 * std::sin(1.5708 / directions) + goal<S>());
                last = error + goal<S>();
            }
        }
    }
}

TYPED_TEST(Direct, NaturalMapIsZeroOnlyForTheLaw) {
    using S = TypeParam;
    using R = typename S::Real;
    RowProblem<S> p;
    typename S::Vec v = S::Vec::Zero();
    v[0] = R(1);
    p.addBody(1, 0.2, v);
    p.addContact(0, 1, S::Vec::Unit(1), S::Vec::Zero(), S::Vec::Zero(), 0.5);
    Row<S>* rows = p.rows.rows.data();
    EXPECT_EQ(p.residual(), 0) << "open and separating at no speed: no impulse is right";
    rows[0].impulse = R(2);
    EXPECT_GT(p.residual(), 0.1) << "pressed and sliding without friction";
    p.rows.blocks[0].friction = 0;
    EXPECT_EQ(p.residual(), 0) << "right without friction";
    p.velocities[1].v[1] = R(-0.25);
    EXPECT_NEAR(p.residual(), 0.25, 1e-6) << "approaching";
    p.velocities[1].v[1] = R(0.25);
    EXPECT_NEAR(p.residual(), 0.25, 1e-6) << "pressed and separating";
    p.velocities[1].v[1] = 0;
    p.rows.blocks[0].friction = R(0.5);
    for (int t = 1; t <= S::tangents; ++t) {
        const R along = rows[t].lin[0];
        rows[t].impulse = -along;  // mu r_n against the slip
    }
    EXPECT_NEAR(p.residual(), 0, 1e-6);
    for (int t = 1; t <= S::tangents; ++t) rows[t].impulse = -rows[t].impulse;
    EXPECT_GT(p.residual(), 0.1) << "friction with the slip";
    p.velocities[1].v[0] = 0;
    EXPECT_NEAR(p.residual(), 0, 1e-6) << "stuck: any impulse in the cone";
    p.velocities[1].v[1] = R(-0.25);
    EXPECT_NEAR(p.residual(), 0.25, 0.1) << "approaching";
}

}  // namespace
}  // namespace rigor::engine::test
