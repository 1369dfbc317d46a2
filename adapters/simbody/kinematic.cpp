// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/kinematic.hpp"

namespace rigor::simbody {
namespace {

/// A free joint's seven coordinates with their first two derivatives: quaternion and place.
class Steady final : public SimTK::Motion::Custom::Implementation {
  public:
    Steady(const scenario::Body& body, const Pose& frame) : body_(body), frame_(frame) {}

    Implementation* clone() const override { return new Steady(*this); }
    SimTK::Motion::Level getLevel(const SimTK::State&) const override { return SimTK::Motion::Position; }

    void calcPrescribedPosition(const SimTK::State& state, int, SimTK::Real* q) const override {
        const Pose now = poseAt(body_, state.getTime()) * frame_;
        put(now.orientation, now.position, q);
    }
    void calcPrescribedPositionDot(const SimTK::State& state, int, SimTK::Real* rates) const override {
        const Pose now = poseAt(body_, state.getTime());
        const Vec3 arm = rotate(now.orientation, frame_.position);
        put(rate(now.orientation * frame_.orientation), body_.velocity + cross(body_.angularVelocity, arm),
            rates);
    }
    void calcPrescribedPositionDotDot(const SimTK::State& state, int, SimTK::Real* rates) const override {
        const Pose now = poseAt(body_, state.getTime());
        const Vec3 arm = rotate(now.orientation, frame_.position);
        put(rate(rate(now.orientation * frame_.orientation)),
            cross(body_.angularVelocity, cross(body_.angularVelocity, arm)), rates);
    }

  private:
    static void put(const Quat& q, const Vec3& p, SimTK::Real* to) {
        const double all[] = {q.w, q.x, q.y, q.z, p.x, p.y, p.z};
        std::copy(std::begin(all), std::end(all), to);
    }
    /// Half the product of the angular velocity and a quaternion.
    Quat rate(const Quat& q) const {
        const Vec3 half = 0.5 * body_.angularVelocity;
        return Quat{0.0, half.x, half.y, half.z} * q;
    }

    scenario::Body body_;
    Pose frame_;
};

}  // namespace

Pose poseAt(const scenario::Body& body, double time) {
    Pose pose = body.pose;
    pose.position += time * body.velocity;
    const double rate = norm(body.angularVelocity);
    if (rate > 0.0)
        pose.orientation =
            normalized(scenario::fromAxisAngle(body.angularVelocity / rate, rate * time) * pose.orientation);
    return pose;
}

void prescribe(const scenario::Body& body, const Pose& frame, SimTK::MobilizedBody& mobilizer) {
    SimTK::Motion::Custom(mobilizer, new Steady(body, frame));
}

}  // namespace rigor::simbody
