// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A corner hits a floor, followed through the touch: the normal impulse p grows from zero, and friction has
// the direction of the slip of the moment. With c the corner from the centre of mass, slip s, gap rate n:
//   M11 = 1/m + cz^2/I, M12 = -cx cz/I, M22 = 1/m + cx^2/I,
//   slipping: dp_t = -mu sgn(s) dp;  ds = M11 dp_t + M12 dp,  dn = M12 dp_t + M22 dp;
//   at s = 0: sticks (dp_t = -M12/M11 dp) if |M12| <= mu M11, else slips on the other way.
// The touch ends by one of three laws, each a reference of its own:
//   Newton   n+ = -e n-;   Poisson   p = (1 + e) pc;   Stronge   Wr = -e^2 Wc,  W = integral of n dp,
// pc and Wc to the greatest compression (n = 0). They agree with each other and with the law at the level of
// impulses (planar_contact, what time-stepping engines solve) as long as the slip does not change direction.
// Source: Routh 1905; Keller, J. Appl. Mech. 53 (1986) 1; Wang and Mason, J. Appl. Mech. 59 (1992) 635;
// Stronge, Impact Mechanics, 2000; Brach 1991. Assumes: what planar_contact assumes of body and floor; one
// corner hits first, from flight. Valid until the next touch. Quantities: velocity_along, velocity_above,
// spin after the impact. Newton's law may add energy, and is refused where it does.
#include <algorithm>
#include <cmath>

#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation {
namespace {

using Real = PlanarMotion::Real;

enum class Law { Newton, Poisson, Stronge };

/// The touch as a function of the normal impulse: straight pieces.
class Touch {
  public:
    Touch(Real m11, Real m12, Real m22, Real mu, Real slip, Real gapRate) : start_(gapRate) {
        Real along = slip;
        if (std::abs(along) > 1e-14L * std::abs(gapRate)) {
            const Real sign = along > 0 ? 1 : -1, t = -mu * sign;
            const Real change = m11 * t + m12;
            const bool stops = change * along < 0;
            add(stops ? -along / change : 1e300L, t, m12 * t + m22);
            if (!stops) return;
        }
        const bool sticks = std::abs(m12) <= mu * m11;
        const Real t = sticks ? -m12 / m11 : (m12 > 0 ? -mu : mu);
        add(1e300L, t, m12 * t + m22);
    }
    /// Normal and tangential impulse where the law ends the touch.
    std::pair<Real, Real> end(Law law, Real e) const {
        const Real pc = reach(0);
        Real p = (1 + e) * pc;
        if (law == Law::Newton) p = reach(-e * start_);
        if (law == Law::Stronge) p = workUp(pc, -e * e * work(pc));
        return {p, tangential(p)};
    }

  private:
    struct Piece {
        Real length = 0, tangential = 0, slope = 0;  ///< length in p; dp_t/dp; dn/dp
    };
    void add(Real length, Real t, Real slope) {
        require(slope > 0, "the corner jams: friction drives it into the floor");
        pieces_.push_back({length, t, slope});
    }
    /// The impulse at which n has grown to `goal`.
    Real reach(Real goal) const {
        Real p = 0, n = start_;
        for (const Piece& piece : pieces_) {
            const Real need = (goal - n) / piece.slope;
            if (need <= piece.length) return p + need;
            p += piece.length;
            n += piece.slope * piece.length;
        }
        return p;
    }
    Real tangential(Real p) const {
        Real sum = 0;
        for (const Piece& piece : pieces_) {
            const Real part = std::min(p, piece.length);
            sum += piece.tangential * part;
            p -= part;
        }
        return sum;
    }
    /// Integral of n dp from 0 to p.
    Real work(Real p) const {
        Real sum = 0, n = start_;
        for (const Piece& piece : pieces_) {
            const Real part = std::min(p, piece.length);
            sum += n * part + piece.slope * part * part / 2;
            n += piece.slope * part;
            p -= part;
        }
        return sum;
    }
    /// The impulse at which the work from `from` on, where n = 0, has become `goal`.
    Real workUp(Real from, Real goal) const {
        Real low = from, high = from;
        while (work(high) - work(from) < goal) high *= 2;
        for (int k = 0; k < 200; ++k) {
            const Real middle = (low + high) / 2;
            (work(middle) - work(from) < goal ? low : high) = middle;
        }
        return (low + high) / 2;
    }
    Real start_;
    std::vector<Piece> pieces_;
};

class IncrementalImpact : public Reference {
  public:
    IncrementalImpact(const Scenario& scenario, int body, int floor, Law law)
        : scenario_(scenario),
          index_(body),
          frame_(scenario, body, floor),
          motion_(untilImpact(frame_.setup()), frame_.start(), scenario.duration, runEnd(scenario)) {
        const std::string subject = bodyTitle(scenario, body);
        require(!motion_.events().empty(), subject + " does not hit the floor");
        const auto& hit = motion_.events().front();
        require(
            hit.kind == PlanarMotion::EventKind::Impact && hit.corner >= 0 && hit.other < 0 && hit.time > 0.0,
            subject + " does not come from flight to the floor with one corner");
        time_ = hit.time;
        after_ = hit.before;
        const auto& s = frame_.setup();
        const auto [cx, cz] = contactOf(hit.corner, after_);
        const Real slip = after_.vx - after_.rate * cz, gapRate = after_.vz + after_.rate * cx;
        const Touch touch(1 / s.mass + cz * cz / s.inertia, -cx * cz / s.inertia,
                          1 / s.mass + cx * cx / s.inertia, s.friction, slip, gapRate);
        const auto [normal, tangential] = touch.end(law, s.restitution);
        const auto energy = [&s](const PlanarMotion::State& of) {
            return s.mass * (of.vx * of.vx + of.vz * of.vz) + s.inertia * of.rate * of.rate;
        };
        const Real before = energy(after_);
        after_.vx += tangential / s.mass;
        after_.vz += normal / s.mass;
        after_.rate += (cx * normal - cz * tangential) / s.inertia;
        require(energy(after_) <= before * (1 + 1e-12L),
                "Newton's restitution with this friction adds energy in the impact (Kane and Levinson 1985)");
        findNextTouch();
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int, double t) const override {
        return frame_.lift(t < time_ ? motion_.at(t) : flown(t));
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (time_ >= scenario_.duration || validUntil_ < scenario_.duration) return result;
        const Real fast = std::hypot(after_.vx, after_.vz);
        const auto add = [&](const char* name, const char* unit, Real value, Real scale, auto read) {
            Quantity q{name, unit, static_cast<double>(value), {}, static_cast<double>(scale), {}};
            q.measure = [this, read](const Trajectory& run) -> std::optional<double> {
                const std::size_t last = run.frames() - 1;
                return static_cast<double>(
                    read(frame_.read(run.state(last, index_)), run.times[last] - time_));
            };
            result.push_back(std::move(q));
        };
        const auto& s = frame_.setup();
        add("velocity_along", "m/s", after_.vx, fast,
            [g = s.pullAlong](const PlanarMotion::State& at, double t) { return at.vx - g * t; });
        add("velocity_above", "m/s", after_.vz, fast,
            [g = s.pullAbove](const PlanarMotion::State& at, double t) { return at.vz - g * t; });
        add("spin", "rad/s", after_.rate, std::abs(after_.rate),
            [](const PlanarMotion::State& at, double) { return at.rate; });
        return result;
    }

  private:
    /// The law of this file acts in the impact, not that of planar_motion.
    static PlanarMotion::Setup untilImpact(PlanarMotion::Setup setup) {
        setup.stopsAtImpact = true;
        return setup;
    }
    std::pair<Real, Real> contactOf(int corner, const PlanarMotion::State& at) const {
        const auto& c = frame_.setup().corners[corner];
        const Real cs = std::cos(at.angle), sn = std::sin(at.angle);
        return {cs * c.along - sn * c.above, sn * c.along + cs * c.above - c.radius};
    }
    PlanarMotion::State flown(double t) const {
        const auto& s = frame_.setup();
        const Real d = static_cast<Real>(t) - time_;
        PlanarMotion::State at = after_;
        at.x += at.vx * d + s.pullAlong * d * d / 2;
        at.z += at.vz * d + s.pullAbove * d * d / 2;
        at.vx += s.pullAlong * d;
        at.vz += s.pullAbove * d;
        at.angle += at.rate * d;
        return at;
    }
    /// Depth of the deepest corner in the floor at time t, beyond rounding [m].
    double depthAt(double t) const {
        const auto at = flown(t);
        Real lowest = 1e300L;
        for (std::size_t c = 0; c < frame_.setup().corners.size(); ++c)
            lowest = std::min(lowest, at.z + contactOf(c, at).second);
        return static_cast<double>(-lowest - 1e-9L * frame_.setup().size);
    }
    void findNextTouch() {
        const double end = runEnd(scenario_), span = end - time_;
        // The search takes at least fifty samples a turn; a body too fast for that is followed only as far as the samples
        // go.
        constexpr int kMostLooks = 100000;
        const double looks =
            std::max(2000.0, std::ceil(8.0 * std::abs(static_cast<double>(after_.rate)) * span));
        const double step = span / looks;
        for (int k = 1; k <= std::min(looks, double{kMostLooks}); ++k) {
            if (depthAt(time_ + step * k) <= 0.0) continue;
            double low = time_ + step * (k - 1), high = time_ + step * k;
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = low + 0.5 * (high - low);
                (depthAt(middle) <= 0.0 ? low : high) = middle;
            }
            validUntil_ = low;
            return;
        }
        if (looks > kMostLooks) validUntil_ = time_ + step * kMostLooks;
    }

    const Scenario& scenario_;
    int index_;
    PlanarFrame frame_;
    PlanarMotion motion_;
    double time_ = 0.0, validUntil_ = 1e300;
    PlanarMotion::State after_;
};

std::unique_ptr<Reference> make(const Scenario& scenario, const scenario::ReferenceSpec& spec, Law law) {
    const Parts parts(scenario, spec, {"body", "floor"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<IncrementalImpact>(scenario, body, parts.support("floor", body), law);
}

}  // namespace

std::unique_ptr<Reference> makeImpactNewton(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    return make(scenario, spec, Law::Newton);
}
std::unique_ptr<Reference> makeImpactPoisson(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    return make(scenario, spec, Law::Poisson);
}
std::unique_ptr<Reference> makeImpactStronge(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    return make(scenario, spec, Law::Stronge);
}

}  // namespace rigor::validation
