// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two free bodies on a common hinge whose motor turns one against the other: with the relative speed u and
// 1/J = 1/Ia + 1/Ib,
//   J u' = +-max until u is the motor's speed, at t* = J |speed - u0|/max; wa' = -+max/Ia, wb' = +-max/Ib,
// so that Ia wa + Ib wb never changes. Velocities are scheme-exact where a step ends at t*.
// Source: Newton's third law for torques; Landau and Lifshitz, Mechanics, 1976, section 9 (angular momentum).
// Assumes: the hinge runs through both centres of mass along principal axes; the same gravity on both; spins
// along the hinge, equal velocities; nothing else. Quantities: ramp_time, spin_a and spin_b at the end.
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"

namespace rigor::validation {
namespace {

class MotorPair : public Reference {
  public:
    MotorPair(const Scenario& scenario, int jointIndex) : scenario_(scenario) {
        const auto& joint = scenario.joints[jointIndex];
        require(joint.type == scenario::JointType::Hinge, "joint '" + joint.name + "' is not a hinge");
        for (const std::string& feature : joint.features())
            require(feature == "motor", "joint '" + joint.name + "' has a " + feature);
        require(joint.axes[0].hasMotor(), "joint '" + joint.name + "' has no motor");
        a_ = joint.bodyA;
        b_ = joint.bodyB;
        axis_ = axisOf(scenario, joint);
        for (const int body : {a_, b_}) check(joint, body);
        const Body &a = body(a_), &b = body(b_);
        require(norm(a.velocity - b.velocity) <= 1e-9 * norm(a.velocity), "the bodies part at the start");
        require(gravityOn(scenario, a_) == gravityOn(scenario, b_), "gravity acts differently on the bodies");
        const double speed = dot(axis_, b.angularVelocity) - dot(axis_, a.angularVelocity);
        const double goal = joint.axes[0].motorSpeed - speed,
                     reduced = 1.0 / (1.0 / momentA_ + 1.0 / momentB_);
        torque_ = goal < 0.0 ? -joint.axes[0].motorMaxForce : joint.axes[0].motorMaxForce;
        ramp_ = reduced * std::abs(goal) / joint.axes[0].motorMaxForce;
    }
    std::vector<int> bodies() const override { return {a_, b_}; }

    PartialState exact(int index, double t) const override {
        const Body& one = body(index);
        const double w0 = dot(axis_, one.angularVelocity), s = std::min(t, ramp_), rate = rateOf(index);
        const double angle = w0 * t + rate * (0.5 * s * s + s * (t - s));
        const Vec3 g = gravityOn(scenario_, index);
        return stateOf(one, centerOfMass(one) + t * one.velocity + (0.5 * t * t) * g,
                       scenario::normalized(scenario::fromAxisAngle(axis_, angle) * one.pose.orientation),
                       one.velocity + t * g, (w0 + rate * s) * axis_);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (!(ramp_ < scenario_.duration)) return result;
        const auto relative = [this](const Trajectory& run, std::size_t k) {
            return dot(axis_, run.state(k, b_).angularVelocity - run.state(k, a_).angularVelocity);
        };
        // The straight ramp through the frames before half of t*, carried on to the speed at the end.
        Quantity time{"ramp_time", "s", ramp_, {}, ramp_ > 0.0 ? 0.0 : scenario_.duration, {}};
        time.measure = [this, relative](const Trajectory& run) -> std::optional<double> {
            const auto middle = lastFrameBefore(run, 0.5 * ramp_);
            if (!middle || *middle < 1) return std::nullopt;
            const double u0 = relative(run, 0), slope = (relative(run, *middle) - u0) / run.times[*middle];
            if (slope == 0.0) return std::nullopt;
            return (relative(run, run.frames() - 1) - u0) / slope;
        };
        result.push_back(std::move(time));
        const double scale = std::abs(torque_) * ramp_ * (1.0 / momentA_ + 1.0 / momentB_);
        for (const int index : {a_, b_}) {
            const double after = dot(axis_, body(index).angularVelocity) + rateOf(index) * ramp_;
            Quantity q{index == a_ ? "spin_a" : "spin_b", "rad/s", after, after, scale, {}};
            q.measure = [this, index](const Trajectory& run) -> std::optional<double> {
                return dot(axis_, run.state(run.frames() - 1, index).angularVelocity);
            };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    const Body& body(int index) const { return scenario_.bodies[index]; }
    double rateOf(int index) const { return index == a_ ? -torque_ / momentA_ : torque_ / momentB_; }

    void check(const scenario::Joint& joint, int index) {
        require(index != scenario::kNone && body(index).type == scenario::BodyType::Dynamic,
                "joint '" + joint.name + "' does not join two free bodies");
        requireOnlyJoints(scenario_, index, {&joint});
        const Body& one = body(index);
        const std::string subject = bodyTitle(scenario_, index);
        const Vec3 arm = centerOfMass(one) - anchorOf(scenario_, joint, index);
        require(norm(cross(arm, axis_)) <= 1e-9 * sizeOf(one),
                "the hinge misses the centre of mass of " + subject);
        double moment = one.massProperties.inertia(2, 2);
        if (scenario_.dimension == 3) {
            const Vec3 m = worldInertia(one) * axis_;
            moment = dot(axis_, m);
            require(norm(m - moment * axis_) <= 1e-9 * moment,
                    "the hinge is not along a principal axis of " + subject);
        }
        (index == a_ ? momentA_ : momentB_) = moment;
        const Vec3 w = one.angularVelocity;
        require(norm(cross(w, axis_)) <= 1e-9 * norm(w), subject + " does not spin about the hinge");
    }

    const Scenario& scenario_;
    int a_ = 0, b_ = 0;
    Vec3 axis_;
    double momentA_ = 0.0, momentB_ = 0.0, torque_ = 0.0, ramp_ = 0.0;
};

}  // namespace

std::unique_ptr<Reference> makeMotorPair(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"joint"});
    int body = scenario::kNone;
    for (int i = 0; i < static_cast<int>(scenario.bodies.size()) && body == scenario::kNone; ++i)
        if (scenario.bodies[i].type == scenario::BodyType::Dynamic) body = i;
    return std::make_unique<MotorPair>(scenario, parts.joint("joint", body));
}

}  // namespace rigor::validation
