// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A rigid body on a ball joint under gravity: spherical pendulum, conical pendulum, heavy top (symmetric or
// not). Euler's equations about the fixed point, integrated (rotation.hpp); the symmetric top's elliptic
// closed form is the second method in the tests. Source: Goldstein, Poole, Safko 2002, sections 5.5-5.7;
// Klein and Sommerfeld, Theorie des Kreisels. Assumes: a ball joint to a fixed point, initial velocity that
// of turning about it, nothing else.
#include "validation/references/joint_parts.hpp"
#include "validation/references/rotation.hpp"

namespace rigor::validation {
namespace {

class SphericalPendulum : public Reference {
  public:
    SphericalPendulum(const Scenario& scenario, int index, int jointIndex)
        : index_(index),
          body_(scenario.bodies[static_cast<std::size_t>(index)]),
          joint_(fixedJoint(scenario, jointIndex, index)),
          motion_(build(scenario)) {}
    std::vector<int> bodies() const override { return {index_}; }

    PartialState exact(int, double t) const override {
        const Attitude attitude = motion_.at(t);
        const Vec3 arm = rotate(attitude.orientation, arm_);
        return stateOf(body_, joint_.anchor + arm, attitude.orientation, cross(attitude.angularVelocity, arm),
                       attitude.angularVelocity);
    }

  private:
    FixedPointMotion build(const Scenario& scenario) {
        require(scenario.dimension == 3, "a spherical pendulum needs three dimensions");
        require(joint_.joint->type == scenario::JointType::Ball,
                "joint '" + joint_.joint->name + "' is not a ball joint");
        requireOnlyJoints(scenario, index_, {joint_.joint});
        requireTurnsAbout(scenario, index_, joint_.anchor);
        const Quat q = scenario::normalized(body_.pose.orientation);
        arm_ = rotateInverse(q, centerOfMass(body_) - joint_.anchor);
        const double m = body_.massProperties.mass;
        // Parallel axes: I + m (c^2 1 - c c^T).
        Mat3 inertia = body_.massProperties.inertia;
        const double c[3] = {arm_.x, arm_.y, arm_.z};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) inertia(i, j) += m * ((i == j ? dot(arm_, arm_) : 0.0) - c[i] * c[j]);
        return FixedPointMotion(inertia, m, arm_, gravityOn(scenario, index_), q, body_.angularVelocity,
                                horizon(scenario));
    }
    int index_;
    const Body& body_;
    FixedJoint joint_;
    Vec3 arm_;  ///< joint to centre of mass, body frame
    FixedPointMotion motion_;
};

}  // namespace

std::unique_ptr<Reference> makeSphericalPendulum(const Scenario& scenario,
                                                 const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<SphericalPendulum>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
