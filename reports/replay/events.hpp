// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Events that a viewer jumps to: divergence of a run from its reference or another engine's run, the largest
// errors, the worst results of the audit, contacts that begin and end, the first number that is not finite.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "validation/results/trajectory_file.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

struct ReplayEvent {
    std::size_t frame = 0;  ///< frame of the trajectory
    double time = 0.0;      ///< [s] of that frame
    std::string
        kind;  ///< "divergence", "engine_divergence", "largest", "audit", "contact_begin", "contact_end", "nonfinite"
    std::string what;        ///< metric, auditor or other engine's spec; else ""
    std::string subject;     ///< body, "a|b", "" the whole scene
    double value = 0.0;      ///< error, angle or distance; NaN where there is none
    std::string unit;        ///< unit of the value
    double threshold = 0.0;  ///< divergence and engine_divergence: the distance that was passed [m]
    std::string text;        ///< audit: its own words
    long contact = -1;       ///< audit: which of the contacts of the frame, -1: not known
};

/// More contact events of one case are left out: a pile has thousands.
inline constexpr std::size_t kMostContactEvents = 200;
/// Two runs have diverged where a body is further from its twin than this part of the length of the scene.
inline constexpr double kDivergenceFraction = 0.01;

/// Length of what moves [m]: the diagonal of the box around the bodies' first positions, plus the median over
/// the moving bodies of how far they come from there; at least 1e-6.
double sceneLength(const results::TrajectoryFile& file);

/// All but divergences from other engines, in time order. `row` gives metrics and audit.
std::vector<ReplayEvent> replayEvents(const results::TrajectoryFile& file, const results::CaseRow& row);

/// First time at which both have a frame and a body is further than `threshold` from its twin, or one is not
/// finite; frame == files' size of times where they do not part.
ReplayEvent engineDivergenceOf(const results::TrajectoryFile& file, const results::TrajectoryFile& other,
                               double threshold);

/// Frame whose time is nearest to t; 0 without frames.
std::size_t nearestFrame(const std::vector<double>& times, double t);

}  // namespace rigor::report
