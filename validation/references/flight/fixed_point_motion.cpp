// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Euler's equations about a fixed point with the attitude as a quaternion, integrated in extended precision.
// Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., 2002, sections 5.5-5.7.
#include "validation/references/flight/rotation.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation {

using namespace numerics;

FixedPointMotion::FixedPointMotion(const Mat3& inertia, double mass, Vec3 arm, Vec3 gravity, Quat orientation,
                                   Vec3 angularVelocity, double duration) {
    const Real33 moments = real33(inertia);
    const Real3 lever = static_cast<Real>(mass) * real3(arm), field = real3(gravity);
    const auto rhs = [=](Real, const OdeState& y, OdeState& d) {
        const Real3 w{y[4], y[5], y[6]};
        const Real3 torque = cross(lever, transposed(rotationOf(y[0], y[1], y[2], y[3]), field));
        const Real3 a = solve(moments, torque - cross(w, moments * w));
        quaternionRate(y, 0, w, d);
        d[4] = a.x;
        d[5] = a.y;
        d[6] = a.z;
    };
    const Quat q = scenario::normalized(orientation);
    const Vec3 w = rotateInverse(q, angularVelocity);
    const Real heaviest = std::max({moments[0].x, moments[1].y, moments[2].z}),
               turns = 1 / static_cast<Real>(duration) + norm(w) +
                       std::sqrt(norm(lever) * norm(field) / heaviest);
    const OdeState scale{1, 1, 1, 1, turns, turns, turns};
    solution_ = numerics::DenseSolution(rhs, 0, {q.w, q.x, q.y, q.z, w.x, w.y, w.z}, duration, 1e-14L, {},
                                        scale, numerics::OdeLimits::neighbourOf(1e-13L, 1e-8L, scale));
}

double FixedPointMotion::validUntil() const {
    return solution_.isWhole() ? 1e300 : static_cast<double>(solution_.end());
}

Attitude FixedPointMotion::at(double t) const {
    const OdeState y = solution_.at(t);
    const auto d = [&](std::size_t i) { return static_cast<double>(y[i]); };
    Attitude attitude;
    attitude.orientation = scenario::normalized(Quat{d(0), d(1), d(2), d(3)});
    attitude.angularVelocity = rotate(attitude.orientation, {d(4), d(5), d(6)});
    return attitude;
}

}  // namespace rigor::validation
