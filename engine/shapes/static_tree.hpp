// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounding-volume hierarchy over boxes that do not move: the triangles of a mesh, the segments of a chain,
// the shapes of a world during queries. Built top down by splitting at the median centre along the widest
// axis [Ericson2005, ch. 6.2], so that its depth is log2 of the count; nodes are stored depth first.
// Cost: building O(n log^2 n), fitting it to boxes that have moved O(n), a query O(log n + found) for compact boxes. Queries do not allocate.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/space.hpp"

namespace rigor::engine {

/// True if the ray o + t d, t in [0, limit], intersects the box; by the slab method [Ericson2005, ch. 5.3.3].
template <class S>
bool rayMeetsBox(const typename S::Vec& o, const typename S::Vec& d, typename S::Real limit,
                 const Aabb<S>& box) {
    using R = typename S::Real;
    R low = 0, high = limit;
    for (int i = 0; i < S::dim; ++i) {
        if (d[i] == 0) {
            if (o[i] < box.min[i] || o[i] > box.max[i]) return false;
            continue;
        }
        const R a = (box.min[i] - o[i]) / d[i], b = (box.max[i] - o[i]) / d[i];
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    // Rounding of the divisions: a face-on ray must not slip between two boxes.
    return low <= high * (1 + 8 * std::numeric_limits<R>::epsilon());
}

template <class S>
class StaticTree {
  public:
    /// Boxes may be unbounded only in a direction in which all are (or they are better kept outside).
    void build(std::span<const Aabb<S>> boxes);
    /// Fits the nodes to boxes that have moved, in O(n): as many as in build(), empty ones (min > max) for those that are
    /// gone. Queries then find the same as after build() and cost more, the further the boxes have moved apart. Returns
    /// the sum of the diagonals of the inner nodes' boxes, by which the cost can be judged.
    typename S::Real refit(std::span<const Aabb<S>> boxes);
    bool empty() const { return nodes_.empty(); }
    const Aabb<S>& bounds() const { return nodes_[0].box; }

    /// visit(index) for each box that overlaps `box`.
    template <class Visit>
    void query(const Aabb<S>& box, Visit visit) const {
        walk([&](const Aabb<S>& b) { return b.overlaps(box); }, visit);
    }
    /// visit(index) for each box that the ray o + t d, 0 <= t <= limit, hits; `limit` may shrink meanwhile.
    template <class Visit>
    void ray(const typename S::Vec& o, const typename S::Vec& d, const typename S::Real& limit,
             Visit visit) const {
        walk([&](const Aabb<S>& b) { return rayMeetsBox<S>(o, d, limit, b); }, visit);
    }
    /// visit(index) for each box for which `enter(box)` holds for it and all nodes above it.
    template <class Enter, class Visit>
    void walk(Enter enter, Visit visit) const {
        if (nodes_.empty()) return;
        std::array<std::uint32_t, 64> stack;
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth > 0) {
            const std::uint32_t i = stack[--depth];
            const Node& node = nodes_[i];
            if (!enter(node.box)) continue;
            if (node.leaf) {
                visit(node.link);
            } else {
                stack[depth++] = node.link;
                stack[depth++] = i + 1;
            }
        }
    }

  private:
    struct Node {
        Aabb<S> box;
        std::uint32_t link = 0;  ///< leaf: the box's index; else the second child (the first is next)
        bool leaf = false;
    };
    void split(std::span<const Aabb<S>> boxes, std::span<std::uint32_t> indices);

    std::vector<Node> nodes_;
};

}  // namespace rigor::engine
