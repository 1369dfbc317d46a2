// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The way of the shape is cut into stretches of about its own size. For one after the other the pieces near
// it are found, and for each new one its time of impact (time_of_impact.cpp). A hit within the stretches so
// far is the first: pieces of later ones are not met before.
//
// Closest points with a piece may lie on an inner edge: a sphere that rolls over a floor comes within the
// touching gap of the next triangle's edge with a normal that leans against it, and would stop there. So a hit
// counts only if the contacts there, which know the inner edges (narrowphase/surface_contact.hpp), close.
//
// Cost: a query of the surface for each stretch, a time of impact for each piece near the way up to the hit.
// Limit: a piece that was passed over because its contacts did not close is not looked at again in the same
// search; contacts/surface_sides.hpp keeps the shape's middle on its side all the same.
#include "engine/ccd/surface_impact.hpp"

#include <algorithm>
#include <cmath>

#include "engine/narrowphase/surface_contact.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

constexpr int kMostStretches = 256;

/// The shape in the frame of a surface at rest.
template <class S>
MovingShape<S> inFrameOf(const MovingShape<S>& surface, const MovingShape<S>& convex) {
    const Pose<S> X = surface.at(0);
    MovingShape<S> moved = convex;
    moved.body = {rotateInverse<typename S::Real>(X.q, convex.body.p - X.p),
                  compose(inverse(X.q), convex.body.q)};
    moved.velocity.v = rotateInverse<typename S::Real>(X.q, convex.velocity.v);
    if constexpr (S::dim == 3) moved.velocity.w = rotateInverse<typename S::Real>(X.q, convex.velocity.w);
    return moved;
}

/// A piece in place of its surface. It has no thickness: gaps are measured by that of the other shape.
template <class S>
MovingShape<S> pieceAs(const MovingShape<S>& surface, const Shape<S>& piece, const MovingShape<S>& convex) {
    MovingShape<S> part = surface;
    part.shape = &piece;
    part.inscribedRadius = convex.inscribedRadius;
    return part;
}

template <class S>
Aabb<S> pieceBox(const Shape<S>& piece) {
    return boundingBox<S>(piece, {});
}

}  // namespace

template <class S>
void SurfaceImpact<S>::findHits(const MovingShape<S>& surface, const MovingShape<S>& convex, bool surfaceIsA,
                                Real horizon, bool known) {
    hits_.clear();
    const MovingShape<S> inFrame = inFrameOf<S>(surface, convex);
    const Aabb<S> start = boundingBox<S>(*convex.shape, inFrame.at(0));
    const Real size = (start.max - start.min).norm();
    const Real lengths = convex.motion(horizon) / size;
    const int stretches = lengths < Real(kMostStretches) ? 1 + static_cast<int>(lengths) : kMostStretches;
    const Real dt = horizon / static_cast<Real>(stretches);
    Aabb<S> before;
    Real first = horizon;
    withSurface<S>(*surface.shape, [&](const auto& data) {
        for (int k = 0; k < stretches; ++k) {
            MovingShape<S> from = inFrame;
            from.body = movedPose<S>(inFrame.body, inFrame.velocity, static_cast<Real>(k) * dt);
            Aabb<S> box = sweptBox<S>(from, dt);
            box.min.array() -= Real(1e-3) * convex.inscribedRadius;
            box.max.array() += Real(1e-3) * convex.inscribedRadius;
            data.query(box, [&](std::uint32_t index) {
                const Shape<S> piece = data.piece(index);
                if (k > 0 && pieceBox<S>(piece).overlaps(before)) return;
                const MovingShape<S> part = pieceAs<S>(surface, piece, convex);
                const TimeOfImpact<S> impact = surfaceIsA ? timeOfImpact<S>(part, convex, horizon, known)
                                                          : timeOfImpact<S>(convex, part, horizon, known);
                if (!impact.hit) return;
                hits_.push_back({impact, index});
                first = std::min(first, impact.time);
            });
            if (first <= static_cast<Real>(k + 1) * dt && !hits_.empty()) break;
            before = box;
        }
    });
    std::sort(hits_.begin(), hits_.end(), [](const Hit& x, const Hit& y) {
        return x.impact.time != y.impact.time ? x.impact.time < y.impact.time : x.piece < y.piece;
    });
}

/// Largest closing speed of a contact at `time`, with its manifold (A = surface) [m/s]; lowest: none.
template <class S>
typename S::Real SurfaceImpact<S>::fastestContact(const MovingShape<S>& surface, const MovingShape<S>& convex,
                                                  Real time, const NarrowPhase<S>& narrowPhase,
                                                  Manifold<S>& manifold) {
    const Pose<S> Xs = surface.at(0), Xc = convex.at(time);
    const Real reach = 2 * touchingGap<S>(pieceAs<S>(surface, *surface.shape, convex), convex);
    names_.clear();
    addFacetNames<S>(*surface.shape, boxOnSurface<S>(Xs, *convex.shape, Xc, reach), names_);
    const Vec middle = toLocal<S>(Xs, toWorld<S>(Xc, middleOf<S>(*convex.shape)));
    const bool ridge = facesDiffer<S>(*surface.shape, names_, middle);
    const Vec center = movedPose<S>(convex.body, convex.velocity, time).p;
    Real fastest = std::numeric_limits<Real>::lowest();
    for (const std::uint32_t name : names_) {
        Manifold<S> found;
        collideFacet<S>(narrowPhase, *surface.shape, name, ridge, Xs, *convex.shape, Xc, reach, found);
        for (int i = 0; i < found.count; ++i) {
            const Vec u = convex.velocity.v + cross(convex.velocity.w, Vec(found.points[i].pointB - center));
            const Real closing = -found.normal.dot(u);
            if (closing <= fastest) continue;
            fastest = closing;
            manifold = found;
        }
    }
    return fastest;
}

template <class S>
TimeOfImpact<S> SurfaceImpact<S>::find(const MovingShape<S>& a, const MovingShape<S>& b, Real horizon,
                                       bool known, const NarrowPhase<S>& narrowPhase) {
    const bool surfaceIsA = isComposite<S>(*a.shape);
    const MovingShape<S>&surface = surfaceIsA ? a : b, &convex = surfaceIsA ? b : a;
    findHits(surface, convex, surfaceIsA, horizon, known);
    const Real thickness = 2 * convex.inscribedRadius;
    for (const Hit& hit : hits_) {
        Manifold<S> manifold;
        const Real closing = fastestContact(surface, convex, hit.impact.time, narrowPhase, manifold);
        const bool none = closing == std::numeric_limits<Real>::lowest();
        // A contact that the solver holds already counts as in timeOfImpact().
        const Real least = known ? Real(0.25) * thickness / (horizon - hit.impact.time) : Real(0);
        if (none || closing > least) return hit.impact;
    }
    return {};
}

template <class S>
void SurfaceImpact<S>::collideAt(const MovingShape<S>& a, const MovingShape<S>& b,
                                 const TimeOfImpact<S>& impact, const NarrowPhase<S>& narrowPhase,
                                 Manifold<S>& manifold) {
    const bool surfaceIsA = isComposite<S>(*a.shape);
    const MovingShape<S>&surface = surfaceIsA ? a : b, &convex = surfaceIsA ? b : a;
    if (fastestContact(surface, convex, impact.time, narrowPhase, manifold) > 0) {
        if (!surfaceIsA) flipManifold(manifold);
        return;
    }
    manifold = {};
    setToClosest<S>(impact.closest, manifold);
}

RIGOR_INSTANTIATE_CLASS(SurfaceImpact)

}  // namespace rigor::engine
