// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Exact rotation of rigid bodies: torque-free (closed form) and about a fixed point under gravity (ODE).
#pragma once

#include <array>
#include <optional>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {

struct Attitude {
    Quat orientation;      ///< body to world
    Vec3 angularVelocity;  ///< world [rad/s]
};

/// A rigid body that turns about a fixed point (or its centre of mass) in a uniform field:
/// I dw/dt = -w x I w + m c x R^T g, dq/dt = q (0, w)/2 in body axes, to 1e-13 over [0, duration], or until
/// neighbouring motions part (validUntil): a heavy top that is not symmetric moves chaotically.
class FixedPointMotion {
  public:
    /// `inertia` about the point, body axes; `mass`, `arm` from the point to the centre of mass, body axes.
    FixedPointMotion(const Mat3& inertia, double mass, Vec3 arm, Vec3 gravity, Quat orientation,
                     Vec3 angularVelocity, double duration);
    Attitude at(double t) const;
    /// 1e300: to the end.
    double validUntil() const;

  private:
    numerics::DenseSolution solution_;
};

/// Torque-free rotation for any inertia tensor and initial state. Closed forms: constant angular velocity
/// (principal axis, spherical top), symmetric top, asymmetric top in Jacobi elliptic functions with the
/// attitude from the constant angular momentum and one smooth quadrature (Landau and Lifshitz, section 37;
/// Whittaker 1937, section 69). Next to the separatrix (1 - m < 1e-9) the equations are integrated instead.
class TorqueFreeMotion {
  public:
    TorqueFreeMotion(const Body& body, int dimension, double duration);
    Attitude at(double t) const;
    /// 1e300 but where the equations are integrated and neighbouring motions part.
    double validUntil() const { return integrated_ ? integrated_->validUntil() : 1e300; }

    enum class Kind { Constant, Symmetric, Asymmetric, Integrated };
    Kind kind() const { return kind_; }

    /// Symmetric: rate at which the symmetry axis turns about the angular momentum [rad/s], and the axis in
    /// body coordinates.
    double precessionRate() const { return precession_; }
    Vec3 symmetryAxis() const { return symmetryAxis_; }
    Vec3 angularMomentum() const { return angularMomentum_; }  ///< world [kg m^2/s]
    /// Asymmetric: first time the angular velocity about the intermediate axis passes zero, and its period
    /// [s].
    double firstFlip() const;
    double period() const;
    Vec3 intermediateAxis() const;  ///< body coordinates

  private:
    void buildSymmetric(bool prolate);
    void buildAsymmetric();
    Attitude symmetricAt(double t) const;
    Attitude asymmetricAt(double t) const;
    Vec3 principalRates(numerics::Real u) const;
    numerics::Real precessionAt(numerics::Real u) const;

    Kind kind_ = Kind::Constant;
    Quat q0_;
    Vec3 w0_, angularMomentum_;
    // Principal frame: axes of ascending moments; orientation of the frame in the body and in the world.
    std::array<double, 3> moments_{};
    std::array<double, 3> rates0_{};
    Quat frameInBody_, frame0_;
    double momentum_ = 0.0, precession_ = 0.0, spinRate_ = 0.0;
    Vec3 symmetryAxis_;
    std::size_t axisCn_ = 0, axisDn_ = 2;
    std::array<numerics::Real, 3> amplitude_{};
    numerics::Real rate_ = 0, parameter_ = 0, u0_ = 0, halfPeriod_ = 0, halfPeriodPrecession_ = 0;
    numerics::DenseSolution precessionTable_;  ///< angle turned about L over half a period of u
    std::optional<FixedPointMotion> integrated_;
};

}  // namespace rigor::validation
