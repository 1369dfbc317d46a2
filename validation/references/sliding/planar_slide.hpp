// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A point that slides on a plane: constant pull g along the plane, isotropic friction deceleration f against
// the velocity. Exact motion in closed form for any initial velocity.
//   Along the line of g: piecewise uniform acceleration. Otherwise, with psi the angle from downhill,
//   w = tan(psi/2), kappa = f/|g|:  v = C w^kappa/sin(psi) and
//   t = C/(2 g) [w^(kappa-1)/(kappa-1) + w^(kappa+1)/(kappa+1)], across: C^2/(2 g) [w^(2 kappa-1)/(2 kappa-1)
//   + w^(2 kappa+1)/(2 kappa+1)], down: C^2/(4 g) [w^(2 kappa-2)/(2 kappa-2) - w^(2 kappa+2)/(2 kappa+2)],
//   each taken from w to w0 (logarithms where an exponent vanishes); w(t) by root finding in extended
//   precision.
// Source: Coulomb 1785; Whittaker, Analytical Dynamics, 1937 (particle on a rough inclined plane).
#pragma once

#include <optional>
#include <vector>

#include "validation/references/numerics/real.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {

class PlanarSlide {
  public:
    struct State {
        Vec3 displacement, velocity;
    };
    /// `pull`: acceleration along the plane [m/s^2]; `friction`: deceleration mu N/m [m/s^2]; `velocity`
    /// along the plane; `holding`: the pull up to which the point stays once it does not slide, of the static
    /// coefficient, at least `friction` [m/s^2].
    PlanarSlide(Vec3 pull, double friction, Vec3 velocity, double holding);

    State at(double t) const;
    /// Time at which it comes to rest for good [s]; empty if it never does, 0 if it sticks from the start.
    std::optional<double> stopTime() const { return stop_; }
    /// True if it ends sticking and does not slide on.
    bool sticks() const { return stop_.has_value(); }

    /// Times at which the acceleration jumps [s].
    std::vector<double> kinks() const;

    /// One step of ideal time stepping with implicit isotropic friction (maximal dissipation): the velocity
    /// after pull and friction impulse. Exact for the scheme: both act over the whole step.
    static Vec3 step(Vec3 velocity, Vec3 pull, double friction, double dt);

  private:
    State straight(double t) const;
    State curved(double t) const;
    numerics::Real timeAt(numerics::Real s) const;

    Vec3 pull_, velocity_;
    double friction_ = 0.0;
    std::optional<double> stop_;
    bool curved_ = false;
    // Straight: speed along `along_`, deceleration until `turn_`, then acceleration downhill.
    Vec3 along_;
    double speed_ = 0.0, slope_ = 0.0, turn_ = 0.0;
    // Curved: unit vectors downhill and across, g, kappa, w0, P = v0 sin(psi0).
    Vec3 down_, across_;
    numerics::Real g_ = 0, kappa_ = 0, w0_ = 0, p_ = 0;
};

/// Ideal time stepping of PlanarSlide::step, kept so that evaluating many steps in order costs one each. It
/// is not safe to share between threads.
class SlideSteps {
  public:
    struct State {
        Vec3 displacement;  ///< sum of h v over the steps, new velocities (symplectic) or old ones (explicit)
        Vec3 velocity;
    };
    State at(Vec3 pull, double friction, Vec3 velocity, std::size_t step, double dt,
             adapter::Scheme scheme) const;

  private:
    mutable double dt_ = 0.0;
    mutable adapter::Scheme scheme_ = adapter::Scheme::Unknown;
    mutable std::vector<State> states_;
};

}  // namespace rigor::validation
