// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Code of every Chipmunk program here around its scene: the loop of the manual's "Hello Chipmunk", and the bodies'
// states after each step.
#pragma once

#include <chipmunk/chipmunk.h>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

inline std::vector<BodyState> statesOf(const std::vector<cpBody*>& bodies) {
    std::vector<BodyState> states;
    for (const cpBody* body : bodies) {
        const cpVect p = cpBodyGetPosition(body), v = cpBodyGetVelocity(body);
        states.push_back({{p.x, p.y, 0.0},
                          scenario::fromAxisAngle({0.0, 0.0, 1.0}, cpBodyGetAngle(body)),
                          {v.x, v.y, 0.0},
                          {0.0, 0.0, cpBodyGetAngularVelocity(body)}});
    }
    return states;
}

inline Trajectory run(cpSpace* space, const std::vector<cpBody*>& bodies, double dt, int steps) {
    Trajectory trajectory{statesOf(bodies)};
    for (int i = 0; i < steps; ++i) {
        cpSpaceStep(space, dt);
        trajectory.push_back(statesOf(bodies));
    }
    return trajectory;
}

inline cpSpace* earth() {
    cpSpace* space = cpSpaceNew();
    cpSpaceSetGravity(space, cpv(0, -9.81));
    return space;
}

/// A box of these sides on a body of its own. The velocity is set before the shape is added: a tree's boxes reach ahead
/// with it, and which of two corners that just touch comes first is decided there.
inline cpBody* addBox(cpSpace* space, double mass, double width, double height, const cpVect& at,
                      double friction, const cpVect& velocity = {0, 0}) {
    cpBody* body = mass > 0 ? cpBodyNew(mass, cpMomentForBox(mass, width, height)) : cpBodyNewStatic();
    cpBodySetPosition(body, at);
    if (mass > 0) cpBodySetVelocity(body, velocity);
    cpSpaceAddBody(space, body);
    cpShape* shape = cpSpaceAddShape(space, cpBoxShapeNew(body, width, height, 0));
    cpShapeSetFriction(shape, friction);
    return body;
}

}  // namespace rigor::plain
