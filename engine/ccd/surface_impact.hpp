// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time of impact of a moving convex shape with a chain, triangle mesh or height field, which does not move.
#pragma once

#include <vector>

#include "engine/contacts/time_of_impact.hpp"

namespace rigor::engine {

template <class S>
class SurfaceImpact {
  public:
    using Real = typename S::Real;

    /// True where one of the shapes is a surface.
    static bool isOne(const MovingShape<S>& a, const MovingShape<S>& b) {
        return isComposite<S>(*a.shape) || isComposite<S>(*b.shape);
    }

    /// timeOfImpact() of two shapes of which one is a surface: with the piece that is met first.
    TimeOfImpact<S> find(const MovingShape<S>& a, const MovingShape<S>& b, Real horizon, bool known,
                         const NarrowPhase<S>& narrowPhase);
    /// The manifold of a hit where it takes place: of the contacts with the surface the one that closes
    /// fastest.
    void collideAt(const MovingShape<S>& a, const MovingShape<S>& b, const TimeOfImpact<S>& impact,
                   const NarrowPhase<S>& narrowPhase, Manifold<S>& manifold);

  private:
    using Vec = typename S::Vec;
    struct Hit {
        TimeOfImpact<S> impact;
        std::uint32_t piece;
    };
    void findHits(const MovingShape<S>& surface, const MovingShape<S>& convex, bool surfaceIsA, Real horizon,
                  bool known);
    Real fastestContact(const MovingShape<S>& surface, const MovingShape<S>& convex, Real time,
                        const NarrowPhase<S>& narrowPhase, Manifold<S>& manifold);

    std::vector<Hit> hits_;             ///< scratch
    std::vector<std::uint32_t> names_;  ///< scratch
};

}  // namespace rigor::engine
