// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Errors over the scenario's own scales, and the same for an ideal run of the engine's scheme. Pure
// functions; the grades themselves are in validation/results/grades.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/metrics/metric_parts.hpp"
#include "validation/results/types.hpp"

namespace rigor::validation {

/// Scale that an error is measured against. All of it comes from the scenario and its exact solution over the
/// time for which that is known, never from a run.
enum class ScaleKind {
    One,            ///< the metric is relative as it is: to the exact quantity, to the momentum at the start
    Distance,       ///< farthest that a compared body gets from its start; where none moves: Size
    Angle,          ///< farthest that one turns from its first attitude, at most pi; where none turns: 1 rad
    Speed,          ///< largest speed; where nothing moves: that of a fall by Size
    Spin,           ///< largest angular velocity; where nothing turns: Speed over Size
    EventTime,      ///< time from the start to the event; the duration for one at the start
    Energy,         ///< largest kinetic energy, for metrics in units of energyScale(); see SceneScales
    EnergyInJoule,  ///< the same for metrics in joule
    Size,           ///< smallest width of a dynamic body
    Radian,         ///< 1 rad: turning by it moves a body's surface by its size
    JointTravel,  ///< 1 rad where all limits are angles, Size where all are lengths, else the smaller number
};

/// Part of the ideal run that the metric reads.
enum class IdealKind { Unknown, Position, Orientation, Velocity, Spin, WholeState, Quantities };

/// Scales of one scene. Empty where there is none: no gravity and nothing moves.
struct SceneScales {
    std::optional<double> distance, size;  ///< [m]
    std::optional<double> angle;           ///< [rad]
    std::optional<double> speed, spin;     ///< [m/s], [rad/s]
    std::optional<double> energy;          ///< [J]
    std::optional<double> jointTravel;     ///< [m] or [rad]
};

/// `reference` may be null; then what the initial state says. The exact solution is evaluated at 512 evenly
/// spaced times of the scenario, the same for every engine and time step. Energy: the largest kinetic energy
/// of the exact solution where it is known in full, else that at the start and the weights times the height
/// of the scene together.
SceneScales sceneScales(const scenario::Scenario& scenario, const Reference* reference);

/// Reason why a scene has no accuracy grade: it has no exact solution, or a recording; empty if it can have
/// one.
std::string whyNotGraded(const scenario::Scenario& scenario, const Reference* reference);

/// The run that the engine's scheme gives when nothing else is wrong, at the frames of a recorded one, and
/// what of it the reference knows of all compared bodies.
struct IdealRun {
    Trajectory run;
    bool position = false, orientation = false, velocity = false, spin = false;
    bool wholeState = false;  ///< all of it, of every dynamic body, to the last frame
};
IdealRun idealRun(const MetricInput& input);

/// Scale and ideal of a metric; null for one without a line in scales.def.
struct ScaleEntry {
    const char* metric;
    ScaleKind scale;
    IdealKind ideal;
};
const ScaleEntry* findScale(const std::string& metric);
const std::vector<ScaleEntry>& scaleTable();

/// Fills in the relative errors of one case.
class RelativeErrors {
  public:
    /// `input` must outlive this.
    explicit RelativeErrors(const MetricInput& input);

    /// Sets scale and relative of the rows of one metric, whole scene first; the relative error of the whole
    /// scene is the largest over its subjects. If the scenario names the metric, the ideal of the whole scene
    /// is also set.
    void fill(const MetricEntry& entry, std::vector<results::MetricRow>& rows);
    /// The worst over the metrics that the scenario names.
    results::AccuracyRow accuracyOf(const std::vector<results::MetricRow>& rows) const;

  private:
    std::optional<double> scaleOfRow(ScaleKind kind, const std::string& subject, const MetricInput& of) const;
    void setRelative(ScaleKind kind, const MetricInput& of, std::vector<results::MetricRow>& rows) const;
    std::optional<double> ideal(const MetricEntry& entry, const ScaleEntry& scale);
    std::optional<double> idealOfQuantities(ScaleKind kind);
    const IdealRun& run();

    const MetricInput& input_;
    std::string whyNot_;
    SceneScales scales_;
    std::optional<IdealRun> run_;
};

}  // namespace rigor::validation
