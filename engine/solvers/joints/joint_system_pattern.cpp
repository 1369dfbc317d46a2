// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Part of a joint system that is constant while the joints' bodies are the same: the order of elimination,
// the pattern of L and the memory layout. Allocates; joint_system.cpp does not.
#include <algorithm>

#include "engine/solvers/joints/dissection.hpp"
#include "engine/solvers/joints/joint_system.hpp"

namespace rigor::engine {
/// Order of elimination and pattern of L. Allocates.
template <class S>
bool JointSystem<S>::analyse(std::span<const Item> items) {
    const std::size_t n = items.size();
    pattern_.clear();
    for (const Item& item : items) pattern_.push_back(placeOf(item));
    // Joints at each body, so that neighbours are found without looking at all pairs.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> incidences;
    for (std::uint32_t i = 0; i < n; ++i)
        for (const std::uint32_t body : {pattern_[i].a, pattern_[i].b})
            if (body != kNullIndex) incidences.push_back({body, i});
    std::sort(incidences.begin(), incidences.end());
    std::vector<std::vector<std::uint32_t>> near(n);
    std::size_t met = 0;
    for (std::size_t k = 0; k < incidences.size(); ++k)
        for (std::size_t l = k + 1; l < incidences.size() && incidences[l].first == incidences[k].first;
             ++l) {
            if (++met > kMaxFill * n) return false;
            near[incidences[k].second].push_back(incidences[l].second);
            near[incidences[l].second].push_back(incidences[k].second);
        }
    for (auto& list : near) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    Elimination order;
    if (!findOrder(std::move(near), order)) return false;
    layOut(order);
    findCouplings(incidences);
    return true;
}

/// Finds the order by minimum degree, which is best for chains and trees, or by dissection where that makes
/// fewer products.
template <class S>
bool JointSystem<S>::findOrder(std::vector<std::vector<std::uint32_t>> near, Elimination& order) const {
    const std::size_t n = near.size(), most = kMaxFill * n;
    const bool found = findElimination(near, most, order);
    if (n < kMinFrontItems || (found && order.products() < kLongColumns * n)) return found;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
    std::size_t bodies = 0;
    for (const Place& place : pattern_) {
        ends.push_back({place.a, place.b});
        for (const std::uint32_t body : {place.a, place.b})
            if (body != kNullIndex) bodies = std::max(bodies, std::size_t(body) + 1);
    }
    Elimination dissected;
    if (!findElimination(std::move(near), dissectJoints(ends, bodies), most, dissected)) return found;
    if (!found || dissected.products() < order.products()) order = std::move(dissected);
    return true;
}

/// Assigns the memory layout.
template <class S>
void JointSystem<S>::layOut(Elimination& order) {
    item_.swap(order.order);
    start_.swap(order.start);
    row_.swap(order.row);
    const std::size_t n = item_.size();
    position_.resize(n);
    part_.resize(n);
    rows_.resize(n);
    place_.resize(n);
    parts_.clear();
    target_.clear();
    fronts_.clear();
    std::size_t lower = 0, diagonal = 0, x = 0;
    for (std::size_t p = 0; p + 1 < order.part.size(); ++p) {
        Part part{order.part[p],  order.part[p + 1], 1,    0, 0, lower, diagonal, x,
                  target_.size(), kNullIndex,        true, 0};
        for (std::uint32_t k = part.first; k < part.last; ++k) {
            position_[item_[k]] = k;
            rows_[k] = static_cast<std::uint8_t>(pattern_[item_[k]].rows);
            part_[item_[k]] = static_cast<std::uint32_t>(parts_.size());
            part.size = std::max(part.size, static_cast<int>(pattern_[item_[k]].rows));
            part.fixed += pattern_[item_[k]].a == kNullIndex || pattern_[item_[k]].b == kNullIndex;
        }
        for (std::uint32_t k = part.first; k < part.last; ++k) part.full = part.full && rows_[k] == part.size;
        const auto size = static_cast<std::size_t>(part.size);
        const auto block = size * static_cast<std::size_t>(paddedRows<Real>(part.size));
        const bool long_ = needsFronts(part.first, part.last);
        const std::size_t pad = long_ ? size : block / size;
        for (std::uint32_t k = part.first; k < part.last; ++k) place_[item_[k]] = x + (k - part.first) * pad;
        x += (part.last - part.first) * pad;
        if (long_) {
            part.fronts = static_cast<std::uint32_t>(fronts_.size());
            fronts_.emplace_back().analyse({start_.data() + part.first, part.last - part.first + 1}, row_,
                                           part.first, part.size);
        } else {
            findTargets(part);
            lower += (start_[part.last] - start_[part.first]) * block;
            diagonal += (part.last - part.first) * block;
        }
        parts_.push_back(part);
    }
    lower_.assign(lower, Real(0));
    diagonal_.assign(diagonal, Real(0));
    x_.assign(x, Real(0));
    shift_.assign(x, Real(0));
    excess_.assign(x, Real(0));
    redundant_.assign(parts_.size(), 0);
}

/// True if the columns of a part are so long that dense fronts are faster than blocks.
template <class S>
bool JointSystem<S>::needsFronts(std::uint32_t first, std::uint32_t last) const {
    std::size_t products = 0;
    for (std::uint32_t k = first; k < last; ++k) {
        const std::size_t count = start_[k + 1] - start_[k];
        products += count * (count + 3) / 2;
    }
    return last - first >= kMinFrontItems && products >= kLongColumns * (last - first);
}

template <class S>
void JointSystem<S>::findTargets(const Part& part) {
    for (std::uint32_t k = part.first; k < part.last; ++k)
        for (std::size_t e = start_[k]; e < start_[k + 1]; ++e)
            for (std::size_t f = e + 1; f < start_[k + 1]; ++f)
                target_.push_back(static_cast<std::uint32_t>(entry(row_[e], row_[f]) - start_[part.first]));
}

/// Pairs of items at a body that impulses move, in the order of the parts.
template <class S>
void JointSystem<S>::findCouplings(std::span<const std::pair<std::uint32_t, std::uint32_t>> incidences) {
    couplings_.clear();
    for (std::size_t k = 0; k < incidences.size(); ++k)
        for (std::size_t l = k + 1; l < incidences.size() && incidences[l].first == incidences[k].first;
             ++l) {
            std::uint32_t i = incidences[k].second, j = incidences[l].second;
            if (i == j) continue;
            if (position_[i] < position_[j]) std::swap(i, j);
            const std::uint32_t body = incidences[k].first;
            couplings_.push_back(
                {entry(position_[j], position_[i]), i, j, pattern_[i].b == body, pattern_[j].b == body});
        }
    std::sort(couplings_.begin(), couplings_.end(),
              [](const Coupling& a, const Coupling& b) { return a.at < b.at; });
    std::size_t m = 0;
    for (Part& part : parts_) {
        part.coupling = m;
        while (m < couplings_.size() && couplings_[m].at < start_[part.last]) ++m;
        part.lastCoupling = m;
        if (part.fronts == kNullIndex) continue;
        for (std::size_t k = part.coupling; k < m; ++k) {
            Coupling& coupling = couplings_[k];
            coupling.at = fronts_[part.fronts].placeOf(position_[coupling.rowItem] - part.first,
                                                       position_[coupling.columnItem] - part.first);
        }
    }
}

template <class S>
std::size_t JointSystem<S>::entry(std::size_t column, std::uint32_t row) const {
    const auto first = row_.begin() + static_cast<std::ptrdiff_t>(start_[column]);
    const auto last = row_.begin() + static_cast<std::ptrdiff_t>(start_[column + 1]);
    return static_cast<std::size_t>(std::lower_bound(first, last, row) - row_.begin());
}

#define RIGOR_INSTANTIATE(S) template bool JointSystem<S>::analyse(std::span<const Item>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
