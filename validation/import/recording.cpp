// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/import/recording.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr std::size_t kLeadFrames = 3;   // frames before the first possible contact
constexpr std::size_t kLeastFlight = 4;  // frames: fewer say too little of a velocity

std::size_t startFrame(const Recording& recording, double halfWidth) {
    const std::size_t low = firstFrameBelow(recording, halfWidth * std::sqrt(3.0));
    return low > kLeadFrames ? low - kLeadFrames : 0;
}

StartState asRecorded(const Recording& recording, std::size_t frame) {
    const RecordedFrame& f = recording.frames[frame];
    return {frame,         f.position,
            f.velocity,    rotate(f.orientation, f.spinBody),
            f.orientation, "The flight before it is too short: velocities as recorded there."};
}

/// Intercept and slope of the least-squares line through (k dt, y_k), k = 0..count-1.
struct Line {
    double at0, slope;
};
template <class Value>
Line fitLine(std::size_t count, double dt, Value y) {
    const auto n = static_cast<double>(count);
    double meanT = 0.0, meanY = 0.0, tt = 0.0, ty = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        meanT += k * dt / n;
        meanY += y(k) / n;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const double t = k * dt - meanT;
        tt += t * t;
        ty += t * (y(k) - meanY);
    }
    return {meanY - ty / tt * meanT, ty / tt};
}

Quat turnedBy(const Quat& q, Vec3 bodyVector) {
    const double angle = norm(bodyVector);
    return angle > 0.0 ? normalized(q * fromAxisAngle(bodyVector / angle, angle)) : q;
}

}  // namespace

Vec3 turnBetween(const Quat& a, const Quat& b) {
    Quat d = conjugate(a) * b;
    if (d.w < 0.0) d = {-d.w, -d.x, -d.y, -d.z};
    const Vec3 v{d.x, d.y, d.z};
    const double sine = norm(v);
    return sine > 0.0 ? 2.0 * std::atan2(sine, d.w) / sine * v : Vec3{};
}

std::size_t firstFrameBelow(const Recording& recording, double height) {
    const auto& f = recording.frames;
    return std::find_if(f.begin(), f.end(), [&](const RecordedFrame& x) { return x.position.z <= height; }) -
           f.begin();
}

std::size_t firstContact(const Recording& recording, double halfWidth) {
    const auto& f = recording.frames;
    const auto touches = [&](const RecordedFrame& x) {
        const Mat3 axes = toMatrix(x.orientation);
        return x.position.z <=
               halfWidth * (std::abs(axes(2, 0)) + std::abs(axes(2, 1)) + std::abs(axes(2, 2)));
    };
    return std::find_if(f.begin(), f.end(), touches) - f.begin();
}

std::size_t flightFrames(const Recording& recording, double halfWidth, double gravity) {
    const auto& f = recording.frames;
    const double fall = gravity / (recording.rate * recording.rate);
    const std::size_t contact = firstContact(recording, halfWidth);
    // A bounce between two frames shows in the second difference of the height, which is -fall in flight.
    for (std::size_t k = 2; k < contact; ++k)
        if (std::abs(f[k].position.z - 2.0 * f[k - 1].position.z + f[k - 2].position.z + fall) > fall)
            return k;
    return contact;
}

StartState startByRule(const Recording& recording, double halfWidth, double gravity) {
    const auto& f = recording.frames;
    const std::size_t i = startFrame(recording, halfWidth);
    if (i < kLeastFlight) return asRecorded(recording, i);
    const double dt = 1.0 / recording.rate, chord = (i - 1) * dt;
    const Line z = fitLine(i, dt, [&](std::size_t k) {
        const double t = k * dt;
        return f[k].position.z + 0.5 * gravity * t * t;
    });
    const Vec3 moved = f[i - 1].position - f[0].position;
    const Vec3 spin = turnBetween(f[0].orientation, f[i].orientation) / (i * dt);
    return {i,
            f[i].position,
            {moved.x / chord, moved.y / chord, z.slope - gravity * chord},
            rotate(f[i].orientation, spin),
            f[i].orientation,
            "Initial velocities by the rule of the simulator study, from the frames before it."};
}

StartState startByFlight(const Recording& recording, double halfWidth, double gravity) {
    const auto& f = recording.frames;
    const std::size_t i = startFrame(recording, halfWidth);
    const std::size_t count = flightFrames(recording, halfWidth, gravity);
    if (count < kLeastFlight) return asRecorded(recording, i);
    const double dt = 1.0 / recording.rate, t = i * dt;
    const auto line = [&](auto&& component) { return fitLine(count, dt, component); };
    const Line x = line([&](std::size_t k) { return f[k].position.x; });
    const Line y = line([&](std::size_t k) { return f[k].position.y; });
    const Line z = line([&](std::size_t k) {
        const double s = k * dt;
        return f[k].position.z + 0.5 * gravity * s * s;
    });
    std::vector<Vec3> turns;
    for (std::size_t k = 0; k < count; ++k) turns.push_back(turnBetween(f[0].orientation, f[k].orientation));
    const Line a = line([&](std::size_t k) { return turns[k].x; }),
               b = line([&](std::size_t k) { return turns[k].y; }),
               c = line([&](std::size_t k) { return turns[k].z; });
    const Quat q =
        turnedBy(f[0].orientation, {a.at0 + a.slope * t, b.at0 + b.slope * t, c.at0 + c.slope * t});
    return {i,
            {x.at0 + x.slope * t, y.at0 + y.slope * t, z.at0 + z.slope * t - 0.5 * gravity * t * t},
            {x.slope, y.slope, z.slope - gravity * t},
            rotate(q, {a.slope, b.slope, c.slope}),
            q,
            "Initial pose and velocities by least squares over the free flight."};
}

}  // namespace rigor::validation
