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

bool FreeRows::eliminate(const AssembledProblem& whole, double shift) {
    shift_ = shift;
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
    redundant_ = false;
    for (std::size_t i = 0; i < free_.size(); ++i) {
        std::size_t first = 0;
        while (first < i && whole.at(free_[i], free_[first]) == 0) ++first;
        first_.push_back(first);
        start_.push_back(factor_.size());
        for (std::size_t j = first; j <= i; ++j) factor_.push_back(whole.at(free_[i], free_[j]));
        double* row = factor_.data() + start_[i];
        const double own = row[i - first];
        row[i - first] *= 1 + shift_;
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
                redundant_ = redundant_ || rest < kMostShift * shift_ * own;
            }
        }
    }
    return true;
}

/// x := L^-1 x, where x is zero before `from`.
void FreeRows::solveLower(double* x, std::size_t from) const {
    for (std::size_t i = from; i < free_.size(); ++i) {
        const double* row = factor_.data() + start_[i];
        const std::size_t begin = std::max(first_[i], from);
        x[i] = (x[i] - dot(row + (begin - first_[i]), x + begin, i - begin)) / row[i - first_[i]];
    }
}

/// x := L^-T x.
void FreeRows::solveUpper(double* x) const {
    for (std::size_t i = free_.size(); i-- > 0;) {
        const double* row = factor_.data() + start_[i];
        const std::size_t length = i - first_[i];
        x[i] /= row[length];
        for (std::size_t j = 0; j < length; ++j) x[first_[i] + j] -= row[j] * x[i];
    }
}

void FreeRows::complement(const AssembledProblem& whole) {
    const std::size_t n = others_.size(), m = free_.size();
    half_.resize(n * m);
    begin_.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
        double* const half = half_.data() + c * m;
        for (std::size_t e = 0; e < m; ++e) half[e] = whole.at(others_[c], free_[e]);
        begin_[c] =
            static_cast<std::size_t>(std::find_if(half, half + m, [](double x) { return x != 0; }) - half);
        solveLower(half, begin_[c]);
    }
    reduced_.W.resize(n * n);
    reduced_.own.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t d = 0; d <= c; ++d) {
            const std::size_t begin = std::max(begin_[c], begin_[d]);
            const double rest = whole.at(others_[c], others_[d]) -
                                dot(half_.data() + c * m + begin, half_.data() + d * m + begin, m - begin);
            reduced_.W[c * n + d] = reduced_.W[d * n + c] = rest;
        }
        const double own = whole.at(others_[c], others_[c]);
        reduced_.own[c] = own;
        reduced_.W[c * n + c] = std::max(reduced_.W[c * n + c], 0.0) + shift_ * own;
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
    solveLower(rest_.data(), 0);
    for (std::size_t c = 0; c < n; ++c) reduced_.lambda[c] = whole.lambda[others_[c]];
    for (std::size_t c = 0; c < n; ++c)
        reduced_.q[c] = whole.w[others_[c]] -
                        dot(half_.data() + c * m + begin_[c], rest_.data() + begin_[c], m - begin_[c]) -
                        dot(reduced_.W.data() + c * n, reduced_.lambda.data(), n);
    return reduced_;
}

void FreeRows::expand(const AssembledProblem& whole, const std::vector<double>& others,
                      std::vector<double>& all) {
    const std::size_t m = free_.size();
    all.resize(whole.n);
    for (std::size_t c = 0; c < others_.size(); ++c) all[others_[c]] = others[c];
    for (std::size_t e = 0; e < m; ++e) change_[e] = -rest_[e];
    for (std::size_t c = 0; c < others_.size(); ++c) {
        const double changed = others[c] - reduced_.lambda[c];
        const double* const half = half_.data() + c * m;
        for (std::size_t e = begin_[c]; e < m; ++e) change_[e] -= changed * half[e];
    }
    solveUpper(change_.data());
    if (redundant_) dropContradictions(whole);
    for (std::size_t e = 0; e < m; ++e) all[free_[e]] = whole.lambda[free_[e]] + change_[e];
}

/// Takes from d_e the directions that W_ee does not see: (W_ee + D)^-1 W_ee d_e, D the shift. Where free rows contradict
/// each other they would leave 1 / shift times what no impulse can change. The second pass takes the rounding of the first.
void FreeRows::dropContradictions(const AssembledProblem& whole) {
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t e = 0; e < free_.size(); ++e)
            excess_[e] = shift_ * whole.at(free_[e], free_[e]) * change_[e];
        solveLower(excess_.data(), 0);
        solveUpper(excess_.data());
        for (std::size_t e = 0; e < free_.size(); ++e) change_[e] -= excess_[e];
    }
}

}  // namespace rigor::engine
