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

/// Moments of a body: its shape's own, or their mean about every axis, with which it has no gyroscopic term.
enum class Moments { Own, Equal };

Eigen::Matrix3d momentsOf(const Shape& shape, Moments kind) {
    const Eigen::Matrix3d own = shape.computeInertia(1.0);
    return kind == Moments::Own ? own : Eigen::Matrix3d(own.trace() / 3.0 * Eigen::Matrix3d::Identity());
}

/// The scene of the file. The library's capsules and cylinders lie along z, the file's along y.
Loop drop(double step, Moments moments = Moments::Own) {
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
        const Inertia mass(1.0, Eigen::Vector3d::Zero(), momentsOf(*shape, moments));
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

constexpr double kEndless = 1e5;  ///< a spin that only grows from there on [rad/s]

/// The largest spin within `duration` [rad/s]. It ends at `kEndless`, before a pose is no number: Debian's build has its
/// assertions on, and one of them ends the process there.
double largestSpin(const Loop& loop, double step, double duration) {
    double largest = 0.0;
    for (int i = 0; i < std::lround(duration / step) && largest < kEndless; ++i) {
        loop.world->step();
        for (const auto* body : loop.bodies) largest = std::max(largest, body->getAngularVelocity().norm());
    }
    return largest;
}

enum class Solver { Dantzig, Sweeps };

double largestSpinOfDrop(double step, Moments moments, Solver kind) {
    const Loop loop = drop(step, moments);
    if (kind == Solver::Sweeps) {
        auto* solver =
            dynamic_cast<dart::constraint::BoxedLcpConstraintSolver*>(loop.world->getConstraintSolver());
        EXPECT_NE(solver, nullptr);
        solver->setBoxedLcpSolver(std::make_shared<dart::constraint::PgsBoxedLcpSolver>());
        solver->setSecondaryBoxedLcpSolver(nullptr);
    }
    return largestSpin(loop, step, 2.0);
}

/// A box of the scene in free flight: Euler's step of its gyroscopic term gains energy in each step.
TEST(PlainDart, AFastSpinOfABoxInFreeFlightGrowsWithoutEnd) {
    const auto spin = [](double step, bool hasEqualMoments) {
        Loop loop(step, {0, 0, 0});
        const BoxShape box({0.32, 0.04, 0.26});
        const Inertia mass(1.0, Eigen::Vector3d::Zero(),
                           momentsOf(box, hasEqualMoments ? Moments::Equal : Moments::Own));
        auto* body = loop.add(&mass, {0, 0, 0});
        dynamic_cast<FreeJoint*>(body->getParentJoint())->setAngularVelocity({40, 5, 45});
        return largestSpin(loop, step, 1.4);
    };
    EXPECT_GE(spin(1.0 / 60, false), kEndless);
    EXPECT_GE(spin(1.0 / 120, false), kEndless);
    EXPECT_GT(spin(1.0 / 240, false), 1000.0);
    EXPECT_LT(spin(1.0 / 60, true), 61.0);
}

/// Bodies of the scene leave the mesh with spins of 70 rad/s. With long steps those of single ones grow until they are no
/// numbers, by either solver, and with equal moments none does.
TEST(PlainDart, LongStepsSpinBodiesOfDropOnMeshWithoutEnd) {
    for (const auto solver : {Solver::Dantzig, Solver::Sweeps}) {
        EXPECT_GE(largestSpinOfDrop(1.0 / 50, Moments::Own, solver), kEndless);
        for (const double rate : {50, 60})
            EXPECT_LT(largestSpinOfDrop(1.0 / rate, Moments::Equal, solver), 300.0) << rate;
        EXPECT_LT(largestSpinOfDrop(1.0 / 120, Moments::Own, solver), 100.0);
    }
    EXPECT_GT(largestSpinOfDrop(1.0 / 60, Moments::Own, Solver::Dantzig), 1000.0);
}

}  // namespace
}  // namespace rigor::plain
