// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounded rows (limits, motors, springs) of a part, solved under the condition that its equality rows hold. Let
// B be the bounded rows that act, J the equality rows, K = J M^-1 J^T + softness their system, and
// c = J M^-1 B^T. An impulse mu along B is answered by -K^-1 c mu along J, and together they change the
// velocities of the bounded rows by
//     D mu,   D = B M^-1 B^T - c^T K^-1 c + softness     (the Schur complement of the equality rows)
// so that, once the equality rows hold, mu solves the small dense problem
//     lower <= mu <= upper,   B v + bias + softness mu + D (change of mu) = 0 or of the bound's sign
// by projected Gauss-Seidel. Solving bounded and equality rows in turn instead converges slowly: a limit acts
// on the inertia that is left to its coordinate, which may be a small part of that of its row alone.
//
// A row acts from when it is first found in error until the next begin(). Cost: a solution of K for each row
// that begins to act.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/solvers/joints/joint_group.hpp"
#include "engine/solvers/joints/row_coupling.hpp"
#include "engine/solvers/sequential_impulses.hpp"

namespace rigor::engine {

/// Solves the bounded rows of a part whose equality rows hold; `found` becomes the largest residual. False:
/// there are too many acting rows.
template <class S>
bool JointGroup<S>::solveActing(Part& part, ConstraintRows<S>& constraints, std::span<Velocity<S>> velocities,
                                Real& found) {
    for (int round = 0; round < kRounds && !part.tooMany; ++round) {
        const Real largest = findActing(part, constraints, velocities);
        if (round == 0) found = std::max(found, largest);
        if (largest <= kTolerance * found) return true;
        if (part.tooMany) return false;
        relaxActing(part);
        applyActing(part, constraints, velocities);
    }
    return !part.tooMany;
}

/// Finds the errors of the bounded rows, and which of them act. Returns the largest [m/s or rad/s].
template <class S>
typename S::Real JointGroup<S>::findActing(Part& part, const ConstraintRows<S>& constraints,
                                           std::span<const Velocity<S>> velocities) {
    Real largest = 0;
    const std::uint32_t before = part.count;
    for (std::uint32_t k = part.bounded; k < part.lastBounded; ++k) {
        const Block<S>& block = constraints.blocks[bounded_[k]];
        const Row<S>& row = constraints.rows[block.first];
        const Real error = rowError<S>(row, velocities[block.a], velocities[block.b]);
        const Real step = std::clamp(row.impulse - row.invK * error, row.lower, row.upper) - row.impulse;
        if (step == 0) continue;
        largest = std::max(largest, std::abs(step) / row.invK);
        if (acts_[k]) continue;
        if (part.count == part.room) {
            part.tooMany = true;
            continue;
        }
        acting_[part.acting + part.count++] = k;
        acts_[k] = 1;
    }
    for (std::uint32_t i = 0; i < part.count; ++i) {
        const Block<S>& block = constraints.blocks[bounded_[acting_[part.acting + i]]];
        const Row<S>& row = constraints.rows[block.first];
        error_[part.acting + i] = rowError<S>(row, velocities[block.a], velocities[block.b]);
        impulse_[part.acting + i] = row.impulse;
        lower_[part.acting + i] = row.lower;
        upper_[part.acting + i] = row.upper;
    }
    if (part.count > before && !part.tooMany) addColumns(part, constraints, before);
    return largest;
}

/// Columns and numbers of the matrix of the acting rows from `first` on.
template <class S>
void JointGroup<S>::addColumns(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t first) {
    constexpr std::uint32_t W = JointSystem<S>::kLanes;
    for (std::uint32_t last; first < part.count; first = last) {
        last = std::min(first + W, part.count);
        for (std::uint32_t i = first; i < last; ++i) findColumn(part, constraints, i);
        solveColumns(part, constraints, first, last);
        addToMatrix(part, constraints, first, last);
        for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
            const Real* x = lanesOf(k);
            const std::uint32_t rows = constraints.blocks[equalities_[k]].rows;
            for (std::uint32_t r = 0; r < rows; ++r, x += W)
                for (std::uint32_t i = first; i < last; ++i) columnOf(part, i)[offset_[k] + r] = x[i - first];
        }
    }
}

/// c = J M^-1 B^T of an acting row.
template <class S>
void JointGroup<S>::findColumn(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t acting) {
    const std::uint32_t bounded = acting_[part.acting + acting];
    const Block<S>& block = constraints.blocks[bounded_[bounded]];
    Real* const column = columnOf(part, acting);
    std::fill_n(column, part.numbers, Real(0));
    for (std::uint32_t e = firstNear_[bounded]; e < firstNear_[bounded + 1]; ++e) {
        const Near& near = near_[e];
        const Block<S>& other = constraints.blocks[equalities_[near.equality]];
        const Real invMass = near.isRowB ? block.invMassB : block.invMassA;
        Real* const c = column + offset_[near.equality];
        for (std::uint32_t i = 0; i < other.rows; ++i)
            c[i] += bodyCoupling<S>(constraints.rows[other.first + i], near.isEqualityB,
                                    constraints.rows[block.first], near.isRowB, invMass);
    }
}

/// K^-1 c of some acting rows, in lanes_.
template <class S>
void JointGroup<S>::solveColumns(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t first,
                                 std::uint32_t last) {
    constexpr std::uint32_t W = JointSystem<S>::kLanes;
    for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
        Real* x = lanesOf(k);
        const std::uint32_t rows = constraints.blocks[equalities_[k]].rows;
        for (std::uint32_t r = 0; r < rows; ++r, x += W)
            for (std::uint32_t l = 0; l < W; ++l)
                x[l] = first + l < last ? columnOf(part, first + l)[offset_[k] + r] : Real(0);
    }
    for (std::uint32_t k = part.system; k < part.lastSystem; ++k)
        system_.solveLanes(systems_[k], lanes_.data() + firstLane_[systems_[k]]);
}

/// D of acting rows whose columns are c yet, with K^-1 c in lanes_.
template <class S>
void JointGroup<S>::addToMatrix(const Part& part, const ConstraintRows<S>& constraints, std::uint32_t first,
                                std::uint32_t last) {
    constexpr std::uint32_t W = JointSystem<S>::kLanes;
    Real* const matrix = matrix_.data() + part.matrix;
    const auto blockOf = [&](std::uint32_t i) -> const Block<S>& {
        return constraints.blocks[bounded_[acting_[part.acting + i]]];
    };
    for (std::uint32_t i = first; i < last; ++i) {
        const Block<S>& block = blockOf(i);
        const Row<S>& row = constraints.rows[block.first];
        const Real* const c = columnOf(part, i);
        std::array<Real, W> taken{};
        for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
            const Real* x = lanesOf(k);
            const std::uint32_t rows = constraints.blocks[equalities_[k]].rows;
            for (std::uint32_t r = 0; r < rows; ++r, x += W)
                if (const Real own = c[offset_[k] + r]; own != 0)
                    for (std::uint32_t l = 0; l < W; ++l) taken[l] += own * x[l];
        }
        for (std::uint32_t j = 0; j <= i; ++j) {
            const Block<S>& other = blockOf(j);
            Real D = blockCoupling<S>(row, block, constraints.rows[other.first], other);
            if (j >= first) {
                D -= taken[j - first];
            } else {
                const Real* const answer = columnOf(part, j);
                for (std::uint32_t n = 0; n < part.numbers; ++n) D -= c[n] * answer[n];
            }
            if (j == i) {
                D += row.softness;
                // The coordinate cannot move where what is left of its mobility is below the system's rounding.
                if (!(D * row.invK > kLeastMobility)) D = 0;
            }
            matrix[std::size_t(i) * part.room + j] = matrix[std::size_t(j) * part.room + i] = D;
        }
    }
}

/// Projected Gauss-Seidel on the acting rows: finds their impulses and the changes of these.
template <class S>
void JointGroup<S>::relaxActing(const Part& part) {
    const std::uint32_t n = part.count;
    const auto of = [&](std::vector<Real>& numbers) { return numbers.data() + part.acting; };
    Real *const error = of(error_), *const impulse = of(impulse_), *const change = of(change_);
    const Real *const lower = of(lower_), *const upper = of(upper_);
    const Real* const matrix = matrix_.data() + part.matrix;
    std::fill_n(change, n, Real(0));
    Real first = 0;
    for (int pass = 0; pass < kPasses; ++pass) {
        Real largest = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Real* const line = matrix + std::size_t(i) * part.room;
            if (line[i] == 0) continue;
            const Real next = std::clamp(impulse[i] - error[i] / line[i], lower[i], upper[i]);
            const Real step = next - impulse[i];
            if (step == 0) continue;
            impulse[i] = next;
            change[i] += step;
            for (std::uint32_t j = 0; j < n; ++j) error[j] += line[j] * step;
            largest = std::max(largest, std::abs(step) * line[i]);
        }
        if (pass == 0) first = largest;
        if (largest <= kTolerance * kTolerance * first) break;
    }
}

template <class S>
void JointGroup<S>::applyActing(const Part& part, ConstraintRows<S>& constraints,
                                std::span<Velocity<S>> velocities) {
    for (std::uint32_t k = part.equality; k < part.lastEquality; ++k)
        std::fill_n(system_.at(k), constraints.blocks[equalities_[k]].rows, Real(0));
    for (std::uint32_t i = 0; i < part.count; ++i) {
        const Real change = change_[part.acting + i];
        if (change == 0) continue;
        const Block<S>& block = constraints.blocks[bounded_[acting_[part.acting + i]]];
        Row<S>& row = constraints.rows[block.first];
        row.impulse = impulse_[part.acting + i];
        applyRowImpulse<S>(row, block, change, velocities[block.a], velocities[block.b]);
        const Real* const column = columnOf(part, i);
        for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
            Real* const x = system_.at(k);
            const Real* const answer = column + offset_[k];
            for (std::uint32_t r = 0; r < constraints.blocks[equalities_[k]].rows; ++r)
                x[r] -= change * answer[r];
        }
    }
    applyEqualities(part, constraints, velocities);
}

#define RIGOR_INSTANTIATE(S) \
    template bool JointGroup<S>::solveActing(Part&, ConstraintRows<S>&, std::span<Velocity<S>>, Real&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
