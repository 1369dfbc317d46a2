// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/material_table.hpp"

#include <algorithm>

namespace rigor::engine {

template <class S>
PairCoefficients<S> MaterialTable<S>::combine(const PairCoefficients<S>& a,
                                              const PairCoefficients<S>& b) const {
    PairCoefficients<S> both{combineFriction_(a.friction, b.friction),
                             combineRestitution_(a.restitution, b.restitution), Real(0)};
    if (a.staticFriction > 0 || b.staticFriction > 0)
        both.staticFriction = std::max(
            both.friction,
            combineFriction_(std::max(a.friction, a.staticFriction), std::max(b.friction, b.staticFriction)));
    both.rollingFriction = combineFriction_(a.rollingFriction, b.rollingFriction);
    both.torsionalFriction = combineFriction_(a.torsionalFriction, b.torsionalFriction);
    return both;
}

template <class S>
void MaterialTable<S>::setCombineRules(CombineRule<Real> friction, CombineRule<Real> restitution) {
    combineFriction_ = friction;
    combineRestitution_ = restitution;
    add({Real(0.6), Real(0), Real(0)});
}

template <class S>
std::uint32_t MaterialTable<S>::add(const PairCoefficients<S>& own) {
    const std::uint32_t added = size_++;
    materials_.push_back(own);
    std::vector<PairCoefficients<S>> table(size_ * size_);
    for (std::uint32_t a = 0; a < size_; ++a)
        for (std::uint32_t b = 0; b < size_; ++b) {
            if (a < added && b < added)
                table[a * size_ + b] = pairs_[a * added + b];
            else
                table[a * size_ + b] = combine(materials_[a], materials_[b]);
        }
    pairs_ = std::move(table);
    ++revision_;
    return added;
}

template <class S>
void MaterialTable<S>::setPair(std::uint32_t a, std::uint32_t b, const PairCoefficients<S>& coefficients) {
    pairs_[a * size_ + b] = pairs_[b * size_ + a] = coefficients;
    ++revision_;
}

RIGOR_INSTANTIATE_CLASS(MaterialTable)

}  // namespace rigor::engine
