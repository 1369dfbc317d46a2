// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A shape on a body that moves with constant velocity and angular velocity, and the two sizes of it that
// decide how far it may move unseen.
#pragma once

#include "engine/contacts/shape_record.hpp"
#include "engine/math/rotation.hpp"
#include "engine/math/space.hpp"
#include "engine/shapes/inner_sphere.hpp"
#include "engine/shapes/shape.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Bounding radius of the shape's core about a point at `local.p` beyond its frame's origin, i.e. about the
/// body's centre of mass [m]. The core is the shape without its rounding radius: the turning of a sphere
/// about its own centre moves nothing.
template <class S>
typename S::Real coreBoundingRadius(const Shape<S>& shape, const Pose<S>& local);

/// Pose after t [s] of a body that starts at X.
template <class S>
Pose<S> movedPose(const Pose<S>& X, const Velocity<S>& velocity, typename S::Real t) {
    return {X.p + t * velocity.v, rotatedBy(X.q, typename S::Ang(t * velocity.w))};
}

template <class S>
struct MovingShape {
    const Shape<S>* shape = nullptr;
    Pose<S> local;                         ///< pose in the frame at the body's centre of mass
    Pose<S> body;                          ///< pose of that frame, at time 0
    Velocity<S> velocity;                  ///< constant
    typename S::Real boundingRadius = 0;   ///< coreBoundingRadius [m]
    typename S::Real inscribedRadius = 0;  ///< inscribedRadiusOf [m]
    Pose<S> at(typename S::Real t) const { return compose<S>(movedPose<S>(body, velocity, t), local); }
    /// Bound on the path of any of its points over t [m].
    typename S::Real motion(typename S::Real t) const {
        return t * (velocity.v.norm() + std::sqrt(dotAng(velocity.w, velocity.w)) * boundingRadius);
    }
};

/// A shape on its body, whose frame at the centre of mass is at `body` at time 0.
template <class S>
MovingShape<S> movingShape(const ShapeRecord<S>& shape, const Pose<S>& body, const Velocity<S>& velocity) {
    return {&shape.shape, shape.local, body, velocity, shape.boundingRadius, shape.inscribedRadius};
}

/// The constant velocity that leads from `start` to `end` in h [s]. The rotation is the one by h * used,
/// which may be more than half a turn, and what else has turned the body since.
template <class S>
Velocity<S> straightVelocity(const Pose<S>& start, const Pose<S>& end, const Velocity<S>& used,
                             typename S::Real h) {
    const auto rest = compose(end.q, inverse(rotatedBy(start.q, typename S::Ang(h * used.w))));
    return {(end.p - start.p) / h, used.w + logMap(rest) / h};
}

/// |n x w| of a unit vector and an angular velocity: no point at r turns faster along n than |r| times that.
template <class R>
R turningAcross(const Eigen::Matrix<R, 2, 1>&, R w) {
    return std::abs(w);
}
template <class R>
R turningAcross(const Eigen::Matrix<R, 3, 1>& n, const Eigen::Matrix<R, 3, 1>& w) {
    return n.cross(w).norm();
}

/// True if both may cross each other within t [s] without an overlap at the start or the end: their relative
/// motion is more than half of the sum of their thicknesses.
template <class S>
bool mayPassUnseen(const MovingShape<S>& a, const MovingShape<S>& b, typename S::Real t);

/// Contains the shape during [0, t].
template <class S>
Aabb<S> sweptBox(const MovingShape<S>& shape, typename S::Real t);

}  // namespace rigor::engine
