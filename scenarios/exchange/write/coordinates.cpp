// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/write/coordinates.hpp"

#include <algorithm>

namespace rigor::models {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;
using scenario::Vec3;

enum Index : std::size_t { kX, kY, kZ, kTwist, kSwingY, kSwingZ };

bool isLocked(const JointAxis& a) {
    return a.mode == AxisMode::Usual || a.mode == AxisMode::Locked;
}
bool isPlainlyFree(const JointAxis& a) {
    return a.mode == AxisMode::Free && !a.hasSpring() && !a.hasMotor();
}

/// A six_dof joint: travels along the axes of A, then the turns.
std::optional<std::vector<Coordinate>> sixDof(const scenario::Scenario& s, const Joint& j) {
    const auto turnOf = [&](int body) {
        return body == scenario::kNone ? scenario::Quat{}
                                       : s.bodies[static_cast<std::size_t>(body)].pose.orientation;
    };
    const auto inChild = [&](const Vec3& v) {
        return rotateInverse(turnOf(j.bodyB), rotate(turnOf(j.bodyA), v));
    };
    const Vec3 y = inChild(j.normalA), z = inChild(cross(j.axisA, j.normalA));
    const Vec3 axes[] = {j.axisB, y, z, j.axisB, y, z};
    static constexpr const char* kNames[] = {"_x", "_y", "_z", "_twist", "_swing_y", "_swing_z"};
    std::vector<Coordinate> slides, turns;
    // A turn that comes before another one turns its axis: the swings come first, then the twist.
    for (const std::size_t k : {kX, kY, kZ, kSwingY, kSwingZ, kTwist})
        if (!isLocked(j.axes[k]))
            (k < kTwist ? slides : turns)
                .push_back(
                    {k < kTwist ? Coordinate::Slide : Coordinate::Turn, axes[k], j.axes[k], kNames[k]});
    const bool isBall =
        turns.size() == 3 && std::all_of(j.axes.begin() + kTwist, j.axes.end(), isPlainlyFree);
    const bool isUniversal = turns.size() == 2 && !isLocked(j.axes[kTwist]);
    if (turns.size() > 1 && !isBall && !isUniversal) return std::nullopt;
    if (isBall) turns = {{Coordinate::Ball, {}, {}, ""}};
    std::vector<Coordinate> all = slides;
    all.insert(all.end(), turns.begin(), turns.end());
    if (!turns.empty())
        all[slides.size()].suffix = "";
    else if (!slides.empty())
        all.front().suffix = "";
    return all;
}

}  // namespace

std::optional<std::vector<Coordinate>> coordinatesOf(const scenario::Scenario& s, const Joint& j,
                                                     bool isReversed) {
    const Vec3 axis = isReversed ? -j.axisA : j.axisB;
    switch (j.type) {
        case JointType::Fixed:
            return std::vector<Coordinate>{};
        case JointType::Hinge:
            return std::vector<Coordinate>{{Coordinate::Turn, axis, j.axes[0], ""}};
        case JointType::Slider:
            return std::vector<Coordinate>{{Coordinate::Slide, axis, j.axes[0], ""}};
        case JointType::Ball:
            return std::vector<Coordinate>{{Coordinate::Ball, {}, j.axes[0], ""}};
        case JointType::SixDof:
            return isReversed ? std::nullopt : sixDof(s, j);
        default:
            return std::nullopt;
    }
}

bool isPlanar(const Joint& j) {
    return j.type == JointType::SixDof && isLocked(j.axes[kX]) && isPlainlyFree(j.axes[kY]) &&
           isPlainlyFree(j.axes[kZ]) && isPlainlyFree(j.axes[kTwist]) && isLocked(j.axes[kSwingY]) &&
           isLocked(j.axes[kSwingZ]);
}

}  // namespace rigor::models
