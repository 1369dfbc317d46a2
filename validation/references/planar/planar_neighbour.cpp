// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The neighbour of planar_motion.hpp: the same motion with values that differ by 1e-12, which shows how fast
// neighbouring motions part.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

constexpr Real kBeside = 1e-12L;  // initial distance of the neighbour from the motion
constexpr Real kApart = 1e-8L;    // distance at which the two have diverged
constexpr int kLooksApart = 8;    // comparisons in a phase

}  // namespace

PlanarMotion::PlanarMotion(Setup setup, State start, double duration, double end, AsNeighbour)
    : setup_(std::move(setup)), duration_(duration) {
    setScale(start);
    double t = 0.0;
    try {
        State s = start;
        Mode mode = startMode(s);
        followTo(end, t, s, mode);
    } catch (const std::runtime_error&) {
        validUntil_ = t;
    }
}

/// The motion beside this one that shows how fast neighbours part. Factors of the velocities, unlike
/// differences, keep contacts in touch and a body at rest.
PlanarMotion PlanarMotion::neighbourOf(State start, double end) const {
    Setup other = setup_;
    other.mass *= 1 + kBeside;
    other.inertia *= 1 - kBeside;
    other.pullAlong *= 1 - kBeside;
    other.pullAbove *= 1 + kBeside;
    other.friction *= 1 + kBeside;
    other.restitution *= 1 - kBeside;
    start.vx *= 1 + kBeside;
    start.vz *= 1 + kBeside;
    start.rate *= 1 + kBeside;
    return {std::move(other), start, duration_, end, AsNeighbour{}};
}

/// The last time up to `end` at which motion and neighbour were found to agree.
double PlanarMotion::partingFrom(const PlanarMotion& neighbour, double end) const {
    double agreed = 0.0;
    if (phases_.empty() || neighbour.phases_.empty()) return agreed;
    const State start = at(0.0);
    for (const Phase& phase : phases_) {
        const double last = std::min(phase.end, end);
        for (int k = 1; k <= kLooksApart; ++k) {
            const double t = k == kLooksApart ? last : phase.begin + (last - phase.begin) * k / kLooksApart;
            // If both end at one time, they end for one reason.
            if (t > neighbour.validUntil_)
                return end - neighbour.validUntil_ <= kApart * duration_ ? end : agreed;
            const State a = at(t);
            const State b = neighbour.at(t);
            const Real way = std::abs(a.x - start.x) + std::abs(a.z - start.z);
            if (!(std::abs(a.x - b.x) + std::abs(a.z - b.z) <= kApart * (setup_.size + way) &&
                  std::abs(a.angle - b.angle) <= kApart * (1 + std::abs(a.angle))))
                return agreed;
            agreed = t;
        }
        if (last >= end) break;
    }
    return agreed;
}

}  // namespace rigor::validation
