// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/import/push_recording.hpp"

#include <algorithm>
#include <cmath>

#include "validation/import/csv.hpp"
#include "validation/import/dataset.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kSettling = 0.2;                 // [s] of the tracker
constexpr double kMoved = 0.003;                  // [m]: a hundred times the noise
constexpr double kStopped = 0.0005;               // [m]
constexpr double kLeastPush = 0.01;               // [m]
constexpr double kLead = 1.5, kCalmBefore = 0.5;  // [s]: at rest from 1.5 s to 1 s before the largest speed
constexpr std::ptrdiff_t kReach = 3;              // frames to either side of a parabola's middle
constexpr std::size_t kSlide = 2 * kReach + 1;

std::size_t framesIn(double seconds, double rate) {
    return std::lround(seconds * rate);
}

double meanX(const std::vector<RecordedPose>& poses, std::size_t first, std::size_t count) {
    double sum = 0.0;
    for (std::size_t k = first; k < first + count; ++k) sum += poses[k].position.x;
    return sum / count;
}

std::size_t fastestFrame(const std::vector<RecordedPose>& cube) {
    std::size_t best = 1;
    const auto gain = [&](std::size_t k) { return cube[k + 1].position.x - cube[k - 1].position.x; };
    for (std::size_t k = 1; k + 1 < cube.size(); ++k)
        if (gain(k) > gain(best)) best = k;
    return best;
}

/// Finds the stages of the push in its poses; `refuse` throws.
template <class Refuse>
void findStages(Push& push, Refuse refuse) {
    const std::size_t frames = push.cube.size(), lead = framesIn(kLead, push.rate),
                      calm = framesIn(kCalmBefore, push.rate);
    if (frames < lead + calm) refuse("a recording of " + std::to_string(frames) + " frames");
    push.fastest = fastestFrame(push.cube);
    const std::size_t rest = push.fastest < lead ? 0 : push.fastest - lead;
    const double start = meanX(push.cube, rest, calm), end = meanX(push.cube, frames - calm, calm);
    push.displacement = end - start;
    if (!(push.displacement >= kLeastPush))
        refuse("a cube that moves by " + std::to_string(push.displacement) + " m");
    if (push.fastest < lead) refuse("a cube that is pushed from the start");
    push.moved = push.fastest;
    while (push.moved > 0 && push.cube[push.moved - 1].position.x > start + kMoved) --push.moved;
    push.stopped = push.fastest;
    while (push.stopped < frames && push.cube[push.stopped].position.x < end - kStopped) ++push.stopped;
    if (push.stopped < push.fastest + kSlide || push.stopped + calm > frames)
        refuse("a cube that is not at rest at the end");
}

/// Parabola fitted to seven equally spaced values: its middle and its curvature (second difference). Source:
/// Savitzky and Golay, Analytical Chemistry 36 (1964) 1627.
struct Parabola {
    double middle = 0.0, curvature = 0.0;
};
template <class Value>
Parabola fitParabola(Value value) {
    constexpr double kMeanSquare = 4.0, kFourth = 84.0;  // sums over i = -3 .. 3: mean i^2, sum (i^2 - 4)^2
    double mean = 0.0, bent = 0.0;
    for (std::ptrdiff_t i = -kReach; i <= kReach; ++i) {
        const double y = value(i);
        mean += y / kSlide;
        bent += ((i * i) - kMeanSquare) * y / kFourth;
    }
    return {mean - kMeanSquare * bent, 2.0 * bent};
}

}  // namespace

Push readPush(const std::filesystem::path& file) {
    const CsvTable table(file, {"t", "hx", "hy", "hz", "hqw", "hqx", "hqy", "hqz", "cx", "cy", "cz", "cqw",
                                "cqx", "cqy", "cqz"});
    Push push;
    push.rate = table.size() < 2 ? 1.0 : steadyRate(table);
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table.number(row, "t") < kSettling) continue;
        push.hand.push_back({vectorAt(table, row, "h"), unitQuaternionAt(table, row, "hq")});
        push.cube.push_back({vectorAt(table, row, "c"), unitQuaternionAt(table, row, "cq")});
    }
    findStages(push, [&](const std::string& found) {
        throw LoadError({table.problem("import.no_push", 0, found,
                                       "a cube that rests for 1.5 s, is pushed along +x by 10 mm or more, "
                                       "and rests for half a second")});
    });
    return push;
}

PushPoint fitPushPoint(const std::vector<Push>& pushes, double halfWidth) {
    // hand.x + (R p).x = cube.x - halfWidth with p = (0, py, pz): normal equations of two unknowns.
    double yy = 0.0, yz = 0.0, zz = 0.0, yb = 0.0, zb = 0.0, bb = 0.0, count = 0.0;
    for (const Push& push : pushes)
        for (std::size_t k = push.moved; k <= push.fastest; ++k) {
            const RecordedPose& hand = push.hand[k];
            const double y = rotate(hand.orientation, {0, 1, 0}).x, z = rotate(hand.orientation, {0, 0, 1}).x;
            const double b = push.cube[k].position.x - halfWidth - hand.position.x;
            yy += y * y;
            yz += y * z;
            zz += z * z;
            yb += y * b;
            zb += z * b;
            bb += b * b;
            count += 1.0;
        }
    const double determinant = yy * zz - yz * yz;
    if (!(determinant > 1e-9 * count * count))  // the hand does not turn: any point at this distance does
        return {{0, yb / (yy + zz), zb / (yy + zz)}, 0.0};
    const double py = (zz * yb - yz * zb) / determinant, pz = (yy * zb - yz * yb) / determinant;
    return {{0, py, pz}, std::sqrt(std::max(0.0, bb - py * yb - pz * zb) / count)};
}

std::vector<Vec3> pathOf(const Push& push, Vec3 inHand) {
    std::vector<Vec3> raw;
    for (const RecordedPose& hand : push.hand)
        raw.push_back(hand.position + rotate(hand.orientation, inHand));
    std::vector<Vec3> path = raw;
    for (std::size_t k = kReach; k + kReach < raw.size(); ++k) {
        const auto at = [&](std::ptrdiff_t i) -> const Vec3& {
            return raw[static_cast<std::ptrdiff_t>(k) + i];
        };
        path[k] = {fitParabola([&](std::ptrdiff_t i) { return at(i).x; }).middle,
                   fitParabola([&](std::ptrdiff_t i) { return at(i).y; }).middle,
                   fitParabola([&](std::ptrdiff_t i) { return at(i).z; }).middle};
    }
    return path;
}

double slideDeceleration(const Push& push) {
    const auto middle = static_cast<std::ptrdiff_t>(push.stopped) - kReach;
    const Parabola slide = fitParabola([&](std::ptrdiff_t i) { return push.cube[middle + i].position.x; });
    return -slide.curvature * push.rate * push.rate;
}

}  // namespace rigor::validation
