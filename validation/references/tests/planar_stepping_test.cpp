// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// planar_motion of boxes that bounce, rock and slide against a second method that has nothing in common with
// it: Moreau's time stepping, impulses at the corners by projected Gauss-Seidel in every step. Its error is
// of the order of the step, and is estimated by a run with half the step. The end of the motion is tested
// too.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "validation/references/planar/planar_events.hpp"
#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation::testing {
namespace {

using State = PlanarMotion::State;

struct RandomBox {
    PlanarMotion::Setup setup;
    State start;
};

/// A box dropped from up to 0.3 m, or one that begins with a corner on the floor.
RandomBox randomBox(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    RandomBox box;
    const double b = uniform(0.05, 0.5);
    const double h = uniform(0.05, 0.5);
    PlanarMotion::Setup& s = box.setup;
    s.corners = {{-b, -h, 0}, {b, -h, 0}, {b, h, 0}, {-b, h, 0}};
    s.mass = uniform(0.5, 3);
    s.inertia = s.mass * (b * b + h * h) / 3 * uniform(0.7, 1.3);
    s.pullAbove = -9.81L;
    s.friction = uniform(0, 1) < 0.15 ? 0 : uniform(0, 1);
    s.restitution = uniform(0.02, 0.9);
    s.size = std::hypot(b, h);
    box.start.angle = uniform(-0.6, 0.6);
    const double drop = uniform(0, 1) < 0.3 ? 0 : uniform(0.0, 0.3);
    box.start.vx = uniform(-1.5, 1.5);
    box.start.rate = uniform(-3, 3);
    const double side = box.start.angle > 0 ? -1 : 1;
    const auto angle = static_cast<double>(box.start.angle);
    const double across = std::cos(angle) * side * b + std::sin(angle) * h;
    box.start.z = std::cos(angle) * h - std::sin(angle) * side * b + drop;
    box.start.vz = drop > 0 ? uniform(-1, 0.5) : static_cast<double>(-box.start.rate) * across;
    return box;
}

class Stepping {
  public:
    explicit Stepping(const RandomBox& box) : setup_(box.setup), s_(box.start) {}
    /// Moreau 1988: corners that are in the floor at the middle of the step take part. Corners that lie on it
    /// hop by some g h^2, and have to take part in the impact of another corner in whichever step it falls.
    void step(double h) {
        const State before = s_;
        s_.x += h / 2 * before.vx;
        s_.z += h / 2 * before.vz;
        s_.angle += h / 2 * before.rate;
        s_.vz += h * setup_.pullAbove;
        collect(before, -20 * setup_.pullAbove * static_cast<Real>(h) * static_cast<Real>(h));
        for (int pass = 0; pass < kPasses && !touches_.empty(); ++pass) {
            Real change = 0;
            Real most = 0;
            for (Touch& touch : touches_) {
                change = std::max(change, std::abs(solve(touch)));
                most = std::max(most, touch.normal);
            }
            if (change <= 1e-15L * most) break;
        }
        s_.x += h / 2 * s_.vx;
        s_.z += h / 2 * s_.vz;
        s_.angle += h / 2 * s_.rate;
    }
    const State& state() const { return s_; }

  private:
    using Real = PlanarMotion::Real;
    static constexpr int kPasses = 4000;
    struct Touch {
        Real x = 0, z = 0, bounce = 0, normal = 0, tangential = 0;
    };
    void collect(const State& before, Real near) {
        touches_.clear();
        const Real c = std::cos(s_.angle);
        const Real s = std::sin(s_.angle);
        for (const auto& corner : setup_.corners) {
            Touch touch;
            touch.x = c * corner.along - s * corner.above;
            touch.z = s * corner.along + c * corner.above;
            touch.bounce = std::max(Real(0), -setup_.restitution * (before.vz + before.rate * touch.x));
            if (s_.z + touch.z <= near) touches_.push_back(touch);
        }
    }
    /// One corner by Signorini, Newton and Coulomb; how much its normal impulse changed.
    Real solve(Touch& touch) {
        const Real perNormal = 1 / setup_.mass + touch.x * touch.x / setup_.inertia;
        const Real perTangential = 1 / setup_.mass + touch.z * touch.z / setup_.inertia;
        const Real rate = s_.vz + s_.rate * touch.x;
        const Real normal = std::max(Real(0), touch.normal - (rate - touch.bounce) / perNormal);
        const Real added = normal - touch.normal;
        touch.normal = normal;
        s_.vz += added / setup_.mass;
        s_.rate += added * touch.x / setup_.inertia;
        const Real slip = s_.vx - s_.rate * touch.z;
        const Real most = setup_.friction * normal;
        const Real tangential = std::clamp(touch.tangential - slip / perTangential, -most, most);
        const Real turned = tangential - touch.tangential;
        touch.tangential = tangential;
        s_.vx += turned / setup_.mass;
        s_.rate -= turned * touch.z / setup_.inertia;
        return added;
    }

    PlanarMotion::Setup setup_;
    State s_;
    std::vector<Touch> touches_;
};

double apart(const PlanarMotion::Setup& setup, const State& a, const State& b) {
    return static_cast<double>(
        std::max({std::abs(a.x - b.x), std::abs(a.z - b.z), setup.size * std::abs(a.angle - b.angle)}));
}

TEST(PlanarMotion, BouncingBoxesAreThoseOfMoreausStepping) {
    int compared = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const RandomBox box = randomBox(seed);
        std::optional<PlanarMotion> motion;
        try {
            motion.emplace(box.setup, box.start, 0.5);
        } catch (const AssumptionViolated&) {
            continue;
        }
        const double h = 1e-5;
        Stepping coarse(box);
        Stepping fine(box);
        double own = 0;
        double off = 0;
        const double end = std::min(0.5, motion->validUntil());
        for (int k = 1; k * h < end; ++k) {
            coarse.step(h);
            fine.step(h / 2);
            fine.step(h / 2);
            own = std::max(own, apart(box.setup, coarse.state(), fine.state()));
            off = std::max(off, apart(box.setup, fine.state(), motion->at(k * h)));
        }
        // Twice the step, twice the error: the fine run is as far from the limit as the two from each other.
        EXPECT_LT(off, 20 * own + 20 * h) << seed << ", " << motion->events().size() << " events";
        compared += own < 100 * h ? 1 : 0;
    }
    EXPECT_GE(compared, 5) << "of eight boxes these were resolved by the stepping at all";
}

TEST(PlanarMotion, EndsWhereNeighboursPart) {
    int ended = 0;
    for (unsigned seed = 100; seed < 120; ++seed) {
        RandomBox box = randomBox(seed);
        box.setup.restitution = 0.9;
        RandomBox beside = box;
        beside.start.vx *= 1 + 1e-13L;
        beside.start.angle *= 1 + 1e-13L;
        beside.start.z *= 1 + 1e-13L;
        try {
            const PlanarMotion motion(box.setup, box.start, 5);
            const PlanarMotion other(beside.setup, beside.start, 5);
            const double end = std::min({5.0, motion.validUntil(), other.validUntil()});
            ended += motion.validUntil() < 5 ? 1 : 0;
            for (int k = 0; k <= 400; ++k)
                EXPECT_LT(apart(box.setup, motion.at(end * k / 400), other.at(end * k / 400)), 1e-7)
                    << seed << " at " << end * k / 400 << " of " << end;
        } catch (const AssumptionViolated&) {
        }
    }
    EXPECT_GT(ended, 0);
}

TEST(PlanarMotion, ADipBetweenTwoSamplesIsFound) {
    using Real = numerics::Real;
    const auto dip = [](Real depth) {
        return Watched{[depth](Real t) { return (t - 0.5075L) * (t - 0.5075L) - depth; }, 1e-15L};
    };
    EXPECT_NEAR(static_cast<double>(firstZero(dip(1e-6L), 0, 1).value()), 0.5065, 1e-12);
    EXPECT_FALSE(firstZero(dip(-1e-6L), 0, 1).has_value());
    EXPECT_FALSE(firstZero(dip(-1e-12L), 0, 1).has_value());
}

}  // namespace
}  // namespace rigor::validation::testing
