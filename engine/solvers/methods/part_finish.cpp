// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/methods/part_finish.hpp"

#include <algorithm>

#include "engine/solvers/natural_map.hpp"

namespace rigor::engine {

template <class S>
PartRows partRows(const std::vector<Block<S>>& all, std::span<const std::uint32_t> blocks) {
    PartRows rows;
    for (const std::uint32_t k : blocks) {
        const Block<S>& block = all[k];
        rows.all += block.rows;
        if (block.kind != BlockKind::Joint) rows.besideEqualities += block.rows;
        rows.ofJoints = rows.ofJoints || !isOfContact(block.kind);
    }
    return rows;
}

template <class S>
typename PartFinish<S>::Residual PartFinish<S>::residualOf(const SolverInput<S>& input,
                                                           std::span<const std::uint32_t> blocks) {
    Residual residual{0, input.monitor.tolerance()};
    for (const std::uint32_t k : blocks) {
        const Block<S>& block = input.constraints.blocks[k];
        const Real found = blockResidual<S>(input.constraints, block, input.velocities);
        if (!(found <= residual.found)) residual.found = found;
        residual.goal =
            std::max(residual.goal, blockResolution<S>(input.constraints, block, input.velocities));
    }
    return residual;
}

template <class S>
bool PartFinish<S>::isWorthwhile(const SolverInput<S>& input, std::vector<std::uint32_t>& blocks,
                                 const Residual& left, bool unsolved) {
    const PartRows rows = partRows(input.constraints.blocks, blocks);
    const auto isWithin = [&](Real multiple) { return left.found < multiple * input.monitor.tolerance(); };
    if (rows.all <= kSmallRows) {
        if (rows.all > kFewRows && !rows.ofJoints && !isWithin(kNearlySorted)) return false;
        putInOrder(input, blocks);
        return true;
    }
    if (!unsolved || !isWithin(kSorted)) return false;
    putInOrder(input, blocks);
    return order_.cost() < kMostCost;
}

template <class S>
typename S::Real PartFinish<S>::solve(const SolverInput<S>& input, std::span<const std::uint32_t> blocks,
                                      const Residual& left) {
    newton_.forget();
    problem_.load(input, blocks);
    const Real reached = newton_.attempt(problem_.input(), left.found, left.goal, kSteps);
    problem_.store();
    return reached;
}

#define RIGOR_INSTANTIATE(S)                                                                  \
    template PartRows partRows(const std::vector<Block<S>>&, std::span<const std::uint32_t>); \
    template class PartFinish<S>;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
