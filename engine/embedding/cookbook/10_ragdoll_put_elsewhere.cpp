// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A jointed figure is put elsewhere as a whole, and goes on there.
//> moved 20 m, joint apart by 0.000 m
#include <cstdio>
#include <engine/engine.hpp>
using namespace rigor::engine;
using S = Space3d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81, 0};
    World<S> world(def);
    BodyDef<S> place;
    place.pose.p = {0, 5, 0};
    place.velocity = {1, 0, 0};
    const BodyId upper = addSolid<S>(world, {{Capsule<S>{0.1, 0.25}, 900}}, place);
    place.pose.p = {0, 4.3, 0};
    const BodyId lower = addSolid<S>(world, {{Capsule<S>{0.1, 0.25}, 900}}, place);
    JointDef<S> joint;
    joint.bodyA = upper;
    joint.bodyB = lower;
    joint.anchorA = {0, -0.35, 0};
    joint.anchorB = {0, 0.35, 0};
    world.addJoint(joint);
    for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
    for (const BodyId body : {upper, lower}) {
        Pose<S> there = world.pose(body);
        there.p.x() += 20;
        world.setPose(body, there);
    }
    for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
    std::vector<JointPlace<S>> joints;
    world.readJoints(joints);
    std::printf("moved %.0f m, joint apart by %.3f m\n", world.pose(upper).p.x() - 1,
                (joints[0].anchorA - joints[0].anchorB).norm());
}
