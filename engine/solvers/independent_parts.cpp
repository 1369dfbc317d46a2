// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/independent_parts.hpp"

#include "engine/core/ids.hpp"

namespace rigor::engine {

template <class S>
void IndependentParts::find(std::span<const Block<S>> blocks, std::span<const std::uint32_t> units,
                            std::size_t bodies) {
    const std::size_t n = units.empty() ? 0 : units.size() - 1;
    sets_.begin(static_cast<std::uint32_t>(bodies));
    part_.resize(n);
    // First each unit's root: the body that stands for it.
    for (std::size_t u = 0; u < n; ++u) {
        std::uint32_t first = kNullIndex;
        for (std::uint32_t k = units[u]; k < units[u + 1]; ++k)
            for (const auto& [body, invMass] :
                 {std::pair(blocks[k].a, blocks[k].invMassA), std::pair(blocks[k].b, blocks[k].invMassB)}) {
                if (!(invMass > 0)) continue;
                if (first == kNullIndex)
                    first = body;
                else
                    sets_.join(first, body);
            }
        part_[u] = first;
    }
    ofRoot_.assign(bodies, kNullIndex);
    starts_.assign(1, 0);
    for (std::size_t u = 0; u < n; ++u) {
        // Blocks that move nothing are a part each.
        std::uint32_t part = kNullIndex;
        if (part_[u] != kNullIndex) {
            std::uint32_t& found = ofRoot_[sets_.rootOf(part_[u])];
            if (found == kNullIndex) {
                found = static_cast<std::uint32_t>(starts_.size() - 1);
                starts_.push_back(0);
            }
            part = found;
        } else {
            part = static_cast<std::uint32_t>(starts_.size() - 1);
            starts_.push_back(0);
        }
        part_[u] = part;
        ++starts_[part + 1];
    }
    for (std::size_t p = 1; p < starts_.size(); ++p) starts_[p] += starts_[p - 1];
    units_.resize(n);
    for (std::size_t u = n; u-- > 0;) units_[--starts_[part_[u] + 1]] = static_cast<std::uint32_t>(u);
    // Filling backwards from the ends has turned them into the starts.
    starts_.erase(starts_.begin());
    starts_.push_back(static_cast<std::uint32_t>(n));
}

template <class S>
std::uint32_t PartProblem<S>::local(std::uint32_t body) {
    std::uint32_t& found = localOf_[body];
    if (found == kNullIndex) {
        found = static_cast<std::uint32_t>(bodyOf_.size());
        bodyOf_.push_back(body);
        velocities_.push_back(whole_->velocities[body]);
    }
    return found;
}

template <class S>
void PartProblem<S>::load(const SolverInput<S>& whole, std::span<const std::uint32_t> blocks, bool reports) {
    whole_ = &whole;
    reports_ = reports;
    blocks_.assign(blocks.begin(), blocks.end());
    rows_.clear();
    rowOf_.clear();
    bodyOf_.clear();
    velocities_.clear();
    localOf_.resize(whole.velocities.size(), kNullIndex);
    renews_ = false;
    std::uint32_t normal = 0;  // normal row of the last point; its moments follow
    for (const std::uint32_t k : blocks) {
        Block<S> block = whole.constraints.blocks[k];
        renews_ = renews_ || whole.monitor.mayRenew(k);
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            rowOf_.push_back(i);
            rows_.rows.push_back(whole.constraints.rows[i]);
        }
        block.first = static_cast<std::uint32_t>(rows_.rows.size() - block.rows);
        if (block.kind == BlockKind::Contact) normal = block.first;
        if (block.kind == BlockKind::Moment) block.normal = normal;
        block.a = local(block.a);
        block.b = local(block.b);
        if (block.kind == BlockKind::Joint && block.matrix < whole.constraints.matrices.size()) {
            rows_.matrices.push_back(whole.constraints.matrices[block.matrix]);
            block.matrix = static_cast<std::uint32_t>(rows_.matrices.size() - 1);
        }
        rows_.blocks.push_back(block);
    }
    for (const std::uint32_t body : bodyOf_) localOf_[body] = kNullIndex;
}

template <class S>
SolverInput<S> PartProblem<S>::input() {
    return {rows_,
            velocities_,
            whole_->friction,
            *this,
            whole_->iterations,
            whole_->h,
            whole_->warmStarted,
            whole_->residualTolerance,
            whole_->pyramidDirections};
}

template <class S>
void PartProblem<S>::store() {
    for (std::size_t i = 0; i < rowOf_.size(); ++i)
        whole_->constraints.rows[rowOf_[i]].impulse = rows_.rows[i].impulse;
    // Velocities of bodies that impulses do not move are those they were loaded with.
    for (std::size_t i = 0; i < bodyOf_.size(); ++i) whole_->velocities[bodyOf_[i]] = velocities_[i];
}

/// Renews the biases of the whole problem for this part, where they may change, and copies them.
template <class S>
void PartProblem<S>::before(std::span<const Velocity<S>>) {
    if (!renews_) return;
    store();
    whole_->monitor.before(whole_->velocities, blocks_);
    for (std::size_t i = 0; i < rowOf_.size(); ++i) {
        rows_.rows[i].bias = whole_->constraints.rows[rowOf_[i]].bias;
        rows_.rows[i].relaxedBias = whole_->constraints.rows[rowOf_[i]].relaxedBias;
    }
}

template <class S>
bool PartProblem<S>::after(std::span<const Velocity<S>>, Real change) {
    if (!reports_) return false;
    store();
    return whole_->monitor.after(whole_->velocities, change);
}

#define RIGOR_INSTANTIATE(S)                                                                           \
    template void IndependentParts::find<S>(std::span<const Block<S>>, std::span<const std::uint32_t>, \
                                            std::size_t);                                              \
    template class PartProblem<S>;
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
