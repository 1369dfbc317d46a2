// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies on one line that collide centrally, event by event: shared by collision_1d and newtons_cradle.
#pragma once

#include "validation/references/parts.hpp"

namespace rigor::validation {

/// Each impact is between two bodies: va' = V - e mb u/M, vb' = V + e ma u/M with u = va - vb, V the velocity
/// of the pair's centre of mass (Newton's law of restitution). Between impacts the motion is uniform.
/// Assumes: centres of mass on one line, velocities along it, no spin, spheres or boxes (or a fixed
/// half-space) that collide with their normals along it, and the same gravity on all (then in free fall
/// together).
class LineCollisions {
  public:
    struct Impact {
        double time = 0.0;
        int first = 0, second = 0;  ///< scenario indices, in order along the line
    };
    LineCollisions(const Scenario& scenario, std::vector<int> bodies, bool gapsNeeded);

    const std::vector<int>& bodies() const { return bodies_; }  ///< bodies in order along the line
    Vec3 direction() const { return direction_; }
    Vec3 gravity() const { return gravity_; }
    const std::vector<Impact>& impacts() const { return impacts_; }
    double validUntil() const { return validUntil_; }
    PartialState exact(int body, double t) const;
    /// True if the last impact of all is within the duration: no neighbours collide later either.
    bool isOver() const;
    /// Velocity along the line after the last impact within a run, relative to the fall [m/s].
    double velocityAfter(int body) const;
    double velocityBefore(int body) const;  ///< initial, along the line
    double energyLoss() const;              ///< kinetic energy lost in the impacts [J]

  private:
    struct Member {
        double position = 0.0, velocity = 0.0, mass = 0.0;  ///< mass 0: fixed
        double low = 0.0, high = 0.0;                       ///< reach from the centre of mass, both >= 0
        int lowMaterial = 0, highMaterial = 0;
    };
    struct Phase {
        double start = 0.0;
        std::vector<Member> members;
    };
    Member memberOf(int body) const;
    std::size_t slot(int body) const;
    void run(double end);
    bool nextImpact(const Phase& phase, double& time, std::size_t& left, bool& clash) const;

    const Scenario& scenario_;
    std::vector<int> bodies_;
    Vec3 direction_, origin_, gravity_;
    std::vector<Phase> phases_;
    std::vector<Impact> impacts_;
    double validUntil_ = 1e300;
};

}  // namespace rigor::validation
