// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/constraints/row.hpp"

#include <limits>
#include "engine/math/decompositions.hpp"

namespace rigor::engine {

template <class S>
void invertBlock(const Row<S>* rows, const Block<S>& block, BlockMatrix<S>& inverse) {
    using Real = typename S::Real;
    const int n = block.rows;
    BlockMatrix<S> K(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j)
            K(i, j) = K(j, i) =
                rowCoupling<S>(rows[i], rows[j], block) + (i == j ? rows[i].softness : Real(0));
    // A direction that neither body can follow makes K singular; a shift far below every other entry gives it
    // an impulse without effect instead of a division by zero.
    const Real floor =
        std::numeric_limits<Real>::epsilon() * std::max(K.trace(), std::numeric_limits<Real>::min());
    for (int i = 0; i < n; ++i)
        if (K(i, i) <= floor) K(i, i) = floor;
    inverse = K.ldlt().solve(BlockMatrix<S>::Identity(n, n));
    if (!inverse.allFinite()) {
        inverse.setZero(n, n);
        for (int i = 0; i < n; ++i) inverse(i, i) = Real(1) / K(i, i);
    }
}

template <class S>
void ConstraintRows<S>::relax() {
    using Real = typename S::Real;
    for (const Block<S>& block : blocks) {
        bool hardened = false;
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            Row<S>& row = rows[i];
            row.bias = row.relaxedBias;
            if (row.softness == row.relaxedSoftness) continue;
            row.softness = row.relaxedSoftness;
            const Real K = rowK<S>(row, block);
            row.invK = K > 0 ? Real(1) / K : Real(0);
            hardened = true;
        }
        if (hardened && block.kind == BlockKind::Joint && block.matrix < matrices.size())
            invertBlock<S>(rows.data() + block.first, block, matrices[block.matrix]);
    }
}
template struct ConstraintRows<Space2f>;
template struct ConstraintRows<Space2d>;
template struct ConstraintRows<Space3f>;
template struct ConstraintRows<Space3d>;

template void invertBlock<Space2f>(const Row<Space2f>*, const Block<Space2f>&, BlockMatrix<Space2f>&);
template void invertBlock<Space2d>(const Row<Space2d>*, const Block<Space2d>&, BlockMatrix<Space2d>&);
template void invertBlock<Space3f>(const Row<Space3f>*, const Block<Space3f>&, BlockMatrix<Space3f>&);
template void invertBlock<Space3d>(const Row<Space3d>*, const Block<Space3d>&, BlockMatrix<Space3d>&);

}  // namespace rigor::engine
