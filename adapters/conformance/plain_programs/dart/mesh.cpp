// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Meshes: the bodies of drop_on_mesh on their rough ground, with either solver of the contacts' problem.
#include <algorithm>
#include <cmath>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "adapters/conformance/plain_programs/dart/loop.hpp"
#include "adapters/conformance/plain_programs/dart/mesh.hpp"

namespace rigor::plain {
namespace {

using namespace dart::dynamics;

ShapePtr shapeOf(const scenario::Geometry& geometry) {
    if (const auto* ball = std::get_if<scenario::Sphere>(&geometry))
        return std::make_shared<SphereShape>(ball->radius);
    if (const auto* box = std::get_if<scenario::Box>(&geometry))
        return std::make_shared<BoxShape>(
            2.0 * Eigen::Vector3d(box->halfExtents.x, box->halfExtents.y, box->halfExtents.z));
    if (const auto* capsule = std::get_if<scenario::Capsule>(&geometry))
        return std::make_shared<CapsuleShape>(capsule->radius, 2.0 * capsule->halfLength);
    const auto& disc = std::get<scenario::Cylinder>(geometry);
    return std::make_shared<CylinderShape>(disc.radius, 2.0 * disc.halfLength);
}

/// The scene of the file. The library's capsules and cylinders lie along z, the file's along y.
Loop drop(double step) {
    const Scenario scene = load("scenarios/library/3d/drop_on_mesh.json");
    Loop loop(step, {0, -9.81, 0});
    loop.world->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    const double e = std::sqrt(0.1);
    // The ground has 441 corners, which are taken from the file instead of written out.
    loop.add(nullptr, {0, 0, 0},
             meshShape(std::get<scenario::TriangleMesh>(scene.bodies[0].shapes[0].geometry)), 0.5, e);
    const Eigen::Quaterniond alongY(Eigen::AngleAxisd(-0.5 * M_PI, Eigen::Vector3d::UnitX()));
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const auto& of = scene.bodies[i];
        const auto shape = shapeOf(of.shapes[0].geometry);
        const Inertia mass(1.0, Eigen::Vector3d::Zero(), shape->computeInertia(1.0));
        auto* body = loop.add(&mass, {0, 0, 0}, shape, 0.5, e);
        auto* joint = dynamic_cast<FreeJoint*>(body->getParentJoint());
        const Vec3& at = of.pose.position;
        const Quat& q = of.pose.orientation;
        const bool turned =
            dynamic_cast<CapsuleShape*>(shape.get()) || dynamic_cast<CylinderShape*>(shape.get());
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.translation() = Eigen::Vector3d(at.x, at.y, at.z);
        pose.linear() =
            (Eigen::Quaterniond(q.w, q.x, q.y, q.z) * (turned ? alongY : Eigen::Quaterniond::Identity()))
                .toRotationMatrix();
        joint->setTransform(pose);
        const Vec3 &v = of.velocity, &w = of.angularVelocity;
        joint->setLinearVelocity({v.x, v.y, v.z});
        joint->setAngularVelocity({w.x, w.y, w.z});
    }
    return loop;
}

/// The largest speed of two seconds [m/s].
double largestSpeed(const Loop& loop, double step) {
    double largest = 0.0;
    for (int i = 0; i < std::lround(2.0 / step); ++i) {
        loop.world->step();
        for (const auto* body : loop.bodies) largest = std::max(largest, body->getLinearVelocity().norm());
    }
    return largest;
}

/// The bodies fall at 11 m/s. With long steps single ones are thrown, by either solver; Debian's build has its assertions
/// on, and one of them ends the process where a pose is no number.
TEST(PlainDart, LongStepsThrowBodiesOfDropOnMesh) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_GT(largestSpeed(drop(1.0 / 50), 1.0 / 50), 100.0);
    const Loop sweeps = drop(1.0 / 60);
    auto* solver =
        dynamic_cast<dart::constraint::BoxedLcpConstraintSolver*>(sweeps.world->getConstraintSolver());
    ASSERT_NE(solver, nullptr);
    solver->setBoxedLcpSolver(std::make_shared<dart::constraint::PgsBoxedLcpSolver>());
    solver->setSecondaryBoxedLcpSolver(nullptr);
    EXPECT_DEATH(largestSpeed(sweeps, 1.0 / 60), "verifyTransform");

    for (const double step : {1.0 / 90, 1.0 / 120, 1.0 / 240})
        EXPECT_LT(largestSpeed(drop(step), step), 12.0) << step;
}

}  // namespace
}  // namespace rigor::plain
