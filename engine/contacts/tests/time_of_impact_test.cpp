// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Times of impact against closed forms and against fine sampling of the distance.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/contacts/time_of_impact.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Impacts : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Impacts, Spaces);

template <class S>
MovingShape<S> moving(const Shape<S>& shape, const Pose<S>& body, const Velocity<S>& velocity) {
    return {&shape, {}, body, velocity, coreBoundingRadius<S>(shape, {}), inscribedRadiusOf<S>(shape)};
}

template <class S>
struct Rng {
    using R = typename S::Real;
    std::mt19937 random{17};
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }
    typename S::Vec vec(double size) {
        typename S::Vec v;
        for (int k = 0; k < S::dim; ++k) v[k] = static_cast<R>(uniform(-size, size));
        return v;
    }
    typename S::Ang ang(double size) {
        if constexpr (S::dim == 2)
            return static_cast<R>(uniform(-size, size));
        else
            return vec(size);
    }
};

TYPED_TEST(Impacts, OfTwoBallsIsTheRootOfAQuadratic) {
    using S = TypeParam;
    using R = typename S::Real;
    const bool fine = sizeof(R) == 8;
    Rng<S> rng;
    int hits = 0;
    for (int i = 0; i < 6000; ++i) {
        const Shape<S> a = Sphere<S>{R(rng.uniform(0.05, 1))}, b = Sphere<S>{R(rng.uniform(0.05, 1))};
        const Velocity<S> va{rng.vec(100), rng.ang(50)}, vb{rng.vec(100), rng.ang(50)};
        const Pose<S> Xa{rng.vec(3), {}}, Xb{rng.vec(3), {}};
        const auto p = (Xb.p - Xa.p).template cast<double>().eval();
        const auto v = (vb.v - va.v).template cast<double>().eval();
        const double r = double(std::get<Sphere<S>>(a).radius) + double(std::get<Sphere<S>>(b).radius);
        const double c = p.squaredNorm() - r * r, half = p.dot(v), vv = v.squaredNorm();
        const double root = half * half - vv * c;
        if (c < 0.01 || std::abs(root) < 1e-2 * vv * r * r) continue;  // overlapping, or just about grazing
        const double exact = root > 0 ? (-half - std::sqrt(root)) / vv : -1;
        const double horizon = 0.05;
        const auto found = timeOfImpact<S>(moving<S>(a, {Xa.p, Pose<S>::identityRot()}, va),
                                           moving<S>(b, {Xb.p, Pose<S>::identityRot()}, vb), R(horizon));
        const bool expected = exact > 0 && exact < horizon;
        if (std::abs(exact - horizon) < 1e-4) continue;
        ASSERT_EQ(found.hit, expected) << i << " exact " << exact;
        if (!expected) continue;
        ++hits;
        // The extrapolation is first order in the gap of at most 1e-3 of the smaller sphere.
        EXPECT_NEAR(double(found.exact), exact, fine ? 1e-6 : 1e-5);
        EXPECT_GE(double(found.closest.distance), fine ? 0 : -1e-6);
        EXPECT_TRUE(found.converged);
        EXPECT_LE(found.evaluations, 40);
    }
    EXPECT_GT(hits, 100);
}

TYPED_TEST(Impacts, OfTurningBoxesIsTheFirstTouchOfAFineSampling) {
    using S = TypeParam;
    using R = typename S::Real;
    Rng<S> rng;
    int hits = 0, misses = 0;
    for (int i = 0; i < 150; ++i) {
        typename S::Vec thin = S::Vec::Constant(R(0.4));
        thin[0] = R(0.02);
        const Shape<S> a = Box<S>{thin}, b = Box<S>{S::Vec::Constant(R(0.2))};
        typename S::Vec apart = rng.vec(1.5);
        if (apart.norm() < R(1)) continue;
        const Velocity<S> va{rng.vec(3), rng.ang(20)},
            vb{typename S::Vec(R(-20) * apart + rng.vec(15)), rng.ang(20)};
        const auto A = moving<S>(a, {S::Vec::Zero(), Pose<S>::identityRot()}, va);
        const auto B = moving<S>(b, {apart, Pose<S>::identityRot()}, vb);
        const R horizon = R(0.1);
        const auto found = timeOfImpact<S>(A, B, horizon);
        const int samples = 1500;
        int first = samples + 1;
        double nearest = 1;
        for (int k = 0; k <= samples && first > samples; ++k) {
            const R t = horizon * R(k) / R(samples);
            const double d = double(closestPoints<S>(a, A.at(t), b, B.at(t)).distance);
            nearest = std::min(nearest, d);
            if (d <= 0) first = k;
        }
        if (first > samples && nearest < 2e-3) continue;  // the case is too close to call by sampling
        const double sampled = 0.1 * first / samples;
        ASSERT_EQ(found.hit, first <= samples) << i << " nearest " << nearest;
        (found.hit ? hits : misses)++;
        if (found.hit) {
            EXPECT_LE(double(found.time), sampled) << i;
            // The time is at most one sample early, less the time that the touching gap takes.
            EXPECT_GE(double(found.exact), sampled - 0.1 / samples - 1e-4) << i;
        }
    }
    EXPECT_GT(hits, 20);
    EXPECT_GT(misses, 5);
}

TYPED_TEST(Impacts, FromTouchingCountOnlyWhatWouldGoDeep) {
    using S = TypeParam;
    using R = typename S::Real;
    const Shape<S> wall = Box<S>{S::Vec::Constant(R(0.1))}, ball = Sphere<S>{R(0.1)};
    const auto at = [&](double x, double v) {
        Pose<S> X;
        X.p[0] = R(x);
        Velocity<S> velocity;
        velocity.v[0] = R(v);
        return moving<S>(ball, X, velocity);
    };
    const auto W = moving<S>(wall, {}, {});
    EXPECT_TRUE(timeOfImpact<S>(W, at(0.2, -100), R(0.01)).hit) << "touches, and would pass";
    EXPECT_EQ(double(timeOfImpact<S>(W, at(0.2, -100), R(0.01)).time), 0);
    EXPECT_FALSE(timeOfImpact<S>(W, at(0.2, -1), R(0.01)).hit) << "touches, the solver's business";
    EXPECT_FALSE(timeOfImpact<S>(W, at(0.2, 100), R(0.01)).hit) << "parts";
    EXPECT_TRUE(timeOfImpact<S>(W, at(0.205, -1), R(0.01)).hit) << "meets, however slowly";
    EXPECT_FALSE(timeOfImpact<S>(W, at(0.205, -1), R(0.01), true).hit) << "unless the solver knows of it";
}

// A bar turns over a floor: its lower end, which touches, rises, and the other one falls onto the floor. The floor's
// inscribed radius has no end, and must not count where the time that the bar may take unseen is measured.
TYPED_TEST(Impacts, TheOtherEndOfABarIsFoundOverAHalfSpace) {
    using S = TypeParam;
    using R = typename S::Real;
    using Vec = typename S::Vec;
    constexpr R kTilt = R(0.1), kSpin = R(20);
    Vec half = Vec::Constant(R(0.1));
    half[0] = R(0.5);
    const Shape<S> bar = Box<S>{half}, floor = HalfSpace<S>{Vec::Unit(1), R(0)};
    Pose<S> X;
    Velocity<S> velocity;
    if constexpr (S::dim == 2) {
        X.q = S::Rot::fromAngle(kTilt);
        velocity.w = -kSpin;
    } else {
        X.q = typename S::Rot(Eigen::AngleAxis<R>(kTilt, Vec::UnitZ()));
        velocity.w = Vec(0, 0, -kSpin);
    }
    X.p[1] = R(0.5) * std::sin(kTilt) + R(0.1) * std::cos(kTilt);
    const auto ground = moving<S>(floor, {}, {}), falls = moving<S>(bar, X, velocity);
    // The bar turns about its middle, so that the ends have changed places when it has turned by twice the tilt.
    const double down = 2 * double(kTilt / kSpin), late = 0.25 * 0.1 / (double(kSpin) * double(half.norm()));
    const auto found = timeOfImpact<S>(ground, falls, R(2 * down));
    ASSERT_TRUE(found.hit);
    EXPECT_GT(double(found.time), 0.9 * down);
    EXPECT_LT(double(found.time), down + late);
}

}  // namespace
}  // namespace rigor::engine
