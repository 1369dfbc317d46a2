// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body slides and spins on a flat face, or on many feet, whose pressure is the same everywhere. Turning
// makes it easier to push and sliding easier to turn. With eps = v/(R w), mu the friction of the pair:
//   a disc (cylinder on its end):  v' = -mu g F(eps),  I w' = -mu m g R T(eps),
//     eps < 1: F = (4/3 pi) [(eps^2 + 1) E + (eps^2 - 1) K]/eps, T = (4/9 pi) [(4 - 2 eps^2) E + (eps^2 - 1)
//     K], eps > 1: F = (4/3 pi) [(eps^2 + 1) E - (eps^2 - 1) K],
//              T = (4/9 pi) eps [(4 - 2 eps^2) E + (2 eps^2 - 5 + 3/eps^2) K],
//     with the parameter eps^2 or 1/eps^2; v and w end together, with eps = 0.653;
//   n feet at rho_i:  m v' = -(mu m g/n) sum u_i/|u_i|,  I w' = -(mu m g/n) sum rho_i x u_i/|u_i|;
//     pure spin of feet on one circle: w' = -mu m g a/I whatever the loads.
// Torsional friction rho_t of the pair takes m g rho_t/I more of w in each of these.
// The laws of rigid bodies leave the pressure of more than three points open: this is the solution for equal
// pressure, which an engine need not choose. A centre of mass above the floor would tilt the pressure: it
// must lie in the floor's plane, but for pure spin. tripod_slide has loads that follow from statics.
// Source: Farkas, Bartels, Unger, Wolf, Phys. Rev. Lett. 90 (2003) 248302; Voyenli and Eriksen, Am. J. Phys.
// 53 (1985) 1149; Howe and Cutkosky, Int. J. Robot. Res. 15 (1996) 557.
// Assumes: a level floor, velocity along it, spin about its normal, gravity and contact alone. Valid until
// the slowest foot, or the disc, has almost stopped.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/elliptic.hpp"
#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"
#include "validation/references/sliding/flat_motion.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

struct Friction {
    Real force = 0, torque = 0;  ///< force over mu m g and torque over mu m g R
};

/// F and T of a disc of even pressure.
Friction discFriction(Real eps) {
    const Real a = 4 / (3 * kPi), b = 4 / (9 * kPi), e2 = eps * eps;
    if (eps < 1e-4L) return {eps * (1 - e2 / 8), 2.0L / 3 - e2 / 2};
    if (std::abs(eps - 1) < 1e-12L) return {2 * a, 2 * b};
    if (eps < 1) {
        const Real K = ellipticK(e2), E = ellipticE(e2);
        return {a * ((e2 + 1) * E + (e2 - 1) * K) / eps, b * ((4 - 2 * e2) * E + (e2 - 1) * K)};
    }
    if (eps > 1e3L) return {1 - 1 / (8 * e2), 1 / (4 * eps)};
    const Real K = ellipticK(1 / e2), E = ellipticE(1 / e2);
    return {a * ((e2 + 1) * E - (e2 - 1) * K), b * eps * ((4 - 2 * e2) * E + (2 * e2 - 5 + 3 / e2) * K)};
}

class SpinningDisc : public Reference {
  public:
    SpinningDisc(const Scenario& scenario, int index, const FlatMotion& motion, double height,
                 double torsional)
        : scenario_(scenario), index_(index), body_(motion.body), motion_(motion) {
        const std::string subject = bodyTitle(scenario, index);
        const Vec3 n = motion_.normal, g = gravityOn(scenario, index);
        require(norm(g) > 0.0 && norm(cross(g, n)) <= 1e-9 * norm(g), "the floor is not level");
        const bool isFlat = std::abs(height) <= 1e-3 * sizeOf(body_), spins = norm(body_.velocity) == 0.0;
        require(spins || isFlat,
                "the centre of mass of " + subject + " is off the floor: its pressure is not even");
        findFeet(isFlat, spins);
        push_ = motion_.friction * norm(g);
        braking_ = torsional * norm(g) * motion_.mass / motion_.inertia;
        follow(motion_.start());
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return validUntil_; }
    PartialState exact(int, double t) const override { return motion_.state(solution_.at(t)); }

  private:
    using Foot = FlatMotion::Place;

    void findFeet(bool isFlat, bool spins) {
        const std::string subject = bodyTitle(scenario_, index_);
        const auto* cylinder =
            body_.shapes.size() == 1 ? std::get_if<scenario::Cylinder>(&body_.shapes[0].geometry) : nullptr;
        if (cylinder) {
            const Vec3 axis =
                rotate(body_.pose.orientation, rotate(body_.shapes[0].pose.orientation, {0, 1, 0}));
            const Vec3 n = motion_.normal,
                       middle = body_.pose * body_.shapes[0].pose.position - motion_.centre;
            require(norm(cross(axis, n)) <= 1e-6, subject + " does not stand on its end");
            require(norm(middle - dot(middle, n) * n) <= 1e-9 * cylinder->radius,
                    "the centre of mass of " + subject + " is off its axis");
            radius_ = cylinder->radius;
            return;
        }
        Foot middle;
        Real least = 1e30L;
        for (const Vec3 p : motion_.support.points) {
            feet_.push_back(motion_.place(p));
            middle.x += feet_.back().x;
            middle.y += feet_.back().y;
            const Real reach = std::hypot(feet_.back().x, feet_.back().y);
            radius_ = std::max(radius_, reach);
            least = std::min(least, reach);
        }
        const auto n = static_cast<Real>(feet_.size());
        require(n >= 3, subject + " stands on fewer than three points");
        require(std::hypot(middle.x, middle.y) <= 1e-6L * n * radius_,
                "the feet of " + subject + " are not balanced about its centre of mass");
        require(!spins || radius_ - least <= 1e-6L * radius_ || isFlat,
                "the feet of " + subject + " are not on one circle");
    }

    /// Slowest slip of a foot; of a disc the greater of its two speeds.
    Real slowest(const OdeState& y) const {
        if (feet_.empty()) return std::max(std::hypot(y[3], y[4]), std::abs(y[5]) * radius_);
        Real least = 1e30L;
        for (const Foot& f : feet_) {
            const Foot p = turned(f, y[2]);
            least = std::min(least, std::hypot(y[3] - y[5] * p.y, y[4] + y[5] * p.x));
        }
        return least;
    }
    static Foot turned(Foot f, Real angle) {
        const Real c = std::cos(angle), s = std::sin(angle);
        return {c * f.x - s * f.y, s * f.x + c * f.y};
    }

    void derivative(const OdeState& y, OdeState& d) const {
        Real fx = 0, fy = 0, torque = 0;
        if (feet_.empty()) {
            const Real v = std::hypot(y[3], y[4]), rim = std::abs(y[5]) * radius_;
            const Friction f = rim == 0 ? Friction{1, 0} : discFriction(v / rim);
            if (v > 0) {
                fx = -f.force * y[3] / v;
                fy = -f.force * y[4] / v;
            }
            torque = y[5] > 0 ? -f.torque * radius_ : (y[5] < 0 ? f.torque * radius_ : 0);
        }
        for (const Foot& foot : feet_) {
            const Foot p = turned(foot, y[2]);
            const Foot u{y[3] - y[5] * p.y, y[4] + y[5] * p.x};
            const Real share = -1 / (std::hypot(u.x, u.y) * static_cast<Real>(feet_.size()));
            fx += share * u.x;
            fy += share * u.y;
            torque += share * (p.x * u.y - p.y * u.x);
        }
        const Real braking = y[5] > 0 ? braking_ : (y[5] < 0 ? -braking_ : 0);
        d = {y[3],       y[4],       y[5],
             push_ * fx, push_ * fy, push_ * motion_.mass * torque / motion_.inertia - braking};
    }

    void follow(const OdeState& start) {
        const auto rhs = [this](Real, const OdeState& y, OdeState& d) { derivative(y, d); };
        const double whole = runEnd(scenario_);
        const Real speed = std::hypot(start[3], start[4]) + std::abs(start[5]) * radius_,
                   least = 0.02L * speed;
        require(slowest(start) > least,
                "a foot of " + bodyTitle(scenario_, index_) + " does not slide at the start");
        const OdeState scale{radius_, radius_, 1, speed, speed, speed / radius_};
        const auto slides = [&](const OdeState& y) { return slowest(y) > least; };
        const Real spinUp = motion_.mass * radius_ * radius_ / motion_.inertia;
        const auto end = static_cast<double>(lastTimeOf(
            slides, rhs, 0, start, whole, 400,
            [&](const OdeState& y) {
                // Half of what the slowest foot needs at least to come to rest.
                const Real loss =
                    push_ * (1 + spinUp) + braking_ * radius_ + std::abs(y[5]) * std::hypot(y[3], y[4]);
                return loss > 0 ? slowest(y) / (2 * loss) : Real(whole);
            },
            scale, 50'000));
        require(end > 0.0, bodyTitle(scenario_, index_) + " stops at once");
        solution_ = DenseSolution(rhs, 0, start, end, 1e-13L, {}, scale, OdeLimits::ofEvaluations(50'000));
        if (end < whole) validUntil_ = end;
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    FlatMotion motion_;
    std::vector<Foot> feet_;                    ///< feet; none: a disc
    Real radius_ = 0, push_ = 0, braking_ = 0;  ///< [m], [m/s^2], [rad/s^2]
    DenseSolution solution_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeSpinningDisc(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "floor"});
    const int body = parts.dynamicBody("body");
    const int floor = parts.support("floor", body);
    const Body& disc = scenario.bodies[body];
    const Vec3 centre = centerOfMass(disc), up = -1.0 * unit(scenario.gravity);
    const Plane plane = planeOf(scenario, floor, centre + 1e-3 * sizeOf(disc) * up);
    const FlatMotion motion(scenario, body, floor, plane);
    const auto pair = pairCoefficients(scenario, motion.support.material, plane.material);
    return std::make_unique<SpinningDisc>(scenario, body, motion, plane.height(centre),
                                          pair.torsionalFriction);
}

}  // namespace rigor::validation
