// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An ellipsoid that rolls, or rocks on a smooth floor, in a plane across one of its axes k. With a and c the other
// two half axes, f the angle of the floor's normal from the axis of c, H the height of the centre, I the moment about
// k and w = f' the rate of turning:
//   H = sqrt(a^2 sin^2 f + c^2 cos^2 f), H' = (a^2 - c^2) sin f cos f / H, H'' = ((a^2 - c^2) cos 2f - H'^2) / H
//   the point of contact is H below the centre and H' beside it
//   M f'' = -(1/2 M' f'^2 + m g H')
//   rolling      M = I + m (H^2 + H'^2), the centre moves by H f' along the floor
//   no friction  M = I + m H'^2, the centre keeps its speed along the floor
// It rolls where |F| <= mu N, F = m (H' f'^2 + H f''), N = m (g + H'' f'^2 + H' f''), and stays down where N > 0.
// Small oscillations about the flatter axis c < a: period 2 pi sqrt(M(0) c / (m g (a^2 - c^2))).
// Source: Lagrange's equation of one coordinate; Routh, Dynamics of a System of Rigid Bodies, 1905.
// Assumes: one ellipsoid about the centre of mass, its axes principal; a level floor; contact from the start.
// Quantities: period.
#include <array>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;

constexpr std::array<Vec3, 3> kAxes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// Height of the centre over the floor, and its derivatives by the angle.
struct Height {
    Real h, first, second;
    Height(Real a, Real c, Real angle) {
        const Real s = std::sin(angle), co = std::cos(angle), k = a * a - c * c;
        h = std::sqrt(a * a * s * s + c * c * co * co);
        first = k * s * co / h;
        second = (k * (co * co - s * s) - first * first) / h;
    }
};

class RollingEllipsoid : public Reference {
  public:
    RollingEllipsoid(const Scenario& scenario, int index, int floor)
        : index_(index), duration_(scenario.duration), body_(scenario.bodies[index]) {
        const std::string subject = bodyTitle(scenario, index);
        require(scenario.dimension == 3, "an ellipsoid needs three dimensions");
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        requireStill(scenario, floor);
        require(body_.shapes.size() == 1, subject + " is more than one shape");
        const auto* shape = std::get_if<scenario::Ellipsoid>(&body_.shapes[0].geometry);
        require(shape != nullptr, subject + " is no ellipsoid");
        start_ = centerOfMass(body_);
        frame_ = body_.pose.orientation * body_.shapes[0].pose.orientation;
        require(norm(body_.pose * body_.shapes[0].pose.position - start_) <= 1e-9 * sizeOf(body_),
                "the centre of mass of " + subject + " is not that of the ellipsoid");
        const Plane plane = planeOf(scenario, floor, start_);
        normal_ = plane.normal;
        const Vec3 g = gravityOn(scenario, index);
        gravity_ = -dot(g, normal_);
        require(gravity_ > 0.0 && negligible(norm(g + gravity_ * normal_), norm(g)),
                "the floor is not level");
        chooseAxis(subject, *shape);
        const double mu =
            holdingFriction(pairCoefficients(scenario, body_.shapes[0].material, plane.material));
        rolls_ = mu > 0.0;
        const Height now(a_, c_, angle_);
        require(std::abs(plane.height(start_) - static_cast<double>(now.h)) <= 1e-4 * sizeOf(body_),
                subject + " does not touch the floor at the start");
        const double rate = dot(body_.angularVelocity, axis_), along = dot(body_.velocity, tangent_);
        const double fast = norm(body_.velocity) + sizeOf(body_) * std::abs(rate);
        require(norm(body_.angularVelocity - rate * axis_) <= 1e-9 * norm(body_.angularVelocity),
                subject + " does not turn about the axis that lies along the floor");
        require(std::abs(dot(body_.velocity, normal_) - static_cast<double>(now.first) * rate) <= 1e-9 * fast,
                subject + " leaves the floor or enters it at the start");
        require(std::abs(dot(body_.velocity, axis_)) <= 1e-9 * fast, subject + " moves along its axis");
        require(!rolls_ || std::abs(along - static_cast<double>(now.h) * rate) <= 1e-9 * fast,
                subject + " slips at the start");
        speed_ = along;
        solve(scenario, rate);
        requireHold(subject, mu);
    }
    std::vector<int> bodies() const override { return {index_}; }

    PartialState exact(int, double t) const override {
        const OdeState y = solution_.at(t);
        const Height now(a_, c_, y[0]);
        const auto rate = static_cast<double>(y[1]), h = static_cast<double>(now.h);
        const Vec3 foot = start_ - static_cast<double>(Height(a_, c_, angle_).h) * normal_;
        const Vec3 place = foot + static_cast<double>(y[2]) * tangent_ + h * normal_;
        const double along = rolls_ ? h * rate : speed_;
        const Quat q =
            scenario::fromAxisAngle(axis_, static_cast<double>(y[0]) - angle_) * body_.pose.orientation;
        return stateOf(body_, place, scenario::normalized(q),
                       along * tangent_ + static_cast<double>(now.first) * rate * normal_, rate * axis_);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const std::optional<double> exactPeriod =
            periodOf([&](double t) { return fromRest(solution_.at(t)[0]); });
        if (!exactPeriod) return result;
        Quantity q{"period", "s", *exactPeriod, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) -> std::optional<double> {
            const auto tilt = [&](std::size_t k) { return fromRest(angleOf(run.state(k, index_))); };
            const auto slope = [&](std::size_t k) {
                return dot(run.state(k, index_).angularVelocity, axis_);
            };
            return timeBetweenCrossings(run, tilt, slope);
        };
        result.push_back(std::move(q));
        return result;
    }

  private:
    /// The axis across the normal about which it turns; of two that are, the one of the angular velocity.
    void chooseAxis(const std::string& subject, const scenario::Ellipsoid& shape) {
        const std::array<double, 3> half{shape.halfAxes.x, shape.halfAxes.y, shape.halfAxes.z};
        double best = -1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 axis = rotate(frame_, kAxes[k]);
            if (std::abs(dot(axis, normal_)) > 1e-9) continue;
            const double turning = std::abs(dot(axis, body_.angularVelocity));
            if (turning <= best) continue;
            best = turning;
            axis_ = axis;
            const Vec3 ea = rotate(frame_, kAxes[(k + 1) % 3]), ec = rotate(frame_, kAxes[(k + 2) % 3]);
            a_ = half[(k + 1) % 3];
            c_ = half[(k + 2) % 3];
            angle_ = std::atan2(dot(normal_, ea), dot(normal_, ec));
            lying_ = ec;
        }
        require(best >= 0.0, subject + " has no axis along the floor");
        tangent_ = cross(axis_, normal_);
        const Mat3 inertia = worldInertia(body_);
        const Vec3 torque = inertia * axis_;
        moment_ = dot(axis_, torque);
        require(norm(torque - moment_ * axis_) <= 1e-9 * moment_,
                "the axis of " + subject + " is not principal");
    }
    double angleOf(const adapter::BodyState& state) const {
        const Quat turned = state.orientation * scenario::conjugate(body_.pose.orientation);
        const Vec3 up = rotate(turned, lying_), side = cross(up, axis_);
        return std::atan2(dot(normal_, side), dot(normal_, up));
    }
    /// The angle from the nearest place of rest: the flatter axis upright.
    double fromRest(Real angle) const {
        const Real shifted = a_ >= c_ ? angle : angle - std::acos(Real(0));
        return static_cast<double>(std::remainder(shifted, 2 * std::acos(Real(0))));
    }
    Real massOf(const Height& now) const {
        const Real m = body_.massProperties.mass;
        return moment_ + m * (now.first * now.first + (rolls_ ? now.h * now.h : Real(0)));
    }
    Real accelerationOf(const Height& now, Real rate) const {
        const Real m = body_.massProperties.mass;
        const Real change = 2 * m * (now.first * now.second + (rolls_ ? now.h * now.first : Real(0)));
        return -(change * rate * rate / 2 + m * gravity_ * now.first) / massOf(now);
    }
    void solve(const Scenario& scenario, double rate) {
        const auto rhs = [this](Real, const OdeState& y, OdeState& d) {
            const Height now(a_, c_, y[0]);
            d[0] = y[1];
            d[1] = accelerationOf(now, y[1]);
            d[2] = rolls_ ? now.h * y[1] : Real(speed_);
        };
        const double size = sizeOf(body_), quick = std::sqrt(gravity_ / size);
        solution_ = numerics::DenseSolution(rhs, 0, {angle_, rate, 0}, runEnd(scenario), 1e-13L, {},
                                            {1, quick, size});
    }
    void requireHold(const std::string& subject, double mu) const {
        for (const Real t : solution_.nodes()) {
            const OdeState y = solution_.at(t);
            const Height now(a_, c_, y[0]);
            const Real turn = accelerationOf(now, y[1]), w2 = y[1] * y[1];
            const Real load = gravity_ + now.second * w2 + now.first * turn;
            require(load > 0, subject + " leaves the floor");
            require(!rolls_ || std::abs(now.first * w2 + now.h * turn) <= mu * load,
                    subject + " slips: friction is too small");
        }
    }
    /// Time between the first two upward passages of zero; empty where there are none.
    template <class Tilt>
    std::optional<double> periodOf(const Tilt& tilt) const {
        std::optional<double> before;
        const int samples = 4000;
        for (int k = 0; k < samples; ++k) {
            double low = duration_ * k / samples, high = duration_ * (k + 1) / samples;
            if (!(tilt(low) < 0.0 && tilt(high) >= 0.0 && tilt(high) - tilt(low) < 1.0)) continue;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (tilt(middle) < 0.0 ? low : high) = middle;
            }
            if (before) return high - *before;
            before = high;
        }
        return std::nullopt;
    }

    int index_;
    double duration_;
    const Body& body_;
    Quat frame_;  ///< orientation of the ellipsoid at the start
    Vec3 start_, normal_, axis_, tangent_;
    Vec3 lying_;  ///< axis of the half axis c at the start
    double gravity_ = 0.0, a_ = 1.0, c_ = 1.0, angle_ = 0.0, moment_ = 1.0, speed_ = 0.0;
    bool rolls_ = true;
    numerics::DenseSolution solution_;
};

}  // namespace

std::unique_ptr<Reference> makeRollingEllipsoid(const Scenario& scenario,
                                                const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "floor"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<RollingEllipsoid>(scenario, body, parts.support("floor", body));
}

}  // namespace rigor::validation
