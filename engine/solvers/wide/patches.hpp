// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The patches of a step: assigned to lanes, prepared once, and solved in every sub-step. Data: patch.hpp;
// SIMD kernels: kernels.hpp; order and threads: colouring.hpp.
//
//     contacts --setDescriptor--> descriptors --assignLanes--> blocks --fill, prepare--> rows
//     each sub-step: beginSubstep, solvePass (soft), advance, solvePass (relaxation)
//     rows --distribute--> friction impulses of the points
//
// Invariant between the stages of a pass: no moving body belongs to the chunks of two threads.
#pragma once

#include <atomic>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/ids.hpp"
#include "engine/core/large_vector.hpp"
#include "engine/core/tasks.hpp"
#include "engine/solvers/wide/colouring.hpp"
#include "engine/solvers/wide/kernels.hpp"
#include "engine/solvers/wide/velocities.hpp"

namespace rigor::engine {

template <class S>
class Patches {
  public:
    using Real = typename S::Real;
    using F = PatchSpace<S>;
    /// A step begins with a descriptor for each of `count` sources (contacts). assignLanes() then gives each
    /// a lane; the caller fills every lane of every block, empty ones with zeros, and calls prepare().
    void resize(std::size_t count) {
        if (count != descriptors_.size()) changed_ = true;
        descriptors_.resize(count);
    }
    /// Sets the descriptor of a source; may be called by any thread. Zero points: no patch.
    void setDescriptor(std::size_t source, const PatchDescriptor& descriptor) {
        if (descriptors_[source] == descriptor) return;
        descriptors_[source] = descriptor;
        const std::atomic_ref changed(changed_);  // stored only once: the cache line stays shared
        if (!changed.load(std::memory_order_relaxed)) changed.store(true, std::memory_order_relaxed);
    }
    void assignLanes(const BodyArrays<S>& bodies, const Tasks& tasks);
    /// work(b) for each block, in the thread that solves the block in each pass.
    template <class Work>
    void forBlocks(const Tasks& tasks, const Work& work) const {
        tasks.forStages(1, [&](std::size_t, std::size_t chunk) {
            for (const Stage& stage : stages_)
                forChunk(stage, chunk, [&work](std::size_t first, std::size_t last) {
                    for (std::size_t b = first; b < last; ++b) work(b);
                });
        });
    }
    std::size_t blocks() const { return colouring_.blocks(); }
    PatchBlock<F>& block(std::size_t b) { return blocks_[b]; }
    PatchColdData<F>& coldData(std::size_t b) { return cold_[b]; }
    /// Source of the patch in a lane; kNullIndex: the lane is empty.
    std::uint32_t sourceAt(std::size_t b, std::size_t lane) const {
        return colouring_.laneContents()[b * kLanes + lane];
    }
    /// Makes the rows of a block whose lanes have been filled.
    void prepare(std::size_t b, PatchFriction<F>& friction) {
        preparePatches<F>(range(b, friction), inertia_.data());
        const std::atomic_ref bounce(bounce_);
        if (blocks_[b].bounces != 0 && !bounce.load(std::memory_order_relaxed))
            bounce.store(true, std::memory_order_relaxed);
    }

    std::size_t size() const { return colouring_.contacts(); }
    /// Points of all patches; rows: one normal row per point, and the friction rows of each patch.
    std::size_t points() const { return colouring_.points(); }
    std::size_t rows() const;
    bool empty() const { return size() == 0; }

    /// Begins a sub-step, before forces: decides which points bounce in it.
    void beginSubstep(std::span<Velocity<S>> velocities, const PatchPass& pass, const Tasks& tasks);
    /// One Gauss-Seidel pass over all patches. `warmStart`: applies their impulses first. Returns the largest
    /// change of a velocity [m/s or rad/s].
    Real solvePass(std::span<Velocity<S>> velocities, const PatchPass& pass, bool warmStart,
                   const Tasks& tasks);
    /// Adds the displacement of the bodies, which have moved for h [s] with the velocities `used`.
    void advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks);
    /// Distributes friction over the points of a block, at the end of a step.
    void distribute(std::size_t b, PatchFriction<F>& friction) { distributeFriction<F>(range(b, friction)); }

  private:
    PatchRange<F> range(std::size_t first, std::size_t last) {
        return {blocks_.data() + first, cold_.data() + first, last - first, velocities_.data(),
                velocities_.base(),     motions_.data(),      threads_ > 1};
    }
    PatchRange<F> range(std::size_t b, PatchFriction<F>& friction) {
        PatchRange<F> one = range(b, b + 1);
        one.pointFriction = &friction;
        return one;
    }
    /// Blocks that threads solve in parallel between two barriers. The chunk of thread t is, in each size
    /// class, the blocks from splits_[splits + t] to splits_[splits + t + 1].
    struct Stage {
        std::size_t splits;
        bool allClasses;  ///< false: only the first size class is used
    };
    void split(const Tasks& tasks);
    void addRangeStages();
    void addPartitionStage();
    /// work(first, last) for each range of blocks in the chunk of a thread in a stage.
    template <class Work>
    void forChunk(const Stage& stage, std::size_t chunk, const Work& work) const {
        const Colouring::Split* const split = splits_.data() + stage.splits + chunk;
        for (std::uint32_t c = 0; c < (stage.allClasses ? Colouring::kSizeClasses : 1); ++c)
            if (split[0][c] < split[1][c]) work(split[0][c], split[1][c]);
    }
    /// First body of the chunk of a thread.
    std::size_t firstBody(std::size_t chunk, const Tasks& tasks) const {
        const auto partitions = colouring_.partitions();
        if (partitions.size() == 1) return tasks.chunkBegin(velocities_.size(), kBodyGrain, chunk);
        return firstPartition_[chunk] < partitions.size() ? partitions[firstPartition_[chunk]].firstBody
                                                          : velocities_.size();
    }

    std::vector<PatchDescriptor> descriptors_;
    bool changed_ = false;  ///< descriptors_ has changed since assignLanes
    Colouring colouring_;
    std::size_t threads_ = 1;
    std::vector<double> fractions_;            ///< fraction of the work before each thread's; last: 1
    std::vector<std::size_t> firstPartition_;  ///< first partition of each thread; last: the number of
                                               ///< partitions
    std::vector<Stage> stages_;                ///< stages of the ranges, then of the partitions
    std::vector<Colouring::Split> splits_;     ///< splits of all stages
    LargeVector<PatchBlock<F>> blocks_;
    LargeVector<PatchColdData<F>> cold_;
    // --- by body
    std::vector<PatchInertia<F>> inertia_;
    std::vector<Velocity<F>> motions_;
    PatchVelocities<S> velocities_;
    /// Change of the velocities by the current impulses. Rows are constant during a step, so that a warm
    /// start adds this in place of applying the impulses again.
    std::vector<Velocity<F>> impulseDelta_;
    bool impulseDeltaValid_ = false;
    bool bounce_ = false;  ///< some patch has restitution > 0
};

}  // namespace rigor::engine
