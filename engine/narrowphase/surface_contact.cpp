// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/surface_contact.hpp"

#include "engine/narrowphase/surface_piece.hpp"

namespace rigor::engine {

template <class S>
bool facesDiffer(const Shape<S>& surface, std::span<const std::uint32_t> pieces, const typename S::Vec& x) {
    using R = typename S::Real;
    int front = 0, back = 0;
    withSurface<S>(surface, [&](const auto& data) {
        if (data.kSolidBelow) return;
        for (const std::uint32_t name : pieces) {
            const std::uint32_t piece = name & ~kBorderPiece;
            const R height = pieceNormal<R>(data.piece(piece)).dot(x - data.point(data.corners(piece)[0]));
            front += height > 0;
            back += height < 0;
        }
    });
    return front > 0 && back > 0;
}

template <class S>
void collidePiece(const NarrowPhase<S>& narrowPhase, const Shape<S>& surface, std::uint32_t piece, bool ridge,
                  const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                  typename S::Real speculative, Manifold<S>& out) {
    out.count = 0;
    const auto collide = [&](const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                             typename S::Real distance,
                             Manifold<S>& m) { narrowPhase.collide(a, Xa, b, Xb, distance, m); };
    withSurface<S>(surface, [&](const auto& data) {
        collideWith<S>(collide, data, piece, ridge, Xsurface, convex, Xconvex, speculative, out);
    });
}

template <class S>
void collideDeepestPiece(CollideFunction<S> collide, const Shape<S>& surface, const Pose<S>& Xsurface,
                         const Shape<S>& convex, const Pose<S>& Xconvex, typename S::Real speculative,
                         Manifold<S>& out) {
    using R = typename S::Real;
    out.count = 0;
    R deepest = std::numeric_limits<R>::max();
    std::uint32_t first = kNullIndex;
    withSurface<S>(surface, [&](const auto& data) {
        data.query(boxOnSurface<S>(Xsurface, convex, Xconvex, speculative), [&](std::uint32_t piece) {
            Manifold<S> m;
            collideWith<S>(collide, data, piece, false, Xsurface, convex, Xconvex, speculative, m);
            R least = std::numeric_limits<R>::max();
            for (int i = 0; i < m.count; ++i) least = std::min(least, m.points[i].separation);
            if (m.count == 0 || least > deepest || (least == deepest && piece > first)) return;
            deepest = least;
            first = piece;
            out = m;
        });
    });
}

template <class S>
bool collideSurfaces(CollideFunction<S> collide, const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b,
                     const Pose<S>& Xb, typename S::Real speculative, Manifold<S>& out) {
    if (isStaticOnly<S>(a) && isStaticOnly<S>(b)) {
        out.count = 0;
    } else if (isComposite<S>(a)) {
        collideDeepestPiece<S>(collide, a, Xa, b, Xb, speculative, out);
    } else if (isComposite<S>(b)) {
        collideDeepestPiece<S>(collide, b, Xb, a, Xa, speculative, out);
        flip(out);
    } else {
        return false;
    }
    return true;
}

template <class S>
void flipManifold(Manifold<S>& manifold) {
    flip(manifold);
}

template <class S>
Aabb<S> boxOnSurface(const Pose<S>& Xsurface, const Shape<S>& convex, const Pose<S>& Xconvex,
                     typename S::Real margin) {
    Aabb<S> box = boundingBox<S>(convex, relativePose<S>(Xsurface, Xconvex));
    box.min.array() -= margin;
    box.max.array() += margin;
    return box;
}

#define INSTANTIATE(S)                                                                                     \
    template bool facesDiffer<S>(const Shape<S>&, std::span<const std::uint32_t>, const S::Vec&);          \
    template void collidePiece<S>(const NarrowPhase<S>&, const Shape<S>&, std::uint32_t, bool,             \
                                  const Pose<S>&, const Shape<S>&, const Pose<S>&, S::Real, Manifold<S>&); \
    template void collideDeepestPiece<S>(CollideFunction<S>, const Shape<S>&, const Pose<S>&,              \
                                         const Shape<S>&, const Pose<S>&, S::Real, Manifold<S>&);          \
    template bool collideSurfaces<S>(CollideFunction<S>, const Shape<S>&, const Pose<S>&, const Shape<S>&, \
                                     const Pose<S>&, S::Real, Manifold<S>&);                               \
    template void flipManifold<S>(Manifold<S>&);                                                           \
    template Aabb<S> boxOnSurface<S>(const Pose<S>&, const Shape<S>&, const Pose<S>&, S::Real);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
