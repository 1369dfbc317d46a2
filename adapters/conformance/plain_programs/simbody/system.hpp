// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Code of every Simbody program here around its scene: a system as the examples build it, and the bodies' states after
// each step of one size. Simbody's headers come by the adapter's header that
// lets C++20 compile them; nothing else is the adapter's.
#pragma once

#include "adapters/conformance/plain_programs/plain_program.hpp"
#include "adapters/simbody/headers.hpp"

namespace rigor::plain {

/// Moments of a solid box with these sides.
inline SimTK::Inertia boxInertia(double mass, const SimTK::Vec3& s) {
    return {mass / 12.0 * (s[1] * s[1] + s[2] * s[2]), mass / 12.0 * (s[0] * s[0] + s[2] * s[2]),
            mass / 12.0 * (s[0] * s[0] + s[1] * s[1])};
}
inline SimTK::Body::Rigid rigid(double mass, const SimTK::Inertia& inertia) {
    return SimTK::Body::Rigid(SimTK::MassProperties(mass, SimTK::Vec3(0), inertia));
}

class System {
  public:
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    SimTK::Force::Gravity gravity{forces, matter, SimTK::Vec3(0, -9.81, 0)};
    std::vector<SimTK::MobilizedBody> bodies;
    SimTK::State state;

    /// After the last body and constraint.
    void finish() {
        state = system.realizeTopology();
        system.realizeModel(state);
    }

    /// `anew`: the integrator begins anew at every step, which projects constraints whatever their error is.
    Trajectory run(double dt, int steps, double constraintTolerance = 1e-10, bool anew = false) {
        SimTK::RungeKuttaMersonIntegrator integrator(system);
        integrator.setFixedStepSize(dt);
        integrator.setAllowInterpolation(false);
        integrator.setConstraintTolerance(constraintTolerance);
        integrator.initialize(state);
        Trajectory trajectory{states(integrator.getState())};
        for (int i = 1; i <= steps; ++i) {
            if (anew) integrator.initialize(SimTK::State(integrator.getAdvancedState()));
            while (integrator.getTime() < i * dt) integrator.stepTo(i * dt, i * dt);
            trajectory.push_back(states(integrator.getState()));
        }
        return trajectory;
    }

    /// Whether speeds stay below 1e10 for `seconds`.
    bool lasts(double dt, double seconds) {
        try {
            for (const auto& states : run(dt, static_cast<int>(seconds / dt)))
                for (const BodyState& body : states)
                    if (!(norm(body.velocity) < 1e10)) return false;
            return true;
        } catch (const std::exception&) {
            return false;
        }
    }

    std::vector<BodyState> states(const SimTK::State& at) const {
        system.realize(at, SimTK::Stage::Velocity);
        const auto vec = [](const SimTK::Vec3& v) { return Vec3{v[0], v[1], v[2]}; };
        std::vector<BodyState> all;
        for (const SimTK::MobilizedBody& body : bodies) {
            const SimTK::Quaternion q = body.getBodyRotation(at).convertRotationToQuaternion();
            all.push_back({vec(body.getBodyOriginLocation(at)),
                           {q[0], q[1], q[2], q[3]},
                           vec(body.getBodyOriginVelocity(at)),
                           vec(body.getBodyAngularVelocity(at))});
        }
        return all;
    }
};

}  // namespace rigor::plain
