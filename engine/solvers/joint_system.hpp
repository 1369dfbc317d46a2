// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All blocks of equality rows at once, by a direct method: see joint_system.cpp.
#pragma once

#include <span>
#include <vector>

#include "engine/constraints/row.hpp"

namespace rigor::engine {

template <class S>
class JointSystem {
  public:
    using Real = typename S::Real;
    /// A block of equality rows (1..6) and its rows; products with the inverse inertia are filled.
    struct Item {
        const Block<S>* block = nullptr;
        const Row<S>* rows = nullptr;
    };

    /// Factors K of the items. False: so many blocks meet at the same bodies that the factors would be nearly
    /// dense (more than kMaxFill blocks per item); then there are no factors and solve() may not be called.
    bool factor(std::span<const Item> items);
    /// Where the right side of an item stands and the solution is left, in the order of factor().
    BlockVector<S>& at(std::size_t item) { return x_[place_[item]]; }
    /// K x = right side.
    void solve();

  private:
    static constexpr std::size_t kMaxFill = 24;

    /// What decides the pattern of K.
    struct Place {
        std::uint32_t a, b;  ///< bodies; kFixed: moved by no impulse
        std::uint32_t rows;
        friend bool operator==(const Place&, const Place&) = default;
    };
    static constexpr std::uint32_t kFixed = 0xffffffff;

    bool analyse();
    void assemble(std::span<const Item> items);
    void eliminate();
    std::size_t entry(std::size_t column, std::uint32_t row) const;

    std::vector<Place> pattern_, wanted_;
    bool fits_ = false;
    std::vector<std::uint32_t> place_;  ///< item -> position in the elimination
    std::vector<std::uint32_t> item_;   ///< position -> item
    /// Blocks below the diagonal, column by column; entries of a column by growing row (positions).
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> row_;
    std::vector<BlockMatrix<S>> lower_;    ///< K, then L
    std::vector<BlockMatrix<S>> inverse_;  ///< diagonal blocks of K, then D^-1
    std::vector<BlockVector<S>> x_;
    std::vector<BlockMatrix<S>> column_;  ///< scratch: L D of the column being eliminated
};

}  // namespace rigor::engine
