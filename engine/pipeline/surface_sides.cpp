// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/surface_sides.hpp"

#include <utility>

#include "engine/queries/ray_cast.hpp"

namespace rigor::engine {

namespace {

/// Goes from p towards `to` until the surface is `gap` away. True: it was in the way.
template <class S>
bool approach(const Shape<S>& surface, typename S::Vec& p, typename S::Vec to, typename S::Real gap,
              RayHit<S>& hit) {
    const typename S::Vec way = to - p;
    if (way.squaredNorm() > 0 && castRay<S>(surface, {}, p, way, hit)) {
        const typename S::Vec back = p - hit.point;
        const typename S::Real distance = back.norm();
        if (distance > gap) p = hit.point + (gap / distance) * back;
        return true;
    }
    p = to;
    return false;
}

}  // namespace

template <class S>
void SurfaceSides<S>::begin() {
    std::swap(known_, old_);
    known_.clear();
    next_ = 0;
}

template <class S>
typename SurfaceSides<S>::Place SurfaceSides<S>::place(std::uint64_t key, const Shape<S>& surface,
                                                       const Pose<S>& Xsurface, const Vec& before,
                                                       const Vec& now, Real gap) {
    while (next_ < old_.size() && old_[next_].key < key) ++next_;
    Place place;
    place.middle = toLocal<S>(Xsurface, now);
    const bool met = next_ < old_.size() && old_[next_].key == key;
    place.proper = met ? old_[next_].proper : toLocal<S>(Xsurface, before);
    // Straight ahead, and along what is in the way, over hill and dale, to where the middle is nearest.
    constexpr int kMostTurns = 8;
    RayHit<S> hit;
    for (int i = 0; i < kMostTurns; ++i) {
        place.through = kNone;
        if (!approach<S>(surface, place.proper, place.middle, gap, hit)) break;
        place.through = hit.piece;
        const Vec way = place.middle - place.proper;
        const Vec along = way - hit.normal.dot(way) * hit.normal;
        if (along.squaredNorm() <= gap * gap) break;
        approach<S>(surface, place.proper, place.proper + along, gap, hit);
    }
    known_.push_back({key, place.proper});
    return place;
}

template class SurfaceSides<Space2f>;
template class SurfaceSides<Space2d>;
template class SurfaceSides<Space3f>;
template class SurfaceSides<Space3d>;

}  // namespace rigor::engine
