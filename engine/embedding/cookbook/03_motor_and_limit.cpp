// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A door that a motor opens until it meets its stop.
//> 1.20 rad
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    World<S> world(WorldDef<S>{});
    BodyDef<S> place;
    place.pose.p = {0.5, 1, 0};
    const BodyId door = addSolid<S>(world, {{Box<S>{{0.5, 1, 0.02}}, 600}}, place);
    JointDef<S> hinge;
    hinge.type = JointType::Hinge;
    hinge.bodyB = door;  // bodyA is the world
    hinge.anchorA = {0, 1, 0};
    hinge.anchorB = {-0.5, 0, 0};
    hinge.axisA = hinge.axisB = {0, 1, 0};
    hinge.axes[0] = {.mode = AxisMode::Limited, .lower = 0, .upper = 1.2};  // [rad]
    hinge.axes[0].motorSpeed = 1;                                           // [rad/s]
    hinge.axes[0].motorMaxForce = 50;                                       // [N m]
    const JointId id = world.addJoint(hinge);
    for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
    std::printf("%.2f rad\n", world.jointCoordinate(id));
}
