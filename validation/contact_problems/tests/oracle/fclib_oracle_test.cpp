// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Our FCLIB files before the format's own library: what it reads from them, what we read from its files, and its merit
// function (the natural map of the second-order cone problem) beside our residual. Built where libfclib is installed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "validation/contact_problems/residual.hpp"
#include "validation/contact_problems/tests/small_problems.hpp"
#include "validation/runner/describe.hpp"

extern "C" {
#include <fclib.h>
}

namespace rigor::validation::testing {
namespace {

struct LocalDeleter {
    void operator()(fclib_local* p) const {
        fclib_delete_local(p);
        std::free(p);
    }
};
struct GlobalDeleter {
    void operator()(fclib_global* p) const {
        fclib_delete_global(p);
        std::free(p);
    }
};

/// Dense, row by row, of a matrix in any of the library's three forms.
std::vector<double> dense(const fclib_matrix& A) {
    std::vector<double> all(static_cast<std::size_t>(A.m) * A.n, 0.0);
    const auto at = [&](int row, int column) -> double& {
        return all[static_cast<std::size_t>(row) * A.n + column];
    };
    if (A.nz >= 0) {
        for (int k = 0; k < A.nz; ++k) at(A.i[k], A.p[k]) += A.x[k];
    } else {
        const int lines = A.nz == -1 ? A.n : A.m;
        for (int line = 0; line < lines; ++line)
            for (int k = A.p[line]; k < A.p[line + 1]; ++k)
                (A.nz == -1 ? at(A.i[k], line) : at(line, A.i[k])) += A.x[k];
    }
    return all;
}
std::vector<double> dense(const SparseMatrix& A) {
    std::vector<double> all(static_cast<std::size_t>(A.rows) * A.columns, 0.0);
    for (const Triplet& e : toTriplets(A))
        all[static_cast<std::size_t>(e.row) * A.columns + e.column] = e.value;
    return all;
}
std::vector<double> list(const double* values, std::size_t count) {
    return {values, values + count};
}

/// A symmetric local problem whose stored r and u are those of no solution.
ExportedProblem someLocal(int contacts) {
    ExportedProblem exported;
    exported.title = "oracle";
    ContactProblem& p = exported.problem;
    p.dimension = 3;
    const std::size_t n = 3 * static_cast<std::size_t>(contacts);
    for (int i = 0; i < contacts; ++i) p.mu.push_back(0.2 + 0.1 * i);
    p.W.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        p.q.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
        exported.storedR.push_back(std::cos(0.5 * static_cast<double>(i)));
        for (std::size_t j = 0; j < n; ++j)
            p.W[i * n + j] = i == j ? 3.0 : 0.1 * std::cos(static_cast<double>(i + j));
    }
    exported.storedU = relativeVelocities(p, exported.storedR);
    return exported;
}

TEST(FclibOracle, ReadsTheLocalProblemsThatWeWrite) {
    const ScratchFolder scratch;
    const auto file = scratch.path() / "local.hdf5";
    const ExportedProblem ours = someLocal(4);
    for (const SparseLayout layout : {SparseLayout::Columns, SparseLayout::Rows, SparseLayout::Triplets}) {
        writeFclib(ours, file, layout);
        const std::unique_ptr<fclib_local, LocalDeleter> read(fclib_read_local(file.c_str()));
        ASSERT_NE(read, nullptr);
        EXPECT_EQ(read->spacedim, 3);
        EXPECT_EQ(dense(*read->W), ours.problem.W);
        EXPECT_EQ(list(read->q, ours.problem.q.size()), ours.problem.q);
        EXPECT_EQ(list(read->mu, ours.problem.mu.size()), ours.problem.mu);
        ASSERT_NE(read->info, nullptr);
        EXPECT_STREQ(read->info->title, "oracle");
    }
}

TEST(FclibOracle, ReadsTheGlobalProblemsThatWeWrite) {
    const ScratchFolder scratch;
    const auto file = scratch.path() / "global.hdf5";
    const ExportedProblem ours = bodyPoint(0.4, {-1.0, 0.5, 0.25});
    for (const SparseLayout layout : {SparseLayout::Columns, SparseLayout::Rows, SparseLayout::Triplets}) {
        writeFclib(ours, file, layout);
        const std::unique_ptr<fclib_global, GlobalDeleter> read(fclib_read_global(file.c_str()));
        ASSERT_NE(read, nullptr);
        EXPECT_EQ(dense(*read->M), dense(ours.problem.M));
        EXPECT_EQ(dense(*read->H), dense(ours.problem.H));
        EXPECT_EQ(list(read->f, ours.problem.f.size()), ours.problem.f);
        EXPECT_EQ(list(read->w, ours.problem.w.size()), ours.problem.w);
        EXPECT_EQ(list(read->mu, 1), ours.problem.mu);
    }
}

TEST(FclibOracle, WeReadTheProblemsThatItWrites) {
    const ScratchFolder scratch;
    const auto first = scratch.path() / "first.hdf5", second = scratch.path() / "second.hdf5";
    const ExportedProblem ours = someLocal(3);
    writeFclib(ours, first);
    const std::unique_ptr<fclib_local, LocalDeleter> read(fclib_read_local(first.c_str()));
    ASSERT_NE(read, nullptr);
    ASSERT_EQ(fclib_write_local(read.get(), second.c_str()), 1);
    const ExportedProblem again = readContactProblem(second);
    EXPECT_EQ(again.problem.W, ours.problem.W);
    EXPECT_EQ(again.problem.q, ours.problem.q);
    EXPECT_EQ(again.problem.mu, ours.problem.mu);
    EXPECT_EQ(again.title, ours.title);
}

/// Its MERIT_1 is the same norm of the natural map, divided by 1 + sqrt(|q|).
TEST(FclibOracle, ItsMeritFunctionIsOurResidual) {
    const ScratchFolder scratch;
    const auto file = scratch.path() / "merit.hdf5";
    for (const double scale : {1.0, 0.3, 0.01}) {
        ExportedProblem ours = someLocal(5);
        for (double& r : ours.storedR) r *= scale;
        ours.storedU = relativeVelocities(ours.problem, ours.storedR);
        writeFclib(ours, file);
        const std::unique_ptr<fclib_local, LocalDeleter> read(fclib_read_local(file.c_str()));
        ASSERT_NE(read, nullptr);
        fclib_solution solution{nullptr, ours.storedU.data(), ours.storedR.data(), nullptr};
        const double merit = fclib_merit_local(read.get(), MERIT_1, &solution);
        const ContactResidual residual = contactResidual(ours.problem, ours.storedR);
        double squares = 0.0;
        for (const double q : ours.problem.q) squares += q * q;
        EXPECT_GT(residual.absolute, 1e-3);
        EXPECT_NEAR(merit * (1.0 + std::sqrt(std::sqrt(squares))), residual.absolute,
                    1e-12 * residual.absolute);
    }
}

}  // namespace
}  // namespace rigor::validation::testing
