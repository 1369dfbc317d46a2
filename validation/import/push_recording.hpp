// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A recorded push: a hand and the cube that it pushes along +x, as poses at a steady rate, and the quantities
// derived from the poses: when the cube moves, where on the hand it is pushed, how it slides when the hand
// falls behind. World z up.
#pragma once

#include <filesystem>
#include <vector>

#include "scenarios/model/math.hpp"

namespace rigor::validation {

struct RecordedPose {
    scenario::Vec3 position;     ///< [m]
    scenario::Quat orientation;  ///< body to world
};

struct Push {
    double rate = 0.0;  ///< frames per second
    std::vector<RecordedPose> hand, cube;
    // Frames, rising:
    std::size_t moved = 0;      ///< the first at which the cube has moved by 3 mm
    std::size_t fastest = 0;    ///< the cube is nowhere faster
    std::size_t stopped = 0;    ///< the first within 0.5 mm of where it ends
    double displacement = 0.0;  ///< displacement along x, from rest to rest [m]
};

/// Reads columns t, h* (hand), c* (cube): positions x, y, z and quaternions qw .. qz; frames before 0.2 s are
/// passed over, because the tracker settles. Throws LoadError: that of the columns, "import.short",
/// "import.no_push" (the cube moves by less than 10 mm, or ends moving).
Push readPush(const std::filesystem::path& file);

/// The point of the hand that pushes: fixed in the hand's frame, in its y-z plane (x is across the push, and
/// no turn of the hand determines it), such that it stays at the cube's rear face from the first movement up
/// to the largest speed. Least squares over all frames of all pushes, along the push alone.
struct PushPoint {
    scenario::Vec3 inHand;  ///< [m]
    double rms = 0.0;       ///< RMS of the residual [m]
};
PushPoint fitPushPoint(const std::vector<Push>& pushes, double halfWidth);

/// Path of a point of the hand, one position per frame: smoothed by least-squares parabolas over seven
/// frames, since the tracker's noise of 0.04 mm would be 4 mm/s between neighbours.
std::vector<scenario::Vec3> pathOf(const Push& push, scenario::Vec3 inHand);

/// Deceleration over the seven frames up to `stopped`, the last of the slide, when nothing pushes [m/s^2].
double slideDeceleration(const Push& push);

}  // namespace rigor::validation
