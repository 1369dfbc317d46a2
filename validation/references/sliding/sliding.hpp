// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A flat-based body that slides on a plane without tipping: shared by sliding_stop, incline_slide and
// friction_sweep.
#pragma once

#include "validation/references/sliding/planar_slide.hpp"

namespace rigor::validation {

/// Assumes: the body rests on a flat side (or its lowest points) with no gap, velocity along the plane, no
/// spin, nothing but gravity and contact, and the pressure that balances gravity and friction falls inside
/// the contact area (it does not tip). Restitution plays no part: the normal velocity is zero throughout.
class SlidingBody {
  public:
    SlidingBody(const Scenario& scenario, int body, int floor);

    int index() const { return index_; }
    PartialState exact(double t) const;
    std::optional<PartialState> schemeExact(std::size_t step, double dt, adapter::Scheme scheme) const;
    const PlanarSlide& slide() const { return slide_; }
    Vec3 normal() const { return plane_.normal; }
    double pull() const { return norm(pull_); }             ///< |g| along the plane [m/s^2]
    double speed() const { return norm(body_->velocity); }  ///< initial [m/s]

    /// Distance from the start along the plane in frame k [m].
    double distance(const Trajectory& run, std::size_t k) const;
    /// stop_time, stop_distance where it stops within the duration; names end in `suffix`.
    void addStopQuantities(std::vector<Quantity>& result, const std::string& suffix, double dt,
                           adapter::Scheme scheme) const;

  private:
    void requireNoTipping(const Support& support) const;

    const Scenario* scenario_;
    const Body* body_;
    int index_;
    Plane plane_;
    Vec3 com_, pull_;
    double load_ = 0.0, mu_ = 0.0;  ///< normal acceleration [m/s^2], coefficient of sliding
    bool isOneCoefficient_ = true;  ///< static friction is that of sliding
    PlanarSlide slide_;
    SlideSteps steps_;
};

}  // namespace rigor::validation
