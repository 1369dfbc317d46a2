// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Linkages: a chain of five rods on pins, whose error falls with the fourth power of the step, and a loop of four bars,
// whose last pin is a constraint: its error is that of the tolerance to which constraints are projected.
#include <numbers>

#include "adapters/conformance/plain_programs/simbody/system.hpp"

namespace rigor::plain {
namespace {

using SimTK::MobilizedBody;
using SimTK::Transform;

void buildRods(System& chain) {
    for (int i = 0; i < 5; ++i) {
        MobilizedBody parent = chain.matter.getGround();
        if (i > 0) parent = chain.bodies.back();
        chain.bodies.push_back(MobilizedBody::Pin(parent, Transform(SimTK::Vec3(i == 0 ? 0.0 : 0.2, 0, 0)),
                                                  rigid(1, boxInertia(1, {0.4, 0.04, 0.04})),
                                                  Transform(SimTK::Vec3(-0.2, 0, 0))));
    }
    chain.finish();
}

/// Place of the last rod after a second.
SimTK::Vec3 endOfRods(double dt) {
    System chain;
    buildRods(chain);
    const Vec3 end = chain.run(dt, static_cast<int>(std::lround(1.0 / dt))).back()[4].position;
    return {end.x, end.y, end.z};
}

TEST(PlainSimbody, FallingRods) {
    System chain;
    buildRods(chain);
    const Trajectory plain = chain.run(1.0 / 60, 60);
    EXPECT_GT(travel(plain, 4), 0.5);
    const Scenario scene = load("scenarios/library/3d/pendulum_chain.json");
    EXPECT_TRUE(
        same(plain, adapterRun("simbody:preset=matched", scene, 1.0 / 60, 60), {1e-10, 1e-10, 1e-9, 1e-9}));
    const SimTK::Vec3 exact = endOfRods(1.0 / 3840);
    const double coarse = (endOfRods(1.0 / 120) - exact).norm(), fine = (endOfRods(1.0 / 240) - exact).norm();
    EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.8);
}

/// The loop of the file, whose bars begin at an angle to the x axis each.
void buildBars(System& loop) {
    const double mass[] = {0.5, 1, 0.8}, half[] = {0.15, 0.45000000000000007, 0.3500000000000001};
    const double angle[] = {0.5, 0.6653266027623032, 1.6117814322682023};
    for (int i = 0; i < 3; ++i) {
        MobilizedBody parent = loop.matter.getGround();
        if (i > 0) parent = loop.bodies.back();
        // Both pins of a bar are at its ends; the coupler hangs on the crank, and the rocker's upper end on the coupler.
        const double inner = i == 2 ? half[i] : -half[i];
        const double outer = i == 0 ? 0.0 : half[i - 1];
        const double height = 0.06;
        const double about = mass[i] / 12.0 * (4 * half[i] * half[i] + height * height);
        loop.bodies.push_back(MobilizedBody::Pin(parent, Transform(SimTK::Vec3(outer, 0, 0)),
                                                 rigid(mass[i], SimTK::Inertia(about)),
                                                 Transform(SimTK::Vec3(inner, 0, 0))));
    }
    SimTK::MobilizedBody& ground = loop.matter.updGround();
    for (int axis = 0; axis < 2; ++axis)
        SimTK::Constraint::PointInPlane(ground,
                                        axis == 0 ? SimTK::UnitVec3(1, 0, 0) : SimTK::UnitVec3(0, 1, 0),
                                        axis == 0 ? 1.0 : 0.0, loop.bodies[2], SimTK::Vec3(-half[2], 0, 0));
    loop.finish();
    for (int i = 0; i < 3; ++i)
        loop.bodies[i].setOneQ(loop.state, 0, i == 0 ? angle[0] : angle[i] - angle[i - 1]);
}

double gapOf(const Trajectory& run) {
    double gap = 0.0;
    for (const auto& states : run) {
        const Vec3 at = states[2].position + rotate(states[2].orientation, {-0.3500000000000001, 0, 0});
        gap = std::max(gap, norm(at - Vec3{1, 0, 0}));
    }
    return gap;
}

TEST(PlainSimbody, FourBarsByTheToleranceOfConstraints) {
    const Scenario scene = load("scenarios/library/2d/four_bar_linkage_2d.json");
    for (const auto& [tolerance, text] : {std::pair{1e-4, "1e-4"}, {1e-10, "1e-10"}}) {
        System loop;
        buildBars(loop);
        const Trajectory plain = loop.run(1.0 / 60, 120, tolerance, true);
        EXPECT_GT(travel(plain, 1), 0.1);
        const std::string spec = std::string("simbody:preset=matched,constraint_tolerance=") + text;
        EXPECT_TRUE(same(plain, adapterRun(spec, scene, 1.0 / 60, 120), {1e-9, 1e-9, 1e-8, 1e-8}));
        EXPECT_LE(gapOf(plain), 2 * tolerance);
        // Without being begun anew the integrator arrives elsewhere, and no nearer to the bars' exact motion.
        EXPECT_GT(norm(loop.run(1.0 / 60, 120, tolerance).back()[0].position - plain.back()[0].position),
                  1e-6);
    }
}

/// A rod on a pin whose point is held once more: no coordinate can violate that constraint. Simbody's accelerations are no
/// numbers then, and are the pin's own with the constraint switched off, as the adapter does it.
TEST(PlainSimbody, AConstraintThatNothingCanViolate) {
    System rod;
    SimTK::MobilizedBody& ground = rod.matter.updGround();
    rod.bodies.push_back(MobilizedBody::Pin(ground, Transform(), rigid(1, boxInertia(1, {1, 0.06, 0.06})),
                                            Transform(SimTK::Vec3(-0.5, 0, 0))));
    const SimTK::Constraint::Ball again(ground, SimTK::Vec3(0), rod.bodies[0], SimTK::Vec3(-0.5, 0, 0));
    rod.finish();
    rod.system.realize(rod.state, SimTK::Stage::Acceleration);
    EXPECT_TRUE(std::isnan(rod.bodies[0].getOneUDot(rod.state, 0)));
    again.disable(rod.state);
    rod.system.realize(rod.state, SimTK::Stage::Acceleration);
    EXPECT_NEAR(rod.bodies[0].getOneUDot(rod.state, 0), -9.81 * 0.5 / (1.0036 / 12 + 0.25), 1e-9);
}

}  // namespace
}  // namespace rigor::plain
