// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// J1 M^-1 J2^T of rows of different blocks, by the bodies that both act on. Rows of one block: rowCoupling (row.hpp).
#pragma once

#include "engine/constraints/row.hpp"

namespace rigor::engine {

/// J1 M^-1 J2^T of rows of two blocks, one body of each: the same body.
template <class S>
typename S::Real bodyCoupling(const Row<S>& r1, bool isB1, const Row<S>& r2, bool isB2,
                              typename S::Real invMass) {
    const typename S::Real linear = isB1 == isB2 ? invMass : -invMass;
    return linear * r1.lin.dot(r2.lin) + dotAng(isB1 ? r1.angB : r1.angA, isB2 ? r2.invIAngB : r2.invIAngA);
}

/// J1 M^-1 J2^T of rows of two blocks.
template <class S>
typename S::Real blockCoupling(const Row<S>& r1, const Block<S>& b1, const Row<S>& r2, const Block<S>& b2) {
    typename S::Real sum = 0;
    if (b1.a == b2.a) sum += bodyCoupling<S>(r1, false, r2, false, b1.invMassA);
    if (b1.a == b2.b) sum += bodyCoupling<S>(r1, false, r2, true, b1.invMassA);
    if (b1.b == b2.a) sum += bodyCoupling<S>(r1, true, r2, false, b1.invMassB);
    if (b1.b == b2.b) sum += bodyCoupling<S>(r1, true, r2, true, b1.invMassB);
    return sum;
}

}  // namespace rigor::engine
