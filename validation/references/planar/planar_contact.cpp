// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One body seen from the side on a straight floor, from event to event (planar_motion.hpp): the rocking
// block, a box that tips or is pushed over, the falling pencil, a rod on smooth ice, the thrown rod or box
// that hits with a corner, Painleve's rod. Source: Housner, Bull. Seism. Soc. Am. 53 (1963) 403; Routh,
// Dynamics of a System of Rigid Bodies, 1905; Brach, Mechanical Impact Dynamics, 1991; Genot and Brogliato
// 1999. Impacts are those of the scenario's own law: Newton's restitution and Coulomb friction on the whole
// impulse with the slip after it. Routh's incremental law and Poisson's and Stronge's restitution agree with
// it where the slip does not change its direction during the impact. Assumes: motion in a plane across the
// floor (2D, or 3D with a body that is the same on both sides of it); corners and caps (boxes, polygons,
// hulls, capsules, spheres); gravity and constant forces; nothing else. A flat side may rest or slide.
// Quantities: impact_time_n of the first four impacts; peak_n, the turn between impacts n and n + 1 of a
// rocking body; along_after, above_after, spin_after the first impact in free flight.
#include <algorithm>
#include <cmath>

#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation {
namespace {

using Event = PlanarMotion::Event;
using EventKind = PlanarMotion::EventKind;
using Kind = PlanarMotion::Kind;

constexpr std::size_t kMostTimes = 4;

/// One body and its quantities.
class PlanarPart {
  public:
    PlanarPart(const Scenario& scenario, int body, int floor)
        : body_(body),
          duration_(scenario.duration),
          frame_(scenario, body, floor),
          motion_(frame_.setup(), frame_.start(), scenario.duration, runEnd(scenario)) {
        for (const Event& event : motion_.events())
            if (event.kind == EventKind::Impact && event.time < std::min(duration_, validUntil()))
                impacts_.push_back(event);
    }
    int body() const { return body_; }
    double validUntil() const { return motion_.validUntil(); }
    PartialState exact(double t) const { return frame_.lift(motion_.at(t)); }

    void addQuantities(std::vector<Quantity>& result) const {
        for (std::size_t k = 0; k < std::min(kMostTimes, impacts_.size()); ++k) {
            const std::string number = std::to_string(k + 1);
            if (isFree(k)) {
                result.push_back({"impact_time_" + number,
                                  "s",
                                  impacts_[k].time,
                                  {},
                                  0.0,
                                  [this, k](const Trajectory& run) { return meetingTime(run, k); }});
            } else if (isRocking(k)) {
                result.push_back({"impact_time_" + number,
                                  "s",
                                  impacts_[k].time,
                                  {},
                                  0.0,
                                  [this, k](const Trajectory& run) { return impactTime(run, k); }});
                if (k + 1 < impacts_.size() && isRocking(k + 1)) addPeak(result, k);
            }
        }
        if (!impacts_.empty() && isFree(0)) addVelocities(result);
    }

  private:
    double endOf(std::size_t k) const {
        const double next = k + 1 < impacts_.size() ? impacts_[k + 1].time : duration_;
        return std::min(next, motion_.validUntil());
    }
    double startOf(std::size_t k) const { return k > 0 ? impacts_[k - 1].time : 0.0; }
    /// Kind of motion just after t, by 1e-9 of the duration.
    Kind kindAfter(double t) const { return motion_.modeAt(t + 1e-9 * duration_).kind; }
    Kind kindBefore(double t) const { return motion_.modeAt(t - 1e-9 * duration_).kind; }
    bool isFree(std::size_t k) const {
        const double t = impacts_[k].time;
        return kindBefore(t) == Kind::Flight && kindAfter(t) == Kind::Flight &&
               kindAfter(startOf(k)) == Kind::Flight;
    }
    /// True if the body is in contact on both sides of the impact, turning the same way or lying flat (a rate
    /// that is only rounding).
    bool isRocking(std::size_t k) const {
        const double t = impacts_[k].time;
        return kindBefore(t) != Kind::Flight && kindAfter(t) != Kind::Flight &&
               impacts_[k].after.rate / impacts_[k].before.rate > -1e-12L;
    }

    /// Time at which the parabolas of the free flights before and after meet, independent of the steps in
    /// between.
    std::optional<double> meetingTime(const Trajectory& run, std::size_t k) const {
        const double t = impacts_[k].time;
        const auto a = k == 0 ? std::optional<std::size_t>(0)
                              : lastFrameBefore(run, startOf(k) + 0.5 * (t - startOf(k)));
        const auto b = lastFrameBefore(run, t + 0.9 * (endOf(k) - t));
        if (!a || !b || run.times[*b] <= t) return std::nullopt;
        const auto before = frame_.read(run.state(*a, body_)), after = frame_.read(run.state(*b, body_));
        const double g = d(frame_.setup().pullAbove), ta = run.times[*a], tb = run.times[*b];
        // z_a + v_a (t - ta) + g (t - ta)^2/2 = z_b + v_b (t - tb) + g (t - tb)^2/2 is linear in t.
        const double slope = d(before.vz) - d(after.vz) + g * (tb - ta);
        if (!(slope < 0.0)) return std::nullopt;
        return (d(after.z) - d(before.z) - d(after.vz) * tb + d(before.vz) * ta +
                0.5 * g * (tb * tb - ta * ta)) /
               slope;
    }

    /// Time at which the body turns through the angle of the impact. A body that lands on a side and rests a hair above
    /// the floor never does: it has landed where it is within kShort of it, and would arrive at the exact rate.
    std::optional<double> impactTime(const Trajectory& run, std::size_t k) const {
        const std::optional<std::size_t> from = frameBefore(run, k);
        if (!from) return std::nullopt;
        if (const auto time = crossingTime(run, *from, k, 0.0)) return time;
        constexpr double kShort = 1e-3;  // [rad]
        const auto time = crossingTime(run, *from, k, kShort);
        if (!time) return std::nullopt;
        return *time + kShort / std::abs(d(impacts_[k].before.rate));
    }

    /// The frame from which on impact k is looked for: past the peak after the impact before, where the exact motion has
    /// turned half way back.
    std::optional<std::size_t> frameBefore(const Trajectory& run, std::size_t k) const {
        std::optional<std::size_t> from = 0;
        for (std::size_t i = 0; i < k && from; ++i)
            from = lastFrameBefore(run, impacts_[i].time + 0.5 * (impacts_[i + 1].time - impacts_[i].time));
        return from;
    }

    /// Time at which the body turns through the angle of the impact less `before` [rad].
    std::optional<double> crossingTime(const Trajectory& run, std::size_t from, std::size_t k,
                                       double before) const {
        const Event& event = impacts_[k];
        const double sign = event.before.rate > 0 ? 1.0 : -1.0, angle = d(event.before.angle);
        return upwardCrossing(
            run, from,
            [&](std::size_t f) {
                return sign * (d(frame_.read(run.state(f, body_)).angle) - angle) + before;
            },
            [&](std::size_t f) { return sign * d(frame_.read(run.state(f, body_)).rate); });
    }

    void addPeak(std::vector<Quantity>& result, std::size_t k) const {
        const double from = impacts_[k].time, to = impacts_[k + 1].time;
        const double flat = d(impacts_[k].after.angle), sign = impacts_[k].after.rate > 0 ? 1.0 : -1.0;
        double peak = 0.0;
        for (int i = 0; i <= 2000; ++i)
            peak = std::max(peak, sign * (d(motion_.at(from + (to - from) * i / 2000).angle) - flat));
        Quantity q{"peak_" + std::to_string(k + 1), "rad", peak, {}, 0.0, {}};
        q.measure = [this, from, to, flat, sign](const Trajectory& run) -> std::optional<double> {
            const auto first = lastFrameBefore(run, from), last = lastFrameBefore(run, to);
            if (!last) return std::nullopt;
            double most = 0.0;
            for (std::size_t f = first.value_or(0); f <= *last; ++f)
                most = std::max(most, sign * (d(frame_.read(run.state(f, body_)).angle) - flat));
            return most;
        };
        result.push_back(std::move(q));
    }

    void addVelocities(std::vector<Quantity>& result) const {
        const Event& event = impacts_[0];
        const double end = endOf(0), speed = std::hypot(d(event.before.vx), d(event.before.vz)) +
                                             d(frame_.setup().size) * std::abs(d(event.before.rate));
        const auto add = [&](const char* name, const char* unitName, double exact, double scale, auto read) {
            Quantity q{name, unitName, exact, {}, scale, {}};
            q.measure = [this, event, end, read](const Trajectory& run) -> std::optional<double> {
                const auto frame = lastFrameBefore(run, event.time + 0.9 * (end - event.time));
                if (!frame || run.times[*frame] <= event.time) return std::nullopt;
                PlanarMotion::State s = frame_.read(run.state(*frame, body_));
                const double since = run.times[*frame] - event.time;
                s.vx -= since * frame_.setup().pullAlong;
                s.vz -= since * frame_.setup().pullAbove;
                return static_cast<double>(read(s));
            };
            result.push_back(std::move(q));
        };
        using State = PlanarMotion::State;
        add("along_after", "m/s", d(event.after.vx), speed, [](const State& s) { return s.vx; });
        add("above_after", "m/s", d(event.after.vz), speed, [](const State& s) { return s.vz; });
        add("spin_after", "rad/s", d(event.after.rate), speed / d(frame_.setup().size),
            [](const State& s) { return s.rate; });
    }

    static double d(numerics::Real v) { return static_cast<double>(v); }

    int body_;
    double duration_;
    PlanarFrame frame_;
    PlanarMotion motion_;
    std::vector<Event> impacts_;
};

class PlanarContact : public Reference {
  public:
    PlanarContact(const Scenario& scenario, const std::vector<int>& bodies, int floor) : scenario_(scenario) {
        for (const int body : bodies) parts_.push_back(std::make_unique<PlanarPart>(scenario, body, floor));
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const auto& part : parts_) result.push_back(part->body());
        return result;
    }
    double validUntil() const override {
        double end = 1e300;
        for (const auto& part : parts_) end = std::min(end, part->validUntil());
        return end;
    }
    PartialState exact(int body, double t) const override {
        for (const auto& part : parts_)
            if (part->body() == body) return part->exact(t);
        throw std::invalid_argument("planar_contact: unknown body");
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        for (const auto& part : parts_) {
            const std::size_t first = result.size();
            part->addQuantities(result);
            // The name of a quantity contains the body's if there are several bodies.
            for (std::size_t i = first; i < result.size() && parts_.size() > 1; ++i)
                result[i].name += "_" + scenario_.bodies[part->body()].name;
        }
        return result;
    }

  private:
    const Scenario& scenario_;
    std::vector<std::unique_ptr<PlanarPart>> parts_;
};

}  // namespace

std::unique_ptr<Reference> makePlanarContact(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies", "body", "floor"});
    const auto bodies = parts.dynamicBodies(spec.parameters.count("body") ? "body" : "bodies");
    return std::make_unique<PlanarContact>(scenario, bodies, parts.support("floor", bodies.front()));
}

}  // namespace rigor::validation
