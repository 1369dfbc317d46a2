// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that springs, rails, hinges and motors link: catalogued values, and as a second method Newton's and
// Euler's laws with the forces that the links can exert.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/flight/rotation.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::Scheme;
using std::numbers::pi;

// ------------------------------------------------------------------------------------------- spring_network
Scenario springPendulum() {
    Scenario s = emptyScene(3, {0, 0, -9.81}, 3);
    addBall(s, "bob", 0.1, 1, 0.4, {1.2 * std::sin(0.5), 0, -1.2 * std::cos(0.5)});
    s.forces.push_back(SpringForce{kNone, 0, {}, {}, 50, 0, 1});
    setReference(s, "spring_network");
    return s;
}

TEST(SpringNetwork, CatalogueValues) {
    const Scenario s = springPendulum();
    expectNear(*makeReference(s)->exact(0, 1).position, {-0.4846291506, 0, -1.082216696}, 1e-9);
    Scenario pair = emptyScene(3, {}, 4);
    addBall(pair, "a", 0.1, 1, 0.4, {}, {0, 1, 0});
    addBall(pair, "b", 0.1, 2, 0.4, {1.2, 0, 0}, {0, -0.5, 0.3});
    pair.forces.push_back(SpringForce{0, 1, {}, {}, 50, 0, 1});
    setReference(pair, "spring_network");
    const auto r = makeReference(pair);
    expectNear(*r->exact(0, 0.5).position, {0.3936867335, 0.5373277501, -0.007465550017}, 1e-9);
    expectNear(*r->exact(1, 2).position, {0.4349956702, 0.1439465652, 0.371210687}, 1e-9);
    // The radial period by quadrature is that of the integrated distance.
    const auto all = r->quantities(0.01, Scheme::Unknown);
    const Quantity* period = findQuantity(all, "radial_period");
    ASSERT_NE(period, nullptr);
    const auto apart = [&](double t) { return norm(*r->exact(1, t).position - *r->exact(0, t).position); };
    for (const double t : {0.1, 0.5, 1.1}) EXPECT_NEAR(apart(t), apart(t + period->exact), 1e-9);
    EXPECT_GT(std::abs(apart(0.1) - apart(0.1 + period->exact / 2)), 1e-2);
    EXPECT_NEAR(period->measure(exactRun(pair, *r, 0.002, 1500)).value(), period->exact, 1e-6);
}

TEST(SpringNetwork, ALongSwingIsAnsweredUpToWhereNeighboursPart) {
    // Two bobs on springs below one another, thrown: as chaotic as a double pendulum.
    Scenario s = springPendulum();
    addBall(s, "second", 0.1, 1, 0.4, {1.6 * std::sin(0.9), 0, -2.0}, {0, 2, 1});
    s.forces.push_back(SpringForce{0, 1, {}, {}, 80, 0, 0.8});
    setReference(s, "spring_network");
    s.duration = 300;
    const auto r = makeReference(s);
    EXPECT_GT(r->validUntil(), 3);
    EXPECT_LT(r->validUntil(), 200);
    // One bob without gravity moves in a central field, which is regular.
    s = springPendulum();
    s.gravity = {};
    s.duration = 100;
    EXPECT_GT(makeReference(s)->validUntil(), 100);
}

TEST(SpringNetwork, ForcesFollowFromTheMotionOfANetWithDampers) {
    Scenario s = emptyScene(3, {0.5, -9.81, 0}, 2);
    addBall(s, "a", 0.1, 1, 0.4, {0.3, -1, 0}, {0, 0.4, 0.5});
    addBall(s, "b", 0.1, 2.5, 0.4, {0.8, -2, 0.3}, {-1, 0, 0});
    s.bodies[1].gravityScale = 0.5;
    s.forces.push_back(SpringForce{kNone, 0, {0, 0.2, 0}, {}, 60, 1.5, 0.8});
    s.forces.push_back(SpringForce{0, 1, {}, {}, 40, 0.7, 1.1});
    setReference(s, "spring_network");
    const auto r = makeReference(s);
    for (const double t : {0.2, 0.9, 1.7}) {
        Vec3 onA{}, onB{};
        const auto pull = [&](Vec3 xa, Vec3 va, Vec3 xb, Vec3 vb, double k, double c, double rest) {
            const Vec3 n = unit(xb - xa);
            return (k * (norm(xb - xa) - rest) + c * dot(vb - va, n)) * n;
        };
        const auto a = r->exact(0, t), b = r->exact(1, t);
        onA = onA - pull({0, 0.2, 0}, {}, *a.position, *a.velocity, 60, 1.5, 0.8);
        const Vec3 between = pull(*a.position, *a.velocity, *b.position, *b.velocity, 40, 0.7, 1.1);
        onA += between;
        onB = onB - between;
        expectNear(wrenchOn(s, *r, 0, t).force, onA, 1e-7);
        expectNear(wrenchOn(s, *r, 1, t).force, onB, 1e-7);
        expectConsistent(s, *r, 0, t, 1e-9);
    }
}

TEST(SpringNetwork, SchemeValuesAreStepsByHandAndApproachTheExactOnes) {
    const Scenario s = springPendulum();
    const auto r = makeReference(s);
    Vec3 x = s.bodies[0].pose.position, v{};
    for (int k = 0; k < 100; ++k) {
        const double l = norm(x);
        v += 0.005 * (s.gravity - (50 * (l - 1) / l) * x);
        x += 0.005 * v;
    }
    expectNear(*r->schemeExact(0, 100, 0.005, Scheme::SymplecticEuler)->position, x, 1e-12);
    EXPECT_FALSE(r->schemeExact(0, 1, 0.005, Scheme::RungeKutta4).has_value());
    const auto error = [&](double h) {
        const auto n = static_cast<std::size_t>(std::lround(1 / h));
        return norm(*r->schemeExact(0, n, h, Scheme::SymplecticEuler)->position - *r->exact(0, 1).position);
    };
    EXPECT_NEAR(std::log2(error(1e-3) / error(5e-4)), 1.0, 0.05);
}

TEST(SpringNetwork, RefusesWhatItDoesNotKnow) {
    Scenario s = springPendulum();
    s.bodies[0].angularVelocity = {0, 1, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = springPendulum();
    std::get<SpringForce>(s.forces[0]).anchorB = {0.05, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = springPendulum();
    s.forces.clear();
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// -------------------------------------------------------------------------------------------- cart_pendulum
Scenario cartPendulum(int dimension, Vec3 axis = {0, 0, 1}, Vec3 rail = {1, 0, 0}) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 3);
    addBox(s, "cart", {0.2, 0.1, 0.1}, 2, {});
    const Vec3 down = cross(axis, rail) * -1.0;
    const Quat tilt = fromAxisAngle(axis, 2.0);
    addBox(s, "rod", {0.01, 0.5, 0.01}, 1, rotate(tilt, 0.5 * down));
    s.bodies[1].pose.orientation = tilt;
    s.bodies[1].massProperties.inertia = Mat3::diagonal(1.0 / 12, 1.0 / 12, 1.0 / 12);
    for (auto& body : s.bodies) body.collides = false;
    Joint& slider = addJoint(s, JointType::Slider, kNone, 0, {}, rail);
    slider.axisA = rail;
    addJoint(s, JointType::Hinge, 0, 1, {}, axis);
    setReference(s, "cart_pendulum", {{"cart", std::string("cart")}, {"pendulum", std::string("rod")}});
    return s;
}

TEST(CartPendulum, CatalogueValuesInTwoAndThreeDimensions) {
    for (const int dimension : {2, 3}) {
        const Scenario s = cartPendulum(dimension);
        const auto r = makeReference(s);
        const auto rod = r->exact(1, 1);
        EXPECT_NEAR(std::remainder(2 * std::atan2(rod.orientation->z, rod.orientation->w), 2 * pi),
                    -1.983706924, 1e-8);
        EXPECT_NEAR(r->exact(0, 1).position->x, 0.3042090292, 1e-8);
    }
}

TEST(CartPendulum, TheHingeAloneTurnsTheRodAndTheRailOnlyPushesAcross) {
    const Vec3 rail = unit({1, 0.3, 0});
    Scenario s = cartPendulum(3, {0, 0, 1}, rail);
    s.bodies[0].velocity = 0.4 * rail;
    s.bodies[1].angularVelocity = {0, 0, -1.5};
    s.bodies[1].velocity = 0.4 * rail + cross({0, 0, -1.5}, s.bodies[1].pose.position);
    s.bodies[0].gravityScale = 0.7;
    const auto r = makeReference(s);
    const double start = energyOf(s, *r, 0);
    for (const double t : {0.3, 1.0, 1.8}) {
        const Wrench cart = wrenchOn(s, *r, 0, t), rod = wrenchOn(s, *r, 1, t);
        const Vec3 hinge = pointAt(*r, 1, t, s.joints[1].anchorB);
        expectNear(hinge, pointAt(*r, 0, t, s.joints[1].anchorA), 1e-12);
        EXPECT_LT(norm(rod.remainder(hinge)), 1e-7);
        EXPECT_NEAR(dot(cart.force + rod.force, rail), 0.0, 1e-7);
        expectConsistent(s, *r, 1, t, 1e-9);
        EXPECT_NEAR(energyOf(s, *r, t), start, 1e-10);
    }
}

TEST(CartPendulum, RefusesAHingeAlongTheRailAndOtherJoints) {
    Scenario s = cartPendulum(3);
    s.joints[1].axisA = s.joints[1].axisB = {1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = cartPendulum(3);
    s.joints[0].axes[0].motorMaxForce = 1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
    s = cartPendulum(3);
    s.bodies[1].velocity = {1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// ------------------------------------------------------------------------------------------- rotating_hinge
Scenario hoop(double rate, double angle, double spin) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, 4);
    addBody(s, "shaft", BodyType::Kinematic, Box{{0.05, 0.05, 0.05}}, {});
    s.bodies[0].angularVelocity = {0, 0, rate};
    // The hinge along y; the arm hangs in the x-z plane.
    const Vec3 arm{-std::sin(angle), 0, -std::cos(angle)};
    addBall(s, "bead", 0.05, 1, 1e-12, arm);
    s.bodies[1].pose.orientation = fromAxisAngle({0, 1, 0}, angle);
    const Vec3 w = Vec3{0, 0, rate} + Vec3{0, spin, 0};
    s.bodies[1].angularVelocity = w;
    s.bodies[1].velocity = cross(w, arm);
    for (auto& body : s.bodies) body.collides = false;
    addJoint(s, JointType::Hinge, 0, 1, {}, {0, 1, 0});
    setReference(s, "rotating_hinge");
    return s;
}

TEST(RotatingHinge, CatalogueValueAndPitchfork) {
    const auto tilt = [](const Reference& r, double t) {
        const Vec3 x = *r.exact(1, t).position;
        return std::atan2(std::hypot(x.x, x.y), -x.z);
    };
    const Scenario s = hoop(4, 0.5, 0);
    EXPECT_NEAR(tilt(*makeReference(s), 1), 1.194209336, 1e-8);
    // Equilibrium on the hoop at acos(g/(R W^2)) above the critical rate sqrt(g/R), at the bottom below it.
    const Scenario balanced = hoop(4, 0.9107860127, 0);
    EXPECT_NEAR(tilt(*makeReference(balanced), 3), 0.9107860127, 1e-8);
    const Scenario slow = hoop(3.13, 0.05, 0), fast = hoop(3.3, 0.05, 0);
    const auto most = [](const Scenario& scene) {
        const auto r = makeReference(scene);
        const auto all = r->quantities(0.01, Scheme::Unknown);
        const Quantity* q = findQuantity(all, "tilt_max");
        EXPECT_NEAR(q->measure(exactRun(scene, *r, 0.002, 2000)).value(), q->exact, 1e-5);
        return q->exact;
    };
    EXPECT_LT(most(slow), 0.051);
    EXPECT_GT(most(fast), 0.5);
}

TEST(RotatingHinge, TheHingeGivesNoTorqueAboutItsAxis) {
    Scenario s = hoop(2.5, 0.8, 1.2);
    // Anything skew: a tensor with products of inertia, an anchor off the axis, gravity across it.
    Mat3 inertia = Mat3::diagonal(0.11, 0.17, 0.23);
    inertia(0, 1) = inertia(1, 0) = 0.02;
    inertia(1, 2) = inertia(2, 1) = -0.03;
    s.bodies[1].massProperties.inertia = inertia;
    s.gravity = {1, 2, -9};
    const Vec3 shift{0.2, 0.1, 0.3};
    s.bodies[1].pose.position += shift;
    s.bodies[1].velocity += cross(s.bodies[0].angularVelocity, shift);
    s.joints[0].anchorA = shift;
    const auto r = makeReference(s);
    for (const double t : {0.3, 1.1, 2.4}) {
        const Wrench w = wrenchOn(s, *r, 1, t);
        const Quat turn = fromAxisAngle({0, 0, 1}, 2.5 * t);
        const Vec3 axis = rotate(turn, {0, 1, 0});
        EXPECT_NEAR(dot(axis, w.remainder(rotate(turn, shift))), 0.0, 1e-7);
        expectNear(pointAt(*r, 1, t, s.joints[0].anchorB), rotate(turn, shift), 1e-12);
        expectNear(rotate(*r->exact(1, t).orientation, s.joints[0].axisB), axis, 1e-12);
        expectConsistent(s, *r, 1, t, 1e-8);
    }
    s.bodies[1].velocity.x += 0.1;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// ----------------------------------------------------------------------------------------------- motor_pair
Scenario motorPair(int dimension) {
    Scenario s = emptyScene(dimension, {0, 0, 0}, 2);
    addBox(s, "a", {0.1, 0.1, 0.1}, 1, {});
    addBox(s, "b", {0.1, 0.1, 0.1}, 1, {});
    s.bodies[0].massProperties.inertia = Mat3::diagonal(1, 1, 2);
    s.bodies[1].massProperties.inertia = Mat3::diagonal(3, 3, 1);
    Joint& j = addJoint(s, JointType::Hinge, 0, 1, {});
    j.axes[0].motorSpeed = 6;
    j.axes[0].motorMaxForce = 3;
    setReference(s, "motor_pair");
    return s;
}

TEST(MotorPair, CatalogueValuesAndMeasures) {
    for (const int dimension : {2, 3}) {
        const Scenario s = motorPair(dimension);
        const auto r = makeReference(s);
        EXPECT_NEAR(r->exact(0, 1).angularVelocity->z, -1.5, 1e-12);
        EXPECT_NEAR(r->exact(1, 2).angularVelocity->z, 4, 1e-12);
        const auto angle = [&](int body, double t) {
            const Quat q = *r->exact(body, t).orientation;
            return std::remainder(2 * std::atan2(q.z, q.w), 2 * pi);
        };
        EXPECT_NEAR(angle(0, 2), -2.666666667, 1e-9);
        EXPECT_NEAR(angle(1, 2), 5.333333333 - 2 * pi, 1e-9);
        const Trajectory run = exactRun(s, *r, 0.01, 200);
        const auto all = r->quantities(0.01, Scheme::Unknown);
        ASSERT_EQ(all.size(), 3U);
        EXPECT_NEAR(all[0].exact, 1.333333333, 1e-9);
        for (const auto& q : all) EXPECT_NEAR(q.measure(run).value(), q.exact, 1e-9) << q.name;
    }
}

TEST(MotorPair, TorquesAreOppositeAndBoundedAndDriveTheDifference) {
    Scenario s = motorPair(3);
    s.bodies[0].angularVelocity = {0, 0, 5};
    s.bodies[1].angularVelocity = {0, 0, 14};  // The body is too fast: the motor brakes.
    const auto r = makeReference(s);
    for (const double t : {0.2, 1.5}) {
        const Wrench a = wrenchOn(s, *r, 0, t), b = wrenchOn(s, *r, 1, t);
        EXPECT_NEAR(a.torque.z + b.torque.z, 0.0, 1e-9);
        EXPECT_NEAR(b.torque.z, t < 1 ? -3.0 : 0.0, 1e-9);
        expectConsistent(s, *r, 0, t, 1e-8);
    }
    EXPECT_NEAR(r->exact(1, 2).angularVelocity->z - r->exact(0, 2).angularVelocity->z, 6.0, 1e-12);
    s.bodies[1].velocity = {1, 0, 0};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// ---------------------------------------------------------------------------------------------- hooke_joint
/// Input along x; output in the x-y plane at the angle beta; the input's yoke starts along `yoke` (unit).
Scenario hooke(double beta, double rate, double yokeAngle) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 7);
    const Vec3 e{1, 0, 0}, f{std::cos(beta), std::sin(beta), 0};
    const Vec3 c = rotate(fromAxisAngle(e, yokeAngle), {0, 0, 1}), d = unit(cross(c, f));
    addBody(s, "input", BodyType::Kinematic, Box{{0.2, 0.05, 0.05}}, {-0.3, 0, 0});
    s.bodies[0].angularVelocity = rate * e;
    addBox(s, "cross", {0.1, 0.1, 0.1}, 1, {});
    addBox(s, "output", {0.2, 0.05, 0.05}, 1, 0.3 * f);
    const double b = -rate * dot(cross(e, c), d) / dot(c, cross(f, d));
    s.bodies[1].angularVelocity = rate * e + (b * dot(f, c)) * c;
    s.bodies[2].angularVelocity = b * f;
    for (auto& body : s.bodies) body.collides = false;
    addJoint(s, JointType::Hinge, 0, 1, {}, c);
    addJoint(s, JointType::Hinge, 1, 2, {}, d);
    addJoint(s, JointType::Hinge, kNone, 2, {}, f);
    setReference(s, "hooke_joint",
                 {{"input", std::string("input")},
                  {"cross", std::string("cross")},
                  {"output", std::string("output")}});
    return s;
}

TEST(HookeJoint, CatalogueValues) {
    // The catalogue's angle is from the input yoke across the plane of the shafts, as here at the start.
    const Scenario s = hooke(0.5, 1, 0);
    const auto r = makeReference(s);
    const Vec3 f{std::cos(0.5), std::sin(0.5), 0};
    const double ratio[] = {0.9265316872, 1.048172486, 1.083494171};
    const double out[] = {0.4470529806, 0.939136096, 2.051494055};
    int i = 0;
    for (const double t : {0.5, 1.0, 2.0}) {
        const auto e = r->exact(2, t);
        EXPECT_NEAR(dot(*e.angularVelocity, f), ratio[i], 1e-9);
        const Vec3 d = rotate(*e.orientation, s.joints[1].axisB), d0 = s.joints[1].axisB;
        EXPECT_NEAR(std::atan2(dot(f, cross(d0, d)), dot(d0, d)), out[i], 1e-9);
        ++i;
    }
}

TEST(HookeJoint, EveryHingeHoldsAndTheMotionIsThatOfItsVelocities) {
    for (const double beta : {0.4, 0.9, 2.5})
        for (const double yoke : {0.0, 0.7, 2.9}) {
            const Scenario s = hooke(beta, 3, yoke);
            const auto r = makeReference(s);
            for (const double t : {0.0, 0.7, 2.3, 5.9}) {
                const Quat in = fromAxisAngle({1, 0, 0}, 3 * t);
                const Quat spider = *r->exact(1, t).orientation, out = *r->exact(2, t).orientation;
                expectNear(rotate(in, s.joints[0].axisA), rotate(spider, s.joints[0].axisB), 1e-12);
                expectNear(rotate(spider, s.joints[1].axisA), rotate(out, s.joints[1].axisB), 1e-12);
                expectNear(rotate(out, s.joints[2].axisB), s.joints[2].axisA, 1e-12);
                expectConsistent(s, *r, 1, t + 0.1, 1e-7);
                expectConsistent(s, *r, 2, t + 0.1, 1e-7);
            }
            const auto all = r->quantities(0.01, Scheme::Unknown);
            const double c = std::cos(beta);
            EXPECT_NEAR(std::abs(findQuantity(all, c > 0 ? "ratio_max" : "ratio_min")->exact),
                        1 / std::abs(c), 1e-5);
            EXPECT_NEAR(std::abs(findQuantity(all, c > 0 ? "ratio_min" : "ratio_max")->exact), std::abs(c),
                        1e-5);
        }
    Scenario s = hooke(0.4, 3, 0);
    s.bodies[2].angularVelocity = {};
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

// ------------------------------------------------------------------------------------------------ heavy top
Scenario heavyTop(double spin, double precession, double tilt) {
    Scenario s = emptyScene(3, {0, -9.81, 0}, 2);
    const Quat q = fromAxisAngle({0, 0, 1}, -tilt);  // The body's y axis is the top's.
    const Vec3 axis = rotate(q, {0, 1, 0});
    addBox(s, "top", {0.05, 0.05, 0.05}, 1, 0.2 * axis);
    s.bodies[0].pose.orientation = q;
    s.bodies[0].massProperties.inertia = Mat3::diagonal(0.02, 0.02, 0.02);
    s.bodies[0].angularVelocity = precession * Vec3{0, 1, 0} + (spin - precession * std::cos(tilt)) * axis;
    s.bodies[0].velocity = cross(s.bodies[0].angularVelocity, 0.2 * axis);
    addJoint(s, JointType::Ball, kNone, 0, {});
    setReference(s, "spherical_pendulum");
    return s;
}

TEST(HeavyTop, ATopOfThreeMomentsIsAnsweredUpToWhereNeighboursPart) {
    Scenario s = heavyTop(5, 4, 2.0);
    s.duration = 300;
    s.bodies[0].massProperties.inertia = Mat3::diagonal(0.03, 0.01, 0.05);
    const auto r = makeReference(s);
    EXPECT_GT(r->validUntil(), 1);
    EXPECT_LT(r->validUntil(), 300);
    EXPECT_TRUE(r->quantities(0.01, Scheme::Unknown).empty());
}

TEST(HeavyTop, SteadyPrecessionAtBothRatesAndNutation) {
    for (const double rate : {2.221964048, 16.76960141}) {
        const Scenario s = heavyTop(50, rate, 0.5);
        const auto r = makeReference(s);
        const auto all = r->quantities(0.01, Scheme::Unknown);
        EXPECT_NEAR(findQuantity(all, "tilt_max")->exact, 0.5, 1e-8);
        EXPECT_NEAR(findQuantity(all, "tilt_min")->exact, 0.5, 1e-8);
        EXPECT_NEAR(findQuantity(all, "azimuth_turned")->exact, 2 * rate, 1e-7);
        for (const auto& q : all)
            EXPECT_NEAR(q.measure(exactRun(s, *r, 0.002, 1000)).value(), q.exact, 1e-5) << q.name;
    }
    const Scenario dropped = heavyTop(50, 0, 0.5);
    const auto r = makeReference(dropped);
    const auto all = r->quantities(0.01, Scheme::Unknown);
    EXPECT_NEAR(findQuantity(all, "tilt_max")->exact, 0.6623700347, 1e-6);
    EXPECT_NEAR(findQuantity(all, "tilt_min")->exact, 0.5, 1e-9);
    const Vec3 axis = rotate(*r->exact(0, 1).orientation, {0, 1, 0});
    EXPECT_NEAR(std::acos(axis.y), 0.5127335288, 1e-8);
}

}  // namespace
}  // namespace rigor::validation::testing
