// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// On which side of a surface a shape is. A chain or a mesh is a sheet without thickness: a shape that has
// stepped through it, or was pressed through it, overlaps it as much as before and would be pushed out on the
// wrong side. So the side is told by where the shape came from:
//
//     x   the shape's middle now,  p  the last place of its middle on the proper side
//     The way p -> x meets the surface in a piece T:  the shape has gone through T and belongs on p's side
//                                                    of it, however deep; p moves up to T, and along the
//                                                    surface as far as x has.
//     It does not:                                   x is on the proper side, and p := x.
//
// For a pair that was not near in the last step p is where the middle was then; boxes reach back to there
// (ContactSet::findPairs), so that a shape can not pass a sheet between two steps unseen. The way is in the
// frame of the surface, so that the surface may move. Cost: one ray for each pair of a shape and a
// surface, some more for those that are through.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/math/space.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {

template <class S>
class SurfaceSides {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    struct Place {
        Vec proper = Vec::Zero();       ///< p, in the frame of the surface [m]
        Vec middle = Vec::Zero();       ///< x, likewise
        std::uint32_t through = kNone;  ///< T, if any
    };

    /// Begins a step. Pairs that place() is not called for until the next begin() are forgotten.
    void begin();
    /// `key` names the pair, in ascending order; `before` and `now` are the middle of the shape at the last
    /// step's start and now, `gap` > 0 how near to T the place p is brought: small beside the shape [m].
    Place place(std::uint64_t key, const Shape<S>& surface, const Pose<S>& Xsurface, const Vec& before,
                const Vec& now, Real gap);
    bool empty() const { return known_.empty(); }
    void clear() { known_.clear(), old_.clear(); }

    /// For snapshots: key and p of each pair.
    template <class A, class Sides, class Visit>
    static void visit(A& archive, Sides& sides, Visit visitOne) {
        const std::size_t count = archive.size(sides.known_.size());
        if constexpr (!std::is_const_v<Sides>) sides.known_.resize(count);
        for (auto& known : sides.known_) {
            visitOne(known.key);
            visitOne(known.proper);
        }
    }

  private:
    struct Known {
        std::uint64_t key = 0;
        Vec proper = Vec::Zero();
    };
    std::vector<Known> known_, old_;  ///< of this step and the last, by ascending key
    std::size_t next_ = 0;            ///< the first of old_ that may still be looked for
};

}  // namespace rigor::engine
