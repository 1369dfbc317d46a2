// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Materials, and the coefficients of each pair of them.
//
//     materials  [ 0 | 1 | 2 ]        0 and 1: kFrictionless, kUsualMaterial (state/world_def.hpp)
//     pairs      [ 00 01 02 ]         row by row; by the combine rules, or as set
//                [ 10 11 12 ]
//                [ 20 21 22 ]
//
// Invariant: the table of pairs is symmetric and has a cell for every two materials.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solvers/combine_rules.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

template <class S>
class MaterialTable {
  public:
    using Real = typename S::Real;

    /// Must be called once, before materials are added: adds the usual one.
    void setCombineRules(CombineRule<Real> friction, CombineRule<Real> restitution);
    /// A material of these coefficients with itself. Returns its index.
    std::uint32_t add(const PairCoefficients<S>& own);
    void setPair(std::uint32_t a, std::uint32_t b, const PairCoefficients<S>& coefficients);
    const PairCoefficients<S>& pair(std::uint32_t a, std::uint32_t b) const { return pairs_[a * size_ + b]; }
    std::uint32_t size() const { return size_; }
    /// Makes contacts read anew what they keep of their shapes' surfaces.
    void touch() { ++revision_; }
    /// Another number after every change.
    std::uint64_t revision() const { return revision_; }

  private:
    PairCoefficients<S> combine(const PairCoefficients<S>& a, const PairCoefficients<S>& b) const;

    CombineRule<Real> combineFriction_ = nullptr, combineRestitution_ = nullptr;
    std::uint32_t size_ = 1;
    std::vector<PairCoefficients<S>> materials_ = std::vector<PairCoefficients<S>>(1);
    std::vector<PairCoefficients<S>> pairs_ = std::vector<PairCoefficients<S>>(1);
    std::uint64_t revision_ = 1;
};

}  // namespace rigor::engine
