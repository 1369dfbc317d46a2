// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Broad phase: which axis-aligned boxes overlap. Knows boxes and indices, nothing of bodies or shapes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/table.hpp"
#include "engine/core/tasks.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

/// Two proxies, a < b.
struct ProxyPair {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const ProxyPair&, const ProxyPair&) = default;
};

template <class S>
class BroadPhase {
  public:
    virtual ~BroadPhase() = default;
    virtual std::unique_ptr<BroadPhase> clone() const = 0;

    /// Replaces `pairs` by all pairs of boxes that overlap (touching counts), each once, sorted, except those
    /// of two proxies with movable = 0. Boxes may be unbounded (an extent beyond kUnbounded). Consecutive
    /// calls with the same count are taken as the same proxies that moved; another count starts afresh.
    /// No allocation once the numbers of boxes and pairs have stopped growing. The pairs are a function of
    /// the boxes alone, whatever the threads of `tasks`, the instruction set and the updates before.
    virtual void update(std::span<const Aabb<S>> boxes, std::span<const std::uint8_t> movable,
                        std::vector<ProxyPair>& pairs, const Tasks& tasks = Tasks::one()) = 0;

    /// Forgets everything: the next update starts afresh.
    virtual void reset() = 0;

    /// Box tests so far, whatever their outcome: what updates cost, without a clock.
    std::size_t tests() const { return tests_; }

    /// Boxes reaching further than this from the origin are handled outside any spatial structure [m].
    static constexpr typename S::Real kUnbounded = typename S::Real(1e18);
    static bool unbounded(const Aabb<S>& box) {
        return !((box.min.array() > -kUnbounded).all() && (box.max.array() < kUnbounded).all());
    }

  protected:
    /// Overlap test of two boxes; every test is counted.
    bool overlap(const Aabb<S>& a, const Aabb<S>& b) const {
        ++tests_;
        return a.overlaps(b);
    }
    mutable std::size_t tests_ = 0;
};

template <class S>
using BroadPhaseFactory = std::unique_ptr<BroadPhase<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<BroadPhaseFactory<S>>> broadPhaseTable();

}  // namespace rigor::engine
