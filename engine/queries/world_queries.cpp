// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/queries/world_queries.hpp"

#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/narrowphase/distance.hpp"
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

/// True if the lowest point of the shape is in the solid under a height field.
template <class S>
bool underField(const Shape<S>& field, const Pose<S>& Xf, const Shape<S>& shape, const Pose<S>& X) {
    if constexpr (S::dim == 3) {
        const auto* f = std::get_if<HeightField<S>>(&field);
        if (!f) return false;
        const Pose<S> local{toLocal<S>(Xf, X.p), compose(inverse(Xf.q), X.q)};
        using R = typename S::Real;
        using V = typename S::Vec;
        const V low = toWorld<S>(local, support<S>(shape, rotateInverse<R>(local.q, V(-V::UnitY()))));
        const auto& d = *f->data;
        if (low.y() < d.lowest - d.thickness || low.y() > d.highest) return false;
        RayHit<S> hit;
        return castRay<S>(field, Pose<S>{}, low, V(0, d.highest - low.y() + d.thickness, 0), hit);
    } else {
        (void)field;
        (void)Xf;
        (void)shape;
        (void)X;
        return false;
    }
}

}  // namespace

template <class S>
WorldQueries<S>::WorldQueries(const World<S>& world) {
    std::vector<Aabb<S>> bounded;
    for (const ShapeRecord<S>& record : world.shapes()) {
        const auto i = static_cast<std::uint32_t>(entries_.size());
        entries_.push_back({&record, world.shapePose(record), world.bodyOf(record)});
        boxes_.push_back(boundingBox<S>(record.shape, entries_.back().X));
        if (BroadPhase<S>::unbounded(boxes_.back())) {
            outside_.push_back(i);
        } else {
            inTree_.push_back(i);
            bounded.push_back(boxes_.back());
        }
    }
    tree_.build(bounded);
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
    tree_.walk(enter, [&](std::uint32_t leaf) { test(inTree_[leaf]); });
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
              if (!isComposite<S>(entry.record->shape)) {
                  if (closestPoints<S>(shape, X, entry.record->shape, entry.X).distance <= 0)
                      found.push_back({i, kNullIndex});
                  return;
              }
              std::uint32_t piece = kNullIndex;
              withSurface<S>(entry.record->shape, [&](const auto& data) {
                  data.query(boxOnSurface<S>(entry.X, shape, X, Real(0)), [&](std::uint32_t k) {
                      const Shape<S> part = data.piece(k);
                      if (k < piece && closestPoints<S>(shape, X, part, entry.X).distance <= 0) piece = k;
                  });
              });
              if (piece != kNullIndex || underField<S>(entry.record->shape, entry.X, shape, X))
                  found.push_back({i, piece});
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
