// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body with one smooth point of contact that rolls or slips on a plane: ball with any inertia
// (Chaplygin's), ball with its centre of mass off the middle (Routh's, tippe top), disc or cylinder on its
// rim (coin, hula hoop, Euler's disc). In body axes, with gamma the floor's normal, gamma' = gamma x w,
// r(gamma) from the centre of mass to the contact, v the velocity of the centre of mass, F the contact force:
//   I w' + w x I w = r x F,  m (v' + w x v) = F + m g;
//   rolls:  v = r x w, so [I + m (r^2 - r r^T)] w' = -w x I w + m r x (r' x w + w x (r x w) - g);
//   slips with u = v + w x r:  F = N (gamma - mu u/|u|), N from d(gamma.u)/dt = 0.
// Balls: r = s - a gamma. Cylinders: r = s - h sign(gamma.e) e - a p/|p|, p = gamma - (gamma.e) e.
// Integrated to 1e-12. Source: Chaplygin 1903; Routh, Advanced Dynamics of a System of Rigid Bodies, 1905;
// Borisov and Mamaev, Regul. Chaotic Dyn. 7 (2002) 177; Moffatt and Shimomura, Nature 416 (2002) 385;
// McDonald and McDonald 2001, Kessler and O'Reilly, Regul. Chaotic Dyn. 7 (2002) 49 (Euler's disc).
// Assumes: contact from the start; gravity along the normal or not; Coulomb friction, no resistance to
// rolling or drilling. Valid while it rolls with |F_t| <= mu N (the static coefficient), or until the slip
// has all but ended. Quantities: jellett, -L.r at the end, which no force at the contact changes (a ball
// whose inertia and offset share an axis, gravity along the normal); contact_momentum_n, _s, _t: I w + m a^2
// (w - (w.n) n) of a ball that rolls about its centre of mass, a constant vector.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/roots.hpp"
#include "validation/references/numerics/vector.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

class RollingBody : public Reference {
  public:
    RollingBody(const Scenario& scenario, int index, int floor)
        : scenario_(scenario),
          index_(index),
          body_(scenario.bodies[index]),
          plane_(planeOf(scenario, floor, centerOfMass(body_))) {
        const std::string subject = bodyTitle(scenario, index);
        require(scenario.dimension == 3, "a rolling body needs three dimensions");
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        requireStill(scenario, floor);
        readShape(subject);
        const auto pair = pairCoefficients(scenario, body_.shapes[0].material, plane_.material);
        mu_ = pair.friction;
        holds_ = holdingFriction(pair);
        mass_ = body_.massProperties.mass;
        inertia_ = real33(body_.massProperties.inertia);
        normal_ = real3(plane_.normal);
        gravity_ = real3(gravityOn(scenario, index));
        start(subject);
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int, double t) const override {
        const OdeState y = solution_.at(std::min(t, validUntil_));
        const Frame f = frameOf(y);
        const Quat q = scenario::normalized(Quat{static_cast<double>(y[0]), static_cast<double>(y[1]),
                                                 static_cast<double>(y[2]), static_cast<double>(y[3])});
        const Real3 v = rolls_ ? cross(f.r, f.w) : Real3{y[10], y[11], y[12]};
        // The position along the plane is from the integral, the height from the contact.
        Real3 com{y[7], y[8], y[9]};
        com = com + (static_cast<Real>(plane_.offset) - dot(normal_, com) - dot(f.gamma, f.r)) * normal_;
        return stateOf(body_, toVec3(com), q, toVec3(f.turn * v), toVec3(f.turn * f.w));
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const double end = std::min(scenario_.duration, validUntil_);
        const bool upright = norm(cross(gravity_, normal_)) <= 1e-9L * norm(gravity_);
        const auto add = [&](const std::string& name, const char* unitName, double scale, auto read) {
            const PartialState s = exact(index_, 0.0);
            Quantity q{name, unitName, read(*s.orientation, *s.angularVelocity), {}, scale, {}};
            q.measure = [this, read, end](const Trajectory& run) -> std::optional<double> {
                const auto frame = lastFrameBefore(run, end);
                if (!frame) return std::nullopt;
                const auto& state = run.state(*frame, index_);
                return read(state.orientation, state.angularVelocity);
            };
            result.push_back(std::move(q));
        };
        const double size = static_cast<double>(norm(inertia_ * Real3{w0_.x, w0_.y, w0_.z}));
        if (ball_ && upright && hasJellett())
            add("jellett", "kg m^3/s", size * static_cast<double>(radius_), [this](Quat q, Vec3 w) {
                const Vec3 gamma = rotateInverse(q, plane_.normal);
                return -dot(rotate(q, body_.massProperties.inertia * rotateInverse(q, w)),
                            rotate(q, toVec3(contactArm(real3(gamma)))));
            });
        if (ball_ && rolls_ && upright && norm(center_) == 0) {
            const Vec3 n = plane_.normal, s = perpendicular(n), t = cross(n, s);
            for (const auto& [name, axis] : {std::pair{"n", n}, {"s", s}, {"t", t}})
                add(std::string("contact_momentum_") + name, "kg m^2/s", size, [this, axis](Quat q, Vec3 w) {
                    const Vec3 up = plane_.normal;
                    const double a = static_cast<double>(radius_);
                    const Vec3 k = rotate(q, body_.massProperties.inertia * rotateInverse(q, w)) +
                                   (static_cast<double>(mass_) * a * a) * (w - dot(w, up) * up);
                    return dot(k, axis);
                });
        }
        return result;
    }

  private:
    struct Frame {
        Real33 turn{};  ///< body to world
        Real3 gamma, gammaRate, w, r, rRate;
    };

    void readShape(const std::string& subject) {
        require(body_.shapes.size() == 1, subject + " has more than one shape");
        const auto& shape = body_.shapes[0];
        center_ = real3(shape.pose.position - body_.massProperties.centerOfMass);
        if (const auto* s = std::get_if<scenario::Sphere>(&shape.geometry)) {
            ball_ = true;
            radius_ = s->radius;
        } else if (const auto* c = std::get_if<scenario::Cylinder>(&shape.geometry)) {
            radius_ = c->radius;
            half_ = c->halfLength;
            axis_ = real3(rotate(shape.pose.orientation, {0, 1, 0}));
        } else {
            violated(subject + " is neither a ball nor a cylinder");
        }
    }

    /// Vector from the centre of mass to the lowest point, body axes.
    Real3 contactArm(Real3 gamma) const {
        if (ball_) return center_ - radius_ * gamma;
        const Real along = dot(gamma, axis_);
        const Real3 p = gamma - along * axis_;
        return center_ - ((along < 0 ? -1 : 1) * half_) * axis_ - (radius_ / norm(p)) * p;
    }

    Frame frameOf(const OdeState& y) const {
        Frame f;
        f.turn = rotationOf(y[0], y[1], y[2], y[3]);
        f.gamma = transposed(f.turn, normal_);
        f.w = {y[4], y[5], y[6]};
        f.gammaRate = cross(f.gamma, f.w);
        f.r = contactArm(f.gamma);
        if (ball_) {
            f.rRate = -radius_ * f.gammaRate;
        } else {
            const Real3 p = f.gamma - dot(f.gamma, axis_) * axis_,
                        rate = f.gammaRate - dot(f.gammaRate, axis_) * axis_;
            const Real3 u = (1 / norm(p)) * p;
            f.rRate = (-radius_ / norm(p)) * (rate - dot(u, rate) * u);
        }
        return f;
    }

    /// Contact force over the mass and the angular acceleration, body axes; `speed`: v where it slips.
    struct Push {
        Real3 force, spin;
    };
    Push pushIn(const Frame& f, Real3 speed) const {
        const Real3 g = transposed(f.turn, gravity_), gyroscopic = cross(f.w, inertia_ * f.w);
        Push push;
        if (rolls_) {
            const Real3 known = cross(f.rRate, f.w) + cross(f.w, cross(f.r, f.w)) - g;
            Real33 m = inertia_;
            const Real rr = dot(f.r, f.r);
            const Real r[3] = {f.r.x, f.r.y, f.r.z};
            for (std::size_t i = 0; i < 3; ++i) {
                m[i] = m[i] - (mass_ * r[i]) * f.r;
                (i == 0 ? m[i].x : i == 1 ? m[i].y : m[i].z) += mass_ * rr;
            }
            push.spin = solve(m, mass_ * cross(f.r, known) - gyroscopic);
            push.force = known + cross(f.r, push.spin);
            return push;
        }
        const Real3 u = speed + cross(f.w, f.r), direction = f.gamma - (mu_ / norm(u)) * u;
        // gamma.(F/m + g - w x v + w' x r + w x r') + gamma'.u = 0, linear in N.
        const Real3 perNewton = solve(inertia_, cross(f.r, direction)),
                    free = solve(inertia_, -1 * gyroscopic);
        const Real lever = dot(f.gamma, (1 / mass_) * direction + cross(perNewton, f.r));
        const Real rest = dot(f.gamma, g - cross(f.w, speed) + cross(free, f.r) + cross(f.w, f.rRate)) +
                          dot(f.gammaRate, u);
        const Real load = -rest / lever;
        push.force = (load / mass_) * direction;
        push.spin = free + load * perNewton;
        return push;
    }

    void start(const std::string& subject) {
        const Quat q = scenario::normalized(body_.pose.orientation);
        w0_ = rotateInverse(q, body_.angularVelocity);
        const Vec3 com = centerOfMass(body_), v = rotateInverse(q, body_.velocity);
        OdeState y{q.w, q.x, q.y, q.z, w0_.x, w0_.y, w0_.z, com.x, com.y, com.z, v.x, v.y, v.z};
        const Frame f = frameOf(y);
        const Real gap = dot(normal_, real3(com)) - plane_.offset + dot(f.gamma, f.r);
        require(std::abs(gap) <= 1e-6L * radius_, subject + " does not touch the floor at the start");
        const Real3 u = real3(v) + cross(f.w, f.r);
        const Real fast = norm(real3(v)) + radius_ * norm(f.w);
        require(std::abs(dot(f.gamma, u)) <= 1e-6L * fast,
                "the contact of " + subject + " moves off the floor");
        rolls_ = norm(u) <= 1e-6L * fast;
        slip0_ = norm(u);
        const auto rhs = [this](Real, const OdeState& s, OdeState& d) {
            const Frame frame = frameOf(s);
            const Real3 speed = rolls_ ? cross(frame.r, frame.w) : Real3{s[10], s[11], s[12]};
            const Push push = pushIn(frame, speed);
            quaternionRate(s, 0, frame.w, d);
            d[4] = push.spin.x;
            d[5] = push.spin.y;
            d[6] = push.spin.z;
            const Real3 world = frame.turn * speed;
            d[7] = world.x;
            d[8] = world.y;
            d[9] = world.z;
            const Real3 rate =
                rolls_ ? Real3{} : push.force + transposed(frame.turn, gravity_) - cross(frame.w, speed);
            d[10] = rate.x;
            d[11] = rate.y;
            d[12] = rate.z;
        };
        // The integration goes in pieces, so that it can end where the slip ends.
        const double whole = runEnd(scenario_);
        double end = whole;
        const Real turns = (fast + std::sqrt(norm(gravity_) * radius_)) / radius_ + 1 / whole,
                   speed = turns * radius_;
        const OdeState beside{1,       1,       1,       1,     turns, turns, turns,
                              radius_, radius_, radius_, speed, speed, speed};
        if (!rolls_) end = slipEnd(rhs, y, whole, beside);
        solution_ = DenseSolution(rhs, 0, y, end, 1e-14L, {}, beside, OdeLimits::ofEvaluations(2'000'000));
        validUntil_ = end < whole ? end : 1e300;
        const Real last = std::min(end, scenario_.duration);
        const auto held = solution_.lastTimeOf([this](const OdeState& at) { return holds(at); }, last);
        require(held && *held > 0,
                subject + (rolls_ ? " slips: friction does not hold the contact" : " leaves the floor"));
        if (*held < last) validUntil_ = static_cast<double>(*held);
    }

    /// Time at which the slip has fallen to a twentieth, at most `whole`.
    double slipEnd(const OdeRhs& rhs, const OdeState& start, double whole, const OdeState& beside) const {
        const auto slipOf = [this](const OdeState& y) {
            const Frame f = frameOf(y);
            return norm(Real3{y[10], y[11], y[12]} + cross(f.w, f.r));
        };
        return static_cast<double>(lastTimeOf(
            [&](const OdeState& y) { return slipOf(y) > 0.05L * slip0_; }, rhs, 0, start, whole, 400,
            [&](const OdeState& y) {
                // Half of what the slip lasts at the friction of now.
                const Frame f = frameOf(y);
                const Push push = pushIn(f, {y[10], y[11], y[12]});
                const Real loss = norm(push.force) + norm(gravity_) + radius_ * norm(push.spin);
                return loss > 0 ? slipOf(y) / (2 * loss) : Real(whole);
            },
            beside));
    }

    bool holds(const OdeState& y) const {
        const Frame f = frameOf(y);
        const Real3 speed = rolls_ ? cross(f.r, f.w) : Real3{y[10], y[11], y[12]};
        const Push push = pushIn(f, speed);
        const Real load = dot(f.gamma, push.force);
        const Real friction = norm(push.force - load * f.gamma);
        return load > 0 && (!rolls_ || friction <= holds_ * load * (1 + 1e-9L));
    }

    /// Inertia and offset have an axis in common.
    bool hasJellett() const {
        const Real offset = norm(center_);
        if (offset == 0) {
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) {
                    const double x = body_.massProperties.inertia(i, j);
                    const double y = i == j ? body_.massProperties.inertia(0, 0) : 0.0;
                    if (std::abs(x - y) > 1e-9 * body_.massProperties.inertia(0, 0)) return false;
                }
            return true;
        }
        const Real3 e = (1 / offset) * center_, along = inertia_ * e;
        const Real scale = norm(along);
        const Real3 p = real3(perpendicular(toVec3(e))), s = cross(e, p);
        return norm(along - dot(along, e) * e) <= 1e-9L * scale &&
               std::abs(dot(p, inertia_ * p) - dot(s, inertia_ * s)) <= 1e-9L * scale &&
               std::abs(dot(p, inertia_ * s)) <= 1e-9L * scale;
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    Plane plane_;
    bool ball_ = false, rolls_ = true;
    Real radius_ = 0, half_ = 0, mass_ = 0, slip0_ = 0;
    Real mu_ = 0, holds_ = 0;  ///< coefficients of sliding and of a contact that rolls
    Real3 center_, axis_, normal_, gravity_;
    Real33 inertia_{};
    Vec3 w0_;
    DenseSolution solution_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeRollingBody(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "floor"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<RollingBody>(scenario, body, parts.support("floor", body));
}

}  // namespace rigor::validation
