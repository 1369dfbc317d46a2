// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Patches of the solver `wide`: each does what it would do alone, what is reported of it is what it did, gaps
// and overlaps are treated as they should be.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

template <class S>
class WidePatches : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(WidePatches, Spaces);

template <class S>
WorldDef<S> wide(bool gravity = true) {
    WorldDef<S> def;
    if (gravity) def = earth<S>();
    def.solver = "wide";
    return def;
}

/// Collisions side by side in the lanes of blocks, each far from the others: bit for bit that of a world with
/// that one alone, in which it stands in the first lane.
TYPED_TEST(WidePatches, DoAmongOthersWhatTheyDoAlone) {
    using S = TypeParam;
    using R = typename S::Real;
    constexpr int pairs = 19;
    const auto add = [](World<S>& world, std::uint32_t rubber, int k) {
        const BodyId a = addCube<S>(world, 0, 8 * k, 0.5, 1 + 0.1 * k, rubber, 2 + 0.1 * k);
        return std::pair(a, addBall<S>(world, 1.2, 8 * k + 0.3, 0.4, 2, rubber, -1, 0.2 * k, 3));
    };
    World<S> all(wide<S>(false));
    const auto rubber = all.addMaterial(R(0.5), R(0.4));
    std::vector<std::pair<BodyId, BodyId>> bodies;
    for (int k = 0; k < pairs; ++k) bodies.push_back(add(all, rubber, k));
    for (int i = 0; i < 30; ++i) all.step(R(1.0 / 60));
    for (int k = 0; k < pairs; ++k) {
        World<S> one(wide<S>(false));
        one.addMaterial(R(0.5), R(0.4));
        const auto [a, b] = add(one, rubber, k);
        for (int i = 0; i < 30; ++i) one.step(R(1.0 / 60));
        EXPECT_LT(one.velocity(a)[0], 1.7 + 0.1 * k) << "they did collide";
        for (const auto& [alone, among] : {std::pair(a, bodies[k].first), std::pair(b, bodies[k].second)}) {
            EXPECT_EQ(one.pose(alone).p, all.pose(among).p) << k;
            EXPECT_EQ(one.velocity(alone), all.velocity(among)) << k;
            EXPECT_EQ(one.angularVelocity(alone), all.angularVelocity(among)) << k;
        }
    }
}

/// Cubes side by side on the ground: each is carried by its own contact, also in what is reported.
TYPED_TEST(WidePatches, EachCarriesTheWeightOfItsBody) {
    using S = TypeParam;
    using R = typename S::Real;
    World<S> world(wide<S>());
    const auto wood = world.addMaterial(R(0.5), 0);
    addGround<S>(world, wood);
    std::map<std::uint32_t, double> weight;
    for (int k = 0; k < 19; ++k)
        weight[addCube<S>(world, 2 * k, 0.5, 0.5, 1 + k, wood).index] = (1 + k) * kGravity / 60;
    for (int i = 0; i < 300; ++i) world.step(R(1.0 / 60));
    std::vector<ContactView<S>> contacts;
    world.readContacts(contacts);
    std::map<std::uint32_t, double> carried;
    for (const ContactView<S>& c : contacts) carried[c.bodyB.index] += static_cast<double>(c.normalImpulse);
    ASSERT_EQ(carried.size(), weight.size());
    for (const auto& [body, w] : weight) EXPECT_NEAR(carried[body], w, tol<S>(2e-7, 1e-3) * w) << body;
}

/// A sphere that comes to a wall within the distance at which contacts are found ahead: it goes on until it
/// touches, stops there, and the step in which it is stopped says that the contact begins.
TYPED_TEST(WidePatches, AGapIsClosedAndNotMore) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const double share : {0.2, 0.5, 0.9}) {
        WorldDef<S> def = wide<S>(false);
        def.speculativeDistance = R(0.02);
        World<S> world(def);
        const auto smooth = world.addMaterial(0, 0);
        addGround<S>(world, smooth);
        const double gap = 0.02 * share, speed = 60 * gap * 1.4;
        const BodyId ball = addBall<S>(world, 0, 0.5 + gap, 0.5, 2, smooth, 0, -speed);
        bool begun = false;
        for (int i = 0; i < 4; ++i) {
            const bool moved = world.velocity(ball)[1] < -0.5 * speed;
            world.step(R(1.0 / 60));
            const bool stopped = moved && world.velocity(ball)[1] > -0.5 * speed;
            for (const Event<S>& event : world.lastStep().events)
                begun = begun || event.kind == EventKind::ContactBegins;
            EXPECT_EQ(begun, begun || stopped) << share << " step " << i;
        }
        EXPECT_TRUE(begun);
        EXPECT_NEAR(world.pose(ball).p[1], 0.5, 0.02 * gap) << share;
        EXPECT_NEAR(world.velocity(ball)[1], 0, tol<S>(1e-9, 1e-5)) << share;
    }
}

/// Overlap up to the slop is left alone to the bit, more is pushed out to about that, and never faster than
/// the largest push (softBiasRule).
TYPED_TEST(WidePatches, OverlapIsPushedOutToTheSlopAndNotFast) {
    using S = TypeParam;
    using R = typename S::Real;
    const auto rise = [](double overlap, int steps, double half = 0.5) {
        WorldDef<S> def = wide<S>(false);
        def.slop = R(0.01);
        World<S> world(def);
        const auto wood = world.addMaterial(R(0.5), 0);
        addGround<S>(world, wood);
        const BodyId box = addCube<S>(world, 0, half - overlap, half, 1, wood);
        double fastest = 0, last = static_cast<double>(world.pose(box).p[1]);
        const double start = last;
        for (int i = 0; i < steps; ++i) {
            world.step(R(1.0 / 60));
            const double now = static_cast<double>(world.pose(box).p[1]);
            fastest = std::max(fastest, 60 * (now - last));
            last = now;
        }
        return std::pair(last - start, fastest);
    };
    EXPECT_EQ(rise(0.006, 20).first, 0);
    EXPECT_NEAR(rise(0.03, 60).first, 0.02, 5e-3);
    const auto [far, fastest] = rise(1.5, 10, 2);
    EXPECT_LE(fastest, static_cast<double>(softBiasRule<R>().maxBiasVelocity) * 1.001);
    EXPECT_GT(far, 0.05);
}

/// The points of a patch act on each other: of a frictionless body that lands askew none goes on into the
/// ground at the end of a step, which one pass over uncoupled points cannot achieve.
TYPED_TEST(WidePatches, PointsOfOnePatchKnowOfEachOther) {
    using S = TypeParam;
    using R = typename S::Real;
    WorldDef<S> def = wide<S>();
    def.integrator = "symplectic_euler";  // impacts in flight are no patches
    World<S> world(def);
    const auto ice = world.addMaterial(0, 0);
    addGround<S>(world, ice);
    const BodyId box = addCube<S>(world, 0, 0.5 + 1e-4, 0.5, 1, ice);
    world.setVelocity(box, at<S>(0, -2), spin<S>(0.4));
    std::vector<ContactView<S>> contacts;
    double worst = 0, pressed = 0;
    for (int i = 0; i < 3; ++i) {
        const typename S::Vec before = world.pose(box).p;
        world.step(R(1.0 / 60));
        world.readContacts(contacts);
        for (const ContactView<S>& c : contacts) {
            const typename S::Vec r = c.pointA - before;  // the ground's point, where it was found
            // It does not turn about the other axes.
            const double v = static_cast<double>(world.velocity(box)[1]) +
                             spinOf<S>(world.angularVelocity(box)) * static_cast<double>(r[0]);
            if (c.normalImpulse > 0) worst = std::max(worst, -v);
            pressed += static_cast<double>(c.normalImpulse);
        }
    }
    EXPECT_GT(pressed, 1);
    EXPECT_LT(worst, 0.02);
}

/// Twisting: what friction of a turning cube is reported to do is what turned it; a cube that is turned with
/// less than friction can hold stays where it is.
template <class S>
void expectTwistIsReportedAndHolds() {
    using R = typename S::Real;
    World<S> world(wide<S>());
    const auto wood = world.addMaterial(R(0.4), 0);
    addGround<S>(world, wood);
    const double half = 0.25, mass = 2, inertia = 2.0 / 3 * mass * half * half;
    const BodyId cube = addCube<S>(world, 0, half, half, mass, wood);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    const double limit = 0.4 * mass * kGravity * half * std::sqrt(2.0);
    for (int i = 0; i < 60; ++i) {
        world.applyForce(cube, S::Vec::Zero(), typename S::Ang(0, static_cast<R>(0.8 * limit * i / 60), 0));
        world.step(R(1.0 / 60));
    }
    EXPECT_NEAR(world.angularVelocity(cube)[1], 0, 2e-3);
    EXPECT_GT(world.pose(cube).q.w(), 0.9999);
    world.setVelocity(cube, S::Vec::Zero(), typename S::Ang(0, 9, 0));
    std::vector<ContactView<S>> contacts;
    for (int i = 0; i < 10; ++i) {
        const double before = static_cast<double>(world.angularVelocity(cube)[1]);
        const typename S::Vec center = world.pose(cube).p;
        world.step(R(1.0 / 60));
        world.readContacts(contacts);
        double moment = 0;
        for (const ContactView<S>& c : contacts)
            moment += static_cast<double>(typename S::Vec(c.pointA - center).cross(c.frictionImpulse)[1]);
        const double change = inertia * (static_cast<double>(world.angularVelocity(cube)[1]) - before);
        EXPECT_LT(change, -0.01);
        EXPECT_NEAR(moment, change, 0.02 * std::abs(change)) << i;
    }
}
TEST(WidePatchesTwist, IsReportedAndHolds) {
    expectTwistIsReportedAndHolds<Space3f>();
    expectTwistIsReportedAndHolds<Space3d>();
}

/// A torque below what friction can hold on a body that is hard to turn: a visit takes a small part of the
/// spin away, and the impulses of the step before have to do the rest.
template <class S>
void expectHeldWithoutCreeping() {
    using R = typename S::Real;
    World<S> world(wide<S>());
    const auto wood = world.addMaterial(R(0.4), 0);
    addGround<S>(world, wood);
    BodyDef<S> def;
    const double half = 0.25, r2 = 2 * half * half;
    def.mass = 1;
    def.inertia = isotropic<S>(20 * r2);  // inertia of a sphere of 1 kg
    def.pose.p = at<S>(0, half);
    const BodyId body = world.addBody(def);
    attach<S>(world, body, Box<S>{S::Vec::Constant(static_cast<R>(half))}, wood);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    const double limit = 0.4 * kGravity * std::sqrt(r2);
    for (int i = 0; i < 180; ++i) {
        const double share = 0.6 * std::min(1.0, i / 60.0);
        world.applyForce(body, S::Vec::Zero(), typename S::Ang(0, static_cast<R>(share * limit), 0));
        world.step(R(1.0 / 60));
    }
    EXPECT_NEAR(world.angularVelocity(body)[1], 0, 1e-5);
}
TEST(WidePatchesTwist, IsHeldWithoutCreeping) {
    expectHeldWithoutCreeping<Space3f>();
    expectHeldWithoutCreeping<Space3d>();
}

/// A wide plate that is easily turned: friction slows its spin and never reverses it.
template <class S>
void expectSpinIsNotReversed() {
    using R = typename S::Real;
    World<S> world(wide<S>());
    const auto wood = world.addMaterial(R(0.3), 0);
    addGround<S>(world, wood);
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = isotropic<S>(0.1);
    def.pose.p = at<S>(0, 0.1);
    const BodyId plate = world.addBody(def);
    attach<S>(world, plate, Box<S>{typename S::Vec(R(1), R(0.1), R(1))}, wood);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    world.setVelocity(plate, S::Vec::Zero(), typename S::Ang(0, 6, 0));
    double least = 6;
    for (int i = 0; i < 60; ++i) {
        world.step(R(1.0 / 60));
        least = std::min(least, static_cast<double>(world.angularVelocity(plate)[1]));
    }
    EXPECT_GT(least, -1e-3);
    EXPECT_LT(world.angularVelocity(plate)[1], 1e-3);
}
TEST(WidePatchesSpin, IsSlowedAndNotReversed) {
    expectSpinIsNotReversed<Space3f>();
    expectSpinIsNotReversed<Space3d>();
}

/// Friction acts where the pressure is: a body whose mass is not over the middle of its base slides straight.
template <class S>
void expectSlidesStraight() {
    using R = typename S::Real;
    World<S> world(wide<S>());
    const auto wood = world.addMaterial(R(0.3), 0);
    addGround<S>(world, wood);
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = isotropic<S>(0.2);
    def.pose.p = at<S>(0, 0.1);
    const BodyId body = world.addBody(def);
    ShapeDef<S> base;
    base.shape = Box<S>{typename S::Vec(R(0.5), R(0.1), R(0.5))};
    base.pose.p = typename S::Vec(0, 0, R(0.3));
    base.material = wood;
    world.addShape(body, base);
    for (int i = 0; i < 60; ++i) world.step(R(1.0 / 60));
    world.setVelocity(body, at<S>(4, 0), zeroAng<S>());
    for (int i = 0; i < 40; ++i) world.step(R(1.0 / 60));
    EXPECT_NEAR(world.velocity(body)[0], 4 - 0.3 * kGravity * 40 / 60, 0.03);
    EXPECT_NEAR(world.angularVelocity(body)[1], 0, 0.05);
}
TEST(WidePatchesCentre, IsThatOfThePressure) {
    expectSlidesStraight<Space3f>();
    expectSlidesStraight<Space3d>();
}

/// A long body, turned, that hits with a corner: its angular momentum changes by the moment of the reported
/// impulse about its centre, with the inertia about the axes of the world.
template <class S>
void expectImpulseTurnsByTheWorldsInertia() {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    World<S> world(wide<S>(false));
    const auto ice = world.addMaterial(0, 0);
    addGround<S>(world, ice);
    BodyDef<S> def;
    const Vec inertia(R(0.05), R(2), R(2));
    def.mass = 1;
    def.inertia = inertia.asDiagonal();
    def.pose.q = expMap(Vec(R(0.3), R(1), R(0.4)));
    def.velocity = at<S>(0, -2);
    const Box<S> shape{Vec(R(1), R(0.1), R(0.1))};
    const typename S::Mat turned = toMatrix(def.pose.q);
    def.pose.p[1] = turned.row(1).cwiseAbs().dot(shape.halfExtents) + R(0.001);
    const BodyId body = world.addBody(def);
    attach<S>(world, body, shape, ice);
    std::vector<ContactView<S>> contacts;
    bool hit = false;
    for (int i = 0; i < 4 && !hit; ++i) {
        const Vec center = world.pose(body).p;
        world.step(R(1.0 / 2000));
        world.readContacts(contacts);
        Vec moment = Vec::Zero();
        for (const ContactView<S>& c : contacts)
            moment += Vec(c.pointA - center).cross(Vec(c.normalImpulse * c.normal));
        hit = moment.norm() > 0.1;
        if (!hit) continue;
        const Vec momentum =
            turned * (inertia.asDiagonal() * (turned.transpose() * world.angularVelocity(body)));
        EXPECT_LT((momentum - moment).norm(), 0.02 * moment.norm());
    }
    EXPECT_TRUE(hit);
}
TEST(WidePatchesInertia, IsAboutTheWorldsAxes) {
    expectImpulseTurnsByTheWorldsInertia<Space3f>();
    expectImpulseTurnsByTheWorldsInertia<Space3d>();
}

}  // namespace
}  // namespace rigor::engine::test
