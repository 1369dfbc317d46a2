// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies moved in blocks, against the same bodies moved one by one, and on every instruction set.
#include "engine/integrators/block_motion.hpp"

#include <gtest/gtest.h>

#include <hwy/targets.h>
#include <random>

#include "engine/integrators/motion.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class BlockMotionTest : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(BlockMotionTest, Spaces);

template <class S>
using Inertia = typename S::Inertia;

/// Positive definite, far from that of a sphere, not along the axes; 2D: positive.
template <class S, class Random>
Inertia<S> anyInertia(Random& random) {
    using R = typename S::Real;
    if constexpr (S::dim == 2) {
        return static_cast<R>(std::uniform_real_distribution(0.5, 2.0)(random));
    } else {
        std::uniform_real_distribution<double> some(-0.3, 0.3);
        typename S::Mat m = typename S::Vec(R(1), R(1.7), R(2.1)).asDiagonal();
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < i; ++k) m(i, k) = m(k, i) = static_cast<R>(some(random));
        return m;
    }
}

/// World, walls, kinematic bodies, sleepers, spheres and tumblers, some turning by many radians in a step.
template <class S>
BodyArrays<S> someBodies(std::size_t n) {
    using R = typename S::Real;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    BodyArrays<S> bodies;
    for (std::size_t i = 0; i < n; ++i) {
        const auto vec = [&](double size) {
            typename S::Vec v;
            for (auto& x : v) x = static_cast<R>(size * number(random));
            return v;
        };
        const auto ang = [&](double size) {
            if constexpr (S::dim == 2)
                return static_cast<R>(size * number(random));
            else
                return typename S::Ang(vec(size));
        };
        BodyConstants<S> body;
        body.type = i % 11 == 0 ? BodyType::Static : i % 7 == 3 ? BodyType::Kinematic : BodyType::Dynamic;
        const bool dynamic = body.type == BodyType::Dynamic;
        body.inertia = anyInertia<S>(random);
        if constexpr (S::dim == 3)
            if (i % 3 == 0) body.inertia = R(1.5) * S::Mat::Identity();
        body.mass = 2;
        body.gravityScale = i % 5 == 0 ? R(0.5) : R(1);
        body.linearVelocityKept = i % 4 == 0 ? R(0.7) : R(1);
        body.angularVelocityKept = i % 4 == 1 ? R(0.6) : R(1);
        const bool asleep = dynamic && i % 13 == 5;
        Pose<S> pose{vec(3), rotatedBy(Pose<S>::identityRot(), ang(2))};
        bodies.constants.push_back(body);
        bodies.pose.push_back(pose);
        bodies.velocity.push_back(body.type == BodyType::Static || asleep
                                      ? Velocity<S>()
                                      : Velocity<S>(vec(2), ang(i % 9 == 2 ? 300 : 4)));
        bodies.wrench.push_back(i % 2 == 0 ? Wrench<S>{vec(3), ang(3)} : Wrench<S>{});
        bodies.asleep.push_back(asleep);
        bodies.invMass.push_back(dynamic && !asleep ? R(0.5) : R(0));
        bodies.invInertiaLocal.push_back(dynamic ? inverseInertia<S>(body.inertia) : zeroInertia<S>());
        bodies.invInertia.push_back(zeroInertia<S>());
    }
    return bodies;
}

/// Two sub-steps, with a push in each as of constraints.
template <class S>
void advance(Motion<S>& motion, BodyArrays<S>& bodies) {
    using R = typename S::Real;
    const R h = R(1.0 / 120);
    typename S::Vec gravity = S::Vec::Zero();
    gravity[1] = R(-10);
    motion.beginStep();
    for (int k = 0; k < 2; ++k) {
        Motion<S>::setInertia(bodies);
        motion.kick(bodies, {gravity, nullptr, 0}, h);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            if (bodies.invMass[i] > 0) {
                bodies.velocity[i].v[0] += R(0.25);
                if constexpr (S::dim == 3)
                    bodies.velocity[i].w += typename S::Ang(R(0.1), R(-0.2), R(0.3));
                else
                    bodies.velocity[i].w += R(0.1);
            }
        motion.move(bodies, h);
        motion.finish(bodies, h);
    }
}

template <class S>
Motion<S> usual(const char* rotation) {
    return {findAlgorithm(integratorTable<S>(), "integrator", "symplectic_euler").make(),
            findAlgorithm(rotationTable<S>(), "rotation", rotation).make(),
            findAlgorithm(orientationUpdateTable<S>(), "orientation_update", "exponential_map").make()};
}

template <class S>
double difference(const BodyArrays<S>& a, const BodyArrays<S>& b, std::size_t i) {
    const auto rotation = [](const auto& q) { return toMatrix(q); };
    double most = static_cast<double>((a.pose[i].p - b.pose[i].p).norm());
    most = std::max<double>(most, (rotation(a.pose[i].q) - rotation(b.pose[i].q)).norm());
    most = std::max<double>(most, (a.velocity[i].v - b.velocity[i].v).norm());
    const typename S::Ang w = a.velocity[i].w - b.velocity[i].w;
    const double scale = 1 + std::sqrt(static_cast<double>(dotAng(b.velocity[i].w, b.velocity[i].w)));
    return std::max(most, std::sqrt(static_cast<double>(dotAng(w, w))) / scale);
}

TYPED_TEST(BlockMotionTest, MovesAsOneByOneToRounding) {
    using S = TypeParam;
    constexpr double kRounding = sizeof(typename S::Real) == 4 ? 2e-5 : 5e-14;
    for (const char* rotation : {"lie_midpoint", "none"}) {
        BodyArrays<S> one = someBodies<S>(67), block = one;
        const BodyArrays<S> before = one;
        Motion<S> plain = usual<S>(rotation), blocks = usual<S>(rotation);
        blocks.moveInBlocks(std::string(rotation) == "lie_midpoint");
        advance(plain, one);
        advance(blocks, block);
        for (std::size_t i = 0; i < one.size(); ++i) {
            EXPECT_LT(difference(block, one, i), kRounding) << rotation << ", body " << i;
            if (one.asleep[i] || one.constants[i].type == BodyType::Static)
                EXPECT_EQ(difference(block, before, i), 0) << i;
            else
                EXPECT_GT(difference(block, before, i), 1e-3) << i;
        }
    }
}

TYPED_TEST(BlockMotionTest, HasTheSameBitsOnEveryInstructionSet) {
    using S = TypeParam;
    std::vector<BodyArrays<S>> results;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        hwy::SetSupportedTargetsForTest(left & -left);
        BodyArrays<S> bodies = someBodies<S>(67);
        Motion<S> motion = usual<S>("lie_midpoint");
        motion.moveInBlocks(true);
        advance(motion, bodies);
        results.push_back(bodies);
    }
    hwy::SetSupportedTargetsForTest(0);
    ASSERT_GT(results.size(), 1u) << "nothing was compared";
    for (const BodyArrays<S>& other : results)
        for (std::size_t i = 0; i < other.size(); ++i) EXPECT_EQ(difference(other, results[0], i), 0);
}

}  // namespace
}  // namespace rigor::engine::test
