// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Log of the events of a run, as lines that can be followed and searched while it goes on. The words are the
// same for every engine: all but sleeping and breaking is found from outside, in contacts and states.
//
//   t=<s> step=<n> begin contact a=<body> b=<body> n=(..) depth=.. [jn=.. jt=(..)] points=.. p=(..) <ids>
//   t=<s> step=<n> persist contact ...          the same, in every further step
//   t=<s> step=<n> end contact a=.. b=.. <ids> since=<s> steps=<n> [jn_sum=..]
//   t=<s> step=<n> impact a=.. b=.. n=(..) vn=<before> vn_after=.. [jn=..] p=(..) <ids>
//   t=<s> step=<n> break joint=<name> a=.. b=..
//   t=<s> step=<n> sleep body=<name> id=..      and wake
//
// Contacts and impacts are of the step that begins at t, after n steps, at the poses of that moment; joints
// that break and bodies that fall asleep do so in the step that ends at t.
//
// <ids>: a_id=<scenario index> b_id=.. a_shape=<index>:<geometry> b_shape=..
//
// A is the body of lower index, n the normal from A to B at the deepest point, depth [m] there (< 0: apart),
// p the middle between its two surface points [m]; jn [N s] the normal impulses of all points together, jt [N
// s] the sum of the friction impulses on B, both only if the engine reports them. vn [m/s]: speed at which B
// leaves A at p, < 0: they approach.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// Events that are logged.
enum class LogWhat {
    Contacts,  ///< contacts alone: begin, persist, end
    Events,    ///< changes: begin, end, impact, break, sleep, wake
    All
};

class EventLog {
  public:
    /// Functions that report the state of bodies and joints by scenario index; an empty function: the engine
    /// does not report it.
    struct EngineReports {
        std::function<bool(int body)> asleep;
        std::function<bool(int joint)> holds;
        adapter::ContactInstant contactInstant = adapter::ContactInstant::StepStart;
    };

    /// The scenario must outlive the log.
    EventLog(const scenario::Scenario& scenario, double dt, LogWhat what);

    /// The lines of the step that led to `time`, with its contacts and the states after it, each ended by a
    /// line break; "" when nothing happened. The first call is the start, before any step.
    std::string step(double time, std::span<const BodyState> states,
                     const std::vector<ContactPoint>& contacts, const EngineReports& reports);

  private:
    using Pair = std::array<int, 4>;  ///< body A, body B, shape A, shape B
    struct Touch {
        double since = 0.0;
        std::size_t steps = 0, seen = 0;
        double impulseSum = 0.0;
        bool hasImpulses = true;
    };
    /// The points of one pair of shapes in one step.
    struct Manifold {
        const ContactPoint* deepest = nullptr;
        std::size_t points = 0;
        double normalImpulse = 0.0;
        scenario::Vec3 frictionImpulse;
        bool hasImpulses = true;
    };

    static std::map<Pair, Manifold> gathered(const std::vector<ContactPoint>& contacts);
    void contactEvents(const std::map<Pair, Manifold>& manifolds);
    void impactEvents(std::span<const BodyState> states, const std::map<Pair, Manifold>& manifolds);
    void reportedEvents(const EngineReports& reports);
    /// Speed at which the surfaces part at a contact of the states `found`, with the velocities of `states` [m/s].
    double separationSpeed(const Pair& pair, const ContactPoint& at, std::span<const BodyState> found,
                           std::span<const BodyState> states) const;
    std::string pairText(const Pair& pair) const;
    std::string idText(const Pair& pair) const;
    void line(const std::string& text);

    const scenario::Scenario& scenario_;
    double dt_;
    LogWhat what_;
    bool atEnd_ = false;  ///< contacts belong to the end of their step
    std::size_t step_ = 0;
    std::string stamp_, out_;
    std::map<Pair, Touch> touching_;
    std::vector<BodyState> before_;
    double beforeTime_ = 0.0;   ///< [s] of before_
    double contactTime_ = 0.0;  ///< [s] of the contacts of this step
    std::vector<char> asleep_, broken_;
};

}  // namespace rigor::validation
