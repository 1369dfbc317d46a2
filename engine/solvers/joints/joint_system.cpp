// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints all at once. Let J be the rows of all equality blocks and
//     K = J M^-1 J^T + softness,      K x = right side
// K couples two blocks where they share a body that can move, so it is sparse; block Cholesky K = L L^T with
// a minimum-degree order [GeorgeLiu1989] eliminates chains and trees of joints from their leaves without any
// fill, in time linear in their number, as [Baraff1996] does with the larger system of M and J. Loops add
// some fill; nets are ordered by nested dissection (dissection.hpp) where that makes fewer products. The
// pattern is analysed when it changes (elimination.hpp), not in every step: what remains are loops over
// arrays, without a search.
//
// Blocks are of one size in all joints that are connected, smaller ones filled up with ones on the diagonal.
// Where columns of L are short they stand column by column in padded columns, so that they are
// multiplied by fixed-size loops that compilers turn into vector instructions; where they are long (nets) in
// dense fronts (joint_fronts.hpp).
//
// Redundant rows (a closed loop of 3D hinges has three, a flat net of n x n balls some n^2) make K singular.
// Each pivot gets epsilon K_ii on top: a solution exists, tiny in the directions that change nothing. The
// error this leaves elsewhere goes with repeated solves for what is left: each multiplies it by
// epsilon / (epsilon + sigma), for sigma the row's relative stiffness (proximal point method). epsilon is the
// precision to the power 2/3: 3.7e-11 and 2.4e-5. Cholesky's rounding stays far below that whatever K is
// [GolubVanLoan2013, section 4.2]. Where few loops close, it is 1e-9 at least: rows that are
// redundant in a plane are not quite so where bodies have left it, and impulses grow to what that takes (1e6 N s under a truck
// of 1.3 t on a bridge of planks, 3e3 N s with it). That of inverses of the blocks on the diagonal would not: it is multiplied
// by up to 1 / epsilon, and flat nets of 5 x 5 bodies and more lose all their digits.
//
// Cost: sum over the columns of L of (blocks in it)^2 / 2 products of blocks: of a square net of n balls some
// 4 n^1.5, 0.8 ms for 30 x 30 in single precision and 1.2 ms in double, each solution 0.12 and 0.15 ms.
// Limit: n joints at one body make a dense n x n; beyond kMaxFill blocks per item the caller has to do
// without.
#include "engine/solvers/joints/joint_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace rigor::engine {
namespace {

/// Calls use(std::integral_constant<int, size>) for a size of 1..6.
template <class Use>
void withSize(int size, const Use& use) {
    switch (size) {
        case 1:
            return use(std::integral_constant<int, 1>());
        case 2:
            return use(std::integral_constant<int, 2>());
        case 3:
            return use(std::integral_constant<int, 3>());
        case 4:
            return use(std::integral_constant<int, 4>());
        case 5:
            return use(std::integral_constant<int, 5>());
        default:
            return use(std::integral_constant<int, 6>());
    }
}

}  // namespace

template <class S>
typename JointSystem<S>::Place JointSystem<S>::placeOf(const Item& item) {
    const Block<S>& block = *item.block;
    return {block.invMassA > 0 ? block.a : kNullIndex, block.invMassB > 0 ? block.b : kNullIndex, block.rows};
}

template <class S>
bool JointSystem<S>::factor(std::span<const Item> items, const Tasks& tasks) {
    if (!begin(items)) return false;
    tasks.forEach(parts_.size(), kGrain, [&](std::size_t p) { factor(items, p); });
    return true;
}

template <class S>
bool JointSystem<S>::begin(std::span<const Item> items) {
    bool same = items.size() == pattern_.size();
    for (std::size_t i = 0; same && i < items.size(); ++i) same = placeOf(items[i]) == pattern_[i];
    if (!same) fits_ = analyse(items);
    return fits_;
}

template <class S>
void JointSystem<S>::factor(std::span<const Item> items, std::size_t p) {
    const Part& part = parts_[p];
    withSize(part.size, [&](auto size) {
        if (part.fronts != kNullIndex) return factorFronts<size()>(items, part);
        assemble<size()>(items, part);
        eliminate(part);
    });
}

/// The lower triangle of an item's own block, in columns of `stride`.
template <class S>
template <int N>
void JointSystem<S>::addDiagonal(const Item& own, Real* m, std::size_t stride) {
    const int n = own.block->rows;
    for (int j = 0; j < N; ++j, m += stride)
        for (int i = j; i < N; ++i) {
            if (i >= n) {
                m[i] = i == j ? Real(1) : Real(0);
                continue;
            }
            m[i] = rowCoupling<S>(own.rows[i], own.rows[j], *own.block) +
                   (i == j ? own.rows[i].softness : Real(0));
        }
}

template <class S>
void JointSystem<S>::addCoupling(const Coupling& coupling, std::span<const Item> items, Real* m,
                                 std::size_t stride) {
    const Item &mine = items[coupling.rowItem], &other = items[coupling.columnItem];
    const Real invMass = coupling.isRowB ? mine.block->invMassB : mine.block->invMassA;
    const Real linear = coupling.isRowB == coupling.isColumnB ? invMass : -invMass;
    for (int j = 0; j < other.block->rows; ++j, m += stride) {
        const Row<S>& column = other.rows[j];
        const typename S::Vec lin = linear * column.lin;
        const typename S::Ang ang = coupling.isColumnB ? column.invIAngB : column.invIAngA;
        for (int i = 0; i < mine.block->rows; ++i) {
            const Row<S>& row = mine.rows[i];
            m[i] += row.lin.dot(lin) + dotAng(coupling.isRowB ? row.angB : row.angA, ang);
        }
    }
}

template <class S>
template <int N>
void JointSystem<S>::assemble(std::span<const Item> items, const Part& part) {
    constexpr int P = paddedRows<Real>(N), B = N * P;
    Real* m = diagonal_.data() + part.diagonal;
    for (std::uint32_t k = part.first; k < part.last; ++k, m += B) addDiagonal<N>(items[item_[k]], m, P);
    Real* lower = lower_.data() + part.lower;
    const std::size_t firstEntry = start_[part.first];
    std::fill(lower, lower + (start_[part.last] - firstEntry) * B, Real(0));
    for (std::size_t k = part.coupling; k < part.lastCoupling; ++k)
        addCoupling(couplings_[k], items, lower + (couplings_[k].at - firstEntry) * B, P);
}

/// The pivot with its shift, a fraction of K's diagonal before elimination; returns the floor of the pivot.
template <class S>
typename S::Real JointSystem<S>::shiftPivot(Real& pivot, Real epsilon) {
    const Real shift = std::max(pivot * epsilon, std::numeric_limits<Real>::min());
    pivot += shift;
    return shift / 2;
}

template <class S>
template <int N>
void JointSystem<S>::factorFronts(std::span<const Item> items, const Part& part) {
    JointFronts<Real>& fronts = fronts_[part.fronts];
    fronts.clear();
    Real *const numbers = fronts.numbers(), *floor = x_.data() + part.x;
    for (std::uint32_t k = 0; k < part.last - part.first; ++k) {
        const std::size_t stride = fronts.stride(k);
        Real* const m = numbers + fronts.placeOf(k, k);
        addDiagonal<N>(items[item_[part.first + k]], m, stride);
        for (std::size_t i = 0; i < N; ++i) *floor++ = shiftPivot(m[i * stride + i], kShift);
    }
    for (std::size_t k = part.coupling; k < part.lastCoupling; ++k) {
        const Coupling& coupling = couplings_[k];
        addCoupling(coupling, items, numbers + coupling.at,
                    fronts.stride(position_[coupling.columnItem] - part.first));
    }
    fronts.factor(x_.data() + part.x);
}

template <class S>
JointPart<typename S::Real> JointSystem<S>::kernelPart(const Part& part) {
    return {part.full,
            part.size,
            part.last - part.first,
            rows_.data() + part.first,
            start_.data() + part.first,
            row_.data(),
            part.first,
            target_.data() + part.target,
            diagonal_.data() + part.diagonal,
            lower_.data() + part.lower};
}

/// A chain or a tree that hangs on one fixed body has fewer couplings than items, and no redundant rows; a bridge
/// between two has one loop. In large parts of many loops, as flat nets, the directions that K hardly sees matter,
/// of which each solve without the excess gains less.
template <class S>
bool JointSystem<S>::hasFewLoops(const Part& part) {
    const std::size_t items = part.last - part.first, couplings = part.lastCoupling - part.coupling;
    const std::size_t anchors = std::max<std::size_t>(part.fixed, 1);
    const bool isTree = couplings < items && anchors == 1;
    return !isTree && (items <= kMechanism || couplings + anchors <= items + 1);
}

template <class S>
void JointSystem<S>::eliminate(const Part& part) {
    const auto size = static_cast<std::size_t>(part.size);
    const auto pad = static_cast<std::size_t>(paddedRows<Real>(part.size));
    Real *const diagonal = diagonal_.data() + part.diagonal, *const x = x_.data() + part.x;
    const std::size_t items = part.last - part.first;
    const bool mayBeRedundant = hasFewLoops(part);
    for (std::size_t k = 0; k < items; ++k)
        for (std::size_t i = 0; i < size; ++i)
            x[k * pad + i] =
                shiftPivot(diagonal[(k * size + i) * pad + i], mayBeRedundant ? kLoopShift : kShift);
    factorPart(kernelPart(part), x);
    if (!mayBeRedundant) return;
    // A pivot of which the shift is a large part belongs to a row that others make redundant. The diagonal has the
    // reciprocals of the pivots' roots now, x half their shifts.
    bool redundant = false;
    for (std::size_t k = 0; k < items; ++k)
        for (std::size_t i = 0; i < rows_[part.first + k]; ++i) {
            const Real inverse = diagonal[(k * size + i) * pad + i];
            redundant = redundant || !(Real(2) * kMostShift * x[k * pad + i] * inverse * inverse < 1) ||
                        !(inverse > 0);
        }
    redundant_[static_cast<std::size_t>(&part - parts_.data())] = redundant;
    for (std::size_t i = 0; redundant && i < items * pad; ++i) shift_[part.x + i] = Real(2) * x[i];
}

template <class S>
void JointSystem<S>::solve() {
    for (std::size_t p = 0; p < parts_.size(); ++p) solve(p);
}

template <class S>
void JointSystem<S>::solve(std::size_t p) {
    const Part& part = parts_[p];
    if (part.fronts != kNullIndex) return fronts_[part.fronts].solve(x_.data() + part.x);
    Real* const x = x_.data() + part.x;
    solvePart(kernelPart(part), x);
    if (redundant_[p]) dropRedundant(part, numbersOf(p), x);
}

/// Takes from x the directions that K does not see: (K + D)^-1 K x, D the shifts of the pivots. Right sides of which no
/// impulse can change a part, as biases of redundant rows that do not agree yet, would leave 1 / epsilon times that part.
template <class S>
void JointSystem<S>::dropRedundant(const Part& part, std::size_t n, Real* x) {
    Real *const shift = shift_.data() + part.x, *const excess = excess_.data() + part.x;
    for (std::size_t i = 0; i < n; ++i) excess[i] = shift[i] * x[i];
    solvePart(kernelPart(part), excess);
    for (std::size_t i = 0; i < n; ++i) x[i] -= excess[i];
}

template <class S>
std::size_t JointSystem<S>::numbersOf(std::size_t p) const {
    return (p + 1 < parts_.size() ? parts_[p + 1].x : x_.size()) - parts_[p].x;
}

template <class S>
void JointSystem<S>::solveLanes(std::size_t p, Real* x) {
    const Part& part = parts_[p];
    if (part.fronts == kNullIndex) return solvePartLanes(kernelPart(part), x);
    Real* const own = x_.data() + part.x;
    const std::size_t n = numbersOf(p);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        for (std::size_t i = 0; i < n; ++i) own[i] = x[i * kLanes + lane];
        fronts_[part.fronts].solve(own);
        for (std::size_t i = 0; i < n; ++i) x[i * kLanes + lane] = own[i];
    }
}

RIGOR_INSTANTIATE_CLASS(JointSystem)

}  // namespace rigor::engine
