// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body hinged to a shaft that is driven at a constant rate W: the pendulum on a turning hinge, the bead on
// a rotating hoop, the governor. With n the hinge axis and p its anchor, both turning with the shaft, r from
// the anchor to the centre of mass, w = W + theta' n:
//   theta'' n.(I n + m r x (n x r)) =
//       n.[m r x (g - p'' - (W x theta' n) x r - w x (w x r)) - I (W x theta' n) - w x (I w)]
// (Newton and Euler along the only free direction), integrated in extended precision.
// Where the hinge meets the shaft's axis at a right angle, gravity is along that axis and one principal plane
// holds both: theta rests at 0 until W^2 = m g d/(I1 - I3), then at cos(theta) = m g d/((I1 - I3) W^2).
// Source: Goldstein, Poole, Safko 2002, chapters 1-2; Marsden and Ratiu, Introduction to Mechanics and
// Symmetry, 1999, section 2.10. Assumes: a hinge to a kinematic body that turns about a fixed axis, initial
// velocity that of the hinge, nothing else. Quantities: tilt_max, tilt_min of the arm against gravity.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

class RotatingHinge : public Reference {
  public:
    RotatingHinge(const Scenario& scenario, int index, int jointIndex)
        : scenario_(scenario), index_(index), body_(scenario.bodies[index]) {
        const auto& joint = scenario.joints[jointIndex];
        require(scenario.dimension == 3, "a turning hinge needs three dimensions");
        require(joint.type == scenario::JointType::Hinge, "joint '" + joint.name + "' is not a hinge");
        requirePassive(joint);
        requireOnlyJoints(scenario, index, {&joint});
        const int other = joint.bodyA == index ? joint.bodyB : joint.bodyA;
        require(other != scenario::kNone && scenario.bodies[other].type == scenario::BodyType::Kinematic,
                "joint '" + joint.name + "' does not hold " + bodyTitle(scenario, index) +
                    " to a kinematic body");
        const Body& shaft = scenario.bodies[other];
        require(shaft.velocity == Vec3{}, bodyTitle(scenario, other) + " moves away");
        turn_ = real3(shaft.angularVelocity);
        center_ = real3(centerOfMass(shaft));
        anchor_ = real3(anchorOf(scenario, joint, index)) - center_;
        axis_ = real3(axisOf(scenario, joint));
        arm_ = real3(centerOfMass(body_)) - center_ - anchor_;
        inertia_ = real33(worldInertia(body_));
        gravity_ = real3(gravityOn(scenario, index));
        const Real3 relative = real3(body_.angularVelocity) - turn_;
        const Real rate = dot(axis_, relative);
        require(norm(relative - rate * axis_) <= 1e-9L * (norm(turn_) + std::abs(rate)),
                bodyTitle(scenario, index) + " spins as its hinge forbids");
        const Real3 expected = cross(turn_, anchor_) + cross(real3(body_.angularVelocity), arm_);
        require(norm(real3(body_.velocity) - expected) <=
                    1e-6L * std::max(norm(expected), norm(real3(body_.velocity))),
                "the velocity of " + bodyTitle(scenario, index) + " is not that of its hinge, " +
                    shown(toVec3(expected), 3));
        solution_ = DenseSolution([this](Real t, const OdeState& y, OdeState& d) { derivative(t, y, d); }, 0,
                                  {0, rate}, runEnd(scenario), 1e-14L, {},
                                  {1, 1 / static_cast<Real>(runEnd(scenario)) + norm(turn_) + std::abs(rate)},
                                  OdeLimits::ofEvaluations(2'000'000));
    }
    std::vector<int> bodies() const override { return {index_}; }

    PartialState exact(int, double t) const override {
        const OdeState y = solution_.at(t);
        const Real3 n = shaft(t, axis_), w = turn_ + y[1] * n, arm = swung(t, y[0], arm_);
        const double rate = static_cast<double>(norm(turn_)), angle = static_cast<double>(y[0]);
        Quat q = scenario::fromAxisAngle(toVec3(axis_), angle) * body_.pose.orientation;
        if (rate > 0.0) q = scenario::fromAxisAngle(toVec3((1 / norm(turn_)) * turn_), rate * t) * q;
        const Real3 anchor = shaft(t, anchor_);
        return stateOf(body_, toVec3(center_ + anchor + arm), scenario::normalized(q),
                       toVec3(cross(turn_, anchor) + cross(w, arm)), toVec3(w));
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (norm(gravity_) == 0 || norm(arm_) == 0) return result;
        double low = 10.0, high = -10.0;
        const int samples = 4000;
        for (int k = 0; k <= samples; ++k) {
            const double t = scenario_.duration * k / samples;
            const double tilt = tiltOf(toVec3(swung(t, solution_.at(t)[0], arm_)));
            low = std::min(low, tilt);
            high = std::max(high, tilt);
        }
        for (const bool most : {true, false}) {
            Quantity q{most ? "tilt_max" : "tilt_min", "rad", most ? high : low, {}, 1.0, {}};
            q.measure = [this, most](const Trajectory& run) -> std::optional<double> {
                double found = most ? -10.0 : 10.0;
                for (std::size_t k = 0; k < run.frames(); ++k) {
                    const auto& state = run.state(k, index_);
                    const Vec3 local = rotateInverse(body_.pose.orientation, toVec3(arm_));
                    const double tilt = tiltOf(rotate(state.orientation, local));
                    found = most ? std::max(found, tilt) : std::min(found, tilt);
                }
                return found;
            };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    /// Carried along by the shaft for time t.
    Real3 shaft(Real t, Real3 v) const {
        const Real rate = norm(turn_);
        if (rate == 0) return v;
        return turnedAbout((1 / rate) * turn_, std::cos(rate * t), std::sin(rate * t), v);
    }
    /// Turned about the hinge, then carried along.
    Real3 swung(Real t, Real angle, Real3 v) const {
        return shaft(t, turnedAbout(axis_, std::cos(angle), std::sin(angle), v));
    }
    double tiltOf(Vec3 arm) const {
        const Vec3 g = toVec3(gravity_);
        return std::atan2(norm(cross(arm, g)), dot(arm, g));
    }

    void derivative(Real t, const OdeState& y, OdeState& d) const {
        // Everything seen in the shaft's frame: only gravity turns in it.
        const Real m = body_.massProperties.mass, rate = norm(turn_);
        const Real3 g =
            rate == 0 ? gravity_
                      : turnedAbout((1 / rate) * turn_, std::cos(rate * t), -std::sin(rate * t), gravity_);
        const Real c = std::cos(y[0]), s = std::sin(y[0]);
        const auto turned = [&](Real3 v) { return turnedAbout(axis_, c, s, v); };
        const auto inertia = [&](Real3 v) { return turned(inertia_ * turnedAbout(axis_, c, -s, v)); };
        const Real3 n = axis_, r = turned(arm_), w = turn_ + y[1] * n, carried = cross(turn_, y[1] * n);
        const Real3 pivot = cross(turn_, cross(turn_, anchor_));
        const Real3 pull = g - pivot - cross(carried, r) - cross(w, cross(w, r));
        const Real3 torque = m * cross(r, pull) - inertia(carried) - cross(w, inertia(w));
        d[0] = y[1];
        d[1] = dot(n, torque) / dot(n, inertia(n) + m * cross(r, cross(n, r)));
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    Real3 turn_, center_, anchor_, axis_, arm_, gravity_;
    Real33 inertia_{};
    DenseSolution solution_;
};

}  // namespace

std::unique_ptr<Reference> makeRotatingHinge(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<RotatingHinge>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
