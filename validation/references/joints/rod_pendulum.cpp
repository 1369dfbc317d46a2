// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body whose centre of mass hangs on a rod or a taut rope from a fixed point p, in 2D or in 3D: a point
// mass on a sphere of radius l. With n = (x - p)/l:
//   x'' = g - (g.n + |v|^2/l) n, tension m (g.n + |v|^2/l),
// integrated to 1e-12 (ode.hpp); the body does not turn. A rope's solution ends when its tension does.
// Source: Goldstein, Poole, Safko 2002, chapter 1 (Lagrange multipliers); Whittaker 1937, sections 44, 55.
// Assumes: a distance joint from a fixed point to the centre of mass, without spring or motor, taut at the
// start; the initial velocity across it; no spin, nothing else.
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/ode.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;

class RodPendulum : public Reference {
  public:
    RodPendulum(const Scenario& scenario, int index, int jointIndex)
        : index_(index), body_(scenario.bodies[index]) {
        const auto& joint = scenario.joints[jointIndex];
        require(joint.type == scenario::JointType::Distance,
                "joint '" + joint.name + "' is not a distance joint");
        requireOnlyJoints(scenario, index, {&joint});
        for (const std::string& feature : joint.features())
            require(feature == "limit", "joint '" + joint.name + "' has a " + feature);
        const int other = joint.bodyA == index ? joint.bodyB : joint.bodyA;
        require(
            other == scenario::kNone || scenario.bodies[other].type == scenario::BodyType::Static,
            "joint '" + joint.name + "' does not hold " + bodyTitle(scenario, index) + " to a fixed point");
        pivot_ = anchorOf(scenario, joint, other);
        const Vec3 x = centerOfMass(body_), arm = x - pivot_, v = body_.velocity;
        length_ = norm(arm);
        require(norm(anchorOf(scenario, joint, index) - x) <= 1e-9 * length_,
                "joint '" + joint.name + "' does not hold " + bodyTitle(scenario, index) +
                    " at its centre of mass");
        const bool rope = joint.axes[0].mode == scenario::AxisMode::Limited;
        require(!rope || std::abs(joint.axes[0].upper - length_) <= 1e-9 * length_,
                "joint '" + joint.name + "' is not taut at the start");
        g_ = gravityOn(scenario, index);
        const double falling = std::sqrt(norm(g_) * length_);
        require(std::abs(dot(v, arm)) <= (1e-9 * norm(v) + 1e-12 * falling) * length_,
                bodyTitle(scenario, index) + " moves along its rod at the start");
        require(body_.angularVelocity == Vec3{}, bodyTitle(scenario, index) + " spins");
        const double end = runEnd(scenario), fast = norm(v) + falling + length_ / end;
        solution_ =
            numerics::DenseSolution([this](Real, const OdeState& y, OdeState& dydt) { derivative(y, dydt); },
                                    0, {arm.x, arm.y, arm.z, v.x, v.y, v.z}, end, 1e-14L, {},
                                    {length_, length_, length_, fast, fast, fast});
        if (rope) findSlack(end);
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return slack_; }

    PartialState exact(int, double t) const override {
        const OdeState y = solution_.at(t);
        const auto vec = [&](std::size_t i) {
            return Vec3{static_cast<double>(y[i]), static_cast<double>(y[i + 1]),
                        static_cast<double>(y[i + 2])};
        };
        return stateOf(body_, pivot_ + vec(0), body_.pose.orientation, vec(3), {});
    }

  private:
    /// Tension over mass and length [1/s^2].
    Real pull(const OdeState& y) const {
        const Real l2 = static_cast<Real>(length_) * length_;
        return (g_.x * y[0] + g_.y * y[1] + g_.z * y[2] + y[3] * y[3] + y[4] * y[4] + y[5] * y[5]) / l2;
    }
    void derivative(const OdeState& y, OdeState& dydt) const {
        const Real p = pull(y), g[3] = {g_.x, g_.y, g_.z};
        for (std::size_t i = 0; i < 3; ++i) {
            dydt[i] = y[i + 3];
            dydt[i + 3] = g[i] - p * y[i];
        }
    }
    void findSlack(double end) {
        const auto taut = solution_.lastTimeOf([this](const OdeState& y) { return pull(y) >= 0; }, end);
        require(taut.has_value(), "the rope of " + bodyTitle_() + " is slack at the start");
        if (*taut < end) slack_ = static_cast<double>(*taut);
    }
    std::string bodyTitle_() const { return "body '" + body_.name + "'"; }

    int index_;
    const Body& body_;
    Vec3 pivot_, g_;
    double length_ = 0.0, slack_ = 1e300;
    numerics::DenseSolution solution_;
};

}  // namespace

std::unique_ptr<Reference> makeRodPendulum(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<RodPendulum>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
