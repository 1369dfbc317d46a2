// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A recorded rigid body: poses at a steady rate, and the state in which a simulation of it starts. World z
// up.
#pragma once

#include <string>
#include <vector>

#include "scenarios/model/math.hpp"

namespace rigor::validation {

struct RecordedFrame {
    scenario::Vec3 position;     ///< [m]
    scenario::Quat orientation;  ///< body to world, unit
    scenario::Vec3 velocity;     ///< velocity as recorded, world frame [m/s]
    scenario::Vec3 spinBody;     ///< angular velocity as recorded, body frame [rad/s]
};
struct Recording {
    double rate = 0.0;  ///< frames per second
    std::vector<RecordedFrame> frames;
};

/// Initial state of a simulation.
struct StartState {
    std::size_t frame = 0;
    scenario::Vec3 position, velocity, spin;  ///< spin: world frame [rad/s]
    scenario::Quat orientation;
    std::string how;  ///< one sentence for the scenario
};

/// log(a^-1 b): the rotation vector, in the body frame, of the turn from a to b [rad].
scenario::Vec3 turnBetween(const scenario::Quat& a, const scenario::Quat& b);

/// First frame at which the centre is not above `height`; frames.size() when it never comes down to it.
std::size_t firstFrameBelow(const Recording& recording, double height);
/// First frame at which a sharp cube of this half width [m] would touch z = 0; frames.size() if never.
std::size_t firstContact(const Recording& recording, double halfWidth);

/// Number of frames of free flight: up to the first contact, or to a bounce between two frames.
std::size_t flightFrames(const Recording& recording, double halfWidth, double gravity);

/// The rule of the simulator study: three frames before the centre first falls to halfWidth sqrt(3); from
/// frame 4 on spin log(q0^-1 qi)/(i dt), vx and vy the chord slope over frames 0..i-1, vz the slope at frame
/// i-1 of the least-squares parabola of curvature -gravity; before it the recorded velocities.
/// Source: Acosta, Yang, Posa, IEEE RA-L 7 (2022) 6471 and its code's description.
StartState startByRule(const Recording& recording, double halfWidth, double gravity);

/// The same frame; pose and velocities from least squares over the whole free flight (position: parabola of
/// curvature -gravity; attitude: uniform turning, exact for a body of isotropic inertia). Below four frames
/// of flight the recorded velocities.
StartState startByFlight(const Recording& recording, double halfWidth, double gravity);

}  // namespace rigor::validation
