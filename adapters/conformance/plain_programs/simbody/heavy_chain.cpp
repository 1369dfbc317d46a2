// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Heavy chain: eight light links on ball joints that carry a weight of a hundred of them (heavy_end_chain). Hanging at rest,
// the chain's fastest vibration has w = 229.94 rad/s. Merson's method is explicit: with 1/60 s the numbers grow beyond all
// bounds, with a weight of 1 kg or a step of 1/240 s they do not, and where errors choose the steps the chain swings. Hanging,
// the chain lasts 20 s with steps of 1/62 s and not with 1/61 s.
#include "adapters/conformance/plain_programs/simbody/system.hpp"

namespace rigor::plain {
namespace {

using SimTK::Transform;

constexpr double kTurn = 36.86989764584402 * 0.017453292519943295;

/// The chain of the file, turned about z by `turn` [rad] from hanging straight.
void buildChain(System& chain, double endMass, double turn) {
    const SimTK::Vec3 along(std::sin(turn), -std::cos(turn), 0);
    for (int i = 0; i < 9; ++i) {
        const bool last = i == 8;
        const double mass = last ? endMass : 0.1;
        const double across = last ? 0.4 * mass * 0.01 : mass * (0.01 + 0.0004) / 3;
        const SimTK::Inertia inertia(across, last ? across : mass * 0.0008 / 3, across);
        SimTK::MobilizedBody parent = chain.matter.getGround();
        if (i > 0) parent = chain.bodies.back();
        chain.bodies.push_back(
            SimTK::MobilizedBody::Ball(parent, Transform(i == 0 ? SimTK::Vec3(0) : SimTK::Vec3(0.1 * along)),
                                       rigid(mass, inertia.reexpress(~SimTK::Rotation(turn, SimTK::ZAxis))),
                                       Transform(SimTK::Vec3(-0.1 * along))));
    }
    chain.finish();
}

/// The chain begins with a thousandth of a radian per second, so that vibrations begin.
bool chainLasts(double dt, double endMass, double turn, double seconds) {
    System chain;
    buildChain(chain, endMass, turn);
    chain.bodies[0].setOneU(chain.state, 2, 1e-3);
    chain.bodies[3].setOneU(chain.state, 2, -1e-3);
    return chain.lasts(dt, seconds);
}

TEST(PlainSimbody, HeavyChain) {
    System chain;
    buildChain(chain, 10, kTurn);
    const Trajectory plain = chain.run(1.0 / 240, 240);
    EXPECT_GT(travel(plain, 8), 0.1);
    const Scenario scene = load("scenarios/library/3d/heavy_end_chain.json");
    EXPECT_TRUE(
        same(plain, adapterRun("simbody:preset=matched", scene, 1.0 / 240, 240), {1e-8, 1e-8, 1e-7, 1e-6}));
    EXPECT_FALSE(chainLasts(1.0 / 60, 10, kTurn, 2));
    EXPECT_TRUE(chainLasts(1.0 / 240, 10, kTurn, 2));
    EXPECT_TRUE(chainLasts(1.0 / 60, 1, kTurn, 2));
    EXPECT_TRUE(std::isnan(adapterRun("simbody:preset=matched", scene, 1.0 / 60, 120).back()[8].position.x));
    EXPECT_TRUE(
        std::isfinite(adapterRun("simbody:preset=default", scene, 1.0 / 60, 120).back()[8].position.x));
}

TEST(PlainSimbody, HangingChainAtTheLimitOfItsStep) {
    EXPECT_FALSE(chainLasts(1.0 / 60, 10, 0, 20));
    EXPECT_TRUE(chainLasts(1.0 / 63, 10, 0, 20));
}

}  // namespace
}  // namespace rigor::plain
