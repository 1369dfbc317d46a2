// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The published model of a pendulum of one to three arms, integrated here so that a recorded swing can get a
// start, and the error of that model be measured. Angles absolute, from straight up.
#pragma once

#include <cstddef>
#include <vector>

namespace rigor::validation {

struct ArmModel {
    double gravity = 0.0;  ///< [m/s^2]
    /// Properties of each arm: mass [kg], joint to centre of mass and to the next joint [m], inertia about
    /// the centre of mass [kg m^2], braking of its joint per relative rate [N m s].
    std::vector<double> mass, com, length, inertia, braking;
    std::size_t arms() const { return mass.size(); }
};

struct ArmState {
    std::vector<double> angles, rates;  ///< [rad], [rad/s]
};

/// Angles of the model, by sample, then by arm; sample 0 is the start.
std::vector<double> predictAngles(const ArmModel& model, const ArmState& start, double interval,
                                  std::size_t samples);

/// The start from which the model is nearest to the first `samples` of a recording (angles by sample, then by
/// arm) by least squares: Gauss and Newton's iteration over all angles and rates from `guess`.
ArmState fitStart(const ArmModel& model, const ArmState& guess, const std::vector<double>& recorded,
                  double interval, std::size_t samples);

/// Root mean square of the difference of two sets of angles, of the arm where it is largest [rad].
double worstRms(const std::vector<double>& one, const std::vector<double>& other, std::size_t arms);

}  // namespace rigor::validation
