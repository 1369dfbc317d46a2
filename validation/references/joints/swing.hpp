// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The pendulum's equation th'' = -W^2 sin(th), exact at any amplitude: shared by all that swings like a
// pendulum. With m = sin^2(th0/2) + th0'^2/(4 W^2):
//   m < 1: sin(th/2) = sqrt(m) sn(W t + u0 | m), th' = 2 W sqrt(m) cn, period 4 K(m)/W;
//   m > 1: th = 2 am(sqrt(m) W t + u0 | 1/m), th' = 2 W sqrt(m) dn, period 2 K(1/m)/(W sqrt(m));
//   m = 1: separatrix.
// Source: Whittaker, Analytical Dynamics, 1937, section 44.
#pragma once

#include "validation/references/numerics/elliptic.hpp"

namespace rigor::validation {

class Swing {
  public:
    using Real = numerics::Real;
    struct State {
        Real angle = 0, rate = 0;  ///< [rad, rad/s]; the angle goes on over turns
    };
    Swing() = default;
    /// `frequency` W >= 0 [rad/s]; 0: nothing drives the rotation.
    Swing(Real frequency, double angle, double rate);

    State at(double t) const;
    Real frequency() const { return W_; }
    Real parameter() const { return m_; }  ///< m; below 1 it swings, above it turns over
    Real period() const { return period_; }
    Real amplitude() const;  ///< amplitude of a swing [rad]
    /// First passage through the lowest point after the start, towards growing angle [s].
    double firstPassage() const;

  private:
    double angle0_ = 0.0, rate0_ = 0.0;
    Real W_ = 0, m_ = 0, root_ = 0, u0_ = 0, period_ = 0;
};

}  // namespace rigor::validation
