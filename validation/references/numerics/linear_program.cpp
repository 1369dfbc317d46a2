// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See linear_program.hpp.
#include "validation/references/numerics/linear_program.hpp"

#include <cmath>
#include <stdexcept>

namespace rigor::validation::numerics {
namespace {

constexpr Real kTiny = 1e-13L;  // beside entries of order 1; 18 digits and a few hundred pivots

}  // namespace

LinearProgram::LinearProgram(std::vector<std::vector<Real>> rows, std::vector<Real> right) {
    const std::size_t m = rows.size();
    columns_ = m > 0 ? rows[0].size() : 0;
    table_ = std::move(rows);
    for (std::size_t i = 0; i < m; ++i) {
        if (table_[i].size() != columns_) throw std::invalid_argument("a linear program has ragged rows");
        if (right[i] < 0) {
            for (Real& a : table_[i]) a = -a;
            right[i] = -right[i];
        }
        table_[i].resize(columns_ + m + 1, 0);
        table_[i][columns_ + i] = 1;
        table_[i].back() = right[i];
        basis_.push_back(columns_ + i);
    }
    std::vector<Real> cost(columns_ + m, 0);
    for (std::size_t i = 0; i < m; ++i) cost[columns_ + i] = 1;
    run(cost, columns_ + m, infeasibility_);
    // Artificial unknowns left in the basis at zero: leave it where an original one can take the place.
    for (std::size_t i = 0; i < m; ++i) {
        if (basis_[i] < columns_) continue;
        for (std::size_t j = 0; j < columns_; ++j)
            if (std::abs(table_[i][j]) > 1e-9L) {
                if (std::abs(table_[i].back()) <= 1e-9L) pivot(i, j);
                break;
            }
    }
}

void LinearProgram::pivot(std::size_t row, std::size_t column) {
    std::vector<Real>& r = table_[row];
    const Real scale = 1 / r[column];
    for (Real& a : r) a *= scale;
    r[column] = 1;
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const Real factor = table_[i][column];
        if (i == row || factor == 0) continue;
        for (std::size_t j = 0; j < r.size(); ++j) table_[i][j] -= factor * r[j];
        table_[i][column] = 0;
    }
    basis_[row] = column;
}

LinearProgram::Status LinearProgram::run(std::vector<Real> cost, std::size_t columns, Real& value) {
    // Reduced costs: what a unit of a column outside the basis adds.
    cost.resize(table_.empty() ? columns + 1 : table_[0].size(), 0);
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const Real factor = cost[basis_[i]];
        if (factor == 0) continue;
        for (std::size_t j = 0; j < cost.size(); ++j) cost[j] -= factor * table_[i][j];
    }
    for (;;) {
        std::size_t enter = columns;
        for (std::size_t j = 0; j < columns && enter == columns; ++j)
            if (cost[j] < -kTiny) enter = j;
        if (enter == columns) break;
        std::size_t leave = table_.size();
        Real least = 0;
        for (std::size_t i = 0; i < table_.size(); ++i) {
            if (table_[i][enter] <= kTiny) continue;
            const Real ratio = table_[i].back() / table_[i][enter];
            const bool better = leave == table_.size() || ratio < least - kTiny ||
                                (ratio < least + kTiny && basis_[i] < basis_[leave]);
            if (better) leave = i, least = ratio;
        }
        if (leave == table_.size()) return Status::Unbounded;
        pivot(leave, enter);
        const Real factor = cost[enter];
        for (std::size_t j = 0; j < cost.size(); ++j) cost[j] -= factor * table_[leave][j];
        cost[enter] = 0;
    }
    value = cost.empty() ? 0 : -cost.back();
    return Status::Optimal;
}

std::vector<Real> LinearProgram::point() const {
    std::vector<Real> x(columns_, 0);
    for (std::size_t i = 0; i < basis_.size(); ++i)
        if (basis_[i] < columns_) x[basis_[i]] = table_[i].back();
    return x;
}

LinearProgram::Result LinearProgram::minimise(const std::vector<Real>& cost) {
    Result result;
    // Only original columns may enter; artificial ones stay at zero where rows are redundant.
    result.status = run(cost, columns_, result.value);
    return result;
}

}  // namespace rigor::validation::numerics
