// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/shape_set.hpp"

#include <algorithm>
#include <cmath>

#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kShapeGrain = 64;  ///< least number of shapes for a task: some microseconds of work

/// The box around a sphere.
template <class S>
Aabb<S> boxAround(const typename S::Vec& center, typename S::Real radius) {
    const typename S::Vec half = S::Vec::Constant(radius);
    return {center - half, center + half};
}

}  // namespace

template <class S>
ShapeId ShapeSet<S>::add(const ShapeRecord<S>& record) {
    const ShapeId id = ids_.add(static_cast<std::uint32_t>(records_.size()));
    records_.push_back(record);
    records_.back().id = id;
    return id;
}

template <class S>
std::vector<std::uint32_t> ShapeSet<S>::remove(std::span<const std::uint8_t> gone) {
    std::vector<std::uint32_t> newIndex(records_.size(), kNullIndex);
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < records_.size(); ++i) {
        if (gone[i]) {
            ids_.remove(records_[i].id);
            continue;
        }
        ids_.move(records_[i].id, kept);
        if (kept != i) records_[kept] = records_[i];
        newIndex[i] = kept++;
    }
    records_.resize(kept);
    return newIndex;
}

template <class S>
void ShapeSet<S>::changed() {
    staticsValid_ = false;
    surfaces_.clear();
    for (std::uint32_t i = 0; i < records_.size(); ++i)
        if (isComposite<S>(records_[i].shape) && !records_[i].sensor) surfaces_.push_back(i);
}

template <class S>
void ShapeSet<S>::update(const BodyArrays<S>& bodies, const ContactSearch<S>& search,
                         const LookAhead<S>& ahead, const Tasks& tasks) {
    const std::size_t n = records_.size();
    poses_.resize(n);
    boxes_.resize(n);
    movable_.resize(n);
    motions_.resize(n);
    ways_.resize(n);
    turns_.resize(n);
    speculativeDistance_ = search.speculativeDistance;
    ahead_.resize(n);
    const Real motionTime = search.longestMotionTime();
    tolerance_.resize(n, search.cacheTolerance);
    volume_ = search.volume;
    if (volume_.comparesSpheres) centers_.resize(n);
    tasks.forEach(n, kShapeGrain, [&](std::size_t i) {
        const ShapeRecord<S>& record = records_[i];
        const bool isStatic = bodies.constants[record.body].type == BodyType::Static;
        if (isStatic && staticsValid_) return;
        poses_[i] = compose<S>(bodies.pose[record.body], record.local);
        if (volume_.comparesSpheres) centers_[i] = toWorld<S>(poses_[i], record.sphere.center);
        boxes_[i] = volume_.boxesOfSpheres && std::isfinite(record.sphere.radius)
                        ? boxAround<S>(centers_[i], record.sphere.radius)
                        : boundingBox<S>(record.shape, poses_[i]);
        movable_[i] = bodies.constants[record.body].type == BodyType::Dynamic;
        tolerance_[i] = search.toleranceOf(bodies.islands[record.body]);
        if (movable_[i]) {
            const typename S::Vec grown = S::Vec::Constant(search.speculativeDistance + tolerance_[i]);
            boxes_[i].min -= grown;
            boxes_[i].max += grown;
        }
        motions_[i] = turns_[i] = 0;
        ways_[i].setZero();
        ahead_[i] = search.motionTime > 0 || bodies.islands[record.body] == IslandKind::Large;
        if (!isStatic && motionTime > 0)
            growByMotion(bodies, i, search.speculativeDistance + tolerance_[i], motionTime);
        if (!isStatic && ahead.looksAhead()) ahead.growBox(static_cast<std::uint32_t>(i), boxes_[i]);
    });
    staticsValid_ = true;
}

template <class S>
void ShapeSet<S>::growByMotion(const BodyArrays<S>& bodies, std::size_t i, Real margin, Real time) {
    using Vec = typename S::Vec;
    const ShapeRecord<S>& record = records_[i];
    const Velocity<S>& velocity = bodies.velocity[record.body];
    const Vec way = time * velocity.v;
    const Real turn = time * std::sqrt(dotAng(velocity.w, velocity.w)) * record.boundingRadius;
    const Real motion = way.norm() + turn;
    ways_[i] = way;
    turns_[i] = turn;
    if (!(motion > margin)) return;
    const Real share = std::min(Real(1), Real(2) * record.radius / motion);
    motions_[i] = share * motion;
    const Vec around = Vec::Constant(share * turn), ahead = share * way;
    boxes_[i].min += ahead.cwiseMin(Real(0)) - around;
    boxes_[i].max += ahead.cwiseMax(Real(0)) + around;
}

RIGOR_INSTANTIATE_CLASS(ShapeSet)

}  // namespace rigor::engine
