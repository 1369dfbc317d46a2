// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The patches of a step: placed in blocks, prepared once, and visited in every sub-step. What the blocks
// hold: patch.hpp; what is done with them: kernels.hpp.
#pragma once

#include <span>
#include <vector>

#include "engine/core/tasks.hpp"
#include "engine/solvers/wide/colouring.hpp"
#include "engine/solvers/wide/kernels.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

template <class S>
class Patches {
  public:
    using Real = typename S::Real;

    static constexpr std::uint32_t kNobody = 0xffffffffu;

    /// The patches of a step are planned, then placed in blocks; then each block is filled in lane by lane,
    /// also those of nobody, and prepared. The head of a block (moves, points, bounces) is zero at first.
    /// `most`: as many patches, at most.
    void clear(std::size_t most) {
        plans_.clear(), sources_.clear();
        plans_.reserve(most), sources_.reserve(most);
    }
    /// `source`: any number that tells the caller whose patch this is.
    void plan(const PatchPlan& plan, std::uint32_t source) {
        plans_.push_back(plan), sources_.push_back(source);
    }
    void place(const BodyArrays<S>& bodies, const Tasks& tasks);
    std::size_t blocks() const { return blocks_.size(); }
    PatchBlock<S>& block(std::size_t b) { return blocks_[b]; }
    PatchRest<S>& rest(std::size_t b) { return rests_[b]; }
    /// Whose patch stands there; kNobody's lanes are filled with zeros.
    std::uint32_t sourceAt(std::size_t b, std::size_t lane) const { return occupant_[b * kLanes + lane]; }
    /// Rows from what has been filled in.
    void prepare(std::size_t b) { preparePatches<S>(range(b, b + 1), inertia_.data()); }

    std::size_t size() const { return plans_.size(); }
    /// Points of all patches, and the rows they have: one for each point, and those of friction.
    std::size_t points() const;
    std::size_t rows() const;
    bool empty() const { return size() == 0; }

    /// Begins a sub-step, before forces: which points bounce in it.
    void beginSubstep(std::span<Velocity<S>> velocities, const PatchPass<Real>& pass, const Tasks& tasks);
    /// One visit of every patch. `warmStart`: applies their impulses first. Returns the largest change of a
    /// velocity [m/s or rad/s].
    Real visit(std::span<Velocity<S>> velocities, const PatchPass<Real>& pass, bool warmStart,
               const Tasks& tasks);
    /// Bodies have moved for h [s] with these velocities.
    void advance(std::span<const Velocity<S>> used, Real h, const Tasks& tasks);
    /// Friction of the points of a block, before it is read.
    void share(std::size_t b) { sharePatches<S>(range(b, b + 1)); }

  private:
    PatchRange<S> range(std::size_t first, std::size_t last, Velocity<S>* velocities = nullptr) {
        return {blocks_.data() + first, rests_.data() + first, last - first, velocities, motions_.data()};
    }
    template <class Work>
    void forColours(Velocity<S>* velocities, const Tasks& tasks, const Work& work);

    std::vector<PatchPlan> plans_;
    std::vector<std::uint32_t> sources_, occupant_;
    Colouring colouring_;
    std::vector<PatchBlock<S>> blocks_;
    std::vector<PatchRest<S>> rests_;
    // --- by body
    std::vector<PatchInertia<S>> inertia_;
    std::vector<Velocity<S>> motions_;
    std::vector<Velocity<S>> before_;  ///< velocities before a visit
    /// What the impulses that patches have now have made of the velocities, in all visits of a sub-step: rows
    /// stay as they are during a step, so that to apply those impulses again is to add this.
    std::vector<Velocity<S>> gained_;
    bool gainedHolds_ = false;
};

}  // namespace rigor::engine
