// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/queries/world_queries.hpp"

#include <algorithm>
#include <limits>

#include "engine/core/error.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/shape_overlap.hpp"
#include "engine/narrowphase/surface_contact.hpp"
#include "engine/queries/shape_cast.hpp"

namespace rigor::engine {
namespace {

template <class S>
void requireRay(const typename S::Vec& origin, const typename S::Vec& translation) {
    if (!origin.allFinite() || !translation.allFinite() || !(translation.squaredNorm() > 0))
        throw EngineError("query_ray", "a ray needs finite numbers and a translation");
}
template <class S>
void requireConvex(const Shape<S>& shape, const Pose<S>& X) {
    if (isComposite<S>(shape) || std::holds_alternative<HalfSpace<S>>(shape))
        throw EngineError("query_shape", std::string("not with a ") + shapeName<S>(shape));
    if (!X.p.allFinite()) throw EngineError("query_shape", "the pose must be finite");
}

template <class R>
bool isSame(const Rot2<R>& p, const Rot2<R>& q) {
    return p.c == q.c && p.s == q.s;
}
template <class R>
bool isSame(const Eigen::Quaternion<R>& p, const Eigen::Quaternion<R>& q) {
    return p.coeffs() == q.coeffs();
}

/// Distance between two boxes; 0 where they overlap.
template <class S>
typename S::Real gap(const Aabb<S>& a, const Aabb<S>& b) {
    using V = typename S::Vec;
    return V((a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(V::Zero())).norm();
}
template <class S>
Aabb<S> swept(Aabb<S> box, const typename S::Vec& translation) {
    box.min += translation.cwiseMin(S::Vec::Zero());
    box.max += translation.cwiseMax(S::Vec::Zero());
    return box;
}

}  // namespace

template <class S>
WorldQueries<S>::WorldQueries(const World<S>& world) : world_(&world) {
    update();
}

template <class S>
void WorldQueries<S>::update() {
    const std::span<const ShapeRecord<S>> records = world_->shapes();
    matchShapes();
    outside_.clear();
    loose_ = 0;
    for (std::uint32_t i = 0; i < records.size(); ++i) {
        const Pose<S> X = world_->shapePose(records[i]);
        Entry& entry = entries_[i];
        const bool moved = entry.record == nullptr || X.p != entry.X.p || !isSame(X.q, entry.X.q);
        entry = {&records[i], X, world_->bodyOf(records[i])};
        if (records[i].sensor) continue;
        if (moved) boxes_[i] = boundingBox<S>(records[i].shape, X);
        if (!isLoose(i)) {
            leafBoxes_[leafOf_[i]] = boxes_[i];
            continue;
        }
        outside_.push_back(i);
        loose_ += !BroadPhase<S>::unbounded(boxes_[i]);
    }
    const Real size = tree_.refit(leafBoxes_);
    constexpr std::uint32_t kFewest = 16;  // shapes whose search one by one costs no more than the tree's
    const auto many = std::max(kFewest, static_cast<std::uint32_t>(records.size() / 8));
    // Twice the diagonals: about twice the nodes that a query visits.
    if (removed_ + loose_ > many || (builds_ == 0 && loose_ > 0) || size > Real(2) * builtSize_) build();
}

/// Shapes keep their order when others are removed, and new ones come last.
template <class S>
void WorldQueries<S>::matchShapes() {
    const std::span<const ShapeRecord<S>> records = world_->shapes();
    bool same = records.size() == ids_.size();
    for (std::size_t i = 0; same && i < ids_.size(); ++i) same = records[i].id == ids_[i];
    if (same) return;
    std::size_t kept = 0;
    for (std::size_t old = 0; old < ids_.size(); ++old) {
        if (kept < records.size() && records[kept].id == ids_[old]) {
            entries_[kept] = entries_[old];
            boxes_[kept] = boxes_[old];
            leafOf_[kept] = leafOf_[old];
            if (!isLoose(static_cast<std::uint32_t>(kept)))
                entryOf_[leafOf_[kept]] = static_cast<std::uint32_t>(kept);
            ++kept;
            continue;
        }
        if (leafOf_[old] == kNullIndex) continue;
        constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
        entryOf_[leafOf_[old]] = kNullIndex;
        leafBoxes_[leafOf_[old]] = {Vec::Constant(kInfinity), Vec::Constant(-kInfinity)};
        ++removed_;
    }
    entries_.resize(records.size());
    ids_.resize(records.size());
    boxes_.resize(records.size());
    leafOf_.resize(records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        ids_[i] = records[i].id;
        if (i < kept) continue;
        entries_[i].record = nullptr;
        leafOf_[i] = kNullIndex;
    }
}

template <class S>
void WorldQueries<S>::build() {
    entryOf_.clear();
    leafBoxes_.clear();
    outside_.clear();
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        leafOf_[i] = kNullIndex;
        if (entries_[i].record->sensor) continue;
        if (BroadPhase<S>::unbounded(boxes_[i])) {
            outside_.push_back(i);
            continue;
        }
        leafOf_[i] = static_cast<std::uint32_t>(entryOf_.size());
        entryOf_.push_back(i);
        leafBoxes_.push_back(boxes_[i]);
    }
    tree_.build(leafBoxes_);
    builtSize_ = tree_.refit(leafBoxes_);
    removed_ = loose_ = 0;
    ++builds_;
}

/// use(i) for each entry whose box `enter` takes.
template <class S>
template <class Enter, class Visit>
void WorldQueries<S>::visit(Enter enter, const Filter& filter, Visit use) const {
    const auto test = [&](std::uint32_t i) {
        if (filter(entries_[i].body, entries_[i].record->filter)) use(i);
    };
    for (const std::uint32_t i : outside_)
        if (enter(boxes_[i])) test(i);
    tree_.walk(enter, [&](std::uint32_t leaf) {
        if (entryOf_[leaf] != kNullIndex) test(entryOf_[leaf]);
    });
}

template <class S>
std::optional<WorldRayHit<S>> WorldQueries<S>::castRay(const Vec& origin, const Vec& translation,
                                                       const Filter& filter) const {
    requireRay<S>(origin, translation);
    std::optional<WorldRayHit<S>> best;
    std::uint32_t first = kNullIndex;
    Real limit = 1;
    visit([&](const Aabb<S>& box) { return rayMeetsBox<S>(origin, translation, limit, box); }, filter,
          [&](std::uint32_t i) {
              RayHit<S> hit;
              const Entry& entry = entries_[i];
              if (!engine::castRay<S>(entry.record->shape, entry.X, origin, translation, hit)) return;
              if (best && (hit.fraction > best->fraction || (hit.fraction == best->fraction && i > first)))
                  return;
              best = {ref(i, hit.piece), hit.fraction, hit.point, hit.normal, hit.startsInside};
              first = i;
              limit = hit.fraction;
          });
    return best;
}

template <class S>
std::vector<WorldRayHit<S>> WorldQueries<S>::castRayAll(const Vec& origin, const Vec& translation,
                                                        const Filter& filter) const {
    requireRay<S>(origin, translation);
    std::vector<std::pair<std::uint32_t, WorldRayHit<S>>> found;
    visit([&](const Aabb<S>& box) { return rayMeetsBox<S>(origin, translation, Real(1), box); }, filter,
          [&](std::uint32_t i) {
              RayHit<S> hit;
              const Entry& entry = entries_[i];
              if (engine::castRay<S>(entry.record->shape, entry.X, origin, translation, hit))
                  found.push_back(
                      {i, {ref(i, hit.piece), hit.fraction, hit.point, hit.normal, hit.startsInside}});
          });
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return a.second.fraction < b.second.fraction ||
               (a.second.fraction == b.second.fraction && a.first < b.first);
    });
    std::vector<WorldRayHit<S>> hits;
    for (const auto& f : found) hits.push_back(f.second);
    return hits;
}

template <class S>
std::optional<ShapeCastHit<S>> WorldQueries<S>::castShape(const Shape<S>& shape, const Pose<S>& X,
                                                          const Vec& translation,
                                                          const Filter& filter) const {
    requireConvex<S>(shape, X);
    requireRay<S>(X.p, translation);
    std::optional<ShapeCastHit<S>> best;
    std::uint32_t first = kNullIndex;
    Real most = 1;
    const auto consider = [&](std::uint32_t i, std::uint32_t piece, const CastResult<S>& r) {
        if (!r.touches) return;
        if (best && (r.fraction > best->fraction ||
                     (r.fraction == best->fraction && (i > first || (i == first && piece > best->piece)))))
            return;
        best = {ref(i, piece), r.fraction, r.point, r.normal, r.startsTouching, r.converged};
        first = i;
        most = r.fraction;
    };
    const Aabb<S> way = swept<S>(boundingBox<S>(shape, X), translation);
    visit([&](const Aabb<S>& box) { return way.overlaps(box); }, filter,
          [&](std::uint32_t i) {
              const Entry& entry = entries_[i];
              if (!isComposite<S>(entry.record->shape)) {
                  consider(i, kNullIndex,
                           castConvex<S>(shape, X, translation, entry.record->shape, entry.X, most));
                  return;
              }
              const Vec local = rotateInverse<Real>(entry.X.q, translation);
              const Aabb<S> near = swept<S>(boxOnSurface<S>(entry.X, shape, X, Real(0)), local);
              withSurface<S>(entry.record->shape, [&](const auto& data) {
                  data.query(near, [&](std::uint32_t piece) {
                      const Shape<S> part = data.piece(piece);
                      consider(i, piece, castConvex<S>(shape, X, translation, part, entry.X, most));
                  });
              });
          });
    return best;
}

template <class S>
std::vector<ShapeRef> WorldQueries<S>::overlapping(const Shape<S>& shape, const Pose<S>& X,
                                                   const Filter& filter) const {
    requireConvex<S>(shape, X);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    const Aabb<S> own = boundingBox<S>(shape, X);
    visit([&](const Aabb<S>& box) { return own.overlaps(box); }, filter,
          [&](std::uint32_t i) {
              const Entry& entry = entries_[i];
              if (const auto piece = findOverlap<S>(shape, X, entry.record->shape, entry.X))
                  found.push_back({i, *piece});
          });
    std::sort(found.begin(), found.end());
    std::vector<ShapeRef> refs;
    for (const auto& [i, piece] : found) refs.push_back(ref(i, piece));
    return refs;
}

template <class S>
std::vector<ShapeRef> WorldQueries<S>::inBox(const Aabb<S>& box, const Filter& filter) const {
    std::vector<std::uint32_t> found;
    visit([&](const Aabb<S>& b) { return b.overlaps(box); }, filter,
          [&](std::uint32_t i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    std::vector<ShapeRef> refs;
    for (const std::uint32_t i : found) refs.push_back(ref(i, kNullIndex));
    return refs;
}

template <class S>
std::optional<NearestHit<S>> WorldQueries<S>::nearest(const Shape<S>& shape, const Pose<S>& X, Real most,
                                                      const Filter& filter) const {
    requireConvex<S>(shape, X);
    if (!(most >= 0)) throw EngineError("query_distance", "the largest distance must not be negative");
    std::optional<NearestHit<S>> best;
    std::uint32_t first = kNullIndex;
    const auto consider = [&](std::uint32_t i, std::uint32_t piece, const Shape<S>& other) {
        const ClosestPoints<S> c = closestPoints<S>(shape, X, other, entries_[i].X);
        if (c.distance > most) return;
        if (best && (c.distance > best->distance ||
                     (c.distance == best->distance && (i > first || (i == first && piece > best->piece)))))
            return;
        best = {ref(i, piece), c.distance, c.pointA, c.pointB, c.normal};
        first = i;
        most = std::max(Real(0), c.distance);  // overlapping shapes all have boxes at gap 0
    };
    const Aabb<S> own = boundingBox<S>(shape, X);
    visit([&](const Aabb<S>& box) { return gap<S>(own, box) <= most; }, filter,
          [&](std::uint32_t i) {
              const Entry& entry = entries_[i];
              if (!isComposite<S>(entry.record->shape)) {
                  consider(i, kNullIndex, entry.record->shape);
                  return;
              }
              withSurface<S>(entry.record->shape, [&](const auto& data) {
                  data.query(boxOnSurface<S>(entry.X, shape, X, most),
                             [&](std::uint32_t piece) { consider(i, piece, Shape<S>(data.piece(piece))); });
              });
          });
    return best;
}

template <class S>
std::optional<NearestHit<S>> WorldQueries<S>::nearest(const Vec& point, Real most,
                                                      const Filter& filter) const {
    Pose<S> X;
    X.p = point;
    return nearest(Shape<S>(Sphere<S>{Real(0)}), X, most, filter);
}

RIGOR_INSTANTIATE_CLASS(WorldQueries)

}  // namespace rigor::engine
