// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact cache: the narrow phase is not called again while two shapes have hardly moved relative to each
// other (WorldDef::cacheTolerance). The idea is that of the contact caches of [Rouwe2022] and [Box2D2024];
// code and bounds are written anew.
//
// Let T be the pose of the smaller shape (by its radius r about its origin) in the frame of the other, and T'
// the same at the last query. No point of the smaller shape has moved, relative to the other, by more than
//     m = |p - p'| + r |R - R'|,       |R - R'| = 2 sin(angle / 2) <= 2 |q - q'|   (2D: equal to |q - q'|)
// The cached result is valid while m <= s = min(cacheTolerance, kMaxTurn r). The narrow phase is queried with
// the distance speculativeDistance + s, so that
//     no contact    stays true: nothing can have come within speculativeDistance. With a lower bound of the
//                   separation (Manifold::separationLowerBound) it is valid until that has shrunk to the
//                   query distance
//     a manifold    keeps its points, each fixed to its body, and its normal, fixed to the body whose face it
//                   is: n . (pB - pA) is the separation of the same two points now
// Compared with a new query, the deepest separation is off by at most 2 s, and exact between a corner and the
// face that it rests on. Corners stay the same corners; points where two edges cross slide with one of them;
// the normal of two edges turns with A, by at most s / r <= kMaxTurn from the exact one. The solver's input
// moves with the bodies and jumps only at a query.
//
// With WorldDef::speculativeMotion the query distance of fast shapes is larger by their motion, and their
// manifolds are not valid in the next step.
//
// Not cached: pairs with a sphere or circle, pairs of capsules and half-spaces, whose closed forms cost no
// more than this, and speculative contacts of continuous collision.
#pragma once

#include "engine/contacts/candidates.hpp"
#include "engine/contacts/contact.hpp"
#include "engine/contacts/shape_set.hpp"

namespace rigor::engine {

/// A new candidate, with the sizes that decide about its cache.
template <class S>
Candidate<S> makeCandidate(const ShapeSet<S>& shapes, std::uint32_t a, std::uint32_t b, std::uint32_t piece);

/// The rules of the cache at the poses of a step. The cached results themselves are the candidates', the
/// cached points the contacts' (Contact::cache).
template <class S>
class ContactCache {
  public:
    using Real = typename S::Real;

    ContactCache(const ShapeSet<S>& shapes, Real speculativeDistance)
        : shapes_(shapes), speculativeDistance_(speculativeDistance) {}

    /// Largest separation that the narrow phase reports [m].
    Real queryDistance(const Candidate<S>& candidate) const {
        return speculativeDistance_ + slack(candidate);
    }
    /// Addition to the query distance of shapes that move far in the step [m].
    Real motion(const Candidate<S>& candidate) const { return shapes_.motion(candidate.a, candidate.b); }
    /// The cached result is what the narrow phase would find, within the bounds above.
    bool isValid(const Candidate<S>& candidate) const {
        return candidate.cached && hasHardlyMoved(candidate);
    }
    /// Marks the result of the query just made as cached.
    void storeResult(Candidate<S>& candidate) const;
    /// Caches the manifold of a contact, in the frames of its bodies.
    void storeManifold(Candidate<S>& candidate, Contact<S>& contact) const;
    /// Moves the cached manifold to the current poses of its bodies.
    void moveManifold(const Candidate<S>& candidate, Contact<S>& contact) const;

  private:
    bool hasHardlyMoved(const Candidate<S>& candidate) const;
    Real slack(const Candidate<S>& candidate) const;
    Pose<S> relative(const Candidate<S>& candidate) const;

    const ShapeSet<S>& shapes_;
    Real speculativeDistance_;
};

}  // namespace rigor::engine
