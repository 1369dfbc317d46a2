// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Optional interfaces of an engine's broad phase and narrow phase, by which their own work is timed without
// the work of the interface around it: a BroadPhaseEngine that is a TimedBroadPhaseEngine, a CollisionEngine
// that is a TimedCollisionEngine (found by dynamic_cast) takes part in the bench of parts.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapters/interface/engine.hpp"

namespace rigor::adapter {

bool overlap(const Aabb& a, const Aabb& b);  ///< touching counts
/// All pairs that overlap, a < b, sorted, by comparing every box with every other: what broad phases are
/// tested against.
std::vector<Pair> bruteForcePairs(std::span<const Aabb> boxes);

/// A broad phase in three parts, of which update() is made.
class TimedBroadPhase : public BroadPhase {
  public:
    /// Takes the current boxes and stores them in the engine's own precision, rounded outwards, without
    /// passing them on yet.
    virtual void take(std::span<const Aabb> boxes) = 0;
    /// Passes every moved box to the engine, which finds its pairs, which stay in its own form.
    virtual void run() = 0;
    /// The pairs that the engine then holds, in any order, perhaps repeated, a < b: all that overlap, and
    /// what comes on top of them from enlarged or rounded boxes and from pairs that are kept for a while.
    virtual void held(std::vector<Pair>& pairs) = 0;

    /// Throws BadInput for numbers that are not finite.
    void update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) final;
};

class TimedBroadPhaseEngine : public BroadPhaseEngine {
  public:
    /// Key of the engine's option whose values are algorithms(); empty: there is no choice.
    virtual std::string option() const = 0;
    /// `settings`: of a spec, for engines with precisions to choose from; null: the default.
    virtual std::unique_ptr<TimedBroadPhase> createTimed(const std::string& algorithm, int dimension,
                                                         const Settings* settings) const = 0;
    std::unique_ptr<BroadPhase> create(const std::string& algorithm, int dimension) const final {
        return createTimed(algorithm, dimension, nullptr);
    }
};

/// Pairs of posed shapes that are inside an engine: shapes built, poses in its own numbers.
class CollisionBatch {
  public:
    virtual ~CollisionBatch() = default;
    /// Queries the engine's narrow phase for every pair, each as at its first contact: nothing is remembered
    /// of earlier runs. Contacts stay in the engine's own form. Returns how many there are, of all pairs.
    virtual std::size_t run() = 0;
    /// The contacts of pair i, by the same way as run(): those that overlap, and those found apart.
    virtual std::vector<ContactPoint> contacts(std::size_t i) = 0;
};

class TimedCollisionEngine : public CollisionEngine {
  public:
    /// Makes a batch of at least one query; their geometries need not outlive the call. All have the same
    /// dimension, algorithm and settings. Throws as collide() does.
    virtual std::unique_ptr<CollisionBatch> batch(std::span<const CollisionQuery> queries) const = 0;
};

}  // namespace rigor::adapter
