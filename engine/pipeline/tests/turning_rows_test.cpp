// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts whose rows turn within a step (contacts/row_lag.hpp): moreau_midpoint is of order 2 with them, from the first step
// on, where step sizes change, and where bodies let go.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/pipeline/tests/order_fit.hpp"
#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

Eigen::VectorXd stateOf(const World<Space3d>& world, BodyId body) {
    Eigen::VectorXd all(13);
    all << world.pose(body).p, world.pose(body).q.coeffs(), world.velocity(body),
        world.angularVelocity(body) / 10;
    return all;
}

/// Without a slop: the overlap that it leaves would be as large as the errors.
World<Space3d> worldWith(const std::string& integrator) {
    WorldDef<Space3d> def = earthWith<Space3d>(integrator);
    def.slop = 0;
    return World<Space3d>(def);
}

void expectOrders(const RunOf& run, double time, const std::vector<int>& steps) {
    EXPECT_NEAR(orderBetweenRuns(run, "moreau_midpoint", time, steps), 2, 0.15);
    EXPECT_NEAR(orderBetweenRuns(run, "symplectic_euler", time, steps), 1, 0.25);
    const double error = (run("moreau_midpoint", steps[0]) - run("moreau_midpoint", 2 * steps[0])).norm();
    const double ofEuler = (run("symplectic_euler", steps[0]) - run("symplectic_euler", 2 * steps[0])).norm();
    EXPECT_LT(error, 0.2 * ofEuler);
}

/// An ellipsoid on the ground, which rolls to and fro where it is rough.
BodyId addEllipsoid(World<Space3d>& world, double friction) {
    const auto wood = world.addMaterial(friction, 0);
    addGround<Space3d>(world, wood);
    BodyDef<Space3d> def;
    def.mass = 2;
    const Eigen::Vector3d axes(0.3, 0.2, 0.25);
    def.inertia = Eigen::Vector3d(0.2 * (axes.y() * axes.y() + axes.z() * axes.z()),
                                  0.2 * (axes.x() * axes.x() + axes.z() * axes.z()),
                                  0.2 * (axes.x() * axes.x() + axes.y() * axes.y()))
                      .asDiagonal() *
                  2.0;
    const double angle = 0.5;
    def.pose.q = expMap(Eigen::Vector3d(0, 0, angle));
    def.pose.p.y() = std::hypot(axes.x() * std::sin(angle), axes.y() * std::cos(angle));
    def.angularVelocity = Eigen::Vector3d(0.6, 0.3, 0);
    const BodyId body = world.addBody(def);
    attach<Space3d>(world, body, Ellipsoid<Space3d>{axes}, wood);
    return body;
}

TEST(TurningRows, AnEllipsoidRocksOnIceAndRollsOnWood) {
    for (const double friction : {0.0, 0.8}) {
        const auto run = [&](const std::string& integrator, int steps) {
            World<Space3d> world = worldWith(integrator);
            const BodyId body = addEllipsoid(world, friction);
            runSteps(world, 0.8, steps);
            return stateOf(world, body);
        };
        expectOrders(run, 0.8, {120, 240, 480});
    }
}

/// Each change of the step size is a first step: the rows before it are those of another midpoint.
TEST(TurningRows, StepsOfTwoSizesInTurn) {
    const auto run = [](const std::string& integrator, int steps) {
        World<Space3d> world = worldWith(integrator);
        const BodyId body = addEllipsoid(world, 0.8);
        for (int i = 0; i < steps; ++i) world.step(0.8 / steps * (i / 5 % 2 == 0 ? 1.25 : 0.75));
        return stateOf(world, body);
    };
    const Eigen::VectorXd fine = run("moreau_midpoint", 20000);
    for (const int steps : {240, 480, 960}) {
        const double error = (run("moreau_midpoint", steps) - fine).norm();
        EXPECT_LT(error, 0.1 * (run("symplectic_euler", steps) - fine).norm());
    }
}

/// A velocity that is set between steps moves the body to another midpoint than the one the last step has led to.
TEST(TurningRows, AVelocityIsSet) {
    const auto run = [](const std::string& integrator, int steps) {
        World<Space3d> world = worldWith(integrator);
        const BodyId body = addEllipsoid(world, 0.0);
        runSteps(world, 0.3, steps);
        world.setVelocity(body, world.velocity(body),
                          Eigen::Vector3d(world.angularVelocity(body) + Eigen::Vector3d(0, 3, 0)));
        runSteps(world, 0.3, steps);
        return stateOf(world, body);
    };
    EXPECT_NEAR(orderBetweenRuns(run, "moreau_midpoint", 0.3, {120, 240, 480}), 2, 0.15);
}

/// Its surface moves under the contact at a speed that depends on where the contact is.
TEST(TurningRows, ABallRollsOnATurntable) {
    const auto run = [](const std::string& integrator, int steps) {
        World<Space3d> world = worldWith(integrator);
        const auto rubber = world.addMaterial(1, 0);
        BodyDef<Space3d> def;
        def.type = BodyType::Kinematic;
        def.pose.p.y() = -0.1;
        def.angularVelocity.y() = 2.4;
        attach<Space3d>(world, world.addBody(def), Cylinder<Space3d>{3, 0.1}, rubber);
        BodyDef<Space3d> ball;
        ball.pose.p = {0.5, 0.1, 0};
        ball.velocity = {0.2, 0, 0.3};
        const BodyId body = world.addBody(ball);
        ShapeDef<Space3d> shape{Sphere<Space3d>{0.1}, {}};
        shape.material = rubber;
        world.addShape(body, shape);
        runSteps(world, 1.0, steps);
        return stateOf(world, body);
    };
    EXPECT_NEAR(orderBetweenRuns(run, "moreau_midpoint", 1.0, {120, 240, 480}), 2, 0.12);
    EXPECT_NEAR(orderBetweenRuns(run, "symplectic_euler", 1.0, {120, 240, 480}), 1, 0.25);
}

/// A coin that circles on its rim, its middle nearly at rest.
BodyId addCoin(World<Space3d>& world) {
    const auto steel = world.addMaterial(0.9, 0);
    addGround<Space3d>(world, steel);
    const double radius = 0.4, half = 0.02, tilt = 0.35;
    BodyDef<Space3d> def;
    def.mass = 2;
    const double across = 2 * (radius * radius / 4 + half * half / 3);
    def.inertia = Eigen::Vector3d(across, radius * radius, across).asDiagonal();
    def.pose.q = expMap(Eigen::Vector3d(tilt, 0, 0));
    def.pose.p.y() = radius * std::sin(tilt) + half * std::cos(tilt);
    def.angularVelocity = {0, 2.3, -5.4};
    const BodyId body = world.addBody(def);
    attach<Space3d>(world, body, Cylinder<Space3d>{radius, half}, steel);
    return body;
}

TEST(TurningRows, ACoinCirclesOnItsRim) {
    const auto run = [](const std::string& integrator, int steps) {
        World<Space3d> world = worldWith(integrator);
        const BodyId body = addCoin(world);
        runSteps(world, 0.5, steps);
        return stateOf(world, body);
    };
    expectOrders(run, 0.5, {240, 480, 960});
}

/// It weighs as much in the first step as later, and in those in which the midpoints are found anew.
TEST(TurningRows, ACoinKeepsItsWeight) {
    World<Space3d> world = worldWith("moreau_midpoint");
    const BodyId body = addCoin(world);
    for (int i = 0; i < 60; ++i) {
        const double h = i / 7 % 2 == 0 ? 1.0 / 240 : 1.0 / 300;
        if (i % 10 == 5) world.setVelocity(body, world.velocity(body), world.angularVelocity(body));
        world.step(h);
        std::vector<ContactView<Space3d>> contacts;
        world.readContacts(contacts);
        ASSERT_EQ(contacts.size(), 1U) << i;
        EXPECT_NEAR(contacts[0].normalImpulse / h, 2 * kGravity, 0.12 * 2 * kGravity) << i;
    }
}

/// A ball slides off a ball: where they part, and what follows.
TEST(TurningRows, ABallLeavesABall) {
    const double R = 1.02, start = 0.25;
    const auto run = [&](const std::string& integrator, int steps) {
        World<Space3d> world = worldWith(integrator);
        const auto glass = world.addMaterial(0, 0);
        BodyDef<Space3d> fixed;
        fixed.type = BodyType::Static;
        attach<Space3d>(world, world.addBody(fixed), Sphere<Space3d>{0.9}, glass);
        BodyDef<Space3d> def;
        def.pose.p = {R * std::sin(start), R * std::cos(start), 0};
        const BodyId ball = world.addBody(def);
        attach<Space3d>(world, ball, Sphere<Space3d>{0.12}, glass);
        runSteps(world, 0.9, steps);
        return stateOf(world, ball);
    };
    // v^2 = 2 g R (cos start - cos angle) and the normal force g cos angle - v^2 / R is 0 where they part; a parabola follows.
    std::vector<double> h, error;
    const Eigen::VectorXd exact = run("moreau_midpoint", 30000);
    for (int n = 60; n < 2000; n = n * 7 / 5 + 1) {
        h.push_back(0.9 / n);
        error.push_back((run("moreau_midpoint", n) - exact).norm());
    }
    EXPECT_GE(fittedOrder(h, error), 1.8);
    EXPECT_LT(error[0], 3e-3);
}

/// Nothing lags at rest, and contacts that hardly move keep bodies where they are.
TEST(TurningRows, AStackStaysAtRest) {
    World<Space3d> world(earthWith<Space3d>("moreau_midpoint"));
    const auto wood = world.addMaterial(0.5, 0);
    addGround<Space3d>(world, wood);
    std::vector<BodyId> boxes;
    for (int i = 0; i < 5; ++i) boxes.push_back(addCube<Space3d>(world, 0, 0.5 + i, 0.5, 1, wood, 0));
    for (int i = 0; i < 240; ++i) world.step(1.0 / 60);
    for (const BodyId box : boxes)
        EXPECT_LT(world.velocity(box).norm() + world.angularVelocity(box).norm(), 1e-8);
}

}  // namespace
}  // namespace rigor::engine::test
