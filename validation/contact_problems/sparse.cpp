// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <tuple>

#include "validation/contact_problems/problem.hpp"

namespace rigor::validation {
namespace {

std::size_t entry(int i) {
    return i;
}

}  // namespace

void checkDenseSize(std::size_t unknowns) {
    if (unknowns > static_cast<std::size_t>(kMostDense))
        throw adapter::BadInput(std::to_string(unknowns) +
                                " unknowns in one dense matrix, expected at most " +
                                std::to_string(kMostDense));
}

SparseMatrix fromTriplets(int rows, int columns, std::vector<Triplet> entries) {
    if (rows < 0 || columns < 0 || rows > kMostRows || columns > kMostRows)
        throw adapter::BadInput("a matrix of " + std::to_string(rows) + " x " + std::to_string(columns) +
                                ", expected 0 to " + std::to_string(kMostRows));
    for (const Triplet& e : entries)
        if (e.row < 0 || e.row >= rows || e.column < 0 || e.column >= columns)
            throw adapter::BadInput("entry (" + std::to_string(e.row) + ", " + std::to_string(e.column) +
                                    ") is outside of " + std::to_string(rows) + " x " +
                                    std::to_string(columns));
    std::sort(entries.begin(), entries.end(), [](const Triplet& a, const Triplet& b) {
        return std::tie(a.column, a.row) < std::tie(b.column, b.row);
    });
    SparseMatrix A{rows, columns, std::vector<int>(entry(columns) + 1, 0), {}, {}};
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const Triplet& e = entries[k];
        if (k > 0 && e.row == entries[k - 1].row && e.column == entries[k - 1].column) {
            A.value.back() += e.value;
            continue;
        }
        ++A.start[entry(e.column) + 1];
        A.row.push_back(e.row);
        A.value.push_back(e.value);
    }
    for (std::size_t j = 0; j < entry(columns); ++j) A.start[j + 1] += A.start[j];
    return A;
}

std::vector<Triplet> toTriplets(const SparseMatrix& A) {
    std::vector<Triplet> entries;
    for (int j = 0; j < A.columns; ++j)
        for (int k = A.start[entry(j)]; k < A.start[entry(j) + 1]; ++k)
            entries.push_back({A.row[entry(k)], j, A.value[entry(k)]});
    return entries;
}

void multiplyAdd(const SparseMatrix& A, const std::vector<double>& x, std::vector<double>& y) {
    for (const Triplet& e : toTriplets(A)) y[entry(e.row)] += e.value * x[entry(e.column)];
}
void multiplyTransposedAdd(const SparseMatrix& A, const std::vector<double>& x, std::vector<double>& y) {
    for (const Triplet& e : toTriplets(A)) y[entry(e.column)] += e.value * x[entry(e.row)];
}

}  // namespace rigor::validation
