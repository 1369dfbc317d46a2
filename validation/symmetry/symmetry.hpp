// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Symmetries of Newton's equations: a scenario turned into another one whose motion is known from that of the
// first, and the way back. The difference after the way back is due to the engine, for any motion: no
// reference is needed. Source: Landau and Lifshitz, Mechanics, 1976, sections 3, 5, 7-10.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// A scenario that must move like another, and its trajectory seen from there.
struct Transformed {
    scenario::Scenario scenario;  ///< scenario without reference and bounds
    double timeFactor = 1.0;      ///< its time steps beside those of the first
    /// Bodies in the order of the first scenario, times and states in its frame and units. Contacts too: A is
    /// the body with the lower index there.
    std::function<Trajectory(const Trajectory&)> back;
};

/// Run that is made a second time.
enum class Rerun {
    Transformed,  ///< another scenario
    Reversed,     ///< another scenario, made from how the first run ended
    Same,         ///< the same scenario in a process of its own
    Threads,      ///< the same scenario on more threads
};

struct SymmetryEntry {
    const char* name;  ///< "rotation"
    const char* title;
    Rerun rerun;
    const char* formula;
    /// Reason why the exact motion of this scenario does not have the symmetry, or why the model cannot
    /// express the other scenario; "" if it has it.
    std::string (*obstacle)(const scenario::Scenario&);
    /// `firstRun`: of the scenario, for Reversed; else null. Throws std::invalid_argument where there is an
    /// obstacle, or the run does not reach the end of the scenario.
    Transformed (*apply)(const scenario::Scenario&, const Trajectory* firstRun);
};

/// All symmetries in the order of symmetries.def.
const std::vector<SymmetryEntry>& symmetryTable();
const SymmetryEntry* findSymmetry(const std::string& name);
std::string symmetryNames();  ///< "galilean, rotation, ..."

/// Difference of two trajectories of the same bodies.
struct Difference {
    double position = 0.0;      ///< [m] largest distance of a body's origin, over all bodies that may move
    double positionAt = 0.0;    ///< [s]
    int body = 0;               ///< body of the largest difference
    double angle = 0.0;         ///< [rad] largest angle between the orientations
    std::size_t frames = 0;     ///< compared
    std::size_t differing = 0;  ///< number of frames whose states are not the same bits
    std::optional<double> firstDiffering;  ///< [s]
};
/// Frames are compared by their times: those that both have. Throws std::invalid_argument for other bodies or
/// when there is no common frame after the first.
Difference differenceOf(const scenario::Scenario& scenario, const Trajectory& a, const Trajectory& b);

}  // namespace rigor::validation
