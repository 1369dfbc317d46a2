// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The patches of a step: placed in blocks, prepared once, and visited in every sub-step. What the blocks
// hold: patch.hpp; what is done with them: kernels.hpp.
#pragma once

#include <atomic>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/ids.hpp"
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
    /// The patches of a step are planned, one for each of `count` sources; then they are placed in blocks;
    /// then each block is filled in lane by lane, also those of nobody, and prepared.
    void plan(std::size_t count) {
        if (count != plans_.size()) changed_ = true;
        plans_.resize(count);
    }
    /// Of a source, by any thread; of no points where there is no patch.
    void offer(std::size_t source, const PatchPlan& plan) {
        if (plans_[source] == plan) return;
        plans_[source] = plan;
        const std::atomic_ref changed(changed_);  // written once: others read what stands beside it
        if (!changed.load(std::memory_order_relaxed)) changed.store(true, std::memory_order_relaxed);
    }
    void place(const BodyArrays<S>& bodies, const Tasks& tasks);
    /// work(b) for each block, by the thread that visits it later on.
    template <class Work>
    void forBlocks(const Tasks& tasks, const Work& work) const {
        tasks.forStages(1, [&](std::size_t, std::size_t share) {
            for (const Stage& stage : stages_)
                ofShare(stage, share, [&work](std::size_t first, std::size_t last) {
                    for (std::size_t b = first; b < last; ++b) work(b);
                });
        });
    }
    std::size_t blocks() const { return colouring_.blocks(); }
    PatchBlock<F>& block(std::size_t b) { return blocks_[b]; }
    PatchRest<F>& rest(std::size_t b) { return rests_[b]; }
    /// Whose patch stands there (its place among the plans); kNullIndex's lanes are filled with zeros.
    std::uint32_t sourceAt(std::size_t b, std::size_t lane) const {
        return colouring_.occupants()[b * kLanes + lane];
    }
    /// Rows from what has been filled in.
    void prepare(std::size_t b, PatchRubs<F>& rubs) {
        preparePatches<F>(range(b, rubs), inertia_.data());
        const std::atomic_ref bounce(bounce_);
        if (blocks_[b].bounces != 0 && !bounce.load(std::memory_order_relaxed))
            bounce.store(true, std::memory_order_relaxed);
    }

    std::size_t size() const { return colouring_.contacts(); }
    /// Points of all patches, and the rows they have: one for each point, and those of friction.
    std::size_t points() const { return colouring_.points(); }
    std::size_t rows() const;
    bool empty() const { return size() == 0; }

    /// Begins a sub-step, before forces: which points bounce in it.
    void beginSubstep(std::span<Velocity<S>> velocities, const PatchPass& pass, const Tasks& tasks);
    /// One visit of every patch. `warmStart`: applies their impulses first. Returns the largest change of a
    /// velocity [m/s or rad/s].
    Real visit(std::span<Velocity<S>> velocities, const PatchPass& pass, bool warmStart, const Tasks& tasks);
    /// Bodies have moved for h [s] with these velocities.
    void advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks);
    /// Friction of the points of a block, before it is read.
    void share(std::size_t b, PatchRubs<F>& rubs) { sharePatches<F>(range(b, rubs)); }

  private:
    PatchRange<F> range(std::size_t first, std::size_t last) {
        return {blocks_.data() + first, rests_.data() + first, last - first, velocities_.data(),
                velocities_.base(),     motions_.data(),       threads_ > 1};
    }
    PatchRange<F> range(std::size_t b, PatchRubs<F>& rubs) {
        PatchRange<F> one = range(b, b + 1);
        one.rubs = &rubs;
        return one;
    }
    /// What threads do side by side before they wait for each other. cuts_[cuts + share]: where the share of
    /// a thread begins, of each kind; where it ends stands with the next one.
    struct Stage {
        std::size_t cuts;
        bool kinds;  ///< else the first kind is all there is
    };
    void cut(const Tasks& tasks);
    void addRangeStages();
    void addRegionStage();
    /// work(first, last) on ranges of blocks that are the share of a thread in a stage.
    template <class Work>
    void ofShare(const Stage& stage, std::size_t share, const Work& work) const {
        const Colouring::Cut* const cut = cuts_.data() + stage.cuts + share;
        for (std::uint32_t kind = 0; kind < (stage.kinds ? Colouring::kKinds : 1); ++kind)
            if (cut[0][kind] < cut[1][kind]) work(cut[0][kind], cut[1][kind]);
    }
    /// The first body of a share.
    std::size_t bodyOf(std::size_t share, const Tasks& tasks) const {
        const auto regions = colouring_.regions();
        if (regions.size() == 1) return tasks.cut(velocities_.size(), kBodyGrain, share);
        return firstRegion_[share] < regions.size() ? regions[firstRegion_[share]].firstBody
                                                    : velocities_.size();
    }

    std::vector<PatchPlan> plans_;
    bool changed_ = false;  ///< they have, since they were placed
    Colouring colouring_;
    std::size_t threads_ = 1;
    std::vector<double> before_;            ///< parts of the work before each thread's, and all of it
    std::vector<std::size_t> firstRegion_;  ///< of each share, and their number
    std::vector<Stage> stages_;             ///< ranges, then regions
    std::vector<Colouring::Cut> cuts_;      ///< of all stages
    std::vector<PatchBlock<F>> blocks_;
    std::vector<PatchRest<F>> rests_;
    // --- by body
    std::vector<PatchInertia<F>> inertia_;
    std::vector<Velocity<F>> motions_;
    PatchVelocities<S> velocities_;
    /// What the impulses that patches have now have made of the velocities, in all visits of a sub-step: rows
    /// stay as they are during a step, so that to apply those impulses again is to add this.
    std::vector<Velocity<F>> gained_;
    bool gainedHolds_ = false;
    bool bounce_ = false;  ///< some can
};

}  // namespace rigor::engine
