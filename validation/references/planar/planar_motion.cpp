// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See planar_motion.hpp.
#include "validation/references/planar/planar_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "validation/references/planar/planar_events.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using Real = numerics::Real;
using Kind = PlanarMotion::Kind;

constexpr Real kStill = 1e-10L;  // speed relative to those of the scene: rounding of events, not physics
constexpr int kChunks = 48;      // pieces of the duration that are integrated at a time
constexpr int kShorter = 10;     // times that a piece is cut to a quarter
constexpr std::size_t kMostEvents = 200;
// tolerance of the event functions relative to lengths, speeds and forces of the scene
constexpr Real kZero = 1e-15L;
constexpr Real kNear = 1e-3L;  // distance relative to the size of a corner that may land soon
constexpr std::size_t kMostPhases = 5000;
constexpr int kMostStops = 8;                        // changes of the mode in a row in which no time passes
constexpr std::size_t kMostEvaluations = 1'500'000;  // evaluations of the equations of motion: 1.5 s
constexpr std::size_t kMostInPiece = 100'000;        // evaluations in a piece, 100 times the usual number

OdeState pack(const PlanarMotion::State& s) {
    return {s.x, s.z, s.angle, s.vx, s.vz, s.rate};
}
PlanarMotion::State unpack(const OdeState& y) {
    return {y[0], y[1], y[2], y[3], y[4], y[5]};
}
bool isSlip(Kind kind) {
    return kind == Kind::SlipForward || kind == Kind::SlipBackward;
}
bool isSlide(Kind kind) {
    return kind == Kind::SlideForward || kind == Kind::SlideBackward;
}
Real signOf(Kind kind) {
    return kind == Kind::SlipForward ? 1 : (kind == Kind::SlipBackward ? -1 : 0);
}

}  // namespace

PlanarMotion::Arm PlanarMotion::armOf(int corner, Real angle) const {
    const Corner& p = setup_.corners[corner];
    const Real c = std::cos(angle), s = std::sin(angle);
    Arm arm;
    arm.x = c * p.along - s * p.above;
    arm.z = s * p.along + c * p.above;
    arm.cx = arm.x;
    arm.cz = arm.z - p.radius;
    return arm;
}

Real PlanarMotion::gapOf(int corner, const State& s) const {
    return s.z + armOf(corner, s.angle).cz;
}
Real PlanarMotion::closingOf(int corner, const State& s) const {
    return s.vz + s.rate * armOf(corner, s.angle).x;
}
Real PlanarMotion::slipOf(int corner, const State& s) const {
    return s.vx - s.rate * armOf(corner, s.angle).cz;
}

/// Acceleration of the gap per newton of normal force: Painleve's p over m.
Real PlanarMotion::leverOf(const Mode& mode, const State& s) const {
    const Arm a = armOf(mode.corner, s.angle);
    return 1 / setup_.mass + a.x * (a.cx + setup_.friction * signOf(mode.kind) * a.cz) / setup_.inertia;
}

std::optional<PlanarMotion::Forces> PlanarMotion::forcesIn(const Mode& mode, const State& s) const {
    Forces f;
    if (mode.kind != Kind::Flight) {
        const Arm a = armOf(mode.corner, s.angle);
        const Real m = setup_.mass, inertia = setup_.inertia, mu = setup_.friction, w2 = s.rate * s.rate;
        const Real turn = setup_.torque / inertia;
        // gap'' = b + p N + q F; slip' = d + q' N + e F.
        const Real b = setup_.pullAbove + turn * a.x - w2 * a.z;
        const Real d = setup_.pullAlong - turn * a.cz - w2 * a.x;
        const Real p = 1 / m + a.x * a.cx / inertia, q = -a.x * a.cz / inertia;
        const Real r = -a.cx * a.cz / inertia, e = 1 / m + a.cz * a.cz / inertia;
        if (mode.kind == Kind::Stick) {
            const Real det = p * e - q * r;
            f.load.normal = (q * d - e * b) / det;
            f.load.tangential = (r * b - p * d) / det;
        } else {
            const Real lever = leverOf(mode, s);
            if (!(lever > 0)) return std::nullopt;
            f.load.normal = -b / lever;
            f.load.tangential = -mu * signOf(mode.kind) * f.load.normal;
        }
        f.spin = (a.cx * f.load.normal - a.cz * f.load.tangential) / inertia;
    }
    f.ax = setup_.pullAlong + f.load.tangential / setup_.mass;
    f.az = setup_.pullAbove + f.load.normal / setup_.mass;
    f.spin += setup_.torque / setup_.inertia;
    return f;
}

void PlanarMotion::setScale(const State& start) {
    const Real speed = std::abs(start.vx) + std::abs(start.vz) + setup_.size * std::abs(start.rate) +
                       std::sqrt(std::hypot(setup_.pullAlong, setup_.pullAbove) * setup_.size);
    scale_ = {setup_.size, setup_.size, 1, speed, speed, speed / setup_.size};
}

PlanarMotion::PlanarMotion(Setup setup, State start, double duration, double end)
    : setup_(std::move(setup)), duration_(duration) {
    setScale(start);
    double t = 0.0;
    State s = start;
    Mode mode = startMode(s);
    std::optional<AssumptionViolated> open;
    try {
        followTo(duration_, t, s, mode);
        followTo(end, t, s, mode);
    } catch (const AssumptionViolated& violation) {
        // A motion that the laws leave open after the duration does not affect the time before.
        if (t < duration_) open.emplace(violation);
        validUntil_ = std::min(validUntil_, t);
    }
    if (open && setup_.stopsAtImpact) throw *open;
    if (!setup_.stopsAtImpact) {
        const double divergence = partingFrom(neighbourOf(start, end), std::min(t, validUntil_));
        if (open && !(divergence < validUntil_)) throw *open;
        if (divergence < std::min(t, validUntil_)) validUntil_ = divergence;
    }
    require(validUntil_ > 0.0,
            "the contact changes its mode again and again, or neighbouring motions part, "
            "at the start");
}

void PlanarMotion::followTo(double end, double& t, State& s, Mode& mode) {
    end_ = end;
    int stops = 0;
    while (t < end_ && validUntil_ > 1e299) {
        const double before = t;
        mode = follow(t, s, mode);
        stops = t > before ? 0 : stops + 1;
        // Bounces that come closer and closer, or modes that alternate at one instant: known up to here.
        if (events_.size() >= kMostEvents || stops > kMostStops || phases_.size() >= kMostPhases ||
            evaluations_ >= kMostEvaluations)
            validUntil_ = std::min(validUntil_, t);
    }
}

/// The mode that the contact forces of a single touching corner choose.
PlanarMotion::Mode PlanarMotion::contactMode(int corner, const State& s) const {
    const Real slip = slipOf(corner, s),
               speed = std::abs(s.vx) + std::abs(s.vz) + setup_.size * std::abs(s.rate);
    const Real pull = std::hypot(setup_.pullAlong, setup_.pullAbove);
    if (std::abs(slip) > kStill * (speed + std::sqrt(pull * setup_.size)))
        return {slip > 0 ? Kind::SlipForward : Kind::SlipBackward, corner};
    const Mode stick{Kind::Stick, corner};
    const auto f = forcesIn(stick, s);
    if (f->load.normal < 0) return {Kind::Flight, -1};
    if (std::abs(f->load.tangential) <= setup_.friction * f->load.normal) return stick;
    // It starts to slip against the force that would have held it.
    return {f->load.tangential > 0 ? Kind::SlipBackward : Kind::SlipForward, corner};
}

/// True if forces inside the cones of two corners hold the body: the line of the load crosses the base.
bool PlanarMotion::restsOn(const std::vector<int>& corners, const State& s) const {
    if (corners.size() != 2 || setup_.pullAbove >= 0) return false;
    const Arm a = armOf(corners[0], s.angle), b = armOf(corners[1], s.angle);
    const Real normal = -setup_.mass * setup_.pullAbove, tangential = -setup_.mass * setup_.pullAlong;
    if (std::abs(tangential) > setup_.friction * normal) return false;
    // Moments about the centre of mass: Na a.cx + Nb b.cx - F cz + T = 0, Na + Nb = N.
    const Real moment = tangential * a.cz - setup_.torque;
    const Real nb = (moment - normal * a.cx) / (b.cx - a.cx), na = normal - nb;
    return na >= 0 && nb >= 0;
}

/// True if the friction of a side that slides leaves a positive normal force at both of its ends.
bool PlanarMotion::slidesOn(const std::vector<int>& corners, const State& s, Real sign) const {
    if (corners.size() != 2 || setup_.pullAbove >= 0) return false;
    const Arm a = armOf(corners[0], s.angle), b = armOf(corners[1], s.angle);
    const Real normal = -setup_.mass * setup_.pullAbove, tangential = -sign * setup_.friction * normal;
    const Real nb = (tangential * a.cz - setup_.torque - normal * a.cx) / (b.cx - a.cx), na = normal - nb;
    return na >= 0 && nb >= 0;
}

/// The mode of a body whose flat side touches with both ends and does not turn: it rests, slides, or tips.
PlanarMotion::Mode PlanarMotion::flatMode(const std::vector<int>& corners, State& s) const {
    const Real pull = std::hypot(setup_.pullAlong, setup_.pullAbove);
    s.vz = s.rate = 0;
    Real sign = s.vx > 0 ? 1 : -1;
    if (std::abs(s.vx) <= kStill * std::sqrt(pull * setup_.size)) {
        s.vx = 0;
        if (restsOn(corners, s)) return {Kind::Rest, -1};
        sign = setup_.pullAlong > 0 ? 1 : -1;
    }
    const bool moves = s.vx != 0 || std::abs(setup_.pullAlong) > -setup_.friction * setup_.pullAbove;
    if (moves && slidesOn(corners, s, sign)) return {sign > 0 ? Kind::SlideForward : Kind::SlideBackward, -1};
    // The body is not held: it tips over one of its ends.
    for (const int i : corners) {
        const int other = i == corners[0] ? corners[1] : corners[0];
        const Mode mode = contactMode(i, s);
        if (mode.kind == Kind::Flight) continue;
        const auto f = forcesIn(mode, s);
        if (f && f->load.normal >= 0 && f->az + f->spin * armOf(other, s.angle).x > 0) return mode;
    }
    violated("the body leaves the floor with a flat side");
}

PlanarMotion::Mode PlanarMotion::startMode(State& s) const {
    std::vector<int> touching;
    const Real speed = std::abs(s.vx) + std::abs(s.vz) + setup_.size * std::abs(s.rate);
    const Real natural = std::sqrt(std::hypot(setup_.pullAlong, setup_.pullAbove) * setup_.size);
    const Real small = 1e-6L * speed + 1e-12L * natural;
    for (int i = 0; i < static_cast<int>(setup_.corners.size()); ++i) {
        const Real gap = gapOf(i, s), rate = closingOf(i, s);
        require(gap > -1e-6L * setup_.size, "the body starts inside the floor");
        if (gap > 1e-6L * setup_.size || rate > small) continue;
        require(rate >= -small, "a corner of the body moves into the floor at the start");
        touching.push_back(i);
    }
    if (touching.empty()) return {Kind::Flight, -1};
    if (touching.size() == 1) return contactMode(touching[0], s);
    require(touching.size() == 2, "more than two corners touch the floor");
    return flatMode(touching, s);
}

/// Length of one piece of the integration: a part of the duration, or a few times the flight of a corner that
/// is near.
double PlanarMotion::pieceFrom(const State& s, const Mode& mode) const {
    Real piece = static_cast<Real>(duration_) / kChunks;
    const Real pull = std::hypot(setup_.pullAlong, setup_.pullAbove);
    for (int i = 0; i < static_cast<int>(setup_.corners.size()) && pull > 0; ++i) {
        const Real gap = std::max(gapOf(i, s), Real(0));
        const Real flight = (std::abs(closingOf(i, s)) + std::sqrt(2 * gap * pull)) / pull;
        // A corner at rest on the floor does not bound the piece.
        if (i == mode.corner || gap > kNear * setup_.size || flight < 1e-9L * duration_) continue;
        piece = std::min(piece, 32 * flight);
    }
    // The samples of the event functions resolve the corners of a body that spins.
    if (s.rate != 0) piece = std::min(piece, 2 * numerics::kPi / std::abs(s.rate));
    return static_cast<double>(piece);
}

/// One mode from t on, for a piece of time that may reach past its next event. Beyond the event the contact
/// may come to where no force fits it: then a shorter piece is taken.
PlanarMotion::Phase PlanarMotion::piece(double t, const State& s, const Mode& mode) {
    const auto rhs = [this, mode](Real, const OdeState& y, OdeState& d) {
        ++evaluations_;
        const auto f = forcesIn(mode, unpack(y));
        if (f)
            d = {y[3], y[4], y[5], f->ax, f->az, f->spin};
        else
            d.assign(6, std::numeric_limits<Real>::quiet_NaN());
    };
    double length = std::min(end_ - t, pieceFrom(s, mode));
    for (int attempt = 0;; ++attempt) {
        const double end = length < end_ - t ? t + length : end_;
        try {
            return {t,
                    end,
                    mode,
                    s,
                    0,
                    t,
                    numerics::DenseSolution(rhs, t, pack(s), end, 1e-14L, {}, scale_,
                                            numerics::OdeLimits::ofEvaluations(kMostInPiece))};
        } catch (const std::runtime_error&) {
            if (attempt == kShorter || !(t + length / 4 > t)) throw;
        }
        length /= 4;
    }
}

/// Integrates one mode to its next event and says which mode follows.
PlanarMotion::Mode PlanarMotion::follow(double& t, State& s, Mode mode) {
    if (mode.kind == Kind::Rest) {
        phases_.push_back({t, 1e300, mode, s, 0, t, {}});
        t = end_;
        return mode;
    }
    if (isSlide(mode.kind)) return slide(t, s, mode);
    if (!forcesIn(mode, s)) {
        const Arm a = armOf(mode.corner, s.angle);
        require(setup_.pullAbove + setup_.torque / setup_.inertia * a.x - s.rate * s.rate * a.z < 0,
                "the slipping contact may open or jam: the laws leave it undetermined (Painleve)");
        State next = s;
        const Mode after = impact(t, next, {mode.corner}, {}, EventKind::Jam);
        s = next;
        return after;
    }
    Phase phase = piece(t, s, mode);
    const double end = phase.end;
    const auto stateAt = [&](Real at) { return unpack(phase.solution.at(at)); };
    std::vector<Watched> watched;
    const Real pull = std::hypot(setup_.pullAlong, setup_.pullAbove), load = kZero * setup_.mass * pull;
    if (mode.kind != Kind::Flight)
        watched.push_back({[&](Real at) { return forcesIn(mode, stateAt(at))->load.normal; }, load});
    if (isSlip(mode.kind))
        watched.push_back({[&](Real at) { return signOf(mode.kind) * slipOf(mode.corner, stateAt(at)); },
                           kZero * std::sqrt(pull * setup_.size)});
    if (mode.kind == Kind::Stick)
        watched.push_back({[&](Real at) {
                               const auto f = forcesIn(mode, stateAt(at));
                               return setup_.friction * f->load.normal - std::abs(f->load.tangential);
                           },
                           load});
    for (int i = 0; i < static_cast<int>(setup_.corners.size()); ++i)
        if (i != mode.corner)
            watched.push_back({[&, i](Real at) { return gapOf(i, stateAt(at)); }, kZero * setup_.size});
    std::optional<Real> event;
    for (const Watched& one : watched)
        if (const auto zero = firstZero(one, t, end); zero && !(event && *event <= *zero)) event = zero;
    if (event) phase.end = static_cast<double>(*event);
    phases_.push_back(phase);
    t = phase.end;
    s = unpack(phase.solution.at(t));
    if (!event) return mode;
    return resolve(t, s, mode);
}

/// Slides on a flat side with constant acceleration, to the end or to a stop.
PlanarMotion::Mode PlanarMotion::slide(double& t, State& s, Mode mode) {
    const Real sign = mode.kind == Kind::SlideForward ? 1 : -1;
    const Real rate = setup_.pullAlong + sign * setup_.friction * setup_.pullAbove;
    Phase phase{t, 1e300, mode, s, rate, t, {}};
    const Real stop = s.vx * rate < 0 ? static_cast<Real>(t) - s.vx / rate : 1e300L;
    if (stop < static_cast<Real>(end_)) phase.end = static_cast<double>(stop);
    phases_.push_back(phase);
    if (phase.end > end_) {
        const Real past = static_cast<Real>(end_) - static_cast<Real>(t);
        s.x += past * (s.vx + past * rate / 2);
        s.vx += past * rate;
        phases_.back().end = t = end_;
        return mode;
    }
    const Real past = phase.end - static_cast<Real>(t);
    s.x += past * (s.vx + past * rate / 2);
    s.vx = 0;
    t = phase.end;
    events_.push_back({t, EventKind::Stick, -1, -1, s, s});
    return flatMode(lowest(s), s);
}

/// The mode after the event at time t.
PlanarMotion::Mode PlanarMotion::resolve(double& t, State& s, const Mode& mode) {
    std::vector<int> landing;
    for (int i = 0; i < static_cast<int>(setup_.corners.size()); ++i)
        if (i != mode.corner && closingOf(i, s) < 0 &&
            gapOf(i, s) < 1e-14L * setup_.size - 1e-15L * static_cast<Real>(t) * closingOf(i, s))
            landing.push_back(i);
    std::vector<int> touching;
    if (mode.kind != Kind::Flight) touching.push_back(mode.corner);
    if (!landing.empty()) return impact(t, s, touching, landing, EventKind::Impact);
    const auto f = forcesIn(mode, s);
    const Real pull = setup_.mass * std::hypot(setup_.pullAlong, setup_.pullAbove);
    if (f->load.normal <= kStill * pull) {
        events_.push_back({t, EventKind::Release, mode.corner, -1, s, s});
        return {Kind::Flight, -1};
    }
    const Mode next =
        isSlip(mode.kind)
            ? contactMode(mode.corner, s)
            : Mode{f->load.tangential > 0 ? Kind::SlipBackward : Kind::SlipForward, mode.corner};
    if (next != mode)
        events_.push_back({t, isSlip(next.kind) ? EventKind::Slip : EventKind::Stick, mode.corner, -1, s, s});
    return next;
}

const PlanarMotion::Phase& PlanarMotion::phaseAt(double t) const {
    const auto phase = std::lower_bound(phases_.begin(), phases_.end(), t,
                                        [](const Phase& p, double value) { return p.end < value; });
    return phase == phases_.end() ? phases_.back() : *phase;
}

PlanarMotion::State PlanarMotion::at(double t) const {
    const Phase& phase = phaseAt(t);
    if (phase.mode.kind != Kind::Rest && !isSlide(phase.mode.kind)) return unpack(phase.solution.at(t));
    State s = phase.held;
    const Real past = static_cast<Real>(t) - static_cast<Real>(phase.from);
    s.x += past * (s.vx + past * phase.acceleration / 2);
    s.vx += past * phase.acceleration;
    return s;
}

PlanarMotion::Mode PlanarMotion::modeAt(double t) const {
    return phaseAt(t).mode;
}

std::optional<PlanarMotion::Load> PlanarMotion::loadAt(double t) const {
    const Phase& phase = phaseAt(t);
    if (phase.mode.kind == Kind::Rest || isSlide(phase.mode.kind)) return std::nullopt;
    const auto f = forcesIn(phase.mode, at(t));
    if (!f) return std::nullopt;
    return f->load;
}

}  // namespace rigor::validation
