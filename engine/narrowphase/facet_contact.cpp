// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A convex shape on a facet: the neighbouring triangles of a mesh or height field that lie in one plane, the
// segments of a chain that lie on one line (shapes/facets.hpp). Its contact is one manifold, that of the shape
// on the plane, however the facet is cut:
//
//   1. Contact points of the shape with each piece near, along the facet's normal (surface_piece.hpp), but
//      for those on sides between two pieces of the facet: the shape's corners over the facet, the
//      crossings of its edges with the facet's border, and the corners of the border are left.
//   2. A piece whose border is near takes part as far as the rules of surface_piece.hpp find it along its
//      normal. What they find along another normal (at the border of a table, over a ridge) is a contact of
//      that piece alone.
//   3. Where no piece has a contact, the nearest one's with the shape's middle (step 4 of surface_piece.hpp).
//   4. Of more points than a manifold has room for those are kept that span it (reducePoints).
// So a box that slides over small triangles has the four points of its corners, which persist; friction acts
// at the same centers of pressure as on a plane, and the cost for the solver is that of a plane. Without it
// friction had the wrong center whenever a triangle began or ended under the shape, which turned sliding
// shapes, by 0.4 rad/s in a step, under solvers that use the impulses of the last step.
//
// Pieces that have the plane to themselves are met as before, one by one.
#include "engine/narrowphase/surface_contact.hpp"
#include "engine/narrowphase/surface_piece.hpp"

namespace rigor::engine {
namespace {

/// Points of a facet's pieces, each once.
template <class S>
class FacetPoints {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    void add(const Manifold<S>& along, std::uint32_t piece) {
        for (int i = 0; i < along.count; ++i) {
            ManifoldPoint<S> point = along.points[i];
            if (!onShape(point)) point.feature = nameIn(piece, point.feature);
            if (isKnown(point)) continue;
            if (count_ == kRoom) reduce(along.normal);
            points_[static_cast<std::size_t>(count_++)] = point;
        }
    }

    /// The points of the contact, in the order of their names: the order of the pieces does not matter.
    void emit(Manifold<S>& out) {
        if (count_ > S::maxManifoldPoints) reduce(out.normal, out.memory);
        std::sort(points_.begin(), points_.begin() + count_,
                  [](const ManifoldPoint<S>& a, const ManifoldPoint<S>& b) { return a.feature < b.feature; });
        out.count = count_;
        std::copy_n(points_.begin(), count_, out.points.begin());
    }

  private:
    static constexpr int kRoom = 64;

    /// A corner of the shape, or the point of a circle. Other names are of sides and corners of one piece.
    static bool onShape(const ManifoldPoint<S>& point) {
        const std::uint32_t kind = point.feature >> 30;
        return kind == 0 || kind == static_cast<std::uint32_t>(FeatureKind::VertexB);
    }
    static std::uint32_t nameIn(std::uint32_t piece, std::uint32_t feature) {
        return (feature & 0xc0000000u) | ((feature ^ piece * 2654435761u) & 0x3fffffffu);
    }
    /// A corner over the side between two pieces, or a corner of the border of both.
    bool isKnown(const ManifoldPoint<S>& point) const {
        const Real near = Real(16) * kRounding<Real> * point.pointA.cwiseAbs().maxCoeff();
        for (int i = 0; i < count_; ++i) {
            const ManifoldPoint<S>& known = points_[static_cast<std::size_t>(i)];
            if (onShape(point) ? known.feature == point.feature
                               : (known.pointA - point.pointA).squaredNorm() <= near * near)
                return true;
        }
        return false;
    }
    void reduce(const Vec& normal, const ManifoldMemory<S>& memory = {}) {
        const auto at = [&](int i) -> const ManifoldPoint<S>& {
            return points_[static_cast<std::size_t>(i)];
        };
        Real widest = 0, lowest = at(0).separation;
        for (int i = 1; i < count_; ++i) {
            widest = std::max(widest, Real((at(i).pointA - at(0).pointA).norm()));
            lowest = std::min(lowest, at(i).separation);
        }
        // The first of points that are equally deep up to rounding counts, so that the choice lasts.
        const Real noise = kRounding<Real> * at(0).pointA.cwiseAbs().maxCoeff();
        std::array<ManifoldPoint<S>, S::maxManifoldPoints> kept;
        int count = 0;
        reducePoints<S>(
            count_, normal, widest, memory,
            [&](int i) { return at(i).separation <= lowest + noise ? lowest : at(i).separation; },
            [&](int i) -> const Vec& { return at(i).pointA; }, [&](int i) { return at(i).feature; },
            [&](int i) { kept[static_cast<std::size_t>(count++)] = at(i); });
        std::copy_n(kept.begin(), count, points_.begin());
        count_ = count;
    }

    std::array<ManifoldPoint<S>, kRoom> points_;
    int count_ = 0;
};

/// The contact of a shape's middle with the piece that is nearest to it.
template <class S, class Data>
void collideMiddleOf(const Data& data, std::uint32_t facet, const Aabb<S>& box, bool ridge,
                     const Placed<S>& placed, Manifold<S>& out) {
    typename S::Real deepest = 0;
    data.query(box, [&](std::uint32_t index) {
        if (data.facets.of(index) != facet) return;
        Manifold<S> found;
        const typename S::Real depth = collideMiddle<S>(data, index, placed, found);
        if (depth <= deepest || (ridge && !facesItsSide<S>(data, index, placed.middle()))) return;
        deepest = depth;
        out.count = 1;
        out.normal = found.normal;
        out.points[0] = found.points[0];
    });
}

/// The shape over a facet: the plane is that of the first of its pieces that is near.
template <class S, class Data>
struct OverFacet {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    Vec normal = Vec::Zero();  ///< towards the shape's middle; zero: no piece was near
    Real lowest = 0;           ///< separation of the lowest point
    bool deep = false, under = false;

    void take(const Data& data, std::uint32_t index, const Placed<S>& placed) {
        const Vec n = pieceNormal<Real>(data.piece(index)), corner = data.point(data.corners(index)[0]);
        const Real top = placed.reach(n) - n.dot(corner), bottom = -placed.reach(-n) - n.dot(corner);
        under = placed.isUnder(n, corner);
        const bool front = Data::kSolidBelow || !under;
        normal = front ? n : Vec(-n);
        lowest = front ? bottom : -top;
        deep = lowest < -kDeep<Real> * Real(0.5) * (top - bottom);
    }
};

template <class S, class Collide, class Data>
void collidePieces(Collide collide, const Data& data, std::uint32_t facet, bool ridge, const Pose<S>& Xs,
                   const Shape<S>& convex, const Pose<S>& Xc, typename S::Real speculative,
                   Manifold<S>& out) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const Placed<S> placed{convex, relativePose<S>(Xs, Xc)};
    const Aabb<S> box = boxOnSurface<S>(Xs, convex, Xc, speculative);
    OverFacet<S, Data> over;
    FacetPoints<S> points;
    bool any = false;
    data.query(box, [&](std::uint32_t index) {
        if (data.facets.of(index) != facet) return;
        if (over.normal.isZero(0)) over.take(data, index, placed);
        if (over.lowest > speculative) return;
        if (ridge && !facesItsSide<S>(data, index, placed.middle())) return;
        const bool pushedUp = Data::kSolidBelow && over.under;
        if (!pushedUp && isBorderNear<S>(data, index, box)) {
            Manifold<S> own;
            const PieceContact found =
                collideWith<S>(collide, data, index, false, Xs, convex, Xc, speculative, own);
            any = any || found == PieceContact::OwnNormal;
            if (found != PieceContact::Along) return;
        }
        const auto piece = data.piece(index);
        const V n = pieceNormal<R>(piece);
        const bool front = n.dot(over.normal) > 0;
        Manifold<S> along;
        collideAlong<R>(piece, front, convex, placed.X, speculative, along, data.facets.innerSides(index));
        if (over.deep) {
            along.normal = front ? n : V(-n);
            addLowPoints<S>(data, piece, placed, over.lowest, n, along);
        }
        points.add(along, index);
    });
    out.normal = over.normal;
    points.emit(out);
    if (out.count == 0 && !any) collideMiddleOf<S>(data, facet, box, ridge, placed, out);
    toWorldFrame<S>(out, Xs);
    remember(out);
}

}  // namespace

template <class S>
void collideFacet(const NarrowPhase<S>& narrowPhase, const Shape<S>& surface, std::uint32_t name, bool ridge,
                  const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                  typename S::Real speculative, Manifold<S>& out) {
    out.count = 0;
    const auto collide = [&](const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                             typename S::Real distance,
                             Manifold<S>& m) { narrowPhase.collide(a, Xa, b, Xb, distance, m); };
    const std::uint32_t piece = name & ~kBorderPiece;
    withSurface<S>(surface, [&](const auto& data) {
        if (name == piece && data.facets.innerSides(piece) != 0)
            return collidePieces<S>(collide, data, piece, ridge, Xsurface, convex, Xconvex, speculative, out);
        const PieceContact found =
            collideWith<S>(collide, data, piece, ridge, Xsurface, convex, Xconvex, speculative, out);
        if (name != piece && found != PieceContact::OwnNormal) out.count = 0;
        if (name != piece || out.count > 0) return;
        const Placed<S> placed{convex, relativePose<S>(Xsurface, Xconvex)};
        if (ridge && !facesItsSide<S>(data, piece, placed.middle())) return;
        if (collideMiddle<S>(data, piece, placed, out) == 0) return;
        toWorldFrame<S>(out, Xsurface);
        remember(out);
    });
}

template <class S>
void addFacetNames(const Shape<S>& surface, const Aabb<S>& box, std::vector<std::uint32_t>& names) {
    withSurface<S>(surface, [&](const auto& data) {
        data.query(box, [&](std::uint32_t piece) {
            names.push_back(data.facets.of(piece));
            if (data.facets.innerSides(piece) != 0 && isBorderNear<S>(data, piece, box))
                names.push_back(piece | kBorderPiece);
        });
    });
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
}

#define INSTANTIATE(S)                                                                                     \
    template void collideFacet<S>(const NarrowPhase<S>&, const Shape<S>&, std::uint32_t, bool,             \
                                  const Pose<S>&, const Shape<S>&, const Pose<S>&, S::Real, Manifold<S>&); \
    template void addFacetNames<S>(const Shape<S>&, const Aabb<S>&, std::vector<std::uint32_t>&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
