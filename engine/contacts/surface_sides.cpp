// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/surface_sides.hpp"

#include "engine/shapes/ray_cast.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kSideGrain = 256;  ///< least number of shapes for a task: some microseconds of work

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

namespace {

template <class S>
typename S::Vec middleNow(const ShapeRecord<S>& shape, const BodyArrays<S>& bodies) {
    return toWorld<S>(compose<S>(bodies.pose[shape.body], shape.local), shape.middle);
}

/// Takes the middle of a shape, `now`, to the side of all surfaces that it had at `begin`. False: it is there.
template <class S>
bool stayOnSide(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter, const BodyArrays<S>& bodies,
                std::uint32_t shape, const Pose<S>& begin, typename S::Vec& now) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    constexpr Real kGap = Real(0.05);  ///< distance kept from the surface, in inscribed radii
    constexpr int kMostRounds = 3;     ///< a shape moved back by one surface may have crossed another
    const ShapeRecord<S>& record = shapes[shape];
    const Vec before = toWorld<S>(begin, record.middle);
    bool any = false;
    for (int round = 0; round < kMostRounds; ++round) {
        bool moved = false;
        for (const std::uint32_t surface : shapes.surfaces()) {
            if (!Aabb<S>{before.cwiseMin(now), before.cwiseMax(now)}.overlaps(shapes.box(surface))) continue;
            if (!filter.mayCollide(bodies, record, shapes[surface])) continue;
            const Pose<S>& X = shapes.pose(surface);
            Vec x = toLocal<S>(X, now);
            if (!stayOnSideOf<S>(shapes[surface].shape, toLocal<S>(X, before), x,
                                 kGap * record.inscribedRadius))
                continue;
            now = toWorld<S>(X, x);
            moved = any = true;
        }
        if (!moved || shapes.surfaces().size() == 1) return any;
    }
    now = before;
    return true;
}

}  // namespace

/// `begin`: the pose of a shape, by its index.
template <class S>
template <class Begin>
void SurfaceSides<S>::keepFrom(const Begin& begin, const ShapeSet<S>& shapes,
                               const CollisionFilter<S>& filter, BodyArrays<S>& bodies, const Tasks& tasks) {
    using Vec = typename S::Vec;
    if (shapes.surfaces().empty()) return;
    crossed_.resize(shapes.size());
    tasks.forEach(shapes.size(), kSideGrain, [&](std::size_t i) {
        const auto shape = static_cast<std::uint32_t>(i);
        crossed_[i] = 0;
        if (!shapes.movable()[i] || bodies.asleep[shapes[i].body]) return;
        Vec now = middleNow<S>(shapes[i], bodies);
        crossed_[i] = stayOnSide<S>(shapes, filter, bodies, shape, begin(shape), now);
    });
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        if (!crossed_[i]) continue;
        const Vec there = middleNow<S>(shapes[i], bodies);
        Vec now = there;
        if (stayOnSide<S>(shapes, filter, bodies, i, begin(i), now))
            bodies.pose[shapes[i].body].p += now - there;
    }
}

template <class S>
void SurfaceSides<S>::keep(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter, BodyArrays<S>& bodies,
                           const Tasks& tasks) {
    keepFrom([&](std::uint32_t shape) { return shapes.pose(shape); }, shapes, filter, bodies, tasks);
}

template <class S>
void SurfaceSides<S>::keepOfMidpoints(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter,
                                      BodyArrays<S>& bodies, const Tasks& tasks) {
    const Midpoints<S>& midpoints = bodies.midpoints;
    const auto begin = [&](std::uint32_t shape) {
        const std::uint32_t body = shapes[shape].body;
        return midpoints.valid[body] ? compose<S>(midpoints.pose[body], shapes[shape].local)
                                     : shapes.pose(shape);
    };
    keepFrom(begin, shapes, filter, bodies, tasks);
}

#define RIGOR_INSTANTIATE(S) template bool stayOnSideOf<S>(const Shape<S>&, const S::Vec&, S::Vec&, S::Real);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE
RIGOR_INSTANTIATE_CLASS(SurfaceSides)

}  // namespace rigor::engine
