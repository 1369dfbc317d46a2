// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The double pendulum of the study `chaos`, integrated without any engine: what the divergence time and
// growth are to be.
#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/loader/loader.hpp"
#include "validation/chaos/divergence.hpp"
#include "validation/chaos/perturb.hpp"
#include "validation/references/reference.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

constexpr double kFrame = 1.0 / 60.0;

/// The scene as it is at time t of a reference's motion.
scenario::Scenario continuedFrom(const scenario::Scenario& s, const Reference& reference, double t) {
    scenario::Scenario next = s;
    for (const int i : reference.bodies()) {
        const PartialState exact = reference.exact(i, t);
        scenario::Body& body = next.bodies[i];
        body.pose = {exact.position.value(), exact.orientation.value()};
        body.velocity = exact.velocity.value();
        body.angularVelocity = exact.angularVelocity.value();
    }
    return next;
}

/// Motion of the exact solution, in pieces of which each begins where the last has ended: a reference is not
/// valid over a time in which neighbours diverge by as much as here.
Trajectory exactMotion(const scenario::Scenario& s) {
    constexpr int kPiece = 90;  // frames; neighbours part twenty times as far in it
    Trajectory t;
    t.dt = kFrame;
    t.bodyCount = s.bodies.size();
    scenario::Scenario piece = s;
    auto reference = makeReference(piece);
    for (int k = 0; k * kFrame <= s.duration + 1e-9; ++k) {
        if (k > 0 && k % kPiece == 0) {
            piece = continuedFrom(piece, *reference, kPiece * kFrame);
            reference = makeReference(piece);
        }
        const double within = k % kPiece * kFrame;
        EXPECT_LE(within, reference->validUntil());
        t.times.push_back(k * kFrame);
        t.contacts.emplace_back();
        for (int i = 0; i < static_cast<int>(t.bodyCount); ++i) {
            const PartialState exact = reference->exact(i, within);
            t.states.push_back({exact.position.value(), exact.orientation.value(), {}, {}});
        }
    }
    return t;
}

struct Medians {
    double divergenceTime, rate;
};

Medians divergenceTimes(double angle, const std::string& duration) {
    const auto s = scenario::loadScenario(scenario::findScenario("double_pendulum_2d"),
                                          {"generators.0.chain.direction=[0.6,0.8]", "duration=" + duration})
                       .scenario;
    const Trajectory base = exactMotion(s);
    std::vector<double> times, rates;
    for (std::uint32_t member = 1; member <= 3; ++member) {
        scenario::Scenario other = perturbed(s, {0.0, angle, 0.0, 0.0}, 1, member);
        other.reference = s.reference;
        const Divergence d = divergenceOf(s, base, exactMotion(other), {0.01, 1, 1});
        EXPECT_TRUE(d.divergenceTime && d.growth) << member;
        if (!d.divergenceTime || !d.growth) continue;
        EXPECT_GT(d.growth->low, 1.0);
        times.push_back(*d.divergenceTime);
        rates.push_back(d.growth->rate);
    }
    if (times.empty()) return {};
    return {median(times), median(rates)};
}

/// The numbers that the findings of the study name: of seven starts 5.10 s, 1.965/s, 8.60 s, 2.141/s.
TEST(DoublePendulum, PartsLaterFromASmallerStart) {
    const Medians large = divergenceTimes(1e-6, "7"), small = divergenceTimes(1e-9, "10.5");
    EXPECT_NEAR(large.divergenceTime, 5.10, 0.2);
    EXPECT_NEAR(large.rate, 1.97, 0.06);
    EXPECT_NEAR(small.divergenceTime, 8.60, 0.2);
    EXPECT_NEAR(small.rate, 2.14, 0.06);
    // A thousandth of the difference: ln 1000 / rate later.
    EXPECT_NEAR((small.divergenceTime - large.divergenceTime) * small.rate, std::log(1000.0),
                0.15 * std::log(1000.0));
}

}  // namespace
}  // namespace rigor::validation
