// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball (3D) or disc (2D) that slips and rolls on a plane: shared by slip_to_roll and rolling_incline.
#pragma once

#include "validation/references/numerics/ode.hpp"
#include "validation/references/sliding/planar_slide.hpp"

namespace rigor::validation {

/// Equations with u the slip velocity at the contact, k = I/(m r^2), g_t the pull along the plane, N/m = g_n:
///   slipping: u' = g_t - (1 + 1/k) mu g_n u/|u|, a sliding point with a friction coefficient (1 + 1/k) mu;
///   v = v0 + g_t t/(1+k) + k/(1+k) (u - u0), which holds while rolling too (u = 0);
///   k r w' = n x f, f = g_t - v'; the spin about n stays.
/// Assumes: contact from the start, velocity along the plane, nothing but gravity and contact; no rolling or
/// torsional resistance.
class RollingBall {
  public:
    struct State {
        Vec3 center, velocity, spin;
    };
    RollingBall(const Scenario& scenario, int ball, int floor);

    State at(double t) const;
    PartialState exact(double t) const;
    std::optional<PartialState> schemeExact(std::size_t step, double dt, adapter::Scheme scheme) const;

    const Ball& ball() const { return ball_; }
    const PlanarSlide& slip() const { return slip_; }
    Vec3 normal() const { return plane_.normal; }
    Vec3 pull() const { return pull_; }
    double initialSlip() const { return norm(slip0_); }
    /// Slip speed at the contact in frame k [m/s].
    double slipSpeed(const Trajectory& run, std::size_t k) const;

  private:
    State fromSlip(const PlanarSlide::State& slip, double t) const;

    const Body* body_;
    Ball ball_;
    Plane plane_;
    Vec3 pull_, slip0_;
    double friction_ = 0.0;  ///< (1 + 1/k) mu g_n [m/s^2]
    double holding_ = 0.0;   ///< the same of the static coefficient
    PlanarSlide slip_;
    SlideSteps steps_;
    bool fixedAxis_ = true;  ///< the spin keeps its direction: the orientation follows from its angle
    numerics::DenseSolution orientation_;
};

}  // namespace rigor::validation
