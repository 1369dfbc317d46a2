// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files there and back in every arrangement of a matrix; condensation against the equations it comes from;
// what is wrong with a file is said.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "validation/contact_problems/tests/small_problems.hpp"
#include "validation/results/hdf5_file.hpp"
#include "validation/runner/describe.hpp"

namespace rigor::validation::testing {
namespace {

using ::testing::HasSubstr;

/// Random and unsymmetric: m velocities in two groups, `contacts` contacts, p bilateral rows.
ExportedProblem randomGlobal(int dimension, int contacts, int m, int p, unsigned seed) {
    std::mt19937 engine(seed);
    const auto draw = [&] { return engine() / 2147483648.0 - 1.0; };
    ExportedProblem exported;
    exported.isGlobal = true;
    exported.title = "random";
    exported.description = "drawn";
    exported.mathInfo = "none";
    ContactProblem& c = exported.problem;
    c.dimension = dimension;
    for (int i = 0; i < contacts; ++i) c.mu.push_back(0.5 * (draw() + 1.0));
    std::vector<Triplet> M, H, G;
    for (int i = 0; i < m; ++i) {
        c.f.push_back(draw());
        for (int j = 0; j < m; ++j)
            if ((i < m / 2) == (j < m / 2)) M.push_back({i, j, draw() + (i == j ? 4.0 : 0.0)});
    }
    for (int j = 0; j < contacts * dimension; ++j) {
        c.w.push_back(draw());
        for (int i = 0; i < m; ++i)
            if ((i + j) % 3 != 0) H.push_back({i, j, draw()});
    }
    for (int j = 0; j < p; ++j) {
        exported.b.push_back(draw());
        for (int i = 0; i < m; ++i) G.push_back({i, j, draw()});
    }
    c.M = fromTriplets(m, m, M);
    c.H = fromTriplets(m, contacts * dimension, H);
    exported.G = fromTriplets(m, p, G);
    complete(exported, "random");
    exported.storedR.assign(c.size(), 0.25);
    exported.storedV = velocitiesFor(exported, exported.storedR);
    return exported;
}

void expectSame(const ExportedProblem& a, const ExportedProblem& b) {
    EXPECT_EQ(a.isGlobal, b.isGlobal);
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(a.mathInfo, b.mathInfo);
    EXPECT_EQ(a.problem.dimension, b.problem.dimension);
    EXPECT_EQ(a.problem.mu, b.problem.mu);
    EXPECT_EQ(a.problem.f, b.problem.f);
    EXPECT_EQ(a.problem.w, b.problem.w);
    EXPECT_EQ(a.b, b.b);
    for (const auto& [x, y] :
         {std::pair{&a.problem.M, &b.problem.M}, {&a.problem.H, &b.problem.H}, {&a.G, &b.G}}) {
        EXPECT_EQ(x->rows, y->rows);
        EXPECT_EQ(x->value, y->value);
        EXPECT_EQ(x->row, y->row);
        EXPECT_EQ(x->start, y->start);
    }
    EXPECT_EQ(a.problem.W, b.problem.W);
    EXPECT_EQ(a.problem.q, b.problem.q);
    EXPECT_EQ(a.problem.hasBodies, b.problem.hasBodies);
    EXPECT_EQ(a.storedR, b.storedR);
    EXPECT_EQ(a.storedV, b.storedV);
}

TEST(Fclib, ThereAndBackToTheBitInEveryArrangement) {
    const ScratchFolder scratch;
    const auto file = scratch.path() / "problem.hdf5";
    for (const int dimension : {2, 3})
        for (const SparseLayout layout : {SparseLayout::Columns, SparseLayout::Rows, SparseLayout::Triplets})
            for (const int bilateral : {0, 2}) {
                const ExportedProblem global = randomGlobal(dimension, 4, 9, bilateral, 7);
                writeFclib(global, file, layout);
                const ExportedProblem again = readContactProblem(file);
                if (bilateral > 0) {
                    expectSame(global, again);
                } else {
                    EXPECT_TRUE(again.problem.hasBodies);
                    ExportedProblem plain = global;
                    plain.G = again.G;  // a matrix without columns, or without anything
                    expectSame(plain, again);
                }
                ExportedProblem local = global;
                local.isGlobal = false;
                local.problem.hasBodies = false;
                local.problem.M = local.problem.H = local.G = {};
                local.problem.f.clear();
                local.problem.w.clear();
                local.b.clear();
                writeFclib(local, file, layout);
                expectSame(local, readContactProblem(file));
            }
}

/// The file as FCLIB's own tools see it, name by name.
TEST(Fclib, LayoutIsThatOfTheFormat) {
    const ScratchFolder scratch;
    const auto path = scratch.path() / "problem.hdf5";
    ExportedProblem global = randomGlobal(3, 1, 6, 0, 3);
    writeFclib(global, path, SparseLayout::Triplets);
    const auto file = results::Hdf5File::open(path);
    int columns = 0;
    EXPECT_EQ(file.readIntegers("/fclib_global/spacedim", columns), std::vector<int>{3});
    EXPECT_EQ(file.children("/fclib_global"),
              (std::vector<std::string>{"H", "M", "info", "spacedim", "vectors"}));
    EXPECT_EQ(file.children("/fclib_global/H"),
              (std::vector<std::string>{"i", "m", "n", "nz", "nzmax", "p", "x"}));
    EXPECT_EQ(file.children("/fclib_global/vectors"), (std::vector<std::string>{"f", "mu", "w"}));
    EXPECT_EQ(file.children("/solution"), (std::vector<std::string>{"r", "v"}));
    EXPECT_EQ(file.readText("/fclib_global/info/title"), "random");
    // Triplets: rows in i, columns in p.
    const auto i = file.readIntegers("/fclib_global/H/i", columns),
               p = file.readIntegers("/fclib_global/H/p", columns);
    EXPECT_EQ(*std::max_element(i.begin(), i.end()), 5);
    EXPECT_EQ(*std::max_element(p.begin(), p.end()), 2);
}

/// u = H^T v + w and M v = H r + G l + f, G^T v + b = 0: l is found by least squares, so that the residual of
/// the equation of motion along G's complement is the measure.
TEST(Condensation, AgreesWithTheEquationsItComesFrom) {
    for (const int bilateral : {0, 1, 3}) {
        const ExportedProblem exported = randomGlobal(3, 3, 8, bilateral, 11);
        const ContactProblem& p = exported.problem;
        std::vector<double> r(p.size());
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = std::sin(1.0 + i);
        const std::vector<double> v = velocitiesFor(exported, r);
        std::vector<double> u = p.w;
        multiplyTransposedAdd(p.H, v, u);
        const std::vector<double> condensed = relativeVelocities(p, r);
        for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], condensed[i], 1e-12);
        std::vector<double> held = exported.b;
        multiplyTransposedAdd(exported.G, v, held);
        for (const double x : held) EXPECT_NEAR(x, 0.0, 1e-12);
        // M v - H r - f is a combination of G's columns: orthogonal to what is orthogonal to them.
        std::vector<double> left(v.size(), 0.0);
        multiplyAdd(p.M, v, left);
        std::vector<double> force = p.f;
        multiplyAdd(p.H, r, force);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] -= force[i];
        std::vector<std::vector<double>> basis;
        for (int j = 0; j < bilateral; ++j) {
            std::vector<double> g(v.size(), 0.0), unit(static_cast<std::size_t>(bilateral), 0.0);
            unit[j] = 1.0;
            multiplyAdd(exported.G, unit, g);
            basis.push_back(g);
            for (int pass = 0; pass < 2; ++pass)
                for (std::size_t k = 0; k + 1 < basis.size(); ++k) {
                    double along = 0.0;
                    for (std::size_t i = 0; i < g.size(); ++i) along += basis[k][i] * basis.back()[i];
                    for (std::size_t i = 0; i < g.size(); ++i) basis.back()[i] -= along * basis[k][i];
                }
            double size = 0.0;
            for (const double x : basis.back()) size += x * x;
            for (double& x : basis.back()) x /= std::sqrt(size);
        }
        for (const auto& e : basis) {
            double along = 0.0;
            for (std::size_t i = 0; i < left.size(); ++i) along += e[i] * left[i];
            for (std::size_t i = 0; i < left.size(); ++i) left[i] -= along * e[i];
        }
        for (const double x : left) EXPECT_NEAR(x, 0.0, 1e-12);
    }
}

std::string problemOf(const std::string& json) {
    const ScratchFolder scratch;
    const auto file = scratch.path() / "bad.json";
    std::ofstream(file) << json;
    try {
        readContactProblem(file);
    } catch (const adapter::BadInput& error) {
        return error.what();
    }
    return "";
}

TEST(Files, WhatIsWrongIsSaid) {
    const std::string head = R"({"form": "local", "dim": 3, "mu": [0.5], )";
    const std::string W = R"("W": {"n": [3, 3], "rows": [0, 1, 2], "cols": [0, 1, 2], "vals": [1, 1, 1]})";
    EXPECT_EQ(problemOf(head + R"("q": [1, 2, 3], )" + W + "}"), "");
    EXPECT_THAT(problemOf(head + R"("q": [1, 2], )" + W + "}"), HasSubstr("/W/n: found 3 x 3, expected 2"));
    EXPECT_THAT(problemOf(R"({"form": "local", "dim": 2, "mu": [0.5], "q": [1, 2, 3], )" + W + "}"),
                HasSubstr("q has 3 values, expected 2"));
    EXPECT_THAT(problemOf(R"({"form": "local", "dim": 3, "mu": [-1], "q": [1, 2, 3], )" + W + "}"),
                HasSubstr("mu[0] has -1.000000, expected no less than 0"));
    EXPECT_THAT(problemOf(R"({"form": "mixed", "dim": 3, "mu": [1]})"), HasSubstr("\"local\" or \"global\""));
    for (const char* value : {"1e128", "2.5", "3000000000", "-3000000000", "18446744073709551615", "\"3\""})
        EXPECT_THAT(problemOf(R"({"form": "local", "dim": )" + std::string(value) + "}"),
                    HasSubstr("dim: found " + nlohmann::json::parse(value).dump() + ", expected an integer"));
    const std::string entry = R"("q": [1], "W": {"n": [1, 1], "cols": [0], "vals": [1], "rows": [)";
    EXPECT_THAT(problemOf(head + entry + "1e20]}}"), HasSubstr("rows: found 1e+20, expected an integer"));
    EXPECT_THAT(problemOf("nothing"), HasSubstr("parse error"));
    const std::string M =
        R"("f": [1], "w": [0, 0, 0], "H": {"n": [1, 3], "rows": [0], "cols": [0], "vals": [1]},
        "M": {"n": [1, 1], "rows": [0], "cols": [0], "vals": [0]}})";
    EXPECT_THAT(problemOf(R"({"form": "global", "dim": 3, "mu": [0.5], )" + M), HasSubstr("is singular"));
    EXPECT_THROW(readContactProblem("nowhere.hdf5"), adapter::BadInput);
    EXPECT_THROW(readContactProblem(__FILE__), adapter::BadInput);
}

}  // namespace
}  // namespace rigor::validation::testing
