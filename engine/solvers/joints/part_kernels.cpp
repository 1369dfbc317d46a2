// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The kernels are compiled once for every instruction set (hwy/foreach_target.h includes this file again). They
// are loops of fixed length over the padded rows of a block, which the compiler turns into vector instructions;
// the columns of a block are as many as its item has rows.
#include "engine/solvers/joints/part_kernels.hpp"

#include <cmath>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solvers/joints/part_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

/// C -= A B^T for blocks A of one column, with `depth` columns, and `columns` columns of C.
template <int P, class R>
HWY_INLINE void subtractProduct(const R* __restrict A, const R* __restrict B, R* __restrict C, int depth,
                                int columns) {
    for (int c = 0; c < columns; ++c) {
        R sum[P];
        for (int r = 0; r < P; ++r) sum[r] = C[c * P + r];
        for (int k = 0; k < depth; ++k) {
            const R b = B[k * P + c];
            for (int r = 0; r < P; ++r) sum[r] -= A[k * P + r] * b;
        }
        for (int r = 0; r < P; ++r) C[c * P + r] = sum[r];
    }
}

/// Cholesky factor of a symmetric block, in its lower triangle, with the reciprocals of its diagonal. A pivot
/// at `floor` or below is one that rounding has spoilt: its unknown is left out, with zeros in its column.
template <int P, class R>
HWY_INLINE void factorBlock(R* m, const R* floor, int rows) {
    for (int j = 0; j < rows; ++j) {
        R* const column = m + j * P;
        for (int k = 0; k < j; ++k)
            for (int i = j; i < rows; ++i) column[i] -= m[k * P + i] * m[k * P + j];
        const R inverse = column[j] > floor[j] ? R(1) / std::sqrt(column[j]) : R(0);
        for (int i = j + 1; i < rows; ++i) column[i] *= inverse;
        column[j] = inverse;
    }
}

/// A block A below the diagonal becomes that of the factor: A L^-T, for the factor L of its column's diagonal.
template <int P, class R>
HWY_INLINE void divide(R* __restrict A, const R* __restrict L, int columns) {
    for (int c = 0; c < columns; ++c) {
        R sum[P];
        for (int r = 0; r < P; ++r) sum[r] = A[c * P + r];
        for (int k = 0; k < c; ++k) {
            const R l = L[k * P + c];
            for (int r = 0; r < P; ++r) sum[r] -= A[k * P + r] * l;
        }
        for (int r = 0; r < P; ++r) A[c * P + r] = sum[r] * L[c * P + c];
    }
}

template <int N, bool full, class R>
void factorAll(const JointPart<R>& part, const R* floor) {
    constexpr int P = paddedRows<R>(N), B = N * P;
    const std::uint32_t* target = part.target;
    for (std::uint32_t k = 0; k < part.columns; ++k) {
        R* const D = part.diagonal + k * B;
        const int n = full ? N : part.rows[k];
        factorBlock<P>(D, floor + k * P, n);
        const std::size_t count = part.start[k + 1] - part.start[k];
        R* const L = part.lower + (part.start[k] - part.start[0]) * B;
        const std::uint32_t* const row = part.row + part.start[k];
        for (std::size_t e = 0; e < count; ++e) divide<P>(L + e * B, D, n);
        for (std::size_t e = 0; e < count; ++e) {
            const std::uint32_t r = row[e] - part.first;
            const int m = full ? N : part.rows[r];
            subtractProduct<P>(L + e * B, L + e * B, part.diagonal + r * B, n, m);
            for (std::size_t f = e + 1; f < count; ++f)
                subtractProduct<P>(L + f * B, L + e * B, part.lower + *target++ * B, n, m);
        }
    }
}

/// W right sides: `x` has W numbers a row. `full`: all blocks have N rows.
template <int N, int W, bool full, class R>
void solveAll(const JointPart<R>& part, R* x) {
    constexpr int P = paddedRows<R>(N), B = N * P;
    const auto scale = [](R* own, R d) {
        for (int l = 0; l < W; ++l) own[l] *= d;
    };
    const auto subtract = [](R* __restrict to, const R* __restrict from, R factor) {
        for (int l = 0; l < W; ++l) to[l] -= factor * from[l];
    };
    for (std::uint32_t k = 0; k < part.columns; ++k) {
        const R* const D = part.diagonal + k * B;
        R* const own = x + k * P * W;
        const int n = full ? N : part.rows[k];
        for (int c = 0; c < n; ++c) {
            scale(own + c * W, D[c * P + c]);
            for (int r = c + 1; r < n; ++r) subtract(own + r * W, own + c * W, D[c * P + r]);
        }
        for (std::size_t e = part.start[k]; e < part.start[k + 1]; ++e) {
            const R* const L = part.lower + (e - part.start[0]) * B;
            R* const other = x + (part.row[e] - part.first) * P * W;
            const int m = W == 1 ? P : full ? N : part.rows[part.row[e] - part.first];
            for (int c = 0; c < n; ++c)
                for (int r = 0; r < m; ++r) subtract(other + r * W, own + c * W, L[c * P + r]);
        }
    }
    for (std::uint32_t k = part.columns; k-- > 0;) {
        const R* const D = part.diagonal + k * B;
        R* const own = x + k * P * W;
        const int n = full ? N : part.rows[k];
        for (std::size_t e = part.start[k]; e < part.start[k + 1]; ++e) {
            const R* const L = part.lower + (e - part.start[0]) * B;
            const R* const other = x + (part.row[e] - part.first) * P * W;
            const int m = full ? N : part.rows[part.row[e] - part.first];
            for (int c = 0; c < n; ++c)
                for (int r = 0; r < m; ++r) subtract(own + c * W, other + r * W, L[c * P + r]);
        }
        for (int c = n; c-- > 0;) {
            for (int r = c + 1; r < n; ++r) subtract(own + c * W, own + r * W, D[c * P + r]);
            scale(own + c * W, D[c * P + c]);
        }
    }
}

template <int N, class R, class Use>
HWY_INLINE void withRows(const JointPart<R>& part, const Use& use) {
    if (part.full)
        use(std::integral_constant<int, N>(), std::true_type());
    else
        use(std::integral_constant<int, N>(), std::false_type());
}

/// Calls use(integral constant of the size of blocks, of whether all have as many rows).
template <class R, class Use>
HWY_INLINE void withSize(const JointPart<R>& part, const Use& use) {
    switch (part.size) {
        case 1:
            return withRows<1>(part, use);
        case 2:
            return withRows<2>(part, use);
        case 3:
            return withRows<3>(part, use);
        case 4:
            return withRows<4>(part, use);
        case 5:
            return withRows<5>(part, use);
        default:
            return withRows<6>(part, use);
    }
}

#define RIGOR_KERNELS(R)                                                                   \
    void factorPart_##R(const JointPart<R>& part, const R* floor) {                        \
        withSize(part, [&](auto n, auto full) { factorAll<n(), full()>(part, floor); });   \
    }                                                                                      \
    void solvePart_##R(const JointPart<R>& part, R* x) {                                   \
        withSize(part, [&](auto n, auto full) { solveAll<n(), 1, full()>(part, x); });     \
    }                                                                                      \
    void solveLanes_##R(const JointPart<R>& part, R* x) {                                  \
        constexpr auto lanes = static_cast<int>(kJointLanes<R>);                           \
        withSize(part, [&](auto n, auto full) { solveAll<n(), lanes, full()>(part, x); }); \
    }
RIGOR_KERNELS(float)
RIGOR_KERNELS(double)
#undef RIGOR_KERNELS

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigor::engine {

#define RIGOR_DISPATCH(R)                                          \
    HWY_EXPORT(factorPart_##R);                                    \
    HWY_EXPORT(solvePart_##R);                                     \
    HWY_EXPORT(solveLanes_##R);                                    \
    template <>                                                    \
    void factorPart<R>(const JointPart<R>& part, const R* floor) { \
        HWY_DYNAMIC_DISPATCH(factorPart_##R)(part, floor);         \
    }                                                              \
    template <>                                                    \
    void solvePart<R>(const JointPart<R>& part, R* x) {            \
        HWY_DYNAMIC_DISPATCH(solvePart_##R)(part, x);              \
    }                                                              \
    template <>                                                    \
    void solvePartLanes<R>(const JointPart<R>& part, R* x) {       \
        HWY_DYNAMIC_DISPATCH(solveLanes_##R)(part, x);             \
    }
RIGOR_DISPATCH(float)
RIGOR_DISPATCH(double)
#undef RIGOR_DISPATCH

}  // namespace rigor::engine
#endif
