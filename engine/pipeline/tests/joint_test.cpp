// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints: pendulums against their laws, and what each joint must hold.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

/// A unit rod (mass 1, length 1, inertia 1/12) hung from the origin by its end, released horizontally.
template <class S>
struct Pendulum {
    World<S> world;
    BodyId rod;
    JointId joint;
    explicit Pendulum(WorldDef<S> def, JointType type = JointType::Hinge) : world(def) {
        BodyDef<S> body;
        body.pose.p = at<S>(0.5, 0);
        body.mass = 1;
        body.inertia = isotropic<S>(1.0 / 12);
        rod = world.addBody(body);
        JointDef<S> j;
        j.type = type;
        j.bodyB = rod;
        j.anchorB = at<S>(-0.5, 0);
        joint = world.addJoint(j);
    }
    double energy() const {
        const auto w = world.angularVelocity(rod);
        return 0.5 * world.velocity(rod).squaredNorm() + dotAng(w, w) / 24 + kGravity * world.pose(rod).p[1];
    }
    typename S::Vec anchor() const { return toWorld<S>(world.pose(rod), at<S>(-0.5, 0)); }
};

template <class S>
class Joints : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(Joints, Spaces);

TYPED_TEST(Joints, PendulumKeepsItsEnergyOverTwentySwings) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const JointType type : {JointType::Ball, JointType::Hinge}) {
        Pendulum<S> p(earth<S>(), type);
        // The velocity is that of the middle of the step: the energy wavers by (h/2) times the largest power,
        // 16.5 W (at sin = 1/sqrt 3), and does not drift.
        double firstSwing = 0, lastSwing = 0, gap = 0;
        for (int i = 0; i < 2400; ++i) {
            p.world.step(R(1.0 / 60));
            gap = std::max(gap, static_cast<double>(p.anchor().norm()));
            (i < 240 ? firstSwing : lastSwing) =
                std::max(i < 240 ? firstSwing : lastSwing, std::abs(p.energy()));
        }
        EXPECT_LT(firstSwing, 16.5 / 120 * 1.1);
        EXPECT_LT(lastSwing, firstSwing * 1.1 + tol<S>(1e-9, 2e-2));
        EXPECT_LT(gap, tol<S>(1e-12, 2e-6));
    }
}

TYPED_TEST(Joints, LinearisedRowsLoseEnergyAsTheySay) {
    using S = TypeParam;
    WorldDef<S> def = earth<S>();
    def.relinearizedJoints = false;
    Pendulum<S> p(def);
    for (int i = 0; i < 600; ++i) p.world.step(typename S::Real(1.0 / 60));
    EXPECT_LT(p.energy(), -0.3) << "or the setting does nothing";
}

/// Angle after 2 s against the elliptic closed form: theta0 = pi/2, theta(2) = 1.538098984 (unit rod, g
/// = 9.81).
TEST(PendulumConvergence, AngleIsOfOrderOneAtLeast) {
    std::vector<double> errors;
    for (const double h : {1.0 / 128, 1.0 / 512}) {
        Pendulum<Space2d> p(earth<Space2d>());
        for (int i = 0; i < static_cast<int>(2 / h + 0.5); ++i) p.world.step(h);
        const double theta = p.world.pose(p.rod).q.angle() + 1.5707963267948966;
        errors.push_back(std::abs(theta - 1.538098984));
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]) / 2, 0.9);
    EXPECT_LT(errors[1], 1.5e-3);
}

TYPED_TEST(Joints, ReactionCarriesTheWeightAtRest) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(earth<S>());
    BodyDef<S> body;
    body.mass = 2;
    body.pose.p = at<S>(0, -0.5);
    body.inertia = isotropic<S>(1);
    const BodyId id = world.addBody(body);
    JointDef<S> j;
    j.bodyB = id;
    j.anchorB = at<S>(0, 0.5);
    const JointId joint = world.addJoint(j);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    const auto impulses = world.jointImpulses(joint);
    ASSERT_EQ(impulses.size(), static_cast<std::size_t>(S::dim));
    EXPECT_NEAR(impulses[1], 2 * kGravity / 60, tol<S>(1e-12, 1e-5));
    EXPECT_NEAR(impulses[0], 0, tol<S>(1e-12, 1e-6));
}

/// Two bodies joined and thrown in zero gravity: linear and angular momentum stay, and the joint holds.
TYPED_TEST(Joints, EveryJointConservesMomentumAndHolds) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const JointType type :
         {JointType::Ball, JointType::Hinge, JointType::Slider, JointType::Fixed, JointType::Distance}) {
        World<S> world{euler<S>()};
        BodyId ids[2];
        for (int i = 0; i < 2; ++i) {
            BodyDef<S> body;
            body.mass = static_cast<R>(1 + i);
            body.inertia = isotropic<S>(0.1 * (1 + i));
            body.pose.p = at<S>(i, 0);
            body.velocity = at<S>(0.2 * i, i == 0 ? 1.0 : -0.3);
            body.angularVelocity = spin<S>(i == 0 ? 0.5 : -1.0);
            ids[i] = world.addBody(body);
        }
        JointDef<S> j;
        j.type = type;
        j.bodyA = ids[0];
        j.bodyB = ids[1];
        j.anchorA = at<S>(0.5, 0);
        j.anchorB = at<S>(-0.5, 0);
        if (type == JointType::Slider) j.axisA = j.axisB = at<S>(1, 0);
        if (type == JointType::Distance) {
            j.anchorA = at<S>(0, 0);
            j.anchorB = at<S>(0, 0);
            j.length = 1;
        }
        world.addJoint(j);
        const auto momentum = [&] {
            std::array<double, 3> m{};
            for (int i = 0; i < 2; ++i) {
                const typename S::Vec p = world.pose(ids[i]).p, v = world.velocity(ids[i]);
                m[0] += (1 + i) * v[0];
                m[1] += (1 + i) * v[1];
                m[2] += (1 + i) * (p[0] * v[1] - p[1] * v[0]) +
                        0.1 * (1 + i) * spinOf<S>(world.angularVelocity(ids[i]));
            }
            return m;
        };
        const auto before = momentum();
        double worst = 0;
        for (int i = 0; i < 120; ++i) {
            world.step(R(1.0 / 120));
            const Pose<S> A = world.pose(ids[0]), B = world.pose(ids[1]);
            const typename S::Vec d = toWorld<S>(B, j.anchorB) - toWorld<S>(A, j.anchorA);
            const auto turn = logMap(compose(inverse(A.q), B.q));
            const double turned = std::sqrt(dotAng(turn, turn));
            if (type == JointType::Distance) worst = std::max(worst, std::abs(d.norm() - 1.0));
            if (type == JointType::Slider)
                worst = std::max({worst, std::abs(double(rotateInverse(A.q, d)[1])), turned});
            if (type == JointType::Fixed) worst = std::max({worst, double(d.norm()), turned});
            if (type == JointType::Ball || type == JointType::Hinge)
                worst = std::max(worst, double(d.norm()));
        }
        const auto after = momentum();
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(after[k], before[k], tol<S>(1e-12, 2e-5)) << static_cast<int>(type) << " " << k;
        EXPECT_LT(worst, tol<S>(1e-6, 1e-5)) << static_cast<int>(type);
    }
}

TEST(Hinge3d, AxisDoesNotDriftUnderATiltedSpin) {
    using S = Space3d;
    World<S> world(earth<S>());
    BodyDef<S> body;
    body.mass = 1;
    body.inertia = Eigen::Vector3d(0.3, 0.2, 0.1).asDiagonal();
    body.pose.p = at<S>(0.5, 0);
    body.angularVelocity = {0, 0, 4};
    body.velocity = {0, 2, 0};
    const BodyId id = world.addBody(body);
    JointDef<S> j;
    j.type = JointType::Hinge;
    j.bodyB = id;
    j.anchorB = at<S>(-0.5, 0);
    world.addJoint(j);
    for (int i = 0; i < 1200; ++i) {
        world.applyForce(id, {0, 0, 1}, {0.5, 0.2, 0});  // load against the hinge alone
        world.step(1.0 / 120);
        const Eigen::Vector3d axis = world.pose(id).q * Eigen::Vector3d(0, 0, 1);
        ASSERT_LT((axis - Eigen::Vector3d(0, 0, 1)).norm(), 1e-7) << i;
        ASSERT_LT(toWorld<S>(world.pose(id), j.anchorB).norm(), 1e-7) << i;
    }
}

TEST(Chain3d, FiveLinksKeepTheirEnergyAndTheirJoints) {
    using S = Space3d;
    World<S> world(earth<S>());
    std::vector<BodyId> links;
    for (int i = 0; i < 5; ++i) {
        BodyDef<S> body;
        body.mass = 1;
        body.inertia = Eigen::Vector3d(0.002, 0.022, 0.022).asDiagonal();
        body.pose.p = at<S>(0.25 + 0.5 * i, 0);
        const BodyId id = world.addBody(body);
        JointDef<S> j;
        j.bodyA = links.empty() ? BodyId{} : links.back();
        j.bodyB = id;
        j.anchorA = links.empty() ? at<S>(0, 0) : at<S>(0.25, 0);
        j.anchorB = at<S>(-0.25, 0);
        world.addJoint(j);
        links.push_back(id);
    }
    double gap = 0, energy = 0;
    for (int i = 0; i < 960; ++i) {
        world.step(1.0 / 480);
        energy = 0;
        Eigen::Vector3d end = Eigen::Vector3d::Zero();
        for (const BodyId id : links) {
            const Pose<S> X = world.pose(id);
            gap = std::max(gap, (toWorld<S>(X, at<S>(-0.25, 0)) - end).norm());
            end = toWorld<S>(X, at<S>(0.25, 0));
            const Eigen::Vector3d w = rotateInverse(X.q, world.angularVelocity(id));
            energy += 0.5 * world.velocity(id).squaredNorm() + kGravity * X.p.y() +
                      0.5 * (0.002 * w.x() * w.x() + 0.022 * (w.y() * w.y() + w.z() * w.z()));
        }
        ASSERT_NEAR(energy, 0, 0.02 * 61) << "of the 61 J between hanging and horizontal, at step " << i;
    }
    EXPECT_LT(gap, 1e-5);
}

}  // namespace
}  // namespace rigor::engine::test
