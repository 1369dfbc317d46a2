// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See linear_program.hpp.
#include "validation/references/numerics/linear_program.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rigor::validation::numerics {
namespace {

constexpr Real kCost = 1e-14L;      // threshold of negative reduced costs, relative to the multipliers
constexpr Real kFeasible = 1e-15L;  // largest negative value of an unknown that the ratio test allows
constexpr Real kPivot = 1e-10L;     // threshold relative to the largest entry of the column
constexpr int kRefactor = 100;      // pivots on one inverse

}  // namespace

LinearProgram::LinearProgram(std::vector<Real> right) : rows_(right.size()), right_(rows_) {
    for (std::size_t i = 0; i < right.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        right_[row] = right[i];
        sign_.push_back(right[i] < 0 ? -1 : 1);
    }
    basis_.resize(right.size());
    restart();
}

/// The basis of artificial unknowns alone.
void LinearProgram::restart() {
    inBasis_.assign(columns_.size(), false);
    inverse_ = Matrix::Zero(rows_, rows_);
    for (std::size_t i = 0; i < basis_.size(); ++i) {
        basis_[i] = {true, i};
        inverse_(i, i) = sign_[i];
    }
    value_ = right_.cwiseAbs();
    y_ = Vector::Zero(rows_);
}

std::size_t LinearProgram::addColumn(Column column) {
    columns_.push_back(std::move(column));
    inBasis_.push_back(false);
    return columns_.size() - 1;
}

Real LinearProgram::costOf(Basic basic, Phase phase, const std::vector<Real>& cost) const {
    if (phase == Phase::Violation) return basic.artificial ? 1 : 0;
    return basic.artificial ? 0 : cost[basic.index];
}

/// Inverse, values and multipliers from the basis alone; false where it is singular to rounding.
bool LinearProgram::refactor(Phase phase, const std::vector<Real>& cost) {
    Matrix basis = Matrix::Zero(rows_, rows_);
    Vector prices(rows_);
    for (Eigen::Index i = 0; i < rows_; ++i) {
        const Basic basic = basis_[i];
        prices[i] = costOf(basic, phase, cost);
        if (basic.artificial) {
            basis(basic.index, i) = sign_[basic.index];
        } else {
            for (const Entry& e : columns_[basic.index]) basis(e.row, i) = e.value;
        }
    }
    inverse_ = basis.partialPivLu().inverse();
    value_ = inverse_ * right_;
    value_ += inverse_ * (right_ - basis * value_);
    y_ = inverse_.transpose() * prices;
    y_ += inverse_.transpose() * (prices - basis.transpose() * y_);
    const Real scale = 1 + value_.cwiseAbs().sum();
    return inverse_.allFinite() && (right_ - basis * value_).cwiseAbs().maxCoeff() <= 1e-14L * scale;
}

std::size_t LinearProgram::entering(Phase phase, const std::vector<Real>& cost, Real& reduced) {
    std::uniform_real_distribution<double> factor(0.5, 1.0);
    std::size_t best = columns_.size();
    Real least = 0;
    const Real largest = y_.cwiseAbs().maxCoeff();
    for (std::size_t j = 0; j < columns_.size(); ++j) {
        if (inBasis_[j]) continue;
        const Real own = phase == Phase::Cost ? cost[j] : 0;
        Real sum = own, size = std::abs(own) + largest;
        for (const Entry& e : columns_[j]) {
            const Real term = y_[e.row] * e.value;
            sum -= term;
            size += std::abs(term);
        }
        if (sum >= -kCost * size) continue;
        const Real weighted = sum * static_cast<Real>(factor(random_));
        if (weighted < least) {
            least = weighted;
            reduced = sum;
            best = j;
        }
    }
    return best;
}

Eigen::Index LinearProgram::leaving(Phase phase, const Vector& direction) const {
    const Real small = kPivot * direction.cwiseAbs().maxCoeff();
    // An artificial unknown stays zero in the second phase: it leaves before it would move.
    const auto pinned = [&](Eigen::Index i) { return phase == Phase::Cost && basis_[i].artificial; };
    Real bound = -1;
    for (Eigen::Index i = 0; i < rows_; ++i) {
        const Real d = pinned(i) ? std::abs(direction[i]) : direction[i];
        if (d <= small) continue;
        const Real most = pinned(i) ? 0 : (std::max(value_[i], Real(0)) + kFeasible) / d;
        if (bound < 0 || most < bound) bound = most;
    }
    if (bound < 0) return rows_;
    Eigen::Index best = rows_;
    Real largest = 0;
    for (Eigen::Index i = 0; i < rows_; ++i) {
        const Real d = pinned(i) ? std::abs(direction[i]) : direction[i];
        if (d <= small || d <= largest) continue;
        if (!pinned(i) && value_[i] > bound * d) continue;
        largest = d;
        best = i;
    }
    return best;
}

LinearProgram::Status LinearProgram::run(Phase phase, const std::vector<Real>& cost) {
    if (rows_ == 0) return Status::Optimal;
    int restarts = phase == Phase::Violation ? 3 : 0;
    const auto rebuild = [&] {
        if (refactor(phase, cost)) return true;
        if (restarts-- == 0) return false;
        restart();
        return refactor(phase, cost);
    };
    if (!rebuild()) return Status::Stalled;
    const auto allowed = 1000 + 20 * (rows_ + columns_.size());
    int onInverse = 0;
    for (std::size_t pivots = 0; pivots < allowed; ++pivots) {
        if (onInverse >= kRefactor) {
            if (!rebuild()) return Status::Stalled;
            onInverse = 0;
        }
        Real reduced = 0;
        const std::size_t enter = entering(phase, cost, reduced);
        Vector direction = Vector::Zero(rows_);
        Eigen::Index leave = rows_;
        if (enter != columns_.size()) {
            for (const Entry& e : columns_[enter]) direction += e.value * inverse_.col(e.row);
            leave = leaving(phase, direction);
        }
        if (leave == rows_) {
            if (onInverse == 0) return enter == columns_.size() ? Status::Optimal : Status::Unbounded;
            onInverse = kRefactor;  // a result is computed from a fresh inverse only
            continue;
        }
        const Real pivot = direction[leave];
        const Real step = std::max(value_[leave] / pivot, Real(0));
        value_ -= step * direction;
        value_[leave] = step;
        inverse_.row(leave) /= pivot;
        for (Eigen::Index i = 0; i < rows_; ++i)
            if (i != leave && direction[i] != 0) inverse_.row(i) -= direction[i] * inverse_.row(leave);
        y_ += reduced * inverse_.row(leave).transpose();
        Basic& place = basis_[leave];
        if (!place.artificial) inBasis_[place.index] = false;
        place = {false, enter};
        inBasis_[enter] = true;
        ++onInverse;
    }
    return Status::Stalled;
}

LinearProgram::Status LinearProgram::reduceViolation() {
    return run(Phase::Violation, {});
}

LinearProgram::Status LinearProgram::minimise(const std::vector<Real>& cost) {
    return run(Phase::Cost, cost);
}

Real LinearProgram::violation() const {
    Vector rest = -right_;
    const std::vector<Real> x = point();
    for (std::size_t j = 0; j < columns_.size(); ++j)
        for (const Entry& e : columns_[j]) rest[e.row] += x[j] * e.value;
    return rest.cwiseAbs().sum();
}

std::vector<Real> LinearProgram::point() const {
    std::vector<Real> x(columns_.size(), 0);
    for (Eigen::Index i = 0; i < rows_; ++i) {
        const Basic basic = basis_[i];
        if (!basic.artificial) x[basic.index] = std::max(value_[i], Real(0));
    }
    return x;
}

std::vector<Real> LinearProgram::multipliers() const {
    return {y_.data(), y_.data() + rows_};
}

}  // namespace rigor::validation::numerics
