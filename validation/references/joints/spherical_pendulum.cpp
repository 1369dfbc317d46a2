// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A rigid body on a ball joint under gravity: spherical pendulum, conical pendulum, heavy top (symmetric or
// not). Euler's equations about the fixed point, integrated (rotation.hpp); the symmetric top's elliptic
// closed form is the second method in the tests. Source: Goldstein, Poole, Safko 2002, sections 5.5-5.7;
// Klein and Sommerfeld, Theorie des Kreisels. Assumes: a ball joint to a fixed point, initial velocity that
// of turning about it, nothing else. Quantities: tilt_max, tilt_min of the centre of mass from the upward
// vertical; azimuth_turned, the precession over the whole run, unless the arm passes the vertical.
#include <algorithm>
#include <cmath>

#include "validation/references/flight/rotation.hpp"
#include "validation/references/joints/joint_parts.hpp"

namespace rigor::validation {
namespace {

class SphericalPendulum : public Reference {
  public:
    SphericalPendulum(const Scenario& scenario, int index, int jointIndex)
        : index_(index),
          body_(scenario.bodies[index]),
          joint_(fixedJoint(scenario, jointIndex, index)),
          motion_(build(scenario)) {}
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return motion_.validUntil(); }

    PartialState exact(int, double t) const override {
        const Attitude attitude = motion_.at(t);
        const Vec3 arm = rotate(attitude.orientation, arm_);
        return stateOf(body_, joint_.anchor + arm, attitude.orientation, cross(attitude.angularVelocity, arm),
                       attitude.angularVelocity);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (up_ == Vec3{} || norm(arm_) == 0.0 || validUntil() < duration_) return result;
        std::vector<Vec3> arms;
        for (int k = 0; k <= kSamples; ++k)
            arms.push_back(rotate(motion_.at(duration_ * k / kSamples).orientation, arm_));
        const auto add = [&](const char* name, double scale,
                             double (SphericalPendulum::*read)(const std::vector<Vec3>&) const) {
            Quantity q{name, "rad", (this->*read)(arms), {}, scale, {}};
            q.measure = [this, read](const Trajectory& run) -> std::optional<double> {
                std::vector<Vec3> seen;
                for (std::size_t k = 0; k < run.frames(); ++k)
                    seen.push_back(rotate(run.state(k, index_).orientation, arm_));
                return (this->*read)(seen);
            };
            result.push_back(std::move(q));
        };
        add("tilt_max", 1.0, &SphericalPendulum::largestTilt);
        add("tilt_min", 1.0, &SphericalPendulum::smallestTilt);
        // The azimuth means nothing where the arm passes the vertical.
        if (smallestTilt(arms) > 0.05 && largestTilt(arms) < 3.09)
            add("azimuth_turned", 0.0, &SphericalPendulum::azimuth);
        return result;
    }

  private:
    static constexpr int kSamples = 4000;

    double tilt(Vec3 arm) const { return std::atan2(norm(cross(arm, up_)), dot(arm, up_)); }
    double largestTilt(const std::vector<Vec3>& arms) const {
        double most = 0.0;
        for (const Vec3 arm : arms) most = std::max(most, tilt(arm));
        return most;
    }
    double smallestTilt(const std::vector<Vec3>& arms) const {
        double least = 4.0;
        for (const Vec3 arm : arms) least = std::min(least, tilt(arm));
        return least;
    }
    /// Angle that the arm turns about the upward vertical, over turns.
    double azimuth(const std::vector<Vec3>& arms) const {
        double sum = 0.0;
        for (std::size_t k = 1; k < arms.size(); ++k) {
            const Vec3 a = arms[k - 1] - dot(up_, arms[k - 1]) * up_, b = arms[k] - dot(up_, arms[k]) * up_;
            sum += std::atan2(dot(up_, cross(a, b)), dot(a, b));
        }
        return sum;
    }

    FixedPointMotion build(const Scenario& scenario) {
        require(scenario.dimension == 3, "a spherical pendulum needs three dimensions");
        require(joint_.joint->type == scenario::JointType::Ball,
                "joint '" + joint_.joint->name + "' is not a ball joint");
        requireOnlyJoints(scenario, index_, {joint_.joint});
        requireTurnsAbout(scenario, index_, joint_.anchor);
        duration_ = scenario.duration;
        up_ = -unit(gravityOn(scenario, index_));
        const Quat q = scenario::normalized(body_.pose.orientation);
        arm_ = rotateInverse(q, centerOfMass(body_) - joint_.anchor);
        const double m = body_.massProperties.mass;
        // Parallel axes: I + m (c^2 1 - c c^T).
        Mat3 inertia = body_.massProperties.inertia;
        const double c[3] = {arm_.x, arm_.y, arm_.z};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) inertia(i, j) += m * ((i == j ? dot(arm_, arm_) : 0.0) - c[i] * c[j]);
        return FixedPointMotion(inertia, m, arm_, gravityOn(scenario, index_), q, body_.angularVelocity,
                                runEnd(scenario));
    }
    int index_;
    const Body& body_;
    FixedJoint joint_;
    Vec3 arm_;  ///< joint to centre of mass, body frame
    Vec3 up_;   ///< direction against gravity
    double duration_ = 0.0;
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
