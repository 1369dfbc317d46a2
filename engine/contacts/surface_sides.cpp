// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/surface_sides.hpp"

#include "engine/contacts/contact_set.hpp"
#include "engine/shapes/ray_cast.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kShapeGrain = 256;  ///< worth a task: some microseconds of work

template <class S>
bool blocked(const Shape<S>& surface, const typename S::Vec& from, const typename S::Vec& to,
             RayHit<S>& hit) {
    const typename S::Vec way = to - from;
    return way.squaredNorm() > 0 && castRay<S>(surface, {}, from, way, hit);
}

}  // namespace

template <class S>
bool stayOnSideOf(const Shape<S>& surface, const typename S::Vec& before, typename S::Vec& now,
                  typename S::Real gap) {
    using R = typename S::Real;
    using V = typename S::Vec;
    constexpr int kMostTurns = 8;
    RayHit<S> hit;
    if (!blocked<S>(surface, before, now, hit)) return false;
    V p = before, x = now;
    for (int turn = 0; turn < kMostTurns; ++turn) {
        const V back = p - hit.point;
        const R height = hit.normal.dot(back);
        if (height > gap) p = hit.point + (gap / height) * back;
        x += std::max(R(0), gap - hit.normal.dot(x - hit.point)) * hit.normal;
        if (!blocked<S>(surface, p, x, hit)) {
            now = x;
            return true;
        }
    }
    now = p;
    return true;
}

template <class S>
typename S::Vec ContactSet<S>::middleNow(const BodyArrays<S>& bodies, std::uint32_t shape) const {
    const ShapeRecord<S>& record = shapes_[shape];
    return toWorld<S>(compose<S>(bodies.pose[record.body], record.local), record.middle);
}

/// Takes the middle of a shape, `now`, to its side of all surfaces. False: it is there.
template <class S>
bool ContactSet<S>::stayOnSide(const BodyArrays<S>& bodies, std::uint32_t shape, Vec& now) const {
    constexpr Real kGap = Real(0.05);  ///< of the inner radius
    constexpr int kMostRounds = 3;     ///< what one surface sends back may pass another
    const ShapeRecord<S>& record = shapes_[shape];
    const Vec before = toWorld<S>(shapePoses_[shape], record.middle);
    bool any = false;
    for (int round = 0; round < kMostRounds; ++round) {
        bool moved = false;
        for (const std::uint32_t surface : surfaces_) {
            if (!Aabb<S>{before.cwiseMin(now), before.cwiseMax(now)}.overlaps(boxes_[surface])) continue;
            if (!mayCollide(bodies, record.body, shapes_[surface].body)) continue;
            const Pose<S>& X = shapePoses_[surface];
            Vec x = toLocal<S>(X, now);
            if (!stayOnSideOf<S>(shapes_[surface].shape, toLocal<S>(X, before), x,
                                 kGap * record.inscribedRadius))
                continue;
            now = toWorld<S>(X, x);
            moved = any = true;
        }
        if (!moved || surfaces_.size() == 1) return any;
    }
    now = before;
    return true;
}

template <class S>
void ContactSet<S>::keepSides(BodyArrays<S>& bodies, const Tasks& tasks) {
    if (surfaces_.empty()) return;
    crossed_.resize(shapes_.size());
    tasks.forEach(shapes_.size(), kShapeGrain, [&](std::size_t i) {
        const auto shape = static_cast<std::uint32_t>(i);
        crossed_[i] = 0;
        if (!movable_[i] || bodies.asleep[shapes_[i].body]) return;
        Vec now = middleNow(bodies, shape);
        crossed_[i] = stayOnSide(bodies, shape, now);
    });
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
        if (!crossed_[i]) continue;
        const Vec there = middleNow(bodies, i);
        Vec now = there;
        if (stayOnSide(bodies, i, now)) bodies.pose[shapes_[i].body].p += now - there;
    }
}

#define RIGOR_INSTANTIATE(S)                                                                     \
    template bool stayOnSideOf<S>(const Shape<S>&, const S::Vec&, S::Vec&, S::Real);             \
    template S::Vec ContactSet<S>::middleNow(const BodyArrays<S>&, std::uint32_t) const;         \
    template bool ContactSet<S>::stayOnSide(const BodyArrays<S>&, std::uint32_t, S::Vec&) const; \
    template void ContactSet<S>::keepSides(BodyArrays<S>&, const Tasks&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
