// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions shared by metrics: rows with the worst first, the bodies that are compared, errors between
// states.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/metrics/metric.hpp"

namespace rigor::validation {

/// The largest value met and when. Not-a-number counts as infinite, so it can not hide.
class Worst {
  public:
    void add(double value, double at);
    bool any() const { return any_; }
    MetricValue row(const std::string& subject) const { return {subject, value_, at_}; }

  private:
    bool any_ = false;
    double value_ = 0.0, at_ = -1.0;
};

/// Rows with the whole scene's ("", the worst of them) put first; empty stays empty.
std::vector<MetricValue> withWorst(std::vector<MetricValue> rows);

/// Bodies that are observed and known to the reference; all it knows when none of them is observed.
std::vector<int> comparedBodies(const MetricInput& input);
/// Bodies that are observed and dynamic.
std::vector<int> observedDynamic(const MetricInput& input);
bool isDynamic(const scenario::Scenario& scenario, int body);
const std::string& bodyName(const MetricInput& input, int body);

/// Number of frames for which the reference is valid.
std::size_t validFrames(const MetricInput& input);

/// Scale of an error of the quantity: its own scale, or |expected| if it has none; 1 if both are zero.
double scaleOf(const Quantity& quantity, double expected);

/// Angle between two directions [rad, 0..pi]; they need not be unit. Small angles keep their digits.
double angleBetween(const scenario::Vec3& a, const scenario::Vec3& b);
/// Angle to the nearest of equally good directions [rad]; pi where there is none.
double nearestAngle(const scenario::Vec3& direction, const std::vector<scenario::Vec3>& good);

/// Angle of the rotation from a to b [rad, 0..pi]; quaternions need not be unit.
double rotationAngle(const scenario::Quat& a, const scenario::Quat& b);

/// Error of one body in one frame against a state of the reference; empty where that is not known.
using StateError = std::optional<double> (*)(const BodyState& state, const PartialState& exact);
std::optional<double> positionError(const BodyState& state, const PartialState& exact);
std::optional<double> velocityError(const BodyState& state, const PartialState& exact);
std::optional<double> orientationError(const BodyState& state, const PartialState& exact);
std::optional<double> spinError(const BodyState& state, const PartialState& exact);

enum class Over { Final, Max, Rms };
/// The error over the frames of each compared body, against the exact or the scheme-exact reference.
std::vector<MetricValue> stateErrors(const MetricInput& input, StateError error, Over over, bool scheme);

}  // namespace rigor::validation
