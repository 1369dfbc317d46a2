// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The kernel is compiled once for every instruction set (hwy/foreach_target.h includes this file again).
#include "engine/solvers/lcp/lu_kernels.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solvers/lcp/lu_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// to -= factor * from
HWY_INLINE void subtractMultiple(double factor, const double* from, double* to, std::size_t count) {
    const hn::ScalableTag<double> d;
    const std::size_t lanes = hn::Lanes(d);
    const auto factors = hn::Set(d, factor);
    std::size_t j = 0;
    for (; j + lanes <= count; j += lanes)
        hn::StoreU(hn::Sub(hn::LoadU(d, to + j), hn::Mul(factors, hn::LoadU(d, from + j))), d, to + j);
    for (; j < count; ++j) to[j] -= factor * from[j];
}

void eliminateBelow(const LuRows& rows, std::size_t k) {
    const double* const pivotRow = rows.at + k * rows.n;
    const double pivot = pivotRow[k];
    const std::size_t end = rows.end[k];
    for (std::size_t i = k + 1; i < rows.below; ++i) {
        double* const row = rows.at + i * rows.n;
        if (row[k] == 0) continue;
        const double factor = row[k] / pivot;
        row[k] = factor;
        subtractMultiple(factor, pivotRow + k + 1, row + k + 1, end - (k + 1));
        rows.end[i] = std::max(rows.end[i], end);
    }
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigor::engine {

HWY_EXPORT(eliminateBelow);

void eliminateColumn(const LuRows& rows, std::size_t k) {
    HWY_DYNAMIC_DISPATCH(eliminateBelow)(rows, k);
}

}  // namespace rigor::engine
#endif
