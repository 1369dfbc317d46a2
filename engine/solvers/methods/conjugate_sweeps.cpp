// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/methods/conjugate_sweeps.hpp"

namespace rigor::engine {

template <class S>
void ConjugateSweeps<S>::begin(const SolverInput<S>& input, std::size_t parts) {
    norm_.assign(parts, Real(0));
    impulseBefore_.resize(input.constraints.rows.size());
    impulseAlong_.resize(input.constraints.rows.size());
    velocityBefore_.resize(input.velocities.size());
    velocityAlong_.resize(input.velocities.size());
    visited_.assign(input.velocities.size(), 0);
    visit_ = 0;
}

template <class S>
template <class Use>
void ConjugateSweeps<S>::forEachRow(const SolverInput<S>& input, std::span<const std::uint32_t> blocks,
                                    const Use& use) {
    for (const std::uint32_t k : blocks) {
        const Block<S>& block = input.constraints.blocks[k];
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i)
            use(i, input.constraints.rows[i]);
    }
}

/// Each body that impulses of the blocks move, once.
template <class S>
template <class Use>
void ConjugateSweeps<S>::forEachBody(const SolverInput<S>& input, std::span<const std::uint32_t> blocks,
                                     const Use& use) {
    ++visit_;
    const auto visit = [&](std::uint32_t body, Real invMass) {
        if (!(invMass > 0) || visited_[body] == visit_) return;
        visited_[body] = visit_;
        use(body, input.velocities[body]);
    };
    for (const std::uint32_t k : blocks) {
        const Block<S>& block = input.constraints.blocks[k];
        visit(block.a, block.invMassA);
        visit(block.b, block.invMassB);
    }
}

template <class S>
void ConjugateSweeps<S>::remember(const SolverInput<S>& input, std::span<const std::uint32_t> blocks) {
    forEachRow(input, blocks, [&](std::uint32_t i, const Row<S>& row) { impulseBefore_[i] = row.impulse; });
    forEachBody(input, blocks, [&](std::uint32_t b, const Velocity<S>& v) { velocityBefore_[b] = v; });
}

template <class S>
void ConjugateSweeps<S>::advance(const SolverInput<S>& input, std::size_t part,
                                 std::span<const std::uint32_t> blocks) {
    Real norm = 0;
    forEachRow(input, blocks, [&](std::uint32_t i, const Row<S>& row) {
        const Real change = row.impulse - impulseBefore_[i];
        if (row.invK > 0) norm += change * change / row.invK;
    });
    const bool first = !(norm_[part] > 0);
    const bool anew = norm > norm_[part];
    const Real beta = first || anew ? Real(0) : norm / norm_[part];
    const Real keep = !first && anew ? Real(0) : Real(1);
    norm_[part] = norm;
    if (first) {
        forEachRow(input, blocks, [&](std::uint32_t i, const Row<S>&) { impulseAlong_[i] = 0; });
        forEachBody(input, blocks,
                    [&](std::uint32_t b, const Velocity<S>&) { velocityAlong_[b] = Velocity<S>{}; });
    }
    forEachRow(input, blocks, [&](std::uint32_t i, Row<S>& row) {
        const Real change = row.impulse - impulseBefore_[i], along = beta * impulseAlong_[i];
        row.impulse += along;
        impulseAlong_[i] = keep * (along + change);
    });
    forEachBody(input, blocks, [&](std::uint32_t b, Velocity<S>& v) {
        const Velocity<S> now = v, before = velocityBefore_[b], along = velocityAlong_[b];
        v.v += beta * along.v;
        v.w += beta * along.w;
        velocityAlong_[b].v = keep * (beta * along.v + now.v - before.v);
        velocityAlong_[b].w = keep * (beta * along.w + now.w - before.w);
    });
}

#define RIGOR_INSTANTIATE(S) template class ConjugateSweeps<S>;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
