// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Divergence time of two runs of a scene. A distance of rounding in a chaotic scene grows exponentially until
// it is as large as the scene; from then on a distance between trajectories says nothing of either.
#pragma once

#include <optional>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// A length by which the scene is measured [m]: the median of twice the distance from a body's centre of mass
/// to the farthest point of its shapes, over dynamic bodies with shapes; else the largest distance between
/// bodies and anchors at the start; at least 1e-6.
double sceneLength(const scenario::Scenario& scenario);

/// Growth of ln of the distance, by least squares over the frames from the first with a distance to the one
/// at which the runs part. The deviations are correlated, so that the interval is too narrow rather than too
/// wide.
struct Growth {
    double rate = 0.0;               ///< [1/s]
    double low = 0.0, high = 0.0;    ///< 95 %, of the regression
    double from = 0.0, until = 0.0;  ///< [s]
    std::size_t points = 0;
};

/// A contact that one run has and the other has not.
struct ContactSplit {
    double time = 0.0;  ///< [s]
    int bodyA = 0, bodyB = 0;
    bool inFirst = false;  ///< the first run has it
};

struct Divergence {
    double length = 0.0;  ///< length of the scene [m]
    std::optional<double>
        divergenceTime;          ///< [s] first frame with a body farther than threshold * length from itself
    int body = scenario::kNone;  ///< the farthest then
    double largest = 0.0;        ///< [m] of a body, over the run
    std::optional<Growth> growth;  ///< growth rate; empty without ten frames and a tenfold growth
    std::optional<ContactSplit> split;
};

struct DivergenceOptions {
    double threshold = 0.01;                     ///< threshold as a fraction of the length
    int contactStrideA = 1, contactStrideB = 1;  ///< frames between those that have contacts
};

/// Frames are compared by their times. A pair of bodies touches in a frame when a contact between them
/// carried an impulse, or overlaps if the engine does not report impulses; it has split when one run has it
/// and the other neither then nor one frame before or after: a step of delay is no split. Throws
/// std::invalid_argument for other bodies, or frames at other times.
Divergence divergenceOf(const scenario::Scenario& scenario, const Trajectory& a, const Trajectory& b,
                        const DivergenceOptions& options);

/// Least squares of ln(values) over times with the 95 % interval of the slope; none below three points.
std::optional<Growth> growthOf(const std::vector<double>& times, const std::vector<double>& values);

}  // namespace rigor::validation
