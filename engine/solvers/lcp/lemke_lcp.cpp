// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/lcp/lemke_lcp.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/ids.hpp"

namespace rigor::engine {
namespace {
// Entries of the dictionary below this are rounding of entries of order one after some hundred pivots.
constexpr double kZero = 1e-11;

}  // namespace

LemkeLcp::Outcome LemkeLcp::solve(std::size_t n, const double* M, const double* q, double* z) {
    n_ = n;
    pivots_ = 0;
    if (dictionary_.size() < n * (n + 1)) dictionary_.resize(n * (n + 1));
    constant_.resize(n);
    basic_.resize(n);
    nonbasic_.resize(n + 1);
    where_.resize(2 * n + 1);
    double scale = 0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
        std::copy_n(M + i * n, n, &T(i, 0));
        T(i, n) = 1;
        constant_[i] = q[i];
        basic_[i] = i;
        where_[i] = i;
        nonbasic_[i] = n + i;
        where_[n + i] = n + i;
        scale = std::max(scale, std::abs(q[i]));
        // The last of equal values is taken: with epsilon^k it is the least.
        if (q[i] <= q[worst]) worst = i;
    }
    nonbasic_[n] = 2 * n;
    where_[2 * n] = 2 * n;
    noise_ = 1e-13 * scale;
    Outcome outcome = Outcome::Solved;
    if (n > 0 && q[worst] < 0) {
        std::size_t left = basic_[worst];
        pivot(worst, n);
        const int most = 200 + 20 * static_cast<int>(n);
        while (left != 2 * n) {
            const std::size_t column = columnOf(left < n ? left + n : left - n);
            const std::size_t row = leaving(column);
            if (row == kNullIndex || pivots_ > most) {
                outcome = row == kNullIndex ? Outcome::Ray : Outcome::TooManyPivots;
                break;
            }
            left = basic_[row];
            pivot(row, column);
        }
    }
    readSolution(M, q, z);
    return outcome;
}

std::size_t LemkeLcp::columnOf(std::size_t variable) const {
    return where_[variable] - n_;
}

/// The basic variable that first comes to zero as the column's variable grows.
std::size_t LemkeLcp::leaving(std::size_t column) const {
    std::size_t best = kNullIndex;
    double ratio = 0;
    for (std::size_t i = 0; i < n_; ++i) {
        const double rate = -dictionary_[i * (n_ + 1) + column];
        if (!(rate > kZero)) continue;
        const double mine = std::max(0.0, constant_[i]) / rate;
        const double tie = best == kNullIndex ? 0 : noise_ / std::min(rate, 1.0);
        if (best == kNullIndex || mine < ratio - tie) {
            best = i;
            ratio = mine;
        } else if (mine <= ratio + tie) {
            // z_0 leaves whenever it may: that is the end.
            const bool better =
                basic_[i] == 2 * n_ || (basic_[best] != 2 * n_ && lexicographicallyLess(i, best, column));
            if (better) {
                best = i;
                ratio = std::min(ratio, mine);
            }
        }
    }
    return best;
}

/// Rows of the basis inverse over the rates, first difference decides.
bool LemkeLcp::lexicographicallyLess(std::size_t a, std::size_t b, std::size_t column) const {
    const auto entry = [this](std::size_t row, std::size_t k) {
        const std::size_t at = where_[k];
        if (at < n_) return at == row ? 1.0 : 0.0;
        return -dictionary_[row * (n_ + 1) + (at - n_)];
    };
    const double rateA = -dictionary_[a * (n_ + 1) + column], rateB = -dictionary_[b * (n_ + 1) + column];
    for (std::size_t k = 0; k < n_; ++k) {
        const double x = entry(a, k) / rateA, y = entry(b, k) / rateB;
        if (std::abs(x - y) > kZero * (std::abs(x) + std::abs(y))) return x < y;
    }
    return false;
}

/// Exchanges the basic variable of a row with the nonbasic one of a column.
void LemkeLcp::pivot(std::size_t row, std::size_t column) {
    ++pivots_;
    const std::size_t width = n_ + 1;
    double* const pivotRow = dictionary_.data() + row * width;
    const double inverse = 1 / pivotRow[column];
    for (std::size_t j = 0; j < width; ++j) pivotRow[j] *= -inverse;
    pivotRow[column] = inverse;
    constant_[row] *= -inverse;
    for (std::size_t i = 0; i < n_; ++i) {
        double* const to = dictionary_.data() + i * width;
        const double factor = to[column];
        if (i == row || factor == 0) continue;
        to[column] = 0;
        for (std::size_t j = 0; j < width; ++j) to[j] += factor * pivotRow[j];
        constant_[i] += factor * constant_[row];
    }
    std::swap(basic_[row], nonbasic_[column]);
    where_[basic_[row]] = row;
    where_[nonbasic_[column]] = n_ + column;
}

void LemkeLcp::readSolution(const double* M, const double* q, double* z) {
    std::fill_n(z, n_, 0.0);
    in_.clear();
    for (std::size_t i = 0; i < n_; ++i) {
        if (basic_[i] < n_ || basic_[i] == 2 * n_) continue;
        in_.push_back(basic_[i] - n_);
        z[basic_[i] - n_] = std::max(0.0, constant_[i]);
    }
    if (in_.empty()) return;
    std::sort(in_.begin(), in_.end());
    const std::size_t f = in_.size();
    double* A = lu_.reset(f);
    right_.resize(f);
    for (std::size_t a = 0; a < f; ++a) {
        for (std::size_t b = 0; b < f; ++b) A[a * f + b] = M[in_[a] * n_ + in_[b]];
        right_[a] = -q[in_[a]];
        for (std::size_t b = 0; b < f; ++b) right_[a] -= A[a * f + b] * z[in_[b]];
    }
    // The correction to what the pivots say; not taken where the basis is singular.
    if (!lu_.factor()) return;
    lu_.solve(right_.data());
    for (std::size_t a = 0; a < f; ++a)
        if (!std::isfinite(right_[a])) return;
    for (std::size_t a = 0; a < f; ++a) z[in_[a]] = std::max(0.0, z[in_[a]] + right_[a]);
}

}  // namespace rigor::engine
