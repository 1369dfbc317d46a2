// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A world shows of a step from midpoint to midpoint the state at its end, and its contacts there.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class MidpointShown : public testing::Test {};
using MidpointSpaces = testing::Types<Space2d, Space3d>;
TYPED_TEST_SUITE(MidpointShown, MidpointSpaces);

constexpr double kFrame = 1.0 / 60;

template <class S>
WorldDef<S> midpointDef() {
    WorldDef<S> def = earth<S>();
    def.integrator = "moreau_midpoint";
    return def;
}

/// A ball that rolls: the contact lies below its centre where the step ends, at no distance.
TYPED_TEST(MidpointShown, ContactsAreWhereTheStepEnds) {
    using S = TypeParam;
    World<S> world(midpointDef<S>());
    const auto felt = world.addMaterial(0.5, 0);
    addGround<S>(world, felt);
    const double r = 0.1, v = 3;
    const BodyId ball = addBall<S>(world, 0, r, r, 1, felt, v, 0, -v / r);
    EXPECT_TRUE(world.contactsAtStepEnd());
    for (int i = 0; i < 30; ++i) {
        world.step(kFrame);
        const typename S::Vec center = world.pose(ball).p;
        std::vector<ContactView<S>> contacts;
        world.readContacts(contacts);
        ASSERT_EQ(contacts.size(), 1u) << i;
        const ContactView<S>& contact = contacts[0];
        EXPECT_NEAR(contact.pointB[0], center[0], 1e-12) << i;
        EXPECT_NEAR(contact.pointB[1], 0, 1e-9) << i;
        EXPECT_NEAR(contact.pointA[1], 0, 1e-9) << i;
        EXPECT_NEAR(contact.normalImpulse, kFrame * kGravity, 1e-9) << i;
    }
}

/// Cubes on each other, each further out than the one below, so that corners carry different loads: impulses are shown at
/// the corners at which they have acted, where they hold every cube's weight and its moment.
TYPED_TEST(MidpointShown, CornersHaveTheirOwnImpulses) {
    using S = TypeParam;
    for (const char* solver : {"block", "nsgs"}) {
        WorldDef<S> def = midpointDef<S>();
        def.solver = solver;
        World<S> world(def);
        const auto felt = world.addMaterial(0.5, 0);
        addGround<S>(world, felt);
        std::vector<BodyId> cubes;
        for (int i = 0; i < 4; ++i) cubes.push_back(addCube<S>(world, 0.1 * i, 0.5 + i, 0.5, 1, felt));
        for (int step = 0; step < 120; ++step) {
            world.step(kFrame);
            std::vector<ContactView<S>> contacts;
            world.readContacts(contacts);
            for (const BodyId cube : cubes) {
                typename S::Ang moment = spin<S>(0);
                for (const ContactView<S>& contact : contacts) {
                    const typename S::Vec impulse =
                        contact.normalImpulse * contact.normal + contact.frictionImpulse;
                    const typename S::Vec arm = contact.pointB - world.pose(cube).p;
                    if (contact.bodyA == cube) moment -= cross(arm, impulse);
                    if (contact.bodyB == cube) moment += cross(arm, impulse);
                }
                ASSERT_LT(std::sqrt(dotAng(moment, moment)), 1e-4 * kFrame * kGravity)
                    << solver << ' ' << step;
            }
        }
    }
}

/// Balls that pass each other: the normal turns by a tenth of a radian in the step, and is that of its end at once.
TYPED_TEST(MidpointShown, NewContactsHaveTheNormalOfTheEnd) {
    using S = TypeParam;
    WorldDef<S> def = midpointDef<S>();
    def.gravity = S::Vec::Zero();
    std::size_t seen = 0;
    for (const double from : {-0.08, -0.04, 0.0}) {
        World<S> world(def);
        const auto smooth = world.addMaterial(0, 0);
        BodyDef<S> fixed;
        fixed.type = BodyType::Static;
        attach<S>(world, world.addBody(fixed), Sphere<S>{0.5}, smooth);
        const BodyId ball =
            addBall<S>(world, from, std::sqrt(0.745 * 0.745 - from * from), 0.25, 1, smooth, 5);
        const typename S::Vec before = world.velocity(ball);
        world.step(kFrame);
        const typename S::Vec center = world.pose(ball).p;
        std::vector<ContactView<S>> contacts;
        world.readContacts(contacts);
        typename S::Vec sum = S::Vec::Zero();
        for (const ContactView<S>& contact : contacts) {
            ++seen;
            EXPECT_NEAR((contact.normal - center.normalized()).norm(), 0, 1e-12) << from;
            EXPECT_NEAR(contact.separation, center.norm() - 0.75, 1e-12) << from;
            sum += contact.normalImpulse * contact.normal;
        }
        // The impulse acted along the normal of the middle: its size is kept.
        EXPECT_NEAR(sum.norm(), (world.velocity(ball) - before).norm(), 1e-9) << from;
    }
    EXPECT_GT(seen, 0u);
}

/// A crank that a motor drives, a rod and a piston: where the crank is decides where the others are.
template <class S>
struct SliderCrank {
    static constexpr double kSpeed = 6, kCrank = 0.25, kRod = 0.8;
    World<S> world;
    BodyId crank, rod, piston;

    static double rodAngle(double angle) { return -std::asin(kCrank * std::sin(angle) / kRod); }
    static double reach(double angle) { return kCrank * std::cos(angle) + kRod * std::cos(rodAngle(angle)); }
    static BodyDef<S> part(double mass, double inertia, double x, double y, double angle, double vx,
                           double vy, double w) {
        BodyDef<S> def;
        def.mass = mass;
        def.inertia = isotropic<S>(inertia);
        def.pose.p = at<S>(x, y);
        def.pose.q = expMap(spin<S>(angle));
        def.velocity = at<S>(vx, vy);
        def.angularVelocity = spin<S>(w);
        return def;
    }
    JointDef<S> hinge(BodyId a, double ax, BodyId b, double bx) {
        JointDef<S> joint;
        joint.type = JointType::Hinge;
        joint.bodyA = a;
        joint.bodyB = b;
        joint.anchorA = at<S>(ax, 0);
        joint.anchorB = at<S>(bx, 0);
        return joint;
    }

    SliderCrank() : world(midpointDef<S>()) {
        const double a = 1, b = rodAngle(a), wb = -kCrank * std::cos(a) * kSpeed / (kRod * std::cos(b));
        const double pinX = kCrank * std::cos(a), pinY = kCrank * std::sin(a);
        const double pinVx = -kCrank * std::sin(a) * kSpeed, pinVy = kCrank * std::cos(a) * kSpeed;
        crank = world.addBody(part(1, 0.02, pinX / 2, pinY / 2, a, pinVx / 2, pinVy / 2, kSpeed));
        rod =
            world.addBody(part(0.5, 0.03, pinX + kRod / 2 * std::cos(b), pinY / 2, b,
                               pinVx - kRod / 2 * std::sin(b) * wb, pinVy + kRod / 2 * std::cos(b) * wb, wb));
        piston = world.addBody(part(2, 0.01, reach(a), 0, 0, pinVx - kRod * std::sin(b) * wb, 0, 0));
        JointDef<S> drive = hinge(BodyId{}, 0, crank, -kCrank / 2);
        drive.axes[0].motorSpeed = kSpeed;
        drive.axes[0].motorMaxForce = 500;
        world.addJoint(drive);
        world.addJoint(hinge(crank, kCrank / 2, rod, -kRod / 2));
        world.addJoint(hinge(rod, kRod / 2, piston, 0));
        JointDef<S> rail;
        rail.type = JointType::Slider;
        rail.bodyB = piston;
        rail.axisA = rail.axisB = at<S>(1, 0);
        world.addJoint(rail);
    }
};

TYPED_TEST(MidpointShown, AMotorLeadsAMechanism) {
    using S = TypeParam;
    SliderCrank<S> mechanism;
    for (int i = 1; i <= 120; ++i) {
        mechanism.world.step(kFrame);
        const double angle = 1 + SliderCrank<S>::kSpeed * i * kFrame;
        const typename S::Vec crank = mechanism.world.pose(mechanism.crank).p;
        ASSERT_NEAR(crank[0], SliderCrank<S>::kCrank / 2 * std::cos(angle), 1e-7) << i;
        ASSERT_NEAR(crank[1], SliderCrank<S>::kCrank / 2 * std::sin(angle), 1e-7) << i;
        ASSERT_NEAR(mechanism.world.pose(mechanism.piston).p[0], SliderCrank<S>::reach(angle), 1e-7) << i;
    }
}

/// A load that is too large from the first step on breaks a joint at once: the body falls freely.
TYPED_TEST(MidpointShown, AJointBreaksWhenTheStepBegins) {
    using S = TypeParam;
    World<S> world(midpointDef<S>());
    const BodyId body = addBall<S>(world, 0, 0, 0.1, 2, 0);
    JointDef<S> weld;
    weld.type = JointType::Fixed;
    weld.bodyB = body;
    weld.breakForce = 30;
    world.addJoint(weld);
    for (int i = 0; i < 30; ++i) ASSERT_TRUE(world.step(kFrame).broken.empty()) << i;
    ASSERT_NEAR(world.pose(body).p[1], 0, 1e-12);
    ConstantForce<S> load;
    load.body = body;
    load.force = at<S>(0, -20);
    load.start = 30 * kFrame;
    load.end = 60;
    world.addForce(load);
    std::size_t broken = 0;
    for (int i = 0; i < 30; ++i) broken += world.step(kFrame).broken.size();
    EXPECT_EQ(broken, 1u);
    const double a = kGravity + 10;
    EXPECT_NEAR(world.velocity(body)[1], -0.5 * a, 1e-9);
    EXPECT_NEAR(world.pose(body).p[1], -0.125 * a, 1e-9);
}

/// A board that stands on its lower edge, tilted by `angle`.
template <class S>
BodyId addBoard(World<S>& world, double angle, std::uint32_t material) {
    const double mass = 2, half = 0.25, thin = 0.05;
    BodyDef<S> def;
    def.mass = mass;
    def.inertia = isotropic<S>(mass / 3 * (half * half + thin * thin));
    def.pose.q = expMap(spin<S>(angle));
    def.pose.p = at<S>(0, half * std::cos(angle) + thin * std::abs(std::sin(angle)));
    const BodyId board = world.addBody(def);
    typename S::Vec extents = S::Vec::Constant(thin);
    extents[1] = half;
    attach<S>(world, board, Box<S>{extents}, material);
    return board;
}

/// It turns about the edge and keeps its energy; the contact is the edge, which neither parts nor closes, where the step ends.
TYPED_TEST(MidpointShown, ABoardThatTipsKeepsItsEnergy) {
    using S = TypeParam;
    World<S> world(midpointDef<S>());
    const auto wood = world.addMaterial(1, 0);
    addGround<S>(world, wood);
    const BodyId board = addBoard<S>(world, -0.26, wood);
    const double mass = 2, inertia = mass / 3 * (0.25 * 0.25 + 0.05 * 0.05);
    const auto energy = [&] {
        const double w = spinOf<S>(world.angularVelocity(board));
        return 0.5 * mass * world.velocity(board).squaredNorm() + 0.5 * inertia * w * w +
               mass * kGravity * world.pose(board).p[1];
    };
    const double start = energy();
    for (int i = 0; i < 24; ++i) {
        world.step(kFrame);
        ASSERT_NEAR(energy(), start, 3e-4 * start) << i;
        std::vector<ContactView<S>> contacts;
        world.readContacts(contacts);
        ASSERT_FALSE(contacts.empty()) << i;
        const Pose<S> end = world.pose(board);
        const double w = spinOf<S>(world.angularVelocity(board)), lag = 0.5 * kFrame * w * w * 0.25;
        for (const ContactView<S>& contact : contacts) {
            if (!(contact.normalImpulse > 0)) continue;
            const typename S::Vec arm = contact.pointB - end.p;
            const typename S::Vec u = world.velocity(board) + cross(world.angularVelocity(board), arm);
            ASSERT_NEAR(u[1], 0, 0.1 * lag + 2e-5) << i;  // 1.6e-5: gaps that count as closed
            const typename S::Vec local = rotateInverse<double>(end.q, arm);
            const double second = kFrame * kFrame * 0.25 * (w * w + 2);  // first order: kFrame / 2 * 0.25 * w
            ASSERT_NEAR(std::abs(local[0]), 0.05, second) << i;
            ASSERT_NEAR(local[1], -0.25, second) << i;
            ASSERT_NEAR(contact.pointB[1], contact.separation, second) << i;
        }
    }
    EXPECT_GT(std::abs(spinOf<S>(world.angularVelocity(board))), 1);
}

/// It falls flat on the ground, without overlap.
TYPED_TEST(MidpointShown, ABoardLandsWithoutOverlap) {
    using S = TypeParam;
    World<S> world(midpointDef<S>());
    const auto wood = world.addMaterial(1, 0);
    addGround<S>(world, wood);
    const BodyId board = addBoard<S>(world, -0.4, wood);
    for (int i = 0; i < 90; ++i) {
        world.step(kFrame);
        const double angle = spinOf<S>(logMap(world.pose(board).q));
        const double lowest =
            world.pose(board).p[1] - 0.25 * std::abs(std::cos(angle)) - 0.05 * std::abs(std::sin(angle));
        ASSERT_GT(lowest, -1e-3) << i;
    }
    EXPECT_NEAR(world.pose(board).p[1], 0.05, 1e-4);
}

/// A body of three moments of inertia that tumbles freely: energy and angular momentum stay to rounding.
TEST(MidpointShownInSpace, FreeRotationConserves) {
    using S = Space3d;
    WorldDef<S> def;
    def.integrator = "moreau_midpoint";
    World<S> world(def);
    BodyDef<S> body;
    body.mass = 1.2;
    body.inertia = Eigen::Vector3d(0.05, 0.02, 0.035).asDiagonal();
    body.velocity = {0.3, 1, -0.2};
    body.angularVelocity = {1.5, -4, 2.3};
    const BodyId id = world.addBody(body);
    attach<S>(world, id, Capsule<S>{0.3, 0.05}, world.addMaterial(0.4, 0.8));
    const auto momentum = [&]() -> Eigen::Vector3d {
        const Eigen::Matrix3d R = toMatrix(world.pose(id).q);
        return R * body.inertia * R.transpose() * world.angularVelocity(id);
    };
    const Eigen::Vector3d L = momentum();
    const double energy = 0.5 * L.dot(world.angularVelocity(id));
    for (int i = 0; i < 600; ++i) {
        world.step(kFrame);
        ASSERT_NEAR((momentum() - L).norm(), 0, 1e-11) << i;
        ASSERT_NEAR(0.5 * momentum().dot(world.angularVelocity(id)), energy, 1e-11) << i;
    }
}

}  // namespace
}  // namespace rigor::engine::test
