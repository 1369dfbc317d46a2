// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/lcp/dense.hpp"

#include <algorithm>
#include <cmath>

#include "engine/solvers/lcp/lu_kernels.hpp"

namespace rigor::engine {

double* DenseLu::reset(std::size_t n) {
    n_ = n;
    if (a_.size() < n * n) a_.resize(n * n);
    if (swap_.size() < n) {
        swap_.resize(n);
        scale_.resize(n);
        first_.resize(n);
        end_.resize(n);
        below_.resize(n);
    }
    return a_.data();
}

/// Finds where the rows begin and end, and the largest entry of each column.
void DenseLu::measure() {
    std::fill_n(scale_.begin(), n_, 0.0);
    std::fill_n(below_.begin(), n_, std::size_t(0));
    for (std::size_t i = 0; i < n_; ++i) {
        const double* entries = a_.data() + i * n_;
        std::size_t first = 0, end = n_;
        while (end > 0 && entries[end - 1] == 0) --end;
        while (first < end && entries[first] == 0) ++first;
        first_[i] = first;
        end_[i] = end;
        for (std::size_t j = first; j < end; ++j) scale_[j] = std::max(scale_[j], std::abs(entries[j]));
        if (first < n_) below_[first] = i + 1;
    }
    for (std::size_t k = 1; k < n_; ++k) below_[k] = std::max(below_[k], below_[k - 1]);
}

bool DenseLu::factor() {
    constexpr double kSingular = 1e-14;  // some 50 roundings
    measure();
    bool regular = true;
    const auto row = [this](std::size_t i) { return a_.data() + i * n_; };
    for (std::size_t k = 0; k < n_; ++k) {
        std::size_t p = k;
        for (std::size_t i = k + 1; i < below_[k]; ++i)
            if (std::abs(row(i)[k]) > std::abs(row(p)[k])) p = i;
        swap_[k] = p;
        if (p != k) {
            std::swap_ranges(row(k), row(k) + n_, row(p));
            std::swap(first_[k], first_[p]);
            std::swap(end_[k], end_[p]);
        }
        const double pivot = row(k)[k];
        if (!(std::abs(pivot) > kSingular * scale_[k])) {
            regular = false;
            row(k)[k] = 0;
            continue;
        }
        eliminateColumn({a_.data(), n_, below_[k], end_.data()}, k);
    }
    return regular;
}

void DenseLu::solve(double* b) const {
    for (std::size_t k = 0; k < n_; ++k) std::swap(b[k], b[swap_[k]]);
    for (std::size_t i = 1; i < n_; ++i) {
        const double* row = a_.data() + i * n_;
        double sum = b[i];
        for (std::size_t j = first_[i]; j < i; ++j)
            if (a_[j * n_ + j] != 0) sum -= row[j] * b[j];
        b[i] = sum;
    }
    for (std::size_t i = n_; i-- > 0;) {
        const double* row = a_.data() + i * n_;
        double sum = b[i];
        for (std::size_t j = i + 1; j < end_[i]; ++j) sum -= row[j] * b[j];
        b[i] = row[i] != 0 ? sum / row[i] : 0.0;
    }
}

void GrowingCholesky::reset(std::size_t capacity) {
    capacity_ = capacity;
    if (l_.size() < capacity * capacity) l_.resize(capacity * capacity);
    members_.clear();
    members_.reserve(capacity);
}

void GrowingCholesky::append(const double* A, std::size_t n, const double* shift, std::size_t i) {
    const std::size_t k = members_.size();
    double* row = &L(k, 0);
    const double* from = A + i * n;
    double square = 0;
    for (std::size_t j = 0; j < k; ++j) {
        const double* other = &L(j, 0);
        double sum = from[members_[j]];
        for (std::size_t m = 0; m < j; ++m) sum -= row[m] * other[m];
        row[j] = sum / other[j];
        square += row[j] * row[j];
    }
    const double whole = from[i] + shift[i];
    row[k] = std::sqrt(std::max(whole - square, 1e-15 * whole));
    members_.push_back(i);
}

void GrowingCholesky::remove(std::size_t k) {
    const std::size_t n = members_.size();
    for (std::size_t i = k + 1; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) L(i - 1, j) = L(i, j);
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(k));
    // Rows from k on now reach one column too far; rotate columns j and j + 1.
    for (std::size_t j = k; j + 1 < n; ++j) {
        const double a = L(j, j), b = L(j, j + 1), r = std::sqrt(a * a + b * b);
        const double c = a / r, s = b / r;
        for (std::size_t i = j; i + 1 < n; ++i) {
            const double x = L(i, j), y = L(i, j + 1);
            L(i, j) = c * x + s * y;
            L(i, j + 1) = c * y - s * x;
        }
    }
}

void GrowingCholesky::solve(double* x) const {
    const std::size_t n = members_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double* row = l_.data() + i * capacity_;
        double sum = x[i];
        for (std::size_t j = 0; j < i; ++j) sum -= row[j] * x[j];
        x[i] = sum / row[i];
    }
    for (std::size_t i = n; i-- > 0;) {
        const double* row = l_.data() + i * capacity_;
        x[i] /= row[i];
        for (std::size_t j = 0; j < i; ++j) x[j] -= row[j] * x[i];
    }
}

}  // namespace rigor::engine
