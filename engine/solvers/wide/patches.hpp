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

    static constexpr std::uint32_t kNobody = 0xffffffffu;

    /// The patches of a step are planned, then placed in blocks; then each block is filled in lane by lane,
    /// also those of nobody, and prepared.
    /// For the plans of `count` sources, of no points where there is no patch.
    std::span<PatchPlan> plan(std::size_t count) {
        std::swap(offered_, lastOffered_);
        offered_.resize(count);
        return offered_;
    }
    void place(const BodyArrays<S>& bodies, const Tasks& tasks);
    /// work(b) for each block, by the thread that visits it later on.
    template <class Work>
    void forBlocks(const Tasks& tasks, const Work& work) const {
        tasks.forStages(1, [&](std::size_t, std::size_t share) {
            for (std::size_t colour = 0; colour < colouring_.ranges().size(); ++colour)
                ofShare(colour, share, [&work](std::size_t first, std::size_t last) {
                    for (std::size_t b = first; b < last; ++b) work(b);
                });
        });
    }
    std::size_t blocks() const { return blocks_.size(); }
    PatchBlock<F>& block(std::size_t b) { return blocks_[b]; }
    PatchRest<F>& rest(std::size_t b) { return rests_[b]; }
    /// Whose patch stands there (its place among the plans); kNobody's lanes are filled with zeros.
    std::uint32_t sourceAt(std::size_t b, std::size_t lane) const { return occupant_[b * kLanes + lane]; }
    /// Rows from what has been filled in.
    void prepare(std::size_t b, PatchRubs<F>& rubs) {
        preparePatches<F>(range(b, rubs), inertia_.data());
        if (blocks_[b].bounces != 0) std::atomic_ref(bounce_).store(true, std::memory_order_relaxed);
    }

    std::size_t size() const { return plans_.size(); }
    /// Points of all patches, and the rows they have: one for each point, and those of friction.
    std::size_t points() const { return points_; }
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
    void cut(const Tasks& tasks);
    /// work(first, last) on ranges of blocks that are the share of a thread in a colour.
    template <class Work>
    void ofShare(std::size_t colour, std::size_t share, const Work& work) const {
        const Colouring::Cut* const cut = cuts_.data() + colour * (threads_ + 1) + share;
        for (std::uint32_t kind = 0; kind < Colouring::kKinds; ++kind)
            if (cut[0][kind] < cut[1][kind]) work(cut[0][kind], cut[1][kind]);
    }

    std::vector<PatchPlan> offered_, lastOffered_;
    // --- of what was offered last
    std::vector<PatchPlan> plans_;
    std::vector<std::uint32_t> sources_, occupant_;
    std::size_t points_ = 0;
    Colouring colouring_;
    std::size_t threads_ = 1;
    std::vector<Colouring::Cut> cuts_;  ///< colour by colour, before each thread's share and after the last
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
