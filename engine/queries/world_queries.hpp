// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries to a world that is not being stepped: hits of a ray, first contact of a moved shape, overlaps,
// nearest shape.
//
//   WorldQueries<Space3d> queries(world);
//   if (const auto hit = queries.castRay({0, 5, 0}, {0, -10, 0})) use(hit->body, hit->point, hit->normal);
//
// Making one builds a tree over the boxes of all shapes where the bodies are now, in O(n log^2 n). After a step or a
// change of the world, update() brings it up to date in O(n): boxes that have moved are fitted into the same tree, new
// shapes are kept beside it, and it is built anew only when the boxes have moved far apart or many shapes have come or
// gone. The answers are those of a new one. All bodies are searched, those without contacts too, but no sensors;
// `filter` may leave some out. Ties go to the shape added first.
#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/pipeline/world.hpp"
#include "engine/shapes/ray_cast.hpp"
#include "engine/shapes/static_tree.hpp"

namespace rigor::engine {

/// A shape of a body; `piece` of a chain, mesh or height field.
struct ShapeRef {
    BodyId body;
    ShapeId shape;
    std::uint32_t piece = 0xffffffffu;
};

/// The filter of a query: bodies that a function takes, shapes that would collide with a shape of the given filter,
/// both, or all.
class QueryFilter {
  public:
    QueryFilter() = default;
    /// `takes` is true for bodies to query; null: all.
    template <class Takes>
    requires std::is_constructible_v<std::function<bool(BodyId)>, Takes> QueryFilter(Takes takes)
        : takes_(std::move(takes)) {}
    QueryFilter(const ShapeFilter& as) : as_(as) {}
    QueryFilter(const ShapeFilter& as, std::function<bool(BodyId)> takes)
        : takes_(std::move(takes)), as_(as) {}

    bool operator()(BodyId body, const ShapeFilter& shape) const {
        return (!as_ || lets(*as_, shape)) && (!takes_ || takes_(body));
    }

  private:
    std::function<bool(BodyId)> takes_;
    std::optional<ShapeFilter> as_;
};

template <class S>
struct WorldRayHit : ShapeRef {
    typename S::Real fraction = 0;  ///< fraction of the translation, in [0, 1]
    typename S::Vec point, normal;  ///< world frame; normal out of the shape, unit
    bool startsInside = false;
};

/// First touch of a shape moved without turning.
template <class S>
struct ShapeCastHit : ShapeRef {
    typename S::Real fraction = 0;  ///< fraction of the translation, in [0, 1]
    typename S::Vec point, normal;  ///< contact point; unit normal from the moved shape to the one that it
                                    ///< touches
    bool startsTouching = false;    ///< they overlap or touch at once: fraction 0
    bool converged = true;          ///< false: the fraction is early by more than rounding
};

/// Closest points; signed distance.
template <class S>
struct NearestHit : ShapeRef {
    typename S::Real distance = 0;  ///< [m]; < 0: overlap (of a surface: with its nearest piece)
    typename S::Vec point, onShape,
        normal;  ///< points on the query shape and on the world's shape; normal from the first to the second
};

template <class S>
class WorldQueries {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Filter = QueryFilter;

    /// `world` must outlive this, and stay where it is; queries after it has changed need an update() before.
    explicit WorldQueries(const World<S>& world);
    /// Follows the world to where its bodies and shapes are now.
    void update();
    /// Number of times that the tree has been built.
    int builds() const { return builds_; }

    /// Nearest hit of x = origin + t translation, 0 <= t <= 1. Throws EngineError "query_ray" for numbers
    /// that are not finite and for a translation of zero.
    std::optional<WorldRayHit<S>> castRay(const Vec& origin, const Vec& translation,
                                          const Filter& filter = {}) const;
    /// One hit for every shape that the ray hits, nearest first.
    std::vector<WorldRayHit<S>> castRayAll(const Vec& origin, const Vec& translation,
                                           const Filter& filter = {}) const;
    /// First contact of `shape` on its way from X along `translation`. Throws EngineError "query_shape" for
    /// half-spaces, chains, meshes and fields (also below), "query_ray" as above.
    std::optional<ShapeCastHit<S>> castShape(const Shape<S>& shape, const Pose<S>& X, const Vec& translation,
                                             const Filter& filter = {}) const;
    /// Shapes that overlap or touch the posed shape, in the order they were added; of a surface the first
    /// piece.
    std::vector<ShapeRef> overlapping(const Shape<S>& shape, const Pose<S>& X,
                                      const Filter& filter = {}) const;
    /// Shapes whose bounding box overlaps the box.
    std::vector<ShapeRef> inBox(const Aabb<S>& box, const Filter& filter = {}) const;
    /// The nearest shape, if any within `most` [m] >= 0; overlapping ones count as the nearer the deeper.
    std::optional<NearestHit<S>> nearest(const Shape<S>& shape, const Pose<S>& X, Real most,
                                         const Filter& filter = {}) const;
    std::optional<NearestHit<S>> nearest(const Vec& point, Real most, const Filter& filter = {}) const;

  private:
    struct Entry {
        const ShapeRecord<S>* record = nullptr;
        Pose<S> X;
        BodyId body;
    };
    template <class Enter, class Visit>
    void visit(Enter enter, const Filter& filter, Visit use) const;
    ShapeRef ref(std::uint32_t i, std::uint32_t piece) const {
        return {entries_[i].body, entries_[i].record->id, piece};
    }

    void matchShapes();
    void build();
    bool isLoose(std::uint32_t i) const { return leafOf_[i] == kNullIndex; }

    const World<S>* world_;
    int builds_ = 0;
    // --- by dense index of the shape
    std::vector<Entry> entries_;
    std::vector<ShapeId> ids_;
    std::vector<Aabb<S>> boxes_;
    std::vector<std::uint32_t> leafOf_;  ///< its leaf; kNullIndex: none
    // --- by leaf of the tree
    std::vector<std::uint32_t> entryOf_;  ///< kNullIndex: the shape is gone
    std::vector<Aabb<S>> leafBoxes_;
    std::vector<std::uint32_t> outside_;  ///< shapes with unbounded boxes, and those that have no leaf yet
    StaticTree<S> tree_;
    std::uint32_t removed_ = 0, loose_ = 0;  ///< leaves without a shape, bounded shapes without a leaf
    Real builtSize_ = 0;                     ///< StaticTree::refit() of the tree as built
};

}  // namespace rigor::engine
