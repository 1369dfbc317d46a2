// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Reference solutions. A reference takes every physical value from the scenario and names only the bodies
// that play its parts. Three kinds of result, never mixed: exact (the physics), scheme-exact (what an ideal
// implementation of the engine's own time-stepping scheme gives at this dt), and measured (what a real body
// did, with the errors of the instrument). The folder's README lists what a reference may include: nothing
// that an engine is made of, because shared code would prove nothing.
//
// What is guaranteed:
// - Right or refused. A reference is made only for scenes in which the assumptions listed at the top of its
//   file hold; otherwise making it throws AssumptionViolated with the reason. It also refuses where the laws
//   leave the outcome open, where its own numerics do not reach their accuracy ("no reference to the required
//   accuracy: ..."), and where neither of two opposite results can be proved ("undecided: ...",
//   static_equilibrium).
// - Accuracy. Closed forms are evaluated to rounding. Integrated motions keep a local error of 1e-14 (1e-13
//   and 1e-12 where the file says so) beside the scales of the scene: its lengths, speeds and times, not
//   metres and seconds. If neighbouring motions diverge so fast that this is lost, validUntil() ends the
//   solution.
// - Units. No threshold is an absolute number of a physical unit, so that a scene and the same scene in other
//   units get the same solution.
// - Time. Every search and every integration has a bound on its steps and ends with a solution, a solution up
//   to validUntil(), or a refusal.
//   No reference measures its own time: `validate`, `run` and `check` compute it in a child under the limits
//   of validation/runner/reference_guard.hpp (20 s, 2048 MiB by default), and running over is an outcome of
//   its own, not a refusal. A direct call of makeReference() has no such limit.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// Solution of a reference for one body at one time; parts it does not determine are empty. Position and
/// orientation are of the body frame, velocity of the centre of mass, as in BodyState.
struct PartialState {
    std::optional<scenario::Vec3> position;  ///< [m]
    std::optional<scenario::Quat> orientation;
    std::optional<scenario::Vec3> velocity;         ///< [m/s]
    std::optional<scenario::Vec3> angularVelocity;  ///< world [rad/s]
};

/// A named number that the exact solution determines and that can be measured in a trajectory: a stopping
/// distance, the time of the second bounce, a velocity after an impact.
struct Quantity {
    std::string name;  ///< snake_case, unique within the reference
    std::string unit;
    double exact = 0.0;
    std::optional<double> schemeExact;  ///< value at the requested dt
    /// Scale of an error of this quantity; 0: |exact|. It is set if the exact value can be zero.
    double scale = 0.0;
    /// The same number taken from a trajectory; empty when it does not show there (no second bounce).
    std::function<std::optional<double>(const Trajectory&)> measure;
    /// It is a sum of impulses at contacts: a run of an engine that reports none does not show it, and has no error of it.
    bool needsImpulses = false;
};

/// The scenario's values break an assumption of the reference ("slope steeper than the friction angle").
class AssumptionViolated : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Reference {
  public:
    virtual ~Reference() = default;

    /// Scenario indices of the bodies whose states this reference knows; may be empty.
    virtual std::vector<int> bodies() const { return {}; }

    /// Time until which exact() is valid [s]. At least 1e300: to the end of any run of the scenario, which is
    /// half a step after the duration at most, for steps of the scenario's list and any up to an eighth of
    /// the duration. Less: up to the first event that the reference does not resolve.
    virtual double validUntil() const { return 1e300; }

    /// The exact state of a body of bodies() at time t in [0, validUntil()] and of a run; outside of these
    /// the result means nothing.
    virtual PartialState exact(int body, double t) const;

    /// The state after `step` steps of `dt` of an ideal run of `scheme`; empty where no closed form is known.
    virtual std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                                    adapter::Scheme scheme) const;

    virtual std::vector<Quantity> quantities(double dt, adapter::Scheme scheme) const;

    /// Recorded state of a body of bodies() at time t; empty unless the reference is a measurement. Such a
    /// reference has no exact solution.
    virtual std::optional<PartialState> measured(int body, double t) const;
};

/// A line of the table of references.
struct ReferenceEntry {
    const char* name;
    const char* title;
    const char* formula;  ///< plain text, for the terminal
    const char* tex;      ///< the same and its symbols as TeX for display mode, several lines in `aligned`
    const char* source;   ///< literature
    std::unique_ptr<Reference> (*make)(const scenario::Scenario&, const scenario::ReferenceSpec&);
};
const std::vector<ReferenceEntry>& referenceTable();
const ReferenceEntry* findReference(const std::string& name);

/// The scenario's reference, or null when it has none. Throws AssumptionViolated where it refuses (above);
/// std::invalid_argument for an unknown reference, unknown or missing parameters, or bodies that do not
/// exist. The scenario must be one that the loader or adapter::checkScenarioInput accepts. The reference
/// refers to the scenario, which must outlive it; evaluating it is not safe from two threads at once.
std::unique_ptr<Reference> makeReference(const scenario::Scenario& scenario);

}  // namespace rigor::validation
