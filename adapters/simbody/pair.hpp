// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Coordinates of joints between any two bodies, as functions of their motions: those for which Simbody has no mobilizer,
// and all those of joints beside the trees.
#pragma once

#include <optional>
#include <vector>

#include "adapters/simbody/convert.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::simbody {

/// A body of the scenario as one of Simbody's: the pose of the scenario's body frame in the frame of Simbody's body.
struct Frame {
    SimTK::MobilizedBody body;
    Pose pose;
};

/// The two sides of a joint.
struct Sides {
    const scenario::Joint& joint;
    Frame a, b;
    Quat relative;  ///< turns from B's frame to A's at the initial poses
    bool planar = false;
};

enum class PairKind {
    Length,  ///< distance of the anchors
    Travel,  ///< place of B's anchor along an axis of A
    Turn,  ///< twist about an axis of A, what is left of the turn before the shortest turn of the axis, in (-pi, pi]
    Swing,   ///< angle between the two axes
    SwingY,  ///< the shortest turn of the axis as a vector, by its parts along two normals of A
    SwingZ,
};

/// A coordinate u with its gradient: du/dt = a . V_A + b . V_B, where V are angular velocity and velocity of the origin.
/// Poses and velocities are in one common frame. `axis` and `normal` are in the scenario's frame of A.
class PairCoordinate {
  public:
    PairCoordinate(PairKind kind, const Sides& sides, const Vec3& axis = {1, 0, 0});
    PairCoordinate(PairKind kind, const Sides& sides, const Vec3& axis, const Vec3& normal);

    struct Poses {
        SimTK::Transform a, b;
    };
    struct Motions {
        SimTK::SpatialVec a, b;
    };

    double value(const Poses& at) const;
    Motions gradient(const Poses& at) const;
    static double product(const Motions& gradient, const Motions& motions) {
        return ~gradient.a * motions.a + ~gradient.b * motions.b;
    }
    /// Second derivative of u while the two bodies have no accelerations.
    double bias(const Poses& at, const Motions& motions) const;

    const SimTK::MobilizedBody& a() const { return a_; }
    const SimTK::MobilizedBody& b() const { return b_; }
    bool countsTurns() const { return kind_ == PairKind::Turn; }

    Poses poses(const SimTK::State& state) const {
        return {a_.getBodyTransform(state), b_.getBodyTransform(state)};
    }
    Motions motions(const SimTK::State& state) const {
        return {a_.getBodyVelocity(state), b_.getBodyVelocity(state)};
    }

  private:
    struct Turned;
    SimTK::Vec3 direction(const Turned& turned) const;

    PairKind kind_;
    SimTK::MobilizedBody a_, b_;
    SimTK::Vec3 anchorA_, anchorB_;          ///< frames of Simbody's bodies
    SimTK::Vec3 x_, y_, z_, axisB_, sideB_;  ///< axis and normals in A's frame; axis and first normal in B's
};

/// A coordinate with the spring and the motor on it.
struct Driven {
    PairCoordinate coordinate;
    scenario::JointAxis use;
};
/// Coordinates of a joint that have a spring or a motor. In a tree these are only the ones for which the joint has no
/// mobilizer.
std::vector<Driven> drivenCoordinates(const Sides& sides, bool inTree);

/// Angles of a six_dof that are open.
int openAngles(const scenario::Joint& joint);
bool isOpen(const scenario::JointAxis& axis);

}  // namespace rigor::simbody
