// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The shapes of a world, and where they are in this step.
//
//     records   [ s0 | s1 | s2 ]     as built; by dense index, which is the broad-phase proxy
//     poses     [ X0 | X1 | X2 ]     world frame, at the poses that contacts were searched at
//     boxes     [ b0 | b1 | b2 ]     at those poses, around the shapes or their bounding spheres; of dynamic bodies
//                                    grown by a margin
//     centers   [ c0 | c1 | c2 ]     of bounding spheres, if the search compares them
//     movable   [  0 |  1 |  1 ]     1: the body is dynamic
//
// Invariant: after update() the arrays have one element per record. Boxes of static bodies are computed once
// and stay until changed().
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/contacts/contact_search.hpp"
#include "engine/contacts/look_ahead.hpp"
#include "engine/contacts/shape_record.hpp"
#include "engine/core/tasks.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

template <class S>
class ShapeSet {
  public:
    using Real = typename S::Real;

    std::vector<ShapeRecord<S>>& records() { return records_; }
    const std::vector<ShapeRecord<S>>& records() const { return records_; }
    const ShapeRecord<S>& operator[](std::size_t i) const { return records_[i]; }
    std::size_t size() const { return records_.size(); }
    IdTable<ShapeTag>& ids() { return ids_; }
    const IdTable<ShapeTag>& ids() const { return ids_; }

    ShapeId add(const ShapeRecord<S>& record);
    /// Removes the shapes of which the flag is 1; the others keep their order. Returns the new index of each, kNullIndex
    /// of those that are gone.
    std::vector<std::uint32_t> remove(std::span<const std::uint8_t> gone);
    /// Must be called after records or static bodies have changed.
    void changed();

    /// Poses and boxes where the bodies are. Boxes of dynamic bodies are grown by the distances of `search`, and
    /// by the motion in motionTime of those that move further.
    void update(const BodyArrays<S>& bodies, const ContactSearch<S>& search, const LookAhead<S>& ahead,
                const Tasks& tasks);

    const Pose<S>& pose(std::size_t i) const { return poses_[i]; }
    const std::vector<Aabb<S>>& boxes() const { return boxes_; }
    const Aabb<S>& box(std::size_t i) const { return boxes_[i]; }
    /// A lower bound of the distance of two shapes by their bounding spheres; 0 where they meet, have none, or are
    /// not compared [m].
    Real gapOfSpheres(std::size_t i, std::size_t k) const {
        if (!volume_.comparesSpheres) return 0;
        const Real reach = records_[i].sphere.radius + records_[k].sphere.radius;
        const Real apart = (centers_[i] - centers_[k]).squaredNorm();
        return apart > reach * reach ? std::sqrt(apart) - reach : Real(0);
    }
    /// Cache tolerance of a shape's contacts in this step; that of two shapes is the larger [m].
    Real tolerance(std::size_t i) const { return tolerance_[i]; }
    const std::vector<std::uint8_t>& movable() const { return movable_; }
    /// Distance along the relative motion of two shapes in which their contacts are looked for, up to their size; 0 if
    /// they are slow, move together, or are not looked ahead [m].
    Real motion(std::size_t i, std::size_t k) const {
        const Real most = motions_[i] + motions_[k];
        if (most == 0 || !(ahead_[i] || ahead_[k])) return 0;
        const Real relative = (ways_[i] - ways_[k]).norm() + turns_[i] + turns_[k];
        return relative > speculativeDistance_ + std::max(tolerance_[i], tolerance_[k])
                   ? std::min(relative, most)
                   : Real(0);
    }
    /// Indices of the shapes that are chains, meshes or height fields, and no sensors.
    const std::vector<std::uint32_t>& surfaces() const { return surfaces_; }

  private:
    void growByMotion(const BodyArrays<S>& bodies, std::size_t i, Real margin, Real time);

    std::vector<ShapeRecord<S>> records_;
    IdTable<ShapeTag> ids_;
    std::vector<std::uint32_t> surfaces_;
    std::vector<Pose<S>> poses_;
    std::vector<Aabb<S>> boxes_;
    std::vector<typename S::Vec> centers_;
    BoundingVolume volume_;
    std::vector<Real> tolerance_;
    std::vector<std::uint8_t> movable_;
    Real speculativeDistance_ = 0;
    std::vector<Real> motions_;          ///< motion of fast shapes, up to their size [m]
    std::vector<typename S::Vec> ways_;  ///< ahead, of their bodies' centres of mass [m]
    std::vector<Real> turns_;            ///< motion of a point by turning, at most [m]
    std::vector<std::uint8_t> ahead_;    ///< contacts of the shape are looked for ahead
    bool staticsValid_ = false;          ///< poses and boxes of static bodies are computed
};

}  // namespace rigor::engine
