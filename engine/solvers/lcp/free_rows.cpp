// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/lcp/free_rows.hpp"

#include <algorithm>
#include <cmath>

#include "engine/math/space.hpp"

namespace rigor::engine {
namespace {

double dot(const double* a, const double* b, std::size_t n) {
    const auto size = static_cast<Eigen::Index>(n);
    return Eigen::Map<const Eigen::VectorXd>(a, size).dot(Eigen::Map<const Eigen::VectorXd>(b, size));
}

}  // namespace

bool FreeRows::eliminate(const AssembledProblem& whole) {
    separate(whole);
    if (free_.empty() || others_.empty() || !factor(whole)) return false;
    complement(whole);
    return true;
}

void FreeRows::separate(const AssembledProblem& whole) {
    free_.clear();
    others_.clear();
    place_.assign(whole.n + 1, 0);
    for (std::size_t i = 0; i < whole.n; ++i) {
        place_[i] = others_.size();
        (whole.kind[i] == RowKind::Free ? free_ : others_).push_back(i);
    }
    place_[whole.n] = others_.size();  // the tangents of a last contact without friction would begin here
    reduced_.n = others_.size();
    reduced_.kind.clear();
    reduced_.lower.clear();
    reduced_.upper.clear();
    for (const std::size_t i : others_) {
        reduced_.kind.push_back(whole.kind[i]);
        reduced_.lower.push_back(whole.lower[i]);
        reduced_.upper.push_back(whole.upper[i]);
    }
    reduced_.contacts.assign(whole.contacts.begin(), whole.contacts.end());
    for (AssembledContact& contact : reduced_.contacts) {
        contact.normal = place_[contact.normal];
        contact.first = place_[contact.first];
    }
}

/// Cholesky factor of W_ee, whose rows keep the zeros before their first entry [GolubVanLoan2013, section 4.3.5].
bool FreeRows::factor(const AssembledProblem& whole) {
    first_.clear();
    start_.clear();
    factor_.clear();
    for (std::size_t i = 0; i < free_.size(); ++i) {
        std::size_t first = 0;
        while (first < i && whole.at(free_[i], free_[first]) == 0) ++first;
        first_.push_back(first);
        start_.push_back(factor_.size());
        for (std::size_t j = first; j <= i; ++j) factor_.push_back(whole.at(free_[i], free_[j]));
        double* row = factor_.data() + start_[i];
        row[i - first] *= 1 + kShift;
        for (std::size_t j = first; j <= i; ++j) {
            const std::size_t from = std::max(first, first_[j]);
            const double* other = factor_.data() + start_[j];
            const double rest =
                row[j - first] - dot(row + (from - first), other + (from - first_[j]), j - from);
            if (j < i) {
                row[j - first] = rest / other[j - first_[j]];
            } else {
                if (!(rest > 0)) return false;
                row[j - first] = std::sqrt(rest);
            }
        }
    }
    return true;
}

/// x := W_ee^-1 x.
void FreeRows::solve(double* x) const {
    for (std::size_t i = 0; i < free_.size(); ++i) {
        const double* row = factor_.data() + start_[i];
        const std::size_t length = i - first_[i];
        x[i] = (x[i] - dot(row, x + first_[i], length)) / row[length];
    }
    for (std::size_t i = free_.size(); i-- > 0;) {
        const double* row = factor_.data() + start_[i];
        const std::size_t length = i - first_[i];
        x[i] /= row[length];
        for (std::size_t j = 0; j < length; ++j) x[first_[i] + j] -= row[j] * x[i];
    }
}

void FreeRows::complement(const AssembledProblem& whole) {
    const std::size_t n = others_.size(), m = free_.size();
    coupling_.resize(n * m);
    for (std::size_t c = 0; c < n; ++c)
        for (std::size_t e = 0; e < m; ++e) coupling_[c * m + e] = whole.at(others_[c], free_[e]);
    follow_.assign(coupling_.begin(), coupling_.end());
    for (std::size_t c = 0; c < n; ++c) solve(follow_.data() + c * m);
    reduced_.W.resize(n * n);
    reduced_.own.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t d = 0; d <= c; ++d) {
            const double rest =
                whole.at(others_[c], others_[d]) - dot(coupling_.data() + c * m, follow_.data() + d * m, m);
            reduced_.W[c * n + d] = reduced_.W[d * n + c] = rest;
        }
        const double own = whole.at(others_[c], others_[c]);
        reduced_.own[c] = own;
        reduced_.W[c * n + c] = std::max(reduced_.W[c * n + c], 0.0) + kShift * own;
    }
    reduced_.q.resize(n);
    reduced_.lambda.resize(n);
    rest_.resize(m);
    change_.resize(m);
    excess_.resize(m);
}

const AssembledProblem& FreeRows::reduce(const AssembledProblem& whole) {
    const std::size_t n = others_.size(), m = free_.size();
    for (std::size_t e = 0; e < m; ++e) rest_[e] = whole.w[free_[e]];
    solve(rest_.data());
    for (std::size_t c = 0; c < n; ++c) reduced_.lambda[c] = whole.lambda[others_[c]];
    for (std::size_t c = 0; c < n; ++c)
        reduced_.q[c] = whole.w[others_[c]] - dot(coupling_.data() + c * m, rest_.data(), m) -
                        dot(reduced_.W.data() + c * n, reduced_.lambda.data(), n);
    return reduced_;
}

void FreeRows::expand(const AssembledProblem& whole, const std::vector<double>& others,
                      std::vector<double>& all) {
    const std::size_t m = free_.size();
    all.resize(whole.n);
    for (std::size_t c = 0; c < others_.size(); ++c) all[others_[c]] = others[c];
    for (std::size_t e = 0; e < m; ++e) {
        change_[e] = -rest_[e];
        for (std::size_t c = 0; c < others_.size(); ++c)
            change_[e] -= follow_[c * m + e] * (others[c] - reduced_.lambda[c]);
    }
    dropContradictions(whole);
    for (std::size_t e = 0; e < m; ++e) all[free_[e]] = whole.lambda[free_[e]] + change_[e];
}

/// Takes from d_e the directions that W_ee does not see: (W_ee + D)^-1 W_ee d_e, D the shift. Where free rows contradict
/// each other they would leave 1 / kShift times what no impulse can change. The second pass takes the rounding of the first.
void FreeRows::dropContradictions(const AssembledProblem& whole) {
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t e = 0; e < free_.size(); ++e)
            excess_[e] = kShift * whole.at(free_[e], free_[e]) * change_[e];
        solve(excess_.data());
        for (std::size_t e = 0; e < free_.size(); ++e) change_[e] -= excess_[e];
    }
}

}  // namespace rigor::engine
