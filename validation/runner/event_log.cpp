// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/event_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "validation/metrics/mechanics.hpp"
#include "validation/results/values.hpp"

namespace rigor::validation {
namespace {

using scenario::Vec3;

/// Slower approaches are rest: what gravity adds in a step, twice, and a thousandth of a metre per second.
constexpr double kLeastImpactSpeed = 1e-3;
/// An impact takes away at least this part of the speed of approach within one step.
constexpr double kStoppedShare = 0.5;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string vector(const Vec3& v) {
    const auto plain = [](double x) { return number(x == 0.0 ? 0.0 : x); };  // no "-0"
    return "(" + plain(v.x) + "," + plain(v.y) + "," + plain(v.z) + ")";
}

Vec3 middle(const ContactPoint& c) {
    return 0.5 * (c.pointA + c.pointB);
}

}  // namespace

EventLog::EventLog(const scenario::Scenario& scenario, double dt, LogWhat what)
    : scenario_(scenario), dt_(dt), what_(what) {}

std::map<EventLog::Pair, EventLog::Manifold> EventLog::gathered(const std::vector<ContactPoint>& contacts) {
    std::map<Pair, Manifold> manifolds;
    for (const ContactPoint& c : contacts) {
        Manifold& m = manifolds[{c.bodyA, c.bodyB, c.shapeA, c.shapeB}];
        if (m.deepest == nullptr || c.depth > m.deepest->depth) m.deepest = &c;
        ++m.points;
        m.hasImpulses = m.hasImpulses && c.hasImpulse;
        m.normalImpulse += c.normalImpulse;
        m.frictionImpulse = m.frictionImpulse + c.frictionImpulse;
    }
    return manifolds;
}

std::string EventLog::step(double time, std::span<const BodyState> states,
                           const std::vector<ContactPoint>& contacts, const EngineReports& reports) {
    out_.clear();
    const auto stampOf = [](double t, std::size_t step) {
        return "t=" + results::exactText(t) + " step=" + std::to_string(step) + " ";
    };
    const auto manifolds = gathered(contacts);
    atEnd_ = reports.contactInstant == adapter::ContactInstant::StepEnd;
    contactTime_ = atEnd_ ? time : beforeTime_;
    stamp_ = stampOf(contactTime_, atEnd_ || step_ == 0 ? step_ : step_ - 1);
    contactEvents(manifolds);
    if (what_ != LogWhat::Contacts) impactEvents(states, manifolds);
    stamp_ = stampOf(time, step_);
    if (what_ != LogWhat::Contacts) reportedEvents(reports);
    before_.assign(states.begin(), states.end());
    beforeTime_ = time;
    ++step_;
    return out_;
}

void EventLog::contactEvents(const std::map<Pair, Manifold>& manifolds) {
    for (const auto& [pair, m] : manifolds) {
        const auto [it, begins] = touching_.try_emplace(pair);
        Touch& touch = it->second;
        if (begins) touch.since = contactTime_;
        touch.seen = step_;
        ++touch.steps;
        touch.impulseSum += m.normalImpulse;
        touch.hasImpulses = touch.hasImpulses && m.hasImpulses;
        if (!begins && what_ == LogWhat::Events) continue;
        std::string text = std::string(begins ? "begin" : "persist") + " contact " + pairText(pair) +
                           " n=" + vector(m.deepest->normal) + " depth=" + number(m.deepest->depth);
        if (m.hasImpulses) text += " jn=" + number(m.normalImpulse) + " jt=" + vector(m.frictionImpulse);
        line(text + " points=" + std::to_string(m.points) + " p=" + vector(middle(*m.deepest)) +
             idText(pair));
    }
    for (auto it = touching_.begin(); it != touching_.end();) {
        const auto& [pair, touch] = *it;
        if (touch.seen == step_) {
            ++it;
            continue;
        }
        std::string text = "end contact " + pairText(pair) + idText(pair) +
                           " since=" + results::exactText(touch.since) +
                           " steps=" + std::to_string(touch.steps);
        if (touch.hasImpulses) text += " jn_sum=" + number(touch.impulseSum);
        line(text);
        it = touching_.erase(it);
    }
}

void EventLog::impactEvents(std::span<const BodyState> states, const std::map<Pair, Manifold>& manifolds) {
    if (before_.empty()) return;
    const double least = std::max(kLeastImpactSpeed, 2.0 * norm(scenario_.gravity) * dt_);
    for (const auto& [pair, m] : manifolds) {
        const std::span<const BodyState> found = atEnd_ ? states : std::span<const BodyState>(before_);
        const double approach = separationSpeed(pair, *m.deepest, found, before_);
        const double after = separationSpeed(pair, *m.deepest, found, states);
        if (!(approach <= -least) || !(after - approach >= -kStoppedShare * approach)) continue;
        std::string text = "impact " + pairText(pair) + " n=" + vector(m.deepest->normal) +
                           " vn=" + number(approach) + " vn_after=" + number(after);
        if (m.hasImpulses) text += " jn=" + number(m.normalImpulse);
        line(text + " p=" + vector(middle(*m.deepest)) + idText(pair));
    }
}

double EventLog::separationSpeed(const Pair& pair, const ContactPoint& at, std::span<const BodyState> found,
                                 std::span<const BodyState> states) const {
    const Vec3 p = middle(at);
    const auto velocity = [&](int body) {
        const auto i = static_cast<std::size_t>(body);
        const BodyState& s = states[i];
        return s.velocity + cross(s.angularVelocity, p - centerOfMassOf(scenario_.bodies[i], found[i]));
    };
    return dot(velocity(pair[1]) - velocity(pair[0]), at.normal);
}

void EventLog::reportedEvents(const EngineReports& reports) {
    asleep_.resize(scenario_.bodies.size(), 0);
    for (std::size_t i = 0; reports.asleep && i < asleep_.size(); ++i) {
        const char now = reports.asleep(static_cast<int>(i)) ? 1 : 0;
        if (now != asleep_[i])
            line(std::string(now ? "sleep" : "wake") + " body=" + scenario_.bodies[i].name +
                 " id=" + std::to_string(i));
        asleep_[i] = now;
    }
    broken_.resize(scenario_.joints.size(), 0);
    for (std::size_t i = 0; reports.holds && i < broken_.size(); ++i) {
        if (broken_[i] || reports.holds(static_cast<int>(i))) continue;
        broken_[i] = 1;
        const auto& joint = scenario_.joints[i];
        const auto name = [&](int body) {
            return body == scenario::kNone ? std::string("world") : scenario_.bodies[body].name;
        };
        line("break joint=" + joint.name + " a=" + name(joint.bodyA) + " b=" + name(joint.bodyB));
    }
}

std::string EventLog::pairText(const Pair& pair) const {
    return "a=" + scenario_.bodies[pair[0]].name + " b=" + scenario_.bodies[pair[1]].name;
}

std::string EventLog::idText(const Pair& pair) const {
    const auto shape = [&](int body, int index) {
        const auto& shapes = scenario_.bodies[body].shapes;
        const auto i = static_cast<std::size_t>(index);
        return std::to_string(index) +
               (i < shapes.size()
                    ? std::string(":") + scenario::geometryName(shapes[i].geometry, scenario_.dimension)
                    : "");
    };
    return " a_id=" + std::to_string(pair[0]) + " b_id=" + std::to_string(pair[1]) +
           " a_shape=" + shape(pair[0], pair[2]) + " b_shape=" + shape(pair[1], pair[3]);
}

void EventLog::line(const std::string& text) {
    out_ += stamp_ + text + "\n";
}

}  // namespace rigor::validation
