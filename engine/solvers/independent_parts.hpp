// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parts of a problem that share no body which impulses move: each can be solved without the others. They are
// islands without what rests on something that cannot move, and where a part ends does not depend on the rest
// of the world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/constraints/row.hpp"
#include "engine/core/disjoint_sets.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

class IndependentParts {
  public:
    /// Finds the parts of `blocks`. Unit u is the blocks units[u] .. units[u + 1] - 1, and belongs to one part.
    /// Cost: O(blocks + bodies). Allocates only when there are more of them than ever before.
    template <class S>
    void find(std::span<const Block<S>> blocks, std::span<const std::uint32_t> units, std::size_t bodies);

    /// Number of parts; they are numbered by their first unit.
    std::size_t count() const { return starts_.empty() ? 0 : starts_.size() - 1; }
    std::uint32_t partOf(std::size_t unit) const { return part_[unit]; }
    /// Units of a part, in ascending order.
    std::span<const std::uint32_t> units(std::size_t part) const {
        return {units_.data() + starts_[part], starts_[part + 1] - starts_[part]};
    }

  private:
    DisjointSets sets_;                  ///< sets of bodies
    std::vector<std::uint32_t> part_;    ///< part of each unit
    std::vector<std::uint32_t> ofRoot_;  ///< part of each root
    std::vector<std::uint32_t> starts_, units_;
};

/// A part as a problem of its own: copies of its rows, blocks and velocities, with bodies numbered anew. What
/// the solver has made of it goes back by store().
template <class S>
class PartProblem final : private IterationMonitor<S> {
  public:
    using Real = typename S::Real;
    /// Copies the given blocks of `whole`, which has to outlive this object's use. `reports`: iterations are those of the
    /// whole problem, whose monitor sees them.
    void load(const SolverInput<S>& whole, std::span<const std::uint32_t> blocks, bool reports = false);
    SolverInput<S> input();
    /// Writes impulses and velocities to the whole problem.
    void store();

  private:
    void before(std::span<const Velocity<S>> velocities) override;
    bool after(std::span<const Velocity<S>> velocities, Real change) override;
    Real tolerance() const override { return whole_->monitor.tolerance(); }
    std::uint32_t local(std::uint32_t body);

    const SolverInput<S>* whole_ = nullptr;
    ConstraintRows<S> rows_;
    std::vector<Velocity<S>> velocities_;
    bool renews_ = false;  ///< biases of its rows may change with the velocities
    bool reports_ = false;
    std::vector<std::uint32_t> blocks_, rowOf_, bodyOf_;  ///< blocks, rows and bodies of the whole problem
    std::vector<std::uint32_t>
        localOf_;  ///< index of each body of the whole problem; kNullIndex: not in the part
};

}  // namespace rigor::engine
