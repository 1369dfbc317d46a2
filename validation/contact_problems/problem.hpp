// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An exported contact problem with all that its file says; see adapters/interface/contact_problem.hpp for the
// equations. Bilateral constraints come on top:  M v = H r + G l + f,  G^T v + b = 0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/interface/contact_problem.hpp"

namespace rigor::validation {

using adapter::ContactProblem;
using adapter::SparseMatrix;

struct ExportedProblem {
    std::string title, description, mathInfo;
    ContactProblem problem;
    bool isGlobal = false;  ///< the file gives M, H, f, w; else W and q
    SparseMatrix G;         ///< matrix of m rows; no columns: no bilateral constraints
    std::vector<double> b;
    /// The solution stored with the problem; each may be empty.
    std::vector<double> storedV, storedU, storedR;
};

struct Triplet {
    int row = 0, column = 0;
    double value = 0.0;
};
/// Rows of a matrix, and unknowns of a dense one: a small file can claim any number.
inline constexpr int kMostRows = 1 << 24, kMostDense = 1 << 14;
/// Throws BadInput for more than kMostDense unknowns.
void checkDenseSize(std::size_t unknowns);
/// Entries of the same place add up; zeros are kept. Throws BadInput for places outside and for sizes beyond kMostRows.
SparseMatrix fromTriplets(int rows, int columns, std::vector<Triplet> entries);
std::vector<Triplet> toTriplets(const SparseMatrix& A);
/// y += A x and y += A^T x.
void multiplyAdd(const SparseMatrix& A, const std::vector<double>& x, std::vector<double>& y);
void multiplyTransposedAdd(const SparseMatrix& A, const std::vector<double>& x, std::vector<double>& y);

/// Checks sizes and numbers, and condenses a global problem to W and q by LU (M may be unsymmetric). Errors
/// are reported as a BadInput that names `what`, the offending part, what was found and what was expected.
void complete(ExportedProblem& exported, const std::string& what);

/// v of a global problem for the impulses r.
std::vector<double> velocitiesFor(const ExportedProblem& exported, const std::vector<double>& r);
/// u = W r + q.
std::vector<double> relativeVelocities(const ContactProblem& problem, const std::vector<double>& r);

/// Arrangements of a sparse matrix that FCLIB's files may have.
enum class SparseLayout { Columns, Rows, Triplets };

/// FCLIB's HDF5 layout: /fclib_local or /fclib_global, and /solution where there is a stored one.
void writeFclib(const ExportedProblem& exported, const std::filesystem::path& file,
                SparseLayout layout = SparseLayout::Columns);
/// Reads `.hdf5`/`.h5` in that layout or `.json` (README.md); complete. Throws BadInput.
ExportedProblem readContactProblem(const std::filesystem::path& file);
ExportedProblem readFclib(const std::filesystem::path& file);
ExportedProblem readJsonProblem(const std::filesystem::path& file);
/// The same from the content of a file, which `name` names in messages. The HDF5 library may crash on damaged bytes:
/// readFclib tries them in a child first.
ExportedProblem parseFclib(const std::string& bytes, const std::string& name);
ExportedProblem parseJsonProblem(const std::string& text, const std::string& name);

}  // namespace rigor::validation
