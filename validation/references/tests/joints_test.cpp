// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// References of joints: against the catalogue's values, against integration of the equation of motion in
// small steps, and by what is conserved.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/references/tests/scene.hpp"

namespace rigor::validation {
namespace {

using namespace testing;
using std::numbers::pi;

/// A rod of length |b - a| in the x-y plane.
int addRod(Scenario& s, const std::string& name, Vec3 a, Vec3 b, double mass) {
    const Vec3 d = b - a;
    const double l = norm(d), moment = mass * l * l / 12;
    const int i = addBody(s, name, BodyType::Dynamic, Box{{l / 2, 0.01, 0.01}}, 0.5 * (a + b));
    Body& body = s.bodies.back();
    body.pose.orientation = fromAxisAngle({0, 0, 1}, std::atan2(d.y, d.x));
    body.massProperties = {mass, {}, Mat3::diagonal(1e-4, moment, moment)};
    body.collides = false;
    return i;
}
double turnAboutZ(const Quat& q) {
    return 2 * std::atan2(q.z, q.w);
}
double wrapped(double a) {
    return std::remainder(a, 2 * pi);
}

// ---------------------------------------------------------------------------------------- joint_coordinate
struct Drive {
    double inertia, load, k, c, target, lower, upper, speed, force, q0, v0;
};
/// Semi-implicit steps of 1e-6 s with the laws of the header of joint_coordinate.cpp: error below 2e-5.
std::pair<double, double> integrated(const Drive& d, double end) {
    double q = d.q0, v = d.v0;
    const double h = 1e-6;
    const auto steps = static_cast<long>(std::llround(end / h));
    for (long i = 0; i < steps; ++i) {
        v += h / d.inertia * (d.load - d.k * (q - d.target) - d.c * v);
        const double most = h / d.inertia * d.force;
        v += std::clamp(d.speed - v, -most, most);
        q += h * v;
        if (q < d.lower) {
            q = d.lower;
            v = std::max(v, 0.0);
        }
        if (q > d.upper) {
            q = d.upper;
            v = std::min(v, 0.0);
        }
    }
    return {q, v};
}

constexpr double kFar = 1e300;
const Drive kDrives[] = {
    // inertia, load, k, c, target, lower, upper, motor speed, motor force, q0, v0
    {2.0, 0.0, 80.0, 0.0, 0.3, -kFar, kFar, 0, 0, 0, 0.5},    // undamped
    {2.0, -3.0, 80.0, 4.0, 0.3, -kFar, kFar, 0, 0, 0, 0},     // underdamped under a load
    {2.0, 0.0, 50.0, 20.0, -0.2, -kFar, kFar, 0, 0, 0, 1.0},  // critical
    {2.0, 5.0, 50.0, 60.0, 0.4, -kFar, kFar, 0, 0, 0, -1.0},  // overdamped
    {2.0, 0.0, 80.0, 1.0, 0.3, -0.1, 0.35, 0, 0, 0, 0.5},     // a spring that comes back from its stop
    {2.0, 7.0, 80.0, 1.0, 0.9, -0.1, 0.35, 0, 0, 0, 0},       // a spring that stays at its stop
    {2.0, 0.0, 0, 0, 0, -kFar, kFar, 1.5, 6.0, 0, 0},         // motor, then its speed
    {2.0, 0.0, 0, 0, 0, -kFar, kFar, -1.5, 6.0, 0, 0.4},      // backwards, from a speed
    {2.0, -4.0, 0, 0, 0, -kFar, kFar, 1.5, 6.0, 0, 0},        // motor against a load it can hold
    {2.0, -9.0, 0, 0, 0, -kFar, kFar, 1.5, 6.0, 0, 0},        // motor against a load it can not hold
    {2.0, 0.0, 0, 0, 0, -0.2, 0.4, 1.5, 6.0, 0, 0},           // motor into a stop
    {2.0, -9.0, 0, 0, 0, -0.2, 0.4, 0, 0, 0, 1.8},            // thrown up, falls on the lower stop
};

/// A slider that Drive describes; gravity makes the load.
Scenario driven(const Drive& d, JointType type, int dimension) {
    const bool turns = type == JointType::Hinge || type == JointType::ConeTwist;
    const Vec3 axis = turns ? Vec3{0, 0, 1} : dimension == 2 ? Vec3{0.6, 0.8, 0} : Vec3{2, 3, 6} / 7.0;
    Scenario s = emptyScene(dimension, turns ? Vec3{} : (d.load / d.inertia) * axis, 2.0);
    const int b = addBall(s, "body", 0.1, d.inertia, 0.4, {1, 2, dimension == 2 ? 0.0 : 3.0});
    Body& body = s.bodies.back();
    if (turns) body.massProperties.inertia = Mat3::diagonal(d.inertia, d.inertia, d.inertia);
    (turns ? body.angularVelocity : body.velocity) = d.v0 * axis;
    Joint& j = addJoint(s, type, kNone, b, body.pose.position, axis);
    JointAxis& a = j.axes[0];
    a.mode = AxisMode::Free;
    if (d.upper < kFar) {
        a.mode = AxisMode::Limited;
        a.lower = d.lower;
        a.upper = d.upper;
    }
    a.stiffness = d.k;
    a.damping = d.c;
    a.target = d.target;
    a.motorSpeed = d.speed;
    a.motorMaxForce = d.force;
    s.reference = {"joint_coordinate", {}};
    return s;
}

TEST(JointCoordinate, AgreesWithIntegrationForEveryDriveAndJoint) {
    for (const JointType type :
         {JointType::Slider, JointType::Hinge, JointType::Wheel, JointType::SixDof, JointType::ConeTwist})
        for (const int dimension : {2, 3}) {
            if (dimension == 2 && type == JointType::ConeTwist) continue;
            for (const Drive& d : kDrives) {
                const bool turns = type == JointType::Hinge || type == JointType::ConeTwist;
                if (turns && d.load != 0) continue;  // no constant torque in the format's gravity
                Scenario s = driven(d, type, dimension);
                if (type == JointType::Wheel && dimension == 3)
                    s.joints[0].spinAxisB = Vec3{3, -2, 0} / std::sqrt(13.0);
                const auto reference = makeReference(s);
                for (const double t : {0.3, 0.9, 2.0}) {
                    SCOPED_TRACE(::testing::Message() << jointName(type) << dimension << " t " << t << " k "
                                                      << d.k << " motor " << d.force << " load " << d.load);
                    const auto [q, v] = integrated(d, t);
                    const PartialState state = reference->exact(0, t);
                    const Vec3 axis = s.joints[0].axisA;
                    if (turns) {
                        EXPECT_NEAR(wrapped(turnAboutZ(*state.orientation) - q), 0, 3e-5);
                        EXPECT_NEAR(state.angularVelocity->z, v, 3e-4);
                    } else {
                        EXPECT_NEAR(norm(*state.position - s.bodies[0].pose.position - q * axis), 0, 3e-5);
                        EXPECT_NEAR(norm(*state.velocity - v * axis), 0, 3e-4);
                    }
                }
            }
        }
}

TEST(JointCoordinate, CatalogueOscillatorAndFrequencies) {
    // m 1, c 2, k 100, F 9.81 from rest at 0: x(0.2), x(1).
    Scenario s = driven({1.0, 9.81, 100.0, 2.0, 0.0, -kFar, kFar, 0, 0, 0, 0}, JointType::Slider, 2);
    const Vec3 axis = s.joints[0].axisA;
    const auto along = [&](double t) {
        return dot(*makeReference(s)->exact(0, t).position - s.bodies[0].pose.position, axis);
    };
    EXPECT_NEAR(along(0.2), 0.1234166928, 1e-10);
    EXPECT_NEAR(along(1.0), 0.1311451499, 1e-10);
    // The same by frequency and damping ratio: w = 10, zeta = c / (2 m w).
    JointAxis& a = s.joints[0].axes[0];
    a.stiffness = a.damping = 0;
    a.frequency = 10 / (2 * pi);
    a.dampingRatio = 0.1;
    EXPECT_NEAR(along(1.0), 0.1311451499, 1e-10);
    // A body of moment 0.1 with its centre 0.5 beside a vertical hinge: J = 0.1 + 2 0.25.
    Scenario h = emptyScene(3, {0, 0, -9.81}, 1);
    const int b = addBall(h, "body", 0.1, 2, 5, {0.5, 0, 0});
    Joint& j = addJoint(h, JointType::Hinge, kNone, b, {});
    j.axes[0].mode = AxisMode::Free;
    j.axes[0].stiffness = 15;
    j.axes[0].target = 0.2;
    h.reference = {"joint_coordinate", {}};
    const double J = 0.1 + 0.5, w = std::sqrt(15 / J);
    EXPECT_NEAR(turnAboutZ(*makeReference(h)->exact(0, 0.7).orientation), 0.2 * (1 - std::cos(w * 0.7)),
                1e-12);
}

TEST(JointCoordinate, ARopeFallsTautAndARodIsRefused) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    const int b = addBall(s, "body", 0.1, 2, 0.4, {0, -0.5, 0});
    Joint& j = addJoint(s, JointType::Distance, kNone, b, {});
    j.anchorB = {};
    j.length = 0.5;
    j.axes[0].mode = AxisMode::Limited;
    j.axes[0].lower = 0;
    j.axes[0].upper = 1.3;
    s.reference = {"joint_coordinate", {}};
    const auto reference = makeReference(s);
    EXPECT_NEAR(reference->exact(0, 0.2).position->y, -0.5 - 0.5 * 10 * 0.04, 1e-13);
    EXPECT_NEAR(reference->exact(0, 0.5).position->y, -1.3, 1e-12);  // taut at 0.4 s
    EXPECT_EQ(reference->exact(0, 0.5).velocity->y, 0);
    s.joints[0].axes[0].mode = AxisMode::Usual;
    EXPECT_THROW(makeReference(s), AssumptionViolated);
}

TEST(JointCoordinate, Refusals) {
    const Drive plain{2.0, 0.0, 80.0, 0.0, 0.3, -kFar, kFar, 0, 0, 0, 0.5};
    Scenario across = driven(plain, JointType::Slider, 3);
    across.bodies[0].velocity += Vec3{0.1, 0, 0};
    EXPECT_THROW(makeReference(across), AssumptionViolated);
    Scenario both = driven(plain, JointType::Slider, 3);
    both.joints[0].axes[0].motorMaxForce = 1;
    EXPECT_THROW(makeReference(both), AssumptionViolated);
    Scenario pendulum = driven(plain, JointType::Hinge, 3);
    pendulum.gravity = {0, -9.81, 0};
    pendulum.bodies[0].massProperties.centerOfMass = {0.1, 0, 0};
    EXPECT_THROW(makeReference(pendulum), AssumptionViolated);
    Scenario breaks = driven(plain, JointType::Slider, 3);
    breaks.joints[0].breakForce = 5;
    EXPECT_THROW(makeReference(breaks), AssumptionViolated);
    Scenario outside = driven(plain, JointType::Slider, 3);
    outside.joints[0].axes[0].mode = AxisMode::Limited;
    outside.joints[0].axes[0].lower = 0.1;
    outside.joints[0].axes[0].upper = 1;
    EXPECT_THROW(makeReference(outside), AssumptionViolated);
}

// --------------------------------------------------------------------------------------------- rod_pendulum
Scenario onRod(double theta, Vec3 velocity, bool rope) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, 2);
    const int b = addBall(s, "bob", 0.1, 2, 0.4, {std::sin(theta), 0, -std::cos(theta)}, velocity);
    Joint& j = addJoint(s, JointType::Distance, kNone, b, {});
    j.anchorB = {};
    j.length = 1;
    if (rope) {
        j.axes[0].mode = AxisMode::Limited;
        j.axes[0].lower = 0;
        j.axes[0].upper = 1;
    }
    s.reference = {"rod_pendulum", {}};
    return s;
}

TEST(RodPendulum, CatalogueAndEnergyAndVerticalMomentum) {
    const Scenario s = onRod(1.0, {0, 2 * std::sin(1.0), 0}, false);
    const auto reference = makeReference(s);
    const PartialState end = reference->exact(0, 1.0);
    EXPECT_NEAR(norm(*end.position - Vec3{-0.7333494232, -0.392626553, -0.555016228}), 0, 1e-9);
    const auto energy = [](const PartialState& x) {
        return 0.5 * dot(*x.velocity, *x.velocity) + 9.81 * x.position->z;
    };
    const PartialState start = reference->exact(0, 0.0);
    for (const double t : {0.3, 0.8, 1.7, 2.0}) {
        const PartialState x = reference->exact(0, t);
        EXPECT_NEAR(energy(x), energy(start), 1e-11);
        EXPECT_NEAR(cross(*x.position, *x.velocity).z, cross(*start.position, *start.velocity).z, 1e-11);
        EXPECT_NEAR(norm(*x.position), 1, 1e-12);
    }
}

TEST(RodPendulum, ARopeGoesSlackWhereItsTensionEnds) {
    // Start at the lowest point with v0^2 = 3.5 g l: slack at cos(theta) = (2 - 3.5)/3.
    const Scenario s = onRod(0.0, {std::sqrt(3.5 * 9.81), 0, 0}, true);
    const auto reference = makeReference(s);
    ASSERT_LT(reference->validUntil(), 2.0);
    EXPECT_NEAR(-reference->exact(0, reference->validUntil()).position->z, -0.5, 1e-9);
    EXPECT_GT(makeReference(onRod(0.0, {std::sqrt(3.5 * 9.81), 0, 0}, false))->validUntil(), 1e299);
    EXPECT_THROW(makeReference(onRod(pi - 0.5, {}, true)), AssumptionViolated) << "slack at once";
    EXPECT_THROW(makeReference(onRod(0.5, {0.3, 0, 0}, true)), AssumptionViolated) << "along the rope";
}

// ---------------------------------------------------------------------------------------- physical_pendulum
TEST(PhysicalPendulum, RestsAtAStopOfItsHingeOrCone) {
    for (const JointType type : {JointType::Hinge, JointType::ConeTwist, JointType::Ball}) {
        SCOPED_TRACE(jointName(type));
        Scenario s = emptyScene(3, {0, -9.81, 0}, 2);
        const int b = addRod(s, "rod", {}, {1, 0, 0}, 2);
        Scenario unlimited = s;
        const bool hinge = type == JointType::Hinge;
        Joint& j = addJoint(s, type, kNone, b, {}, hinge ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
        JointAxis& axis = j.axes[type == JointType::ConeTwist ? 1 : 0];
        axis.mode = AxisMode::Limited;
        axis.lower = hinge ? -0.7 : -1e300;
        axis.upper = 0.7;
        s.reference = unlimited.reference = {"physical_pendulum", {}};
        addJoint(unlimited, JointType::Hinge, kNone, b, {});
        const auto stopped = makeReference(s), swinging = makeReference(unlimited);
        // The two motions are the same until the angle is 0.7; then the body stays: sin(0.7) below the pivot.
        double hit = 0;
        while (turnAboutZ(*swinging->exact(0, hit).orientation) > -0.7) hit += 1e-5;
        for (const double t : {0.1, 0.2, hit - 1e-5})
            EXPECT_NEAR(norm(*stopped->exact(0, t).position - *swinging->exact(0, t).position), 0, 1e-13);
        for (const double t : {hit + 1e-5, 1.0, 2.0}) {
            EXPECT_NEAR(stopped->exact(0, t).position->y, -0.5 * std::sin(0.7), 1e-12);
            EXPECT_EQ(norm(*stopped->exact(0, t).velocity), 0);
        }
        EXPECT_GT(stopped->validUntil(), 1e299);
    }
    // Gravity moves it back from a stop beyond the lowest point: the solution ends there.
    Scenario s = emptyScene(2, {0, -9.81, 0}, 2);
    const int b = addRod(s, "rod", {}, {1, 0, 0}, 2);
    Joint& j = addJoint(s, JointType::Hinge, b, kNone, {});  // B is the world: the angle has the other sign
    j.axes[0].mode = AxisMode::Limited;
    j.axes[0].lower = -0.5;
    j.axes[0].upper = 2.0;
    s.reference = {"physical_pendulum", {}};
    const auto reference = makeReference(s);
    ASSERT_LT(reference->validUntil(), 1.0);
    EXPECT_NEAR(turnAboutZ(*reference->exact(0, reference->validUntil()).orientation), -2.0, 1e-9);
}

// ----------------------------------------------------------------------------------- four_bar, slider_crank
/// Four-bar of the catalogue: crank 1, coupler 3, rocker 2.5, ground 3; masses as the lengths.
Scenario fourBar(double phi, int dimension = 3) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 1);
    const Vec3 A{std::cos(phi), std::sin(phi), 0}, Q{3, 0, 0}, d = Q - A;
    const double l = norm(d), x = (l * l + 9 - 6.25) / (2 * l), y = std::sqrt(9 - x * x);
    const Vec3 C = A + (x / l) * d + (y / l) * Vec3{-d.y, d.x, 0};
    const int crank = addRod(s, "crank", {}, A, 1), coupler = addRod(s, "coupler", A, C, 3),
              rocker = addRod(s, "rocker", Q, C, 2.5);
    addJoint(s, JointType::Hinge, kNone, crank, {});
    addJoint(s, JointType::Hinge, crank, coupler, A);
    addJoint(s, JointType::Hinge, coupler, rocker, C);
    addJoint(s, JointType::Hinge, kNone, rocker, Q);
    s.reference = {"four_bar",
                   {{"crank", std::string("crank")},
                    {"coupler", std::string("coupler")},
                    {"rocker", std::string("rocker")}}};
    return s;
}
Scenario sliderCrank(double phi, int dimension = 3) {
    Scenario s = emptyScene(dimension, {0, -9.81, 0}, 1);
    const Vec3 A{0.5 * std::cos(phi), 0.5 * std::sin(phi), 0}, C{A.x + std::sqrt(2.25 - A.y * A.y), 0, 0};
    const int crank = addRod(s, "crank", {}, A, 1), rod = addRod(s, "rod", A, C, 1);
    const int slider = addBall(s, "slider", 0.1, 2, 0.4, C);
    addJoint(s, JointType::Hinge, kNone, crank, {});
    addJoint(s, JointType::Hinge, crank, rod, A);
    addJoint(s, JointType::Hinge, rod, slider, C);
    addJoint(s, JointType::Slider, kNone, slider, C, {1, 0, 0});
    s.reference = {
        "slider_crank",
        {{"crank", std::string("crank")}, {"rod", std::string("rod")}, {"slider", std::string("slider")}}};
    return s;
}
double crankAngle(const Reference& reference, double t) {
    return turnAboutZ(*reference.exact(0, t).orientation);
}
/// Kinetic and potential energy of the exact states.
double energyOf(const Scenario& s, const Reference& reference, double t) {
    double sum = 0;
    for (const int i : reference.bodies()) {
        const Body& b = s.bodies[i];
        const PartialState x = reference.exact(i, t);
        const double w = x.angularVelocity->z;
        sum += 0.5 * b.massProperties.mass * dot(*x.velocity, *x.velocity) +
               0.5 * b.massProperties.inertia(2, 2) * w * w -
               b.massProperties.mass * dot(s.gravity, *x.position);
    }
    return sum;
}

TEST(PlanarLinkage, CatalogueFreeMotion) {
    for (const int dimension : {2, 3}) {
        const Scenario bar = fourBar(1.0, dimension);
        const auto four = makeReference(bar);
        EXPECT_NEAR(wrapped(crankAngle(*four, 0.5) - 0.1243307427), 0, 1e-9);
        EXPECT_NEAR(wrapped(crankAngle(*four, 1.0) + 2.099531997), 0, 1e-9);
        const Scenario engine = sliderCrank(1.0, dimension);
        const auto slider = makeReference(engine);
        EXPECT_NEAR(crankAngle(*slider, 0.25), 0.8934655273, 1e-9);
        EXPECT_NEAR(crankAngle(*slider, 0.5), 0.4572592783, 1e-9);
        for (const double t : {0.2, 0.6, 1.0}) {
            EXPECT_NEAR(energyOf(bar, *four, t), energyOf(bar, *four, 0), 1e-9);
            EXPECT_NEAR(energyOf(engine, *slider, t), energyOf(engine, *slider, 0), 1e-9);
        }
    }
}

/// The anchors of every joint coincide, and move alike.
void expectClosed(const Scenario& s, const Reference& reference, double t) {
    const auto at = [&](int body, Vec3 anchor, Vec3& velocity) {
        velocity = {};
        if (body == kNone) return anchor;
        const PartialState x = reference.exact(body, t);
        const Vec3 arm = rotate(*x.orientation, anchor);
        velocity = *x.velocity + cross(*x.angularVelocity, arm);
        return *x.position + arm;
    };
    for (const Joint& j : s.joints) {
        Vec3 va, vb;
        Vec3 gap = at(j.bodyB, j.anchorB, vb) - at(j.bodyA, j.anchorA, va), slip = vb - va;
        if (j.type == JointType::Slider) gap.x = slip.x = 0;
        EXPECT_LT(norm(gap), 1e-12) << j.name << " at " << t;
        EXPECT_LT(norm(slip), 1e-11) << j.name << " at " << t;
    }
}

TEST(PlanarLinkage, DrivenByAMotorFromRestAndAtItsSpeed) {
    for (const bool slider : {false, true}) {
        Scenario s = slider ? sliderCrank(1.0) : fourBar(1.0);
        JointAxis& motor = s.joints[0].axes[0];
        motor.mode = AxisMode::Free;
        motor.motorSpeed = -3;
        motor.motorMaxForce = 300;
        const auto reference = makeReference(s);
        const double turn = crankAngle(*reference, 0.0);
        bool reached = false;
        for (const double t : {0.01, 0.03, 0.1, 0.4, 1.0}) {
            expectClosed(s, *reference, t);
            const double rate = reference->exact(0, t).angularVelocity->z;
            EXPECT_GE(rate, -3 - 1e-12);
            if (rate > -3 + 1e-9) {  // the motor's work is the energy gained
                const double turned = wrapped(crankAngle(*reference, t) - turn);
                EXPECT_NEAR(energyOf(s, *reference, t) - energyOf(s, *reference, 0), -300 * turned, 1e-7);
            } else {
                reached = true;
            }
        }
        EXPECT_TRUE(reached);
        const double last = crankAngle(*reference, 0.9);
        EXPECT_NEAR(wrapped(crankAngle(*reference, 1.0) - last + 0.3), 0, 1e-12);
    }
}

TEST(PlanarLinkage, CatalogueKinematicsOfASteadyCrank) {
    // Values at phi = 1.5: coupler and rocker angles and rates for a crank of 1 rad/s; slider and rod for 2
    // rad/s.
    Scenario s = fourBar(1.0);
    const auto steady = [](Scenario& scene, double w) {
        scene.joints[0].axes[0].mode = AxisMode::Free;
        scene.joints[0].axes[0].motorSpeed = w;
        scene.joints[0].axes[0].motorMaxForce = 1e9;
    };
    steady(s, 1);
    const auto bar = makeReference(s);
    const double spinUp = 1.0 - wrapped(crankAngle(*bar, 1.0) - 1.0);  // angle lost by the start, about 1e-8
    EXPECT_LT(std::abs(spinUp), 1e-7);
    const double t = 0.5 + spinUp;
    EXPECT_NEAR(turnAboutZ(*bar->exact(1, t).orientation), 0.5166225646, 1e-8);
    EXPECT_NEAR(wrapped(turnAboutZ(*bar->exact(2, t).orientation) - 1.699465298), 0, 1e-8);
    EXPECT_NEAR(bar->exact(1, t).angularVelocity->z, -0.07135084758, 1e-8);
    EXPECT_NEAR(bar->exact(2, t).angularVelocity->z, 0.3596790742, 1e-8);
    Scenario e = sliderCrank(1.0);
    steady(e, 2);
    const auto crank = makeReference(e);
    EXPECT_NEAR(crank->exact(2, 0.25).position->x, 1.450024367, 1e-7);
    EXPECT_NEAR(crank->exact(2, 0.25).velocity->x, -1.022433917, 1e-7);
    EXPECT_NEAR(turnAboutZ(*crank->exact(1, 0.25).orientation), -0.338951392, 1e-7);
}

TEST(PlanarLinkage, Refusals) {
    Scenario velocity = fourBar(1.0);
    velocity.bodies[0].angularVelocity = {0, 0, 1};
    EXPECT_THROW(makeReference(velocity), AssumptionViolated);
    Scenario weak = fourBar(1.0);
    weak.joints[0].axes[0].mode = AxisMode::Free;
    weak.joints[0].axes[0].motorSpeed = 5;
    weak.joints[0].axes[0].motorMaxForce = 30;
    EXPECT_THROW(makeReference(weak), AssumptionViolated) << "it gets there and can not hold it";
    Scenario open = fourBar(1.0);
    open.joints.pop_back();
    EXPECT_THROW(makeReference(open), AssumptionViolated);
    Scenario limited = sliderCrank(1.0);
    limited.joints[3].axes[0].mode = AxisMode::Limited;
    EXPECT_THROW(makeReference(limited), AssumptionViolated);
}

// ------------------------------------------------------------------------------------------- breaking_joint
TEST(BreakingJoint, HoldsBreaksAndFalls) {
    Scenario s = emptyScene(3, {0, -10, 0}, 2);
    const int b = addBall(s, "body", 0.1, 2, 0.4, {1, 3, 0});
    Joint& j = addJoint(s, JointType::Fixed, kNone, b, {1, 3, 0});
    j.breakForce = 25;
    s.forces.push_back(ConstantForce{b, {0, -4, 0}, {}, 0.2, 0.4});  // 24 N: holds
    s.forces.push_back(ConstantForce{b, {0, -6, 0}, {}, 0.5, 0.7});  // 26 N: breaks
    s.reference = {"breaking_joint", {}};
    const auto reference = makeReference(s);
    EXPECT_EQ(*reference->exact(b, 0.5).position, (Vec3{1, 3, 0}));
    // 0.2 s at 13 m/s^2, then free fall.
    EXPECT_NEAR(reference->exact(b, 0.7).position->y, 3 - 0.5 * 13 * 0.04, 1e-14);
    EXPECT_NEAR(reference->exact(b, 1.0).velocity->y, -2.6 - 3, 1e-14);
    EXPECT_NEAR(reference->exact(b, 1.0).position->y, 3 - 0.26 - 2.6 * 0.3 - 5 * 0.09, 1e-14);
    ASSERT_EQ(reference->quantities(0.01, adapter::Scheme::SymplecticEuler).size(), 1u);
    EXPECT_EQ(reference->quantities(0.01, adapter::Scheme::SymplecticEuler)[0].exact, 0.5);
    s.joints[0].breakForce = 27;
    EXPECT_EQ(*makeReference(s)->exact(b, 2.0).position, (Vec3{1, 3, 0}));
    // The same load on an arm of 0.5 m: 13 N m.
    s.joints[0].anchorA.x += 0.5;
    s.joints[0].anchorB.x += 0.5;
    s.joints[0].breakTorque = 12.5;
    EXPECT_NEAR(makeReference(s)->exact(b, 0.7).position->y, 3 - 0.5 * 13 * 0.04, 1e-14);
    s.joints[0].type = JointType::Hinge;
    EXPECT_THROW(makeReference(s), AssumptionViolated) << "it turns on a hinge";
}

}  // namespace
}  // namespace rigor::validation
