// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All blocks of equality rows at once, by a direct method: see joint_system.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/constraints/row.hpp"
#include "engine/core/ids.hpp"
#include "engine/core/tasks.hpp"
#include "engine/solvers/joints/elimination.hpp"
#include "engine/solvers/joints/joint_fronts.hpp"
#include "engine/solvers/joints/part_kernels.hpp"

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

    /// Factors K of the items. False: so many blocks share bodies that the factors would be nearly
    /// dense (more than kMaxFill blocks per item); then there are no factors and solve() may not be called.
    /// Allocates where the items' bodies or numbers of rows are not those of the call before.
    bool factor(std::span<const Item> items, const Tasks& tasks = Tasks::one());
    /// The same in two steps: finds the parts of the items, and factors one of them.
    bool begin(std::span<const Item> items);
    void factor(std::span<const Item> items, std::size_t part);
    /// Right side of an item, replaced by its solution, one number per row, in the order of factor(). All
    /// right sides have to be set before each solve().
    Real* at(std::size_t item) { return x_.data() + place_[item]; }
    /// K x = right side.
    void solve();
    /// Items that are connected are a part. The same for one of the parts: threads may solve several at once.
    void solve(std::size_t part);
    /// The part of an item.
    std::uint32_t partOf(std::size_t item) const { return part_[item]; }
    /// kLanes right sides of a part at once: `x` has numbersOf(part) times kLanes numbers, those of an item from
    /// laneAt(item) times kLanes on, the lanes of each row together; 0 where an item has no row.
    static constexpr std::size_t kLanes = kJointLanes<Real>;
    void solveLanes(std::size_t part, Real* x);
    std::size_t numbersOf(std::size_t part) const;
    std::size_t laneAt(std::size_t item) const { return place_[item] - parts_[part_[item]].x; }

  private:
    static constexpr std::size_t kMaxFill = 24;
    static constexpr std::size_t kMechanism =
        8;  ///< largest number of items of a part with several loops that is looked at for redundant rows
    static constexpr Real kMostShift =
        Real(100);  ///< pivots of redundant rows are less than this times their shift
    /// Fraction of K's diagonal on top of it, and in parts of few loops.
    static constexpr Real kShift = sizeof(Real) == sizeof(float) ? Real(2.4e-5) : Real(3.7e-11);
    static constexpr Real kLoopShift = std::max(kShift, Real(1e-9));
    static constexpr std::size_t kGrain = 8;  ///< parts: one takes some microseconds
    /// Items, and products of blocks per item, from which dense fronts are faster than blocks.
    static constexpr std::size_t kMinFrontItems = 60, kLongColumns = 24;

    /// Bodies and size of an item: they determine the sparsity pattern of K.
    struct Place {
        std::uint32_t a, b;  ///< bodies; kNullIndex: moved by no impulse
        std::uint32_t rows;
        friend bool operator==(const Place&, const Place&) = default;
    };
    /// An off-diagonal block of K, below the diagonal: two items that act on the same body.
    struct Coupling {
        std::size_t at;                     ///< entry of row_; place of the block in the fronts, if there are
                                            ///< any
        std::uint32_t rowItem, columnItem;  ///< the item of the block's rows, and that of its columns
        bool isRowB, isColumnB;             ///< true if the body is B of these items
    };
    /// Items that are connected, as consecutive positions: blocks of one size, that of the largest.
    struct Part {
        std::uint32_t first, last;           ///< positions, the last one excluded
        int size;                            ///< rows of a block
        std::size_t coupling, lastCoupling;  ///< range of its couplings, the last one excluded
        std::size_t lower, diagonal, x;      ///< indices of its first numbers
        std::size_t target;                  ///< index of its first entry in target_
        std::uint32_t fronts;                ///< kNullIndex, or where its fronts are
        bool full;                           ///< all its items have `size` rows
        std::uint32_t fixed;                 ///< number of its items one of whose bodies no impulse moves
    };
    static Place placeOf(const Item& item);
    bool analyse(std::span<const Item> items);
    bool findOrder(std::vector<std::vector<std::uint32_t>> near, Elimination& order) const;
    bool needsFronts(std::uint32_t first, std::uint32_t last) const;
    void layOut(Elimination& order);
    void findTargets(const Part& part);
    void findCouplings(std::span<const std::pair<std::uint32_t, std::uint32_t>> incidences);
    std::size_t entry(std::size_t column, std::uint32_t row) const;
    template <int N>
    void assemble(std::span<const Item> items, const Part& part);
    template <int N>
    void factorFronts(std::span<const Item> items, const Part& part);
    template <int N>
    static void addDiagonal(const Item& item, Real* m, std::size_t stride);
    static void addCoupling(const Coupling& coupling, std::span<const Item> items, Real* m,
                            std::size_t stride);
    static Real shiftPivot(Real& pivot, Real epsilon);
    static bool hasFewLoops(const Part& part);
    void eliminate(const Part& part);
    void dropRedundant(const Part& part, std::size_t n, Real* x);
    JointPart<Real> kernelPart(const Part& part);

    std::vector<Place> pattern_;
    bool fits_ = false;
    std::vector<Part> parts_;
    std::vector<Coupling> couplings_;
    std::vector<std::uint32_t> item_;      ///< position -> item
    std::vector<std::uint8_t> rows_;       ///< position -> rows of its item
    std::vector<std::uint32_t> position_;  ///< item -> position
    std::vector<std::uint32_t> part_;      ///< item -> part
    std::vector<std::size_t> place_;       ///< item -> place of its right side in x_
    /// Blocks below the diagonal, column by column; entries of a column by growing row (positions).
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> row_;
    /// Target of each column and each pair of its entries e < f: the entry of column row_[e] in row row_[f],
    /// counted from its part's first.
    std::vector<std::uint32_t> target_;
    std::vector<Real> lower_;  ///< K, then L
    /// Diagonal blocks of K, then of L, with the reciprocals of its own diagonal.
    std::vector<Real> diagonal_;
    std::vector<Real> x_;
    std::vector<Real> shift_, excess_;       ///< like x_: shifts of the pivots; shifts times solutions
    std::vector<std::uint8_t> redundant_;    ///< part -> has redundant rows
    std::vector<JointFronts<Real>> fronts_;  ///< instead of lower_ and diagonal_ where columns are long
};

}  // namespace rigor::engine
