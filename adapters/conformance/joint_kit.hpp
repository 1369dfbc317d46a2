// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// This header holds what the tests of joints share: joints between bodies, and the angle of a pendulum.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {

class Joints : public DynamicsTest {
  protected:
    static constexpr double kStep = 1.0 / 480.0;

    static Joint jointOf(JointType type, int a, int b, const Vec3& anchorA, const Vec3& anchorB) {
        Joint joint;
        joint.name = "joint";
        joint.type = type;
        joint.bodyA = a;
        joint.bodyB = b;
        joint.anchorA = anchorA;
        joint.anchorB = anchorB;
        return joint;
    }
    static Vec3 at(const BodyState& state, const Vec3& local) {
        return Pose{state.position, state.orientation} * local;
    }
    /// Null, and what is lacking, where the library has the kind of joint but not this one of it.
    std::unique_ptr<adapter::World> buildIfOffered(const Scenario& s, std::string& lacking) {
        try {
            return build(s, kStep);
        } catch (const adapter::Unsupported& refused) {
            EXPECT_EQ(refused.refusal(), adapter::Refusal::NotInLibrary) << refused.what();
            lacking = refused.what();
            return nullptr;
        }
    }
    /// The angle about z of a six_dof whose axis is x and whose normal is y.
    scenario::JointAxis& turnOf(Joint& joint) const { return joint.axes[is2d() ? 2 : 5]; }
    /// Angle of a physical pendulum, theta'' = -k sin(theta), released at rest at `theta`, after `time`.
    static double pendulumAngle(double theta, double k, double time) {
        const int steps = 20000;
        const double h = time / steps;
        double rate = 0.0;
        for (int i = 0; i < steps; ++i) {  // Störmer-Verlet, error 1e-8
            rate -= 0.5 * h * k * std::sin(theta);
            theta += h * rate;
            rate -= 0.5 * h * k * std::sin(theta);
        }
        return theta;
    }
    /// A body hung beside its pivot and let go; its angle after 0.4 s must be that of the pendulum.
    void swing(JointType type);
};

}  // namespace rigor::conformance
