// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The kernels are compiled once for every instruction set (hwy/foreach_target.h includes this file again).
// Products are made in tiles of kTile columns and two vectors of rows, which stay in registers while the sum
// over the columns of the factors runs; what is left of the rows goes by ever shorter vectors.
#include "engine/solvers/joints/front_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solvers/joints/front_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// C -= A B^T over `depth` columns of A and B, which both have `stride`.
template <class R>
struct Product {
    const R* A;
    const R* B;
    std::size_t stride, depth;
    R* C;
    std::size_t strideC, rows;
};

/// `columns` columns of C, rows i .. i + vectors * lanes - 1.
template <std::size_t columns, std::size_t vectors, class D, class R>
HWY_INLINE void multiplyTile(D d, const Product<R>& p, std::size_t i) {
    const std::size_t lanes = hn::Lanes(d);
    hn::Vec<D> sum[columns][vectors];
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t v = 0; v < vectors; ++v)
            sum[c][v] = hn::LoadU(d, p.C + c * p.strideC + i + v * lanes);
    const R *a = p.A + i, *b = p.B;
    for (std::size_t k = 0; k < p.depth; ++k, a += p.stride, b += p.stride) {
        hn::Vec<D> row[vectors];
        for (std::size_t v = 0; v < vectors; ++v) row[v] = hn::LoadU(d, a + v * lanes);
        for (std::size_t c = 0; c < columns; ++c) {
            const hn::Vec<D> factor = hn::Set(d, b[c]);
            for (std::size_t v = 0; v < vectors; ++v) sum[c][v] = hn::Sub(sum[c][v], hn::Mul(row[v], factor));
        }
    }
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t v = 0; v < vectors; ++v)
            hn::StoreU(sum[c][v], d, p.C + c * p.strideC + i + v * lanes);
}

/// Rows from i on, by vectors of `lanes` and shorter ones.
template <std::size_t columns, std::size_t lanes, class R>
HWY_INLINE void multiplyRest(const Product<R>& p, std::size_t i) {
    const hn::CappedTag<R, lanes> d;
    for (; i + lanes <= p.rows; i += lanes) multiplyTile<columns, 1>(d, p, i);
    if constexpr (lanes > 1) multiplyRest<columns, lanes / 2>(p, i);
}

template <std::size_t columns, class R>
void multiplyColumns(const Product<R>& p) {
    const hn::ScalableTag<R> d;
    constexpr std::size_t lanes = HWY_LANES(R);
    std::size_t i = 0;
    for (; i + 2 * lanes <= p.rows; i += 2 * lanes) multiplyTile<columns, 2>(d, p, i);
    multiplyRest<columns, lanes>(p, i);
}

constexpr std::size_t kTile = 6;

/// The first of `columns` columns that go together, at most kTile.
template <class R>
std::size_t multiplySome(const Product<R>& p, std::size_t columns) {
    if (columns >= kTile) {
        multiplyColumns<kTile>(p);
        return kTile;
    }
    if (columns >= 3) {
        multiplyColumns<3>(p);
        return 3;
    }
    multiplyColumns<1>(p);
    return 1;
}

/// Calls use(std::integral_constant<std::size_t, n>) for n of 1..kTile.
template <class Use>
HWY_INLINE void withColumns(std::size_t n, const Use& use) {
    switch (n) {
        case 1:
            return use(std::integral_constant<std::size_t, 1>());
        case 2:
            return use(std::integral_constant<std::size_t, 2>());
        case 3:
            return use(std::integral_constant<std::size_t, 3>());
        case 4:
            return use(std::integral_constant<std::size_t, 4>());
        case 5:
            return use(std::integral_constant<std::size_t, 5>());
        default:
            return use(std::integral_constant<std::size_t, kTile>());
    }
}

/// n columns whose triangle, on top, has been factored, with the reciprocals of its diagonal.
template <class R>
struct Columns {
    R* at;
    std::size_t stride, rows;  ///< rows from the top of the triangle
};

/// Replaces the rows A below the triangle T by those of the factor, A T^-T, from row i on.
template <std::size_t n, std::size_t lanes, class R>
HWY_INLINE void divideRows(const Columns<R>& t, std::size_t i) {
    const hn::CappedTag<R, lanes> d;
    for (; i + lanes <= t.rows; i += lanes) {
        hn::Vec<decltype(d)> x[n];
        for (std::size_t c = 0; c < n; ++c) {
            x[c] = hn::LoadU(d, t.at + c * t.stride + i);
            for (std::size_t k = 0; k < c; ++k)
                x[c] = hn::Sub(x[c], hn::Mul(x[k], hn::Set(d, t.at[k * t.stride + c])));
            x[c] = hn::Mul(x[c], hn::Set(d, t.at[c * t.stride + c]));
            hn::StoreU(x[c], d, t.at + c * t.stride + i);
        }
    }
    if constexpr (lanes > 1) divideRows<n, lanes / 2>(t, i);
}

/// Factors column by column and scales each column last, so that a pivot waits only for one division of the
/// pivot before.
template <std::size_t n, class R>
HWY_INLINE void factorTriangle(const Columns<R>& t, const R* floor) {
    R m[n][n], scale[n];
    for (std::size_t c = 0; c < n; ++c)
        for (std::size_t i = c; i < n; ++i) m[c][i] = t.at[c * t.stride + i];
    for (std::size_t c = 0; c < n; ++c) {
        const bool sound = m[c][c] > floor[c];
        const R inverse = sound ? R(1) / m[c][c] : R(0);
        scale[c] = sound ? R(1) / std::sqrt(m[c][c]) : R(0);
        for (std::size_t k = c + 1; k < n; ++k) {
            const R factor = m[c][k] * inverse;
            for (std::size_t i = k; i < n; ++i) m[k][i] -= m[c][i] * factor;
        }
    }
    for (std::size_t c = 0; c < n; ++c) {
        t.at[c * t.stride + c] = scale[c];
        for (std::size_t i = c + 1; i < n; ++i) t.at[c * t.stride + i] = m[c][i] * scale[c];
    }
}

template <class R>
void factorAll(const FrontPanel<R>& panel, const R* floor) {
    const std::size_t stride = panel.stride;
    for (std::size_t first = 0; first < panel.columns; first += kTile) {
        const std::size_t count = std::min(kTile, panel.columns - first), rows = panel.rows - first;
        R* const top = panel.at + first * stride + first;
        // Subtract the products of the columns before.
        for (std::size_t j = 0; first > 0 && j < count;) {
            const R* const before = panel.at + first + j;
            j += multiplySome(
                Product<R>{before, before, stride, first, top + j * stride + j, stride, rows - j}, count - j);
        }
        withColumns(count, [&](auto n) {
            const Columns<R> columns{top, stride, rows};
            factorTriangle<n()>(columns, floor + first);
            divideRows<n(), HWY_LANES(R)>(columns, n());
        });
    }
}

template <class R>
void subtractAll(const FrontPanel<R>& panel, R* C, std::size_t stride) {
    const std::size_t n = panel.rows - panel.columns;
    const R* const A = panel.at + panel.columns;
    for (std::size_t j = 0; j < n;)
        j += multiplySome(
            Product<R>{A + j, A + j, panel.stride, panel.columns, C + j * stride + j, stride, n - j}, n - j);
}

template <std::size_t n, class R>
HWY_INLINE void forwardColumns(const Columns<R>& t, R* y) {
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t k = 0; k < c; ++k) y[c] -= t.at[k * t.stride + c] * y[k];
        y[c] *= t.at[c * t.stride + c];
    }
    const hn::ScalableTag<R> d;
    // The last vector also processes the elements behind the rows, and leaves them behind those of y.
    for (std::size_t i = n; i < t.rows; i += hn::Lanes(d)) {
        auto sum = hn::LoadU(d, y + i);
        for (std::size_t c = 0; c < n; ++c)
            sum = hn::Sub(sum, hn::Mul(hn::LoadU(d, t.at + c * t.stride + i), hn::Set(d, y[c])));
        hn::StoreU(sum, d, y + i);
    }
}

template <class R>
void forwardAll(const FrontPanel<R>& panel, R* y) {
    for (std::size_t first = 0; first < panel.columns; first += kTile) {
        const Columns<R> columns{panel.at + first * panel.stride + first, panel.stride, panel.rows - first};
        withColumns(std::min(kTile, panel.columns - first),
                    [&](auto n) { forwardColumns<n()>(columns, y + first); });
    }
}

/// Products with the rows below are summed up in kSums sums each, whatever the vectors.
template <std::size_t n, class R>
HWY_INLINE void backwardColumns(const Columns<R>& t, R* y) {
    constexpr std::size_t kSums = 8, lanes = std::min<std::size_t>(kSums, HWY_LANES(R));
    const hn::CappedTag<R, lanes> d;
    hn::Vec<decltype(d)> sum[n][kSums / lanes];
    for (auto& own : sum)
        for (auto& s : own) s = hn::Zero(d);
    for (std::size_t i = n; i < t.rows; i += kSums)
        for (std::size_t v = 0; v < kSums / lanes && i + v * lanes < t.rows; ++v) {
            const std::size_t at = i + v * lanes;
            const auto rest = hn::FirstN(d, std::min(lanes, t.rows - at));
            const auto other = hn::IfThenElseZero(rest, hn::LoadU(d, y + at));
            for (std::size_t c = 0; c < n; ++c) {
                const auto column = hn::IfThenElseZero(rest, hn::LoadU(d, t.at + c * t.stride + at));
                sum[c][v] = hn::Add(sum[c][v], hn::Mul(column, other));
            }
        }
    for (std::size_t c = n; c-- > 0;) {
        R s[kSums];
        for (std::size_t v = 0; v < kSums / lanes; ++v) hn::StoreU(sum[c][v], d, s + v * lanes);
        for (std::size_t half = kSums / 2; half > 0; half /= 2)
            for (std::size_t k = 0; k < half; ++k) s[k] += s[k + half];
        R x = y[c] - s[0];
        for (std::size_t k = n; k-- > c + 1;) x -= t.at[c * t.stride + k] * y[k];
        y[c] = x * t.at[c * t.stride + c];
    }
}

template <class R>
void backwardAll(const FrontPanel<R>& panel, R* y) {
    for (std::size_t last = panel.columns; last > 0;) {
        const std::size_t first = (last - 1) / kTile * kTile;
        const Columns<R> columns{panel.at + first * panel.stride + first, panel.stride, panel.rows - first};
        withColumns(last - first, [&](auto n) { backwardColumns<n()>(columns, y + first); });
        last = first;
    }
}

#define RIGOR_KERNELS(R)                                                 \
    void factor_##R(const FrontPanel<R>& panel, const R* floor) {        \
        factorAll(panel, floor);                                         \
    }                                                                    \
    void subtract_##R(const FrontPanel<R>& panel, R* C, std::size_t s) { \
        subtractAll(panel, C, s);                                        \
    }                                                                    \
    void forward_##R(const FrontPanel<R>& panel, R* y) {                 \
        forwardAll(panel, y);                                            \
    }                                                                    \
    void backward_##R(const FrontPanel<R>& panel, R* y) {                \
        backwardAll(panel, y);                                           \
    }
RIGOR_KERNELS(float)
RIGOR_KERNELS(double)
#undef RIGOR_KERNELS

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigor::engine {

#define RIGOR_DISPATCH(R)                                                     \
    HWY_EXPORT(factor_##R);                                                   \
    HWY_EXPORT(subtract_##R);                                                 \
    HWY_EXPORT(forward_##R);                                                  \
    HWY_EXPORT(backward_##R);                                                 \
    template <>                                                               \
    void factorPanel<R>(const FrontPanel<R>& panel, const R* floor) {         \
        HWY_DYNAMIC_DISPATCH(factor_##R)(panel, floor);                       \
    }                                                                         \
    template <>                                                               \
    void subtractSquare<R>(const FrontPanel<R>& panel, R* C, std::size_t s) { \
        HWY_DYNAMIC_DISPATCH(subtract_##R)(panel, C, s);                      \
    }                                                                         \
    template <>                                                               \
    void solveForward<R>(const FrontPanel<R>& panel, R* y) {                  \
        HWY_DYNAMIC_DISPATCH(forward_##R)(panel, y);                          \
    }                                                                         \
    template <>                                                               \
    void solveBackward<R>(const FrontPanel<R>& panel, R* y) {                 \
        HWY_DYNAMIC_DISPATCH(backward_##R)(panel, y);                         \
    }
RIGOR_DISPATCH(float)
RIGOR_DISPATCH(double)
#undef RIGOR_DISPATCH

}  // namespace rigor::engine
#endif
