// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Siconos' solvers on problems whose solutions are known by hand, in the order and the units of the interface.
#include <gtest/gtest.h>

#include <cmath>

#include "adapters/interface/registry.hpp"

namespace rigor::test {
namespace {

using adapter::ContactProblem;

const adapter::Engine& engine() {
    static const adapter::LoadedEngine loaded{RIGOR_MODULE};
    return *loaded;
}
std::unique_ptr<adapter::ContactSolve> take(const std::string& solver, const ContactProblem& problem) {
    const auto spec = adapter::parseSpec("siconos:solver=" + solver);
    return engine().contactSolvers()->take(problem, adapter::resolveSettings(spec, engine()));
}

/// A point of this mass with a free velocity over a floor, normal first.
ContactProblem massPoint(double mass, double mu, const std::vector<double>& velocity) {
    ContactProblem p;
    p.dimension = static_cast<int>(velocity.size());
    p.mu = {mu};
    p.q = velocity;
    p.W.assign(velocity.size() * velocity.size(), 0.0);
    for (std::size_t i = 0; i < velocity.size(); ++i) p.W[i * velocity.size() + i] = 1.0 / mass;
    return p;
}

/// A point of 2 kg at (-3, 2, 1) m/s with mu 0.3 goes on sliding: r_N = 6 N s, |r_T| = 1.8 N s against the velocity.
TEST(Siconos, ASlidingPointIsBrakedAsFarAsItsConeAllows) {
    const ContactProblem point = massPoint(2.0, 0.3, {-3.0, 2.0, 1.0});
    for (const char* solver :
         {"nsgs", "nsn_ac", "nsn_fb", "nsn_nm", "admm", "proximal", "tresca", "vi_fpp", "vi_eg"}) {
        SCOPED_TRACE(solver);
        const auto solve = take(solver, point);
        EXPECT_EQ(solve->friction().kind, adapter::FrictionModel::Kind::Cone);
        const auto found = solve->run(2000, 1e-12);
        EXPECT_FALSE(found.gaveUp);
        EXPECT_GE(found.iterations, 1);
        EXPECT_NEAR(found.r[0], 6.0, 1e-8);
        EXPECT_NEAR(found.r[1], -1.8 * 2.0 / std::sqrt(5.0), 1e-8);
        EXPECT_NEAR(found.r[2], -1.8 * 1.0 / std::sqrt(5.0), 1e-8);
        const auto again = solve->run(2000, 1e-12);  // the second run starts from r = 0 as well
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(again.r[i], found.r[i], 1e-9);
    }
}

TEST(Siconos, AnIterationIsAllThatItIsGiven) {
    ContactProblem chain = massPoint(1.0, 0.5, {-1.0, 0.2, 0.1, -1.0, 0.0, 0.3});
    chain.dimension = 3;
    chain.mu = {0.5, 0.5};
    for (std::size_t i = 0; i < 3; ++i) chain.W[i * 6 + i + 3] = chain.W[(i + 3) * 6 + i] = 0.6;
    const auto solve = take("nsgs", chain);
    EXPECT_EQ(solve->run(1, 0.0).iterations, 1);
    const auto early = solve->run(1, 0.0).r, late = solve->run(500, 1e-13).r;
    EXPECT_GT(std::abs(early[0] - late[0]), 1e-4);
}

TEST(Siconos, InTwoDimensionsItHasOtherSolvers) {
    const ContactProblem point = massPoint(2.0, 0.3, {-3.0, 2.0});
    for (const char* solver : {"nsgs", "lemke"}) {
        SCOPED_TRACE(solver);
        const auto found = take(solver, point)->run(1000, 1e-12);
        EXPECT_NEAR(found.r[0], 6.0, 1e-8);
        EXPECT_NEAR(found.r[1], -1.8, 1e-8);
    }
    EXPECT_THROW(take("admm", point), adapter::Unsupported);
    EXPECT_THROW(take("lemke", massPoint(2.0, 0.3, {-3.0, 2.0, 1.0})), adapter::Unsupported);
}

/// W is given by rows. This one sticks: r = -W^-1 q, r_T = -0.1 and r_N = 1 + 0.3 * 0.1; transposed r_T would be -0.4.
TEST(Siconos, TheMatrixIsNotTransposed) {
    ContactProblem point = massPoint(1.0, 0.5, {-1.0, 0.1, 0.0});
    point.W[1] = 0.3;
    const auto found = take("nsgs", point)->run(1000, 1e-13);
    EXPECT_NEAR(found.r[0], 1.03, 1e-9);
    EXPECT_NEAR(found.r[1], -0.1, 1e-9);
}

}  // namespace
}  // namespace rigor::test
