// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts: ten boxes on each other, a block that slides to rest, and a ball that bounces, by DART's defaults and with
// ODE's narrow phase.
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "adapters/conformance/plain_programs/dart/loop.hpp"

namespace rigor::plain {
namespace {

using dart::dynamics::BoxShape;
using dart::dynamics::PlaneShape;
using dart::dynamics::SphereShape;

const Eigen::Vector3d kDown(0, -9.81, 0);

/// Ten boxes with ODE's narrow phase. All surfaces are the same, so that DART's own coefficients are the pairs'.
TEST(PlainDart, Stack) {
    Loop loop(1.0 / 60, kDown);
    loop.world->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    loop.add(nullptr, {0, -0.5, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(40, 1, 40)), 0.5);
    const auto box = boxInertia(1, {1, 1, 1});
    for (int i = 0; i < 10; ++i)
        loop.add(&box, {0, 0.49999 + i * 0.99999, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(1, 1, 1)),
                 0.5);
    const Trajectory plain = loop.run(60);
    const Scenario scene = load("scenarios/library/3d/box_stack.json");
    EXPECT_TRUE(same(plain, adapterRun("dart:preset=default,narrow_phase=ode", scene, 1.0 / 60, 60),
                     {1e-9, 1e-9, 1e-8, 1e-8}));
}

/// A block on a floor, all by DART's defaults: meshes for shapes, the lesser of two coefficients.
TEST(PlainDart, Slide) {
    Loop loop(1.0 / 240, kDown);
    loop.add(nullptr, {0, -0.5, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(40, 1, 40)), 0.5);
    const auto box = boxInertia(2, {0.5, 0.1, 0.5});
    auto* block =
        loop.add(&box, {0, 0.05, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(0.5, 0.1, 0.5)), 0.9);
    dynamic_cast<dart::dynamics::FreeJoint*>(block->getParentJoint())->setLinearVelocity({4, 0, 0});
    const Trajectory plain = loop.run(240);
    EXPECT_GT(travel(plain, 1), 1.0);
    const Scenario scene = load("adapters/conformance/plain_programs/dart/slide.json");
    EXPECT_TRUE(
        same(plain, adapterRun("dart:preset=default", scene, 1.0 / 240, 240), {1e-12, 1e-12, 1e-12, 1e-12}));
}

/// The way of a block of 4 m/s, mu = 0.5, in a direction between x and z [m]; Coulomb's law has 1.631 m.
double slideWay(double angle) {
    Loop loop(1.0 / 240, kDown);
    loop.world->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    loop.add(nullptr, {0, -0.5, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(40, 1, 40)), 0.5);
    const auto box = boxInertia(2, {0.5, 0.1, 0.5});
    auto* block =
        loop.add(&box, {0, 0.05, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(0.5, 0.1, 0.5)), 0.5);
    dynamic_cast<dart::dynamics::FreeJoint*>(block->getParentJoint())
        ->setLinearVelocity({4 * std::cos(angle), 0, 4 * std::sin(angle)});
    return travel(loop.run(240), 1);
}

/// Each of two directions is bounded by itself, so that friction between them is sqrt 2 of the cone's.
TEST(PlainDart, FrictionIsAPyramid) {
    EXPECT_NEAR(slideWay(0.0), 1.631, 0.02);
    EXPECT_NEAR(slideWay(M_PI / 4) / 1.631, 1.0 / std::sqrt(2.0), 0.01);
}

/// DART takes the product of both restitutions, so that one of the shapes has 1.
TEST(PlainDart, Bounce) {
    Loop loop(1.0 / 240, kDown);
    loop.world->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    loop.add(nullptr, {0, 0, 0}, std::make_shared<PlaneShape>(Eigen::Vector3d(0, 1, 0), 0.0), 0.0, 1.0);
    const auto ball = inertia(1, Eigen::Vector3d::Constant(0.4 * 0.01));
    loop.add(&ball, {0, 1.1, 0}, std::make_shared<SphereShape>(0.1), 0.0, 0.8);
    const Trajectory plain = loop.run(480);
    EXPECT_GT(travel(plain, 1), 0.9);
    const Scenario scene = load("scenarios/library/3d/bouncing_ball.json");
    EXPECT_TRUE(same(plain, adapterRun("dart:preset=default,narrow_phase=ode", scene, 1.0 / 240, 480),
                     {1e-12, 1e-12, 1e-12, 1e-12}));
}

/// The rebound is e (v + g h) of the approach v, where Newton's law has e v: the step's gravity is in it. Measured as the
/// first height after the bounce against that of a ball that is thrown up from the touch.
TEST(PlainDart, ReboundCountsTheStepsGravity) {
    const double h = 1.0 / 240, e = 0.8;
    Loop loop(h, kDown);
    loop.world->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    loop.add(nullptr, {0, 0, 0}, std::make_shared<PlaneShape>(Eigen::Vector3d(0, 1, 0), 0.0), 0.0, 1.0);
    const auto ball = inertia(1, Eigen::Vector3d::Constant(0.4 * 0.01));
    loop.add(&ball, {0, 1.1, 0}, std::make_shared<SphereShape>(0.1), 0.0, e);
    const Trajectory plain = loop.run(120);
    for (std::size_t i = 1; i < plain.size(); ++i) {
        const double before = plain[i - 1][1].velocity.y, after = plain[i][1].velocity.y;
        if (after < 0.0) continue;
        EXPECT_NEAR(after, e * (9.81 * h - before), 1e-4);
        return;
    }
    FAIL() << "no bounce";
}

/// Whether a ball of 0.2 m touches a shape of about half a metre, by FCL.
bool touches(dart::collision::FCLCollisionDetector::PrimitiveShape kind,
             const dart::dynamics::ShapePtr& shape, const Eigen::Vector3d& ball) {
    using dart::dynamics::SimpleFrame;
    const auto detector = dart::collision::FCLCollisionDetector::create();
    detector->setPrimitiveShapeType(kind);
    SimpleFrame one(dart::dynamics::Frame::World(), "one"), two(dart::dynamics::Frame::World(), "two");
    const auto groupOf = [&](SimpleFrame& frame, const dart::dynamics::ShapePtr& of) {
        frame.setShape(of);
        frame.createCollisionAspect();
        auto group = detector->createCollisionGroupAsSharedPtr();
        group->addShapeFrame(&frame);
        return group;
    };
    two.setTranslation(ball);
    const auto first = groupOf(one, shape), second = groupOf(two, std::make_shared<SphereShape>(0.2));
    return first->collide(second.get());
}

/// A ball that overlaps a cone's tip by 0.1 m, and one a metre away. The mesh that DART makes of a cone is none (FCL's
/// iterations on it do not converge): which balls touch it differs from run to run. As FCL's own it touches nothing.
TEST(PlainDart, ConesAreNotFound) {
    using dart::collision::FCLCollisionDetector;
    const Eigen::Vector3d tip(0.01, 0.02, 0.6), away(0.01, 0.02, 1.6);
    for (const auto kind : {FCLCollisionDetector::MESH, FCLCollisionDetector::PRIMITIVE}) {
        const auto isRight = [&](const dart::dynamics::ShapePtr& shape) {
            return touches(kind, shape, tip) && !touches(kind, shape, away);
        };
        EXPECT_TRUE(isRight(std::make_shared<SphereShape>(0.5)));
        EXPECT_FALSE(isRight(std::make_shared<dart::dynamics::ConeShape>(0.5, 1.0)));
    }
}

/// Contacts between two boxes of a metre, one a millimetre deep in the other and turned by half a radian.
std::size_t contactsOfBoxes(const std::shared_ptr<dart::collision::CollisionDetector>& detector) {
    Loop loop(1.0 / 60, kDown);
    if (detector) loop.world->getConstraintSolver()->setCollisionDetector(detector);
    const auto box = boxInertia(1, {1, 1, 1});
    loop.add(nullptr, {0, 0, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(1, 1, 1)), 0.5);
    auto* upper = loop.add(&box, {0, 0, 0}, std::make_shared<BoxShape>(Eigen::Vector3d(1, 1, 1)), 0.5);
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
    pose.translation().y() = 0.999;
    dynamic_cast<dart::dynamics::FreeJoint*>(upper->getParentJoint())->setTransform(pose);
    loop.world->step();
    return loop.world->getLastCollisionResult().getNumContacts();
}

/// Every pair of triangles has contacts by default: 19 where ODE's narrow phase finds 8. Dantzig's method takes the cube
/// of the contacts of a pile, so that pile and pyramid_2d do not end in their time.
TEST(PlainDart, BoxesAsMeshesTouchAtManyPoints) {
    const std::size_t meshes = contactsOfBoxes(nullptr);
    const std::size_t boxes = contactsOfBoxes(dart::collision::OdeCollisionDetector::create());
    EXPECT_LE(boxes, 8u);
    EXPECT_GE(meshes, 2 * boxes);
}

}  // namespace
}  // namespace rigor::plain
