// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts of planar_motion.hpp, and the limits of impacts at ever shorter intervals. Source: Brogliato,
// Nonsmooth Mechanics, 2016, chapters 4-5; Kane and Levinson, Dynamics, 1985, section 5.9 (Newton's
// restitution with friction may add energy: such an impact is refused); Aitken, Proc. R. Soc. Edinb. 46
// (1926) 289 (limit of a geometric sequence).
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/references/numerics/linear_system.hpp"
#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

constexpr Real kSettling = 1e-5L;   // rocking beside its natural rate from which the limit is extrapolated
constexpr Real kChatter = 1e-6L;    // the same of bounces, beside the natural speed
constexpr Real kGeometric = 1e-3L;  // largest difference of the ratios of bounces

/// Limit of a sequence whose differences form a geometric series, from three members.
Real limitOf(Real a, Real b, Real c) {
    const Real bend = (c - b) - (b - a);
    return bend == 0 ? c : c - (c - b) * (c - b) / bend;
}

}  // namespace

/// The corners of the side that the body lies on.
std::vector<int> PlanarMotion::lowest(const State& s) const {
    std::vector<int> corners;
    for (int i = 0; i < static_cast<int>(setup_.corners.size()); ++i)
        if (gapOf(i, s) < 1e-6L * setup_.size) corners.push_back(i);
    return corners;
}

/// Turns and lifts the body so that both corners touch the floor, and stops its turning.
void PlanarMotion::layFlat(int one, int other, State& s) const {
    for (int newton = 0; newton < 3; ++newton) {
        const Arm a = armOf(one, s.angle), b = armOf(other, s.angle);
        s.angle -= (a.cz - b.cz) / (a.x - b.x);
    }
    s.z = -armOf(one, s.angle).cz;
    s.vz = s.rate = 0;
}

/// A body that rocks between two corners at ever shorter intervals comes to lie flat after a finite time: the
/// times and velocities after every second impact form geometric series, whose limits Aitken's rule finds.
/// True where the motion has come so far; t and s are then those of the limit.
bool PlanarMotion::settles(double& t, State& s) const {
    const Real natural = std::sqrt(std::abs(setup_.pullAbove) * setup_.size);
    if (!(std::abs(s.rate) * setup_.size <= kSettling * natural)) return false;
    std::vector<const Event*> impacts;
    for (const Event& event : events_)
        if (event.kind == EventKind::Impact) impacts.push_back(&event);
    const std::size_t n = impacts.size();
    if (n < 5) return false;
    const Event &last = *impacts[n - 1], &before = *impacts[n - 3], &first = *impacts[n - 5];
    const int other = impacts[n - 2]->corner;
    if (last.corner != before.corner || last.corner != first.corner || other == last.corner) return false;
    if (std::abs(last.after.rate) >= std::abs(before.after.rate)) return false;
    const auto limit = [&](auto read) { return limitOf(read(first), read(before), read(last)); };
    State flat = s;
    flat.x = limit([](const Event& e) { return e.after.x; });
    flat.vx = limit([](const Event& e) { return e.after.vx; });
    layFlat(last.corner, other, flat);
    t = static_cast<double>(limit([](const Event& e) { return static_cast<Real>(e.time); }));
    s = flat;
    return true;
}

/// A corner that bounces ever lower, in flight or while the other stays on the floor, or a flat side that
/// falls back on both its corners: times and velocities after the bounces form geometric series of the
/// restitution. True where the bounces have become so low; t and s are then those of the limit.
bool PlanarMotion::chatters(double& t, State& s) const {
    const std::size_t n = events_.size();
    if (n < 3 || setup_.pullAbove >= 0) return false;
    const Event &first = events_[n - 3], &before = events_[n - 2], &last = events_[n - 1];
    for (const Event* event : {&first, &before})
        if (event->kind != EventKind::Impact || event->corner != last.corner || event->other != last.other)
            return false;
    const auto bounce = [&](const Event& e) { return closingOf(e.corner, e.after); };
    const Real natural = std::sqrt(std::abs(setup_.pullAbove) * setup_.size);
    const Real u = bounce(first), v = bounce(before), w = bounce(last);
    if (!(w <= kChatter * natural && w < v && v < u && std::abs(w / v - v / u) <= kGeometric * (v / u)))
        return false;
    const auto limit = [&](Real State::*part) {
        return limitOf(first.after.*part, before.after.*part, last.after.*part);
    };
    for (Real State::*part : {&State::x, &State::angle, &State::vx, &State::rate}) s.*part = limit(part);
    if (last.other >= 0) {
        layFlat(last.corner, last.other, s);
    } else {
        s.z = -armOf(last.corner, s.angle).cz;
        s.vz = -s.rate * armOf(last.corner, s.angle).x;
    }
    t = static_cast<double>(limitOf(first.time, before.time, last.time));
    return true;
}

/// The velocities after an impact in which both corners of a flat side stick and leave the floor at the given
/// rates, where impulses within the cones of friction give them. The distribution of the tangential part of
/// these impulses is arbitrary: both act along one line.
std::optional<PlanarMotion::State> PlanarMotion::bothStick(const std::vector<int>& corners, const State& s,
                                                           std::array<Real, 2> rates) const {
    const Arm a = armOf(corners[0], s.angle), b = armOf(corners[1], s.angle);
    State after = s;
    after.rate = (rates[1] - rates[0]) / (b.x - a.x);
    after.vz = rates[0] - after.rate * a.x;
    after.vx = after.rate * a.cz;
    const Real normal = setup_.mass * (after.vz - s.vz), tangential = setup_.mass * (after.vx - s.vx);
    // Moments: I (rate' - rate) = a.cx Pa + b.cx Pb - cz Pt, Pa + Pb = Pn.
    const Real moment = setup_.inertia * (after.rate - s.rate) + a.cz * tangential;
    const Real second = (moment - a.cx * normal) / (b.cx - a.cx), first = normal - second;
    const Real small =
        1e-12L * setup_.mass * (std::abs(s.vx) + std::abs(s.vz) + setup_.size * std::abs(s.rate));
    if (first < -small || second < -small || std::abs(tangential) > setup_.friction * normal + small)
        return std::nullopt;
    return after;
}

/// Impulses at the corners that touch and land, each in one of the modes leave, stick, slip either way.
PlanarMotion::Mode PlanarMotion::impact(double& t, State& s, const std::vector<int>& touching,
                                        const std::vector<int>& landing, EventKind kind) {
    std::vector<int> corners = landing;
    corners.insert(corners.end(), touching.begin(), touching.end());
    require(corners.size() <= 2, "three corners meet the floor at once");
    const std::size_t n = corners.size();
    if (setup_.stopsAtImpact) {
        events_.push_back({t, kind, corners[0], n == 2 ? corners[1] : -1, s, s});
        validUntil_ = t;
        return {Kind::Flight, -1};
    }
    const Real speed = std::abs(s.vx) + std::abs(s.vz) + setup_.size * std::abs(s.rate), tiny = 1e-9L * speed;
    struct Outcome {
        State state;
        std::array<int, 2> choice{};  ///< 0 leave, 1 stick, 2 slip forward, 3 slip backward
    };
    std::vector<Outcome> outcomes;
    int combinations = 1;
    for (std::size_t i = 0; i < n; ++i) combinations *= 4;
    for (int pick = 0; pick < combinations; ++pick) {
        std::array<int, 2> choice{pick % 4, pick / 4};
        // Unknown: impulses (Pn, Pt) of each corner; equations: its law.
        const auto unknowns = static_cast<Eigen::Index>(2 * n);
        numerics::Matrix matrix = numerics::Matrix::Zero(unknowns, unknowns);
        numerics::Vector right = numerics::Vector::Zero(unknowns);
        for (std::size_t i = 0; i < n; ++i) {
            const Arm a = armOf(corners[i], s.angle);
            const bool lands = i < landing.size();
            const auto normal = static_cast<Eigen::Index>(2 * i), tangent = normal + 1;
            if (choice[i] == 0) {
                matrix(normal, normal) = matrix(tangent, tangent) = 1;
                continue;
            }
            for (std::size_t j = 0; j < n; ++j) {
                const Arm b = armOf(corners[j], s.angle);
                const auto column = static_cast<Eigen::Index>(2 * j);
                matrix(normal, column) += 1 / setup_.mass + a.x * b.cx / setup_.inertia;
                matrix(normal, column + 1) += -a.x * b.cz / setup_.inertia;
                if (choice[i] != 1) continue;
                matrix(tangent, column) += -a.cz * b.cx / setup_.inertia;
                matrix(tangent, column + 1) += 1 / setup_.mass + a.cz * b.cz / setup_.inertia;
            }
            const Real e = lands ? setup_.restitution : 0;
            right[normal] = -(1 + e) * closingOf(corners[i], s);
            if (choice[i] == 1) {
                right[tangent] = -slipOf(corners[i], s);
            } else {
                matrix(tangent, tangent) = 1;
                matrix(tangent, normal) = choice[i] == 2 ? setup_.friction : -setup_.friction;
            }
        }
        const auto solution = numerics::solveDense(std::move(matrix), std::move(right));
        // If both corners stick, see below, the distribution of the tangential impulse is undetermined.
        if (!solution) continue;
        std::array<Real, 2> push{}, drag{};
        for (std::size_t i = 0; i < n; ++i) {
            push[i] = (*solution)[2 * i];
            drag[i] = (*solution)[2 * i + 1];
        }
        State after = s;
        for (std::size_t i = 0; i < n; ++i) {
            const Arm a = armOf(corners[i], s.angle);
            after.vx += drag[i] / setup_.mass;
            after.vz += push[i] / setup_.mass;
            after.rate += (a.cx * push[i] - a.cz * drag[i]) / setup_.inertia;
        }
        bool fits = true;
        Real total = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Real normal = push[i], tangential = drag[i], slip = slipOf(corners[i], after);
            total += normal;
            fits = fits && normal >= -1e-12L * setup_.mass * speed;
            if (choice[i] == 0) fits = fits && closingOf(corners[i], after) >= -tiny;
            if (choice[i] == 1)
                fits =
                    fits && std::abs(tangential) <= setup_.friction * normal + 1e-12L * setup_.mass * speed;
            if (choice[i] == 2) fits = fits && slip > tiny;
            if (choice[i] == 3) fits = fits && slip < -tiny;
        }
        // A jam is the solution with an impulse; without one the contact has no force that fits.
        if (fits && (kind != EventKind::Jam || total > 1e-9L * setup_.mass * speed))
            outcomes.push_back({after, choice});
    }
    if (n == 2) {
        const auto target = [&](std::size_t i) {
            return i < landing.size() ? -setup_.restitution * closingOf(corners[i], s) : 0;
        };
        if (const auto both = bothStick(corners, s, {target(0), target(1)}))
            outcomes.push_back({*both, {1, 1}});
    }
    require(!outcomes.empty(), "an impact has no solution by the laws of Newton and Coulomb");
    for (const Outcome& other : outcomes) {
        const State &a = other.state, &b = outcomes[0].state;
        require(std::abs(a.vx - b.vx) + std::abs(a.vz - b.vz) + setup_.size * std::abs(a.rate - b.rate) <=
                    1e-8L * speed,
                "an impact has several solutions by the laws of Newton and Coulomb");
    }
    const State before = s;
    s = outcomes[0].state;
    const auto energy = [this](const State& of) {
        return setup_.mass * (of.vx * of.vx + of.vz * of.vz) + setup_.inertia * of.rate * of.rate;
    };
    require(energy(s) <= energy(before) + 1e-9L * setup_.mass * speed * speed,
            "Newton's restitution with this friction adds energy in an impact (Kane and Levinson 1985)");
    events_.push_back({t, kind, corners[0], n == 2 ? corners[1] : -1, before, s});
    std::vector<int> staying;
    for (const int i : corners)
        if (closingOf(i, s) <= tiny) staying.push_back(i);
    if (staying.size() == 2) return flatMode(staying, s);
    const double last = t;
    const State left = s;
    if (chatters(t, s)) {
        bridge(last, left, t, s);
        return n == 2 ? flatMode(corners, s) : contactMode(corners[0], s);
    }
    if (staying.empty()) return {Kind::Flight, -1};
    if (!settles(t, s)) return contactMode(staying[0], s);
    bridge(last, left, t, s);
    return flatMode(lowest(s), s);
}

/// The phase from the last impact that was followed to the limit of the series: every part of the state goes
/// evenly from one to the other. The bounces in between are lower than the square of kChatter beside the size.
void PlanarMotion::bridge(double begin, const State& from, double end, const State& to) {
    if (!(end > begin)) return;
    const auto time = static_cast<Real>(end) - static_cast<Real>(begin);
    const numerics::OdeState y{from.x, from.z, from.angle, from.vx, from.vz, from.rate};
    const numerics::OdeState rate{(to.x - from.x) / time,         (to.z - from.z) / time,
                                  (to.angle - from.angle) / time, (to.vx - from.vx) / time,
                                  (to.vz - from.vz) / time,       (to.rate - from.rate) / time};
    const auto rhs = [&rate](Real, const numerics::OdeState&, numerics::OdeState& d) { d = rate; };
    phases_.push_back({begin,
                       end,
                       {Kind::Flight, -1},
                       from,
                       0,
                       begin,
                       numerics::DenseSolution(rhs, begin, y, end, 1e-14L, {}, scale_)});
}

}  // namespace rigor::validation
