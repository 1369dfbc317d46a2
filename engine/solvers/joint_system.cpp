// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints all at once. Let J be the rows of all equality blocks and
//     K = J M^-1 J^T + softness,      K x = right side
// K couples two blocks where they share a body that can move, so it is sparse; block LDL^T with a
// minimum-degree order [GeorgeLiu1989] eliminates chains and trees of joints from their leaves without any
// fill, in time linear in their number, as [Baraff1996] does with the larger system of M and J. Loops add
// some fill. The pattern is analysed when it changes, not in every step.
//
// Redundant rows (a closed loop of 3D hinges has three) make K singular. Each pivot gets epsilon K_ii on top:
// a solution exists, tiny in the directions that change nothing. The error this leaves elsewhere goes with
// repeated solves for what is left: each multiplies it by epsilon / (epsilon + sigma), for sigma the row's
// relative stiffness (proximal point method). epsilon is the precision to the power 2/3: 3.7e-11 and 2.4e-5.
//
// Cost: sum over the columns of L of (blocks in it)^2 products of 6 x 6. Limit: n joints at one body make a
// dense n x n; beyond kMaxFill blocks per item the caller has to do without.
#include "engine/solvers/joint_system.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::engine {
namespace {

/// K of row r1 of one block against r2 of another through a body they share; the signs are those of lin.
template <class S>
typename S::Real coupling(const Row<S>& r1, bool isB1, const Row<S>& r2, bool isB2,
                          typename S::Real invMass) {
    const typename S::Real linear = invMass * r1.lin.dot(r2.lin);
    return (isB1 == isB2 ? linear : -linear) +
           dotAng(isB1 ? r1.angB : r1.angA, isB2 ? r2.invIAngB : r2.invIAngA);
}

/// Inverse of a symmetric positive definite matrix by Cholesky, whose pivots are kept at `floor` of the
/// original diagonal or above.
template <class S>
void invert(BlockMatrix<S>& m, const BlockVector<S>& floor) {
    using Real = typename S::Real;
    const Eigen::Index n = m.rows();
    BlockMatrix<S> L = BlockMatrix<S>::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        Real d = m(j, j);
        for (Eigen::Index k = 0; k < j; ++k) d -= L(j, k) * L(j, k);
        L(j, j) = std::sqrt(std::max(d, floor[j]));
        for (Eigen::Index i = j + 1; i < n; ++i) {
            Real sum = m(i, j);
            for (Eigen::Index k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
            L(i, j) = sum / L(j, j);
        }
    }
    for (Eigen::Index c = 0; c < n; ++c) {
        BlockVector<S> x = BlockVector<S>::Zero(n);
        for (Eigen::Index i = c; i < n; ++i) {
            Real sum = i == c ? Real(1) : Real(0);
            for (Eigen::Index k = c; k < i; ++k) sum -= L(i, k) * x[k];
            x[i] = sum / L(i, i);
        }
        for (Eigen::Index i = n - 1; i >= 0; --i) {
            Real sum = x[i];
            for (Eigen::Index k = i + 1; k < n; ++k) sum -= L(k, i) * x[k];
            x[i] = sum / L(i, i);
        }
        m.col(c) = x;
    }
}

}  // namespace

template <class S>
bool JointSystem<S>::factor(std::span<const Item> items) {
    wanted_.clear();
    for (const Item& item : items) {
        const Block<S>& block = *item.block;
        wanted_.push_back(
            {block.invMassA > 0 ? block.a : kFixed, block.invMassB > 0 ? block.b : kFixed, block.rows});
    }
    if (wanted_ != pattern_) {
        pattern_ = wanted_;
        fits_ = analyse();
    }
    if (!fits_) return false;
    assemble(items);
    eliminate();
    return true;
}

/// Order of elimination and pattern of L. Allocates.
template <class S>
bool JointSystem<S>::analyse() {
    const std::size_t n = pattern_.size();
    // Who is at each body, so that neighbours are found without looking at all pairs.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> visits;
    for (std::uint32_t i = 0; i < n; ++i)
        for (const std::uint32_t body : {pattern_[i].a, pattern_[i].b})
            if (body != kFixed) visits.push_back({body, i});
    std::sort(visits.begin(), visits.end());
    std::vector<std::vector<std::uint32_t>> near(n);
    std::size_t fill = 0;
    for (std::size_t k = 0; k < visits.size(); ++k)
        for (std::size_t l = k + 1; l < visits.size() && visits[l].first == visits[k].first; ++l) {
            if (++fill > kMaxFill * n) return false;
            near[visits[k].second].push_back(visits[l].second);
            near[visits[l].second].push_back(visits[k].second);
        }
    for (auto& list : near) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    place_.assign(n, kFixed), item_.clear(), start_.assign(1, 0), row_.clear();
    std::vector<std::vector<std::uint32_t>> columns;
    for (std::size_t k = 0; k < n; ++k) {
        std::uint32_t next = kFixed;
        for (std::uint32_t i = 0; i < n; ++i)
            if (place_[i] == kFixed && (next == kFixed || near[i].size() < near[next].size())) next = i;
        place_[next] = static_cast<std::uint32_t>(k);
        item_.push_back(next);
        // Eliminating it joins its neighbours to each other.
        for (const std::uint32_t i : near[next]) {
            auto& list = near[i];
            list.erase(std::find(list.begin(), list.end(), next));
            std::vector<std::uint32_t> both;
            std::set_union(list.begin(), list.end(), near[next].begin(), near[next].end(),
                           std::back_inserter(both));
            both.erase(std::find(both.begin(), both.end(), i));
            list = both;
        }
        columns.push_back(near[next]);
        fill += near[next].size();
        if (fill > 2 * kMaxFill * n) return false;
    }
    for (auto& column : columns) {
        for (std::uint32_t& i : column) i = place_[i];
        std::sort(column.begin(), column.end());
        row_.insert(row_.end(), column.begin(), column.end());
        start_.push_back(row_.size());
    }
    lower_.resize(row_.size());
    inverse_.resize(n), x_.resize(n);
    for (std::size_t k = 0; k < n; ++k) x_[k].setZero(pattern_[item_[k]].rows);
    return true;
}

template <class S>
std::size_t JointSystem<S>::entry(std::size_t column, std::uint32_t row) const {
    const auto first = row_.begin() + static_cast<std::ptrdiff_t>(start_[column]);
    const auto last = row_.begin() + static_cast<std::ptrdiff_t>(start_[column + 1]);
    return static_cast<std::size_t>(std::lower_bound(first, last, row) - row_.begin());
}

template <class S>
void JointSystem<S>::assemble(std::span<const Item> items) {
    for (std::size_t k = 0; k < item_.size(); ++k) {
        const Item& own = items[item_[k]];
        const int n = own.block->rows;
        BlockMatrix<S>& diagonal = inverse_[k];
        diagonal.resize(n, n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j)
                diagonal(i, j) = diagonal(j, i) = rowCoupling<S>(own.rows[i], own.rows[j], *own.block) +
                                                  (i == j ? own.rows[i].softness : Real(0));
        for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) {
            const Item& other = items[item_[row_[e]]];
            BlockMatrix<S>& m = lower_[e];
            m.setZero(other.block->rows, n);
            for (const bool isB1 : {false, true})
                for (const bool isB2 : {false, true}) {
                    const std::uint32_t body = isB1 ? other.block->b : other.block->a;
                    const Real invMass = isB1 ? other.block->invMassB : other.block->invMassA;
                    if (!(invMass > 0) || body != (isB2 ? own.block->b : own.block->a)) continue;
                    for (int i = 0; i < other.block->rows; ++i)
                        for (int j = 0; j < n; ++j)
                            m(i, j) += coupling<S>(other.rows[i], isB1, own.rows[j], isB2, invMass);
                }
        }
    }
}

template <class S>
void JointSystem<S>::eliminate() {
    const Real root = std::cbrt(std::numeric_limits<Real>::epsilon()), epsilon = root * root;
    // The shift is a share of K's diagonal before elimination.
    for (std::size_t k = 0; k < item_.size(); ++k) {
        BlockVector<S> floor = inverse_[k].diagonal() * epsilon;
        for (Eigen::Index i = 0; i < floor.size(); ++i)
            floor[i] = std::max(floor[i], std::numeric_limits<Real>::min());
        inverse_[k].diagonal() += floor;
        x_[k] = floor;
    }
    for (std::size_t k = 0; k < item_.size(); ++k) {
        invert<S>(inverse_[k], x_[k]);
        const std::size_t first = start_[k], last = start_[k + 1];
        if (column_.size() < last - first) column_.resize(last - first);
        for (std::size_t e = first; e < last; ++e) {
            column_[e - first] = lower_[e];
            lower_[e] = column_[e - first] * inverse_[k];
        }
        for (std::size_t e = first; e < last; ++e) {
            const std::size_t j = row_[e];
            inverse_[j] -= lower_[e] * column_[e - first].transpose();
            for (std::size_t f = e + 1; f < last; ++f)
                lower_[entry(j, row_[f])] -= lower_[f] * column_[e - first].transpose();
        }
    }
}

template <class S>
void JointSystem<S>::solve() {
    for (std::size_t k = 0; k < item_.size(); ++k)
        for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) x_[row_[e]] -= lower_[e] * x_[k];
    for (std::size_t k = item_.size(); k-- > 0;) {
        x_[k] = BlockVector<S>(inverse_[k] * x_[k]);
        for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) x_[k] -= lower_[e].transpose() * x_[row_[e]];
    }
}

template class JointSystem<Space2f>;
template class JointSystem<Space2d>;
template class JointSystem<Space3f>;
template class JointSystem<Space3d>;

}  // namespace rigor::engine
