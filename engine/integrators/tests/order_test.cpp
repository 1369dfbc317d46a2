// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of every integrator on smooth problems, measured by halving the step twice: differences of three
// runs measure it without a reference, closed forms, if there are any, show that it converges to the exact
// solution.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {
namespace {

const std::map<std::string, double> kOrder{{"explicit_euler", 1},
                                           {"symplectic_euler", 1},
                                           {"moreau_midpoint", 2},
                                           {"velocity_verlet", 2},
                                           {"rk4", 4}};

/// Everything the world says of its bodies, in one vector.
template <class S>
Eigen::VectorXd stateOf(const World<S>& world, const std::vector<BodyId>& bodies) {
    std::vector<double> values;
    const auto add = [&](const auto& v) {
        for (Eigen::Index i = 0; i < v.size(); ++i) values.push_back(static_cast<double>(v[i]));
    };
    for (const BodyId id : bodies) {
        const Pose<S> X = world.pose(id);
        add(X.p);
        add(world.velocity(id));
        if constexpr (S::dim == 2) {
            values.push_back(X.q.c);
            values.push_back(X.q.s);
            values.push_back(world.angularVelocity(id));
        } else {
            add(X.q.coeffs());
            add(world.angularVelocity(id));
        }
    }
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

template <class S>
typename S::Vec point(double x, double y, double z) {
    if constexpr (S::dim == 2)
        return {x, y + 0.5 * z};
    else
        return {x, y, z};
}
template <class S>
typename S::Ang turning(double x, double y, double z) {
    if constexpr (S::dim == 2)
        return z;
    else
        return {x, y, z};
}
template <class S>
typename S::Inertia uneven() {
    if constexpr (S::dim == 2) {
        return 0.02;
    } else {
        typename S::Inertia I;
        I << 0.02, 0.002, 0, 0.002, 0.03, 0.001, 0, 0.001, 0.045;
        return I;
    }
}

/// A scene of this file: builds its bodies and forces.
template <class S>
using Build = std::vector<BodyId> (*)(World<S>&);

template <class S>
Eigen::VectorXd run(Build<S> build, WorldDef<S> def, double duration, int steps) {
    World<S> world(def);
    const std::vector<BodyId> bodies = build(world);
    for (int i = 0; i < steps; ++i) world.step(duration / steps);
    EXPECT_FALSE(world.lastStep().nonFinite);
    return stateOf<S>(world, bodies);
}

template <class S>
double measuredOrder(Build<S> build, const WorldDef<S>& def, double duration, int steps) {
    const Eigen::VectorXd coarse = run<S>(build, def, duration, steps),
                          middle = run<S>(build, def, duration, 2 * steps),
                          fine = run<S>(build, def, duration, 4 * steps);
    return std::log2((coarse - middle).norm() / (middle - fine).norm());
}

// --- scenes ------------------------------------------------------------------------------------------------
template <class S>
std::vector<BodyId> thrownInAMedium(World<S>& world) {
    BodyDef<S> def;
    def.velocity = point<S>(8, 5, -3);
    const BodyId ball = world.addBody(def);
    world.addForce(LinearDrag<S>{ball, 0.7});
    return {ball};
}
template <class S>
std::vector<BodyId> onASpring(World<S>& world) {
    BodyDef<S> def;
    def.mass = 2;
    def.pose.p = point<S>(0, -1, 0);
    const BodyId weight = world.addBody(def);
    LinearSpring<S> spring;
    spring.bodyB = weight;
    spring.stiffness = 80;
    spring.damping = 1.5;
    spring.restLength = 1;
    world.addForce(spring);
    return {weight};
}
/// Two spinning bodies with offset centres of mass on springs and dampers at off-centre anchors.
template <class S>
std::vector<BodyId> offCenter(World<S>& world) {
    std::vector<BodyId> bodies;
    for (int i = 0; i < 2; ++i) {
        BodyDef<S> def;
        def.mass = 1 + i;
        def.inertia = uneven<S>();
        def.centerOfMass = point<S>(0.05, -0.02, 0.03);
        def.pose.p = point<S>(0.4 + i, -0.6, 0.1 * i);
        def.velocity = point<S>(0.5, i, -0.4);
        def.angularVelocity = turning<S>(1, -2, 3.0 - i);
        bodies.push_back(world.addBody(def));
    }
    LinearSpring<S> hang;
    hang.bodyB = bodies[0];
    hang.anchorA = point<S>(0, 1, 0);
    hang.anchorB = point<S>(0.1, 0.15, -0.1);
    hang.stiffness = 40;
    hang.damping = 0.3;
    hang.restLength = 0.8;
    world.addForce(hang);
    LinearSpring<S> couple;
    couple.bodyA = bodies[0];
    couple.bodyB = bodies[1];
    couple.anchorA = point<S>(0.2, 0, 0.05);
    couple.anchorB = point<S>(-0.15, 0.1, 0);
    couple.stiffness = 25;
    couple.damping = 0.2;
    couple.restLength = 0.5;
    world.addForce(couple);
    world.addForce(LinearDrag<S>{bodies[1], 0.2});
    return bodies;
}
/// A spinning body with damping of both velocities under a torque that is not along its axes.
template <class S>
std::vector<BodyId> dampedAndTwisted(World<S>& world) {
    BodyDef<S> def;
    def.mass = 1;
    def.inertia = uneven<S>();
    def.velocity = point<S>(3, 2, 1);
    def.angularVelocity = turning<S>(2, 1, -3);
    def.linearVelocityKept = 0.4;
    def.angularVelocityKept = 0.3;
    const BodyId body = world.addBody(def);
    ConstantForce<S> push;
    push.body = body;
    push.force = point<S>(0, 1, 2);
    push.torque = turning<S>(0.02, -0.03, 0.05);
    world.addForce(push);
    return {body};
}

struct Problem {
    const char* name;
    Build<Space2d> build2;
    Build<Space3d> build3;
    double duration;
    int steps;  ///< steps of the coarsest run; small enough to be in the asymptotic range
};
const Problem kProblems[] = {
    {"drag", &thrownInAMedium<Space2d>, &thrownInAMedium<Space3d>, 2, 32},
    {"spring", &onASpring<Space2d>, &onASpring<Space3d>, 2, 512},
    {"off centre", &offCenter<Space2d>, &offCenter<Space3d>, 1, 1024},
    {"damped", &dampedAndTwisted<Space2d>, &dampedAndTwisted<Space3d>, 1, 256},
};

template <class S>
void everyIntegratorHasItsOrder(Build<S> build, const Problem& problem) {
    for (const auto& entry : integratorTable<S>()) {
        ASSERT_TRUE(kOrder.count(entry.name)) << entry.name << ": what is its order?";
        const double expected = kOrder.at(entry.name);
        WorldDef<S> def = earth<S>();
        def.integrator = entry.name;
        // First-order schemes need smaller steps to show their order; rk4 reaches rounding there.
        const int steps = expected == 1   ? 4 * problem.steps
                          : expected == 4 ? problem.steps / 2
                                          : problem.steps;
        EXPECT_NEAR(measuredOrder<S>(build, def, problem.duration, steps), expected, 0.1)
            << entry.name << ", " << problem.name << ", " << S::dim << "D";
    }
}

TEST(Order, OfEveryIntegratorInThePlane) {
    for (const Problem& problem : kProblems) everyIntegratorHasItsOrder<Space2d>(problem.build2, problem);
}
TEST(Order, OfEveryIntegratorInSpace) {
    for (const Problem& problem : kProblems) everyIntegratorHasItsOrder<Space3d>(problem.build3, problem);
}

}  // namespace
}  // namespace rigor::engine::test
