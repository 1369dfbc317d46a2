// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/lcp/box_lcp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/ids.hpp"

namespace rigor::engine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
}  // namespace

bool BoxLcp::solve(std::size_t n, const double* A, const double* shift, const double* q, const double* lower,
                   const double* upper, double* x) {
    const Problem p{n, A, shift, q, lower, upper, x};
    if (w_.size() < n) {
        w_.resize(n);
        dw_.resize(n);
        part_.resize(n);
        taken_.resize(n);
    }
    double scale = 0;
    for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(q[i]));
    // Rounding of sums of some hundred terms of this size.
    tolerance_ = 1e-13 * scale;
    if (state_.size() == n && tryStates(p)) return true;
    return pivot(p);
}

/// w_i from scratch.
double BoxLcp::row(const Problem& p, std::size_t i) const {
    double sum = p.q[i] + p.shift[i] * p.x[i];
    const double* A = p.A + i * p.n;
    for (std::size_t j = 0; j < p.n; ++j) sum += A[j] * p.x[j];
    return sum;
}

/// x_F such that w_F = 0, the others being where they are.
void BoxLcp::updateFree(const Problem& p) {
    const std::size_t f = factor_.size();
    for (std::size_t k = 0; k < f; ++k) p.x[factor_.member(k)] = 0;
    for (std::size_t k = 0; k < f; ++k) part_[k] = -row(p, factor_.member(k));
    factor_.solve(part_.data());
    for (std::size_t k = 0; k < f; ++k) p.x[factor_.member(k)] = part_[k];
}

/// Solves for the states as they are and exchanges the indices that are wrong. Returns how many there are.
std::size_t BoxLcp::solveForStates(const Problem& p) {
    factor_.reset(p.n);
    for (std::size_t i = 0; i < p.n; ++i) {
        if (state_[i] == BoxState::Lower && p.lower[i] == -kInfinity) state_[i] = BoxState::Free;
        if (state_[i] == BoxState::Upper && p.upper[i] == kInfinity) state_[i] = BoxState::Free;
        if (state_[i] == BoxState::Free) factor_.append(p.A, p.n, p.shift, i);
        p.x[i] = state_[i] == BoxState::Lower ? p.lower[i] : state_[i] == BoxState::Upper ? p.upper[i] : 0.0;
    }
    updateFree(p);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < p.n; ++i) {
        const double slack = tolerance_ / (p.A[i * p.n + i] + p.shift[i]);
        BoxState right = state_[i];
        if (state_[i] == BoxState::Free) {
            if (p.x[i] < p.lower[i] - slack) right = BoxState::Lower;
            if (p.x[i] > p.upper[i] + slack) right = BoxState::Upper;
        } else if (p.lower[i] < p.upper[i]) {
            const double w = row(p, i);
            if (state_[i] == BoxState::Lower ? w < -tolerance_ : w > tolerance_) right = BoxState::Free;
        }
        wrong += right != state_[i];
        state_[i] = right;
    }
    return wrong;
}

bool BoxLcp::tryStates(const Problem& p) {
    std::size_t fewest = kNullIndex;
    constexpr int kTries = 10;
    for (int i = 0; i < kTries; ++i) {
        const std::size_t wrong = solveForStates(p);
        if (wrong == 0) {
            for (std::size_t k = 0; k < p.n; ++k) p.x[k] = std::clamp(p.x[k], p.lower[k], p.upper[k]);
            return true;
        }
        if (wrong >= fewest && i > 2) return false;
        fewest = std::min(fewest, wrong);
    }
    return false;
}

bool BoxLcp::pivot(const Problem& p) {
    state_.assign(p.n, BoxState::Lower);
    std::fill_n(taken_.begin(), p.n, std::uint8_t(0));
    factor_.reset(p.n);
    for (std::size_t i = 0; i < p.n; ++i) {
        p.x[i] = std::clamp(0.0, p.lower[i], p.upper[i]);
        if (p.lower[i] > -kInfinity || p.upper[i] < kInfinity) continue;
        factor_.append(p.A, p.n, p.shift, i);
        state_[i] = BoxState::Free;
        taken_[i] = 1;
    }
    updateFree(p);
    for (std::size_t i = 0; i < p.n; ++i) w_[i] = taken_[i] ? 0.0 : row(p, i);
    std::size_t pieces = 0;
    bool finished = true;
    for (std::size_t d = 0; d < p.n && finished; ++d)
        if (!taken_[d]) finished = takeIn(p, d, pieces);
    if (finished) updateFree(p);  // once more without the rounding of the way
    for (std::size_t i = 0; i < p.n; ++i) p.x[i] = std::clamp(p.x[i], p.lower[i], p.upper[i]);
    if (!finished) state_.clear();
    return finished;
}

/// part_ = dx_F and dw_ for x_d moving by `direction`.
void BoxLcp::follow(const Problem& p, std::size_t d, double direction) {
    const double* column = p.A + d * p.n;  // A is symmetric
    const std::size_t f = factor_.size();
    for (std::size_t k = 0; k < f; ++k) part_[k] = -direction * column[factor_.member(k)];
    factor_.solve(part_.data());
    for (std::size_t i = 0; i < p.n; ++i) dw_[i] = direction * column[i];
    dw_[d] += direction * p.shift[d];
    for (std::size_t k = 0; k < f; ++k) {
        const double* A = p.A + factor_.member(k) * p.n;
        const double dx = part_[k];
        for (std::size_t i = 0; i < p.n; ++i) dw_[i] += dx * A[i];
    }
}

bool BoxLcp::takeIn(const Problem& p, std::size_t d, std::size_t& pieces) {
    const std::size_t most = 100 + 10 * p.n;
    for (;; ++pieces) {
        if (pieces > most) return false;
        const double direction = w_[d] > 0 ? -1 : 1;
        taken_[d] = 1;
        if (direction < 0 && p.x[d] <= p.lower[d]) {
            state_[d] = BoxState::Lower;
            return true;
        }
        if (direction > 0 && p.x[d] >= p.upper[d]) {
            state_[d] = BoxState::Upper;
            return true;
        }
        follow(p, d, direction);
        // The step length is that of the first blocking row; among equals the one found first.
        double way = std::abs(w_[d]) / std::max(std::abs(dw_[d]), 1e-300);
        std::size_t blocking = d, place = kNullIndex;
        BoxState becomes = BoxState::Free;
        const auto object = [&](double t, std::size_t row, std::size_t where, BoxState state) {
            if (t < way) {
                way = std::max(0.0, t);
                blocking = row;
                place = where;
                becomes = state;
            }
        };
        object(direction > 0 ? p.upper[d] - p.x[d] : p.x[d] - p.lower[d], d, kNullIndex,
               direction > 0 ? BoxState::Upper : BoxState::Lower);
        for (std::size_t k = 0; k < factor_.size(); ++k) {
            const std::size_t i = factor_.member(k);
            if (part_[k] > 0) object((p.upper[i] - p.x[i]) / part_[k], i, k, BoxState::Upper);
            if (part_[k] < 0) object((p.lower[i] - p.x[i]) / part_[k], i, k, BoxState::Lower);
        }
        for (std::size_t i = 0; i < p.n; ++i) {
            if (!taken_[i] || i == d || state_[i] == BoxState::Free || !(p.lower[i] < p.upper[i])) continue;
            if (state_[i] == BoxState::Lower ? dw_[i] < 0 : dw_[i] > 0)
                object(-w_[i] / dw_[i], i, kNullIndex, BoxState::Free);
        }
        p.x[d] += way * direction;
        for (std::size_t k = 0; k < factor_.size(); ++k) p.x[factor_.member(k)] += way * part_[k];
        for (std::size_t i = 0; i < p.n; ++i) w_[i] += way * dw_[i];
        for (std::size_t k = 0; k < factor_.size(); ++k) w_[factor_.member(k)] = 0;
        state_[blocking] = becomes;
        if (becomes == BoxState::Free) {
            w_[blocking] = 0;
            factor_.append(p.A, p.n, p.shift, blocking);
        } else {
            p.x[blocking] = becomes == BoxState::Lower ? p.lower[blocking] : p.upper[blocking];
            if (place != kNullIndex) factor_.remove(place);
        }
        if (blocking == d) return true;
    }
}

}  // namespace rigor::engine
