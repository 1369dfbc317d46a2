// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The solvers on contact problems: one contact by hand, with bodies and without; agreement between the two
// ways into the same solver; the published problems of RIGOR_DATA.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "validation/contact_problems/residual.hpp"
#include "validation/contact_problems/tests/small_problems.hpp"

namespace rigor::validation::testing {
namespace {

struct OneContact {
    const char* name;
    std::vector<double> v;  ///< free velocity, normal first; mu = 0.5, m = 2 kg
    std::vector<double> r;  ///< solution by hand
};
const std::vector<OneContact>& oneContacts() {
    static const std::vector<OneContact> table{
        {"leaves", {1, 3, -4}, {0, 0, 0}},       {"sticks", {-2, 0.3, 0.4}, {4, -0.6, -0.8}},
        {"slides", {-2, 3, -4}, {4, -1.2, 1.6}}, {"leaves in 2D", {1, 3}, {0, 0}},
        {"sticks in 2D", {-2, -0.5}, {4, 1}},    {"slides in 2D", {-2, 5}, {4, -2}}};
    return table;
}

void expectAnswer(const adapter::LoadedEngine& engine, const std::string& spec, const ContactProblem& p,
                  const std::vector<double>& exact, double tolerance) {
    SCOPED_TRACE(spec);
    const auto solve = take(engine, spec, p);
    // The first solution must leave nothing behind for the second.
    for (int run = 0; run < 2; ++run) {
        const auto found = solve->run(200, 1e-14);
        ASSERT_EQ(found.r.size(), exact.size());
        EXPECT_GE(found.iterations, 1);
        for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(found.r[i], exact[i], tolerance) << i;
    }
}

TEST(OneContact, EveryConeSolverFindsIt) {
    const auto engine = loadEngineOfBuild("rigor");
    for (const OneContact& c : oneContacts()) {
        SCOPED_TRACE(c.name);
        const ExportedProblem onMatrix = massPoint(2, 0.5, c.v), onBodies = bodyPoint(0.5, c.v);
        for (const char* solver : {"nsgs", "pgs", "single_pass"})
            expectAnswer(engine, std::string("rigor:solver=") + solver, onMatrix.problem, c.r, 1e-12);
        for (const char* solver : {"block", "jacobi", "nsgs", "pgs", "single_pass"})
            expectAnswer(engine, std::string("rigor:solver=") + solver, onBodies.problem, c.r, 1e-12);
    }
}

/// The pyramid is the cone in 2D; each solver finds its own law's solution in 3D.
TEST(OneContact, PyramidSolversFindTheirOwn) {
    const auto rigorEngine = loadEngineOfBuild("rigor");
    std::vector<std::pair<const adapter::LoadedEngine*, std::string>> solvers{
        {&rigorEngine, "rigor:solver=dantzig"},
        {&rigorEngine, "rigor:solver=lemke"},
        {&rigorEngine, "rigor:friction=pyramid,solver=pgs"}};
    std::unique_ptr<adapter::LoadedEngine> bullet;
    const auto installed = adapter::availableEngines();
    if (std::find(installed.begin(), installed.end(), "bullet") != installed.end()) {
        bullet = std::make_unique<adapter::LoadedEngine>(loadEngineOfBuild("bullet"));
        for (const char* solver : {"mlcp_dantzig", "mlcp_lemke", "mlcp_pgs"})
            solvers.emplace_back(bullet.get(), std::string("bullet:solver=") + solver);
    }
    for (const auto& [engine, spec] : solvers) {
        SCOPED_TRACE(spec);
        for (const OneContact& c : oneContacts()) {
            SCOPED_TRACE(c.name);
            const ExportedProblem exported = massPoint(2, 0.5, c.v);
            const auto solve = take(*engine, spec, exported.problem);
            EXPECT_NE(solve->friction().kind, adapter::FrictionModel::Kind::Cone);
            const auto found = solve->run(100, 1e-14);
            const ContactResidual residual = contactResidual(exported.problem, found.r, solve->friction());
            // A known fault of the library: its Lemke gives an impulse where nothing has to be done.
            if (spec == "bullet:solver=mlcp_lemke" && c.r[0] == 0.0) {
                EXPECT_GT(residual.own, 0.1);
                continue;
            }
            EXPECT_LT(residual.own, 1e-7);
            const bool exact = c.v.size() == 2 || c.r[0] == 0.0, differs = std::string(c.name) == "slides";
            EXPECT_LT(residual.relative, exact ? 1e-7 : 1.0);
            EXPECT_GE(residual.relative, differs ? 1e-2 : 0.0);
        }
    }
}

/// A block on four corners with another one on top, pushed sideways: redundant, sticking and sliding.
ExportedProblem twoBlocks() {
    ExportedProblem exported;
    exported.isGlobal = true;
    ContactProblem& p = exported.problem;
    std::vector<Triplet> M, H;
    for (int b = 0; b < 2; ++b)
        for (int i = 0; i < 6; ++i) {
            M.push_back({6 * b + i, 6 * b + i, i < 3 ? 1.0 + b : 0.2 + 0.1 * b + 0.01 * i});
            p.f.push_back(i == 1 ? -1.0 - b : (i == 0 && b == 1 ? 1.5 : 0.02 * i));
        }
    int column = 0;
    for (int layer = 0; layer < 2; ++layer)
        for (const double x : {-0.5, 0.5})
            for (const double z : {-0.5, 0.5}) {
                // normal y, tangents z and x; arms to the layer's plane
                const double axes[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
                for (const auto& d : axes) {
                    for (int b = layer; b >= std::max(0, layer - 1); --b) {
                        const double y = b == layer ? -0.25 : 0.25, sign = b == layer ? 1 : -1;
                        const double turn[3] = {y * d[2] - z * d[1], z * d[0] - x * d[2],
                                                x * d[1] - y * d[0]};
                        for (int i = 0; i < 3; ++i) {
                            if (d[i] != 0) H.push_back({6 * b + i, column, sign * d[i]});
                            if (turn[i] != 0) H.push_back({6 * b + 3 + i, column, sign * turn[i]});
                        }
                    }
                    p.w.push_back(0);
                    ++column;
                }
                p.mu.push_back(layer == 0 ? 0.7 : 0.3);
            }
    p.M = fromTriplets(12, 12, M);
    p.H = fromTriplets(12, column, H);
    complete(exported, "two blocks");
    return exported;
}

/// Rows on bodies and rows on W are two ways into one solver: iterate by iterate the same impulses.
TEST(TwoWays, OnBodiesAndOnTheMatrixAreTheSameSolver) {
    const auto engine = loadEngineOfBuild("rigor");
    const ExportedProblem exported = twoBlocks();
    ExportedProblem matrix = exported;
    matrix.problem.hasBodies = false;
    for (const char* solver : {"nsgs", "pgs", "single_pass", "dantzig", "lemke"})
        for (const int iterations : {1, 7, 60}) {
            SCOPED_TRACE(std::string(solver) + " " + std::to_string(iterations));
            const std::string spec = std::string("rigor:solver=") + solver;
            const auto a = take(engine, spec, exported.problem)->run(iterations, 1e-13);
            const auto b = take(engine, spec, matrix.problem)->run(iterations, 1e-13);
            const auto u = relativeVelocities(exported.problem, a.r),
                       v = relativeVelocities(exported.problem, b.r);
            for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], v[i], 1e-9) << i;
        }
    EXPECT_LT(contactResidual(exported.problem,
                              take(engine, "rigor:solver=nsgs", exported.problem)->run(500, 1e-13).r)
                  .relative,
              1e-12);
}

TEST(Refusals, SayWhatIsMissing) {
    const auto engine = loadEngineOfBuild("rigor");
    const auto reason = [&](const std::string& solver, const ContactProblem& p) -> std::string {
        try {
            take(engine, "rigor:solver=" + solver, p);
        } catch (const adapter::Unsupported& error) {
            return error.what();
        }
        return "";
    };
    const ExportedProblem local = massPoint(2, 0.5, {1, 2, 3}), global = bodyPoint(0.5, {1, 2, 3});
    for (const char* solver : {"block", "jacobi"}) {
        EXPECT_THAT(reason(solver, local.problem), ::testing::HasSubstr("needs bodies")) << solver;
        EXPECT_EQ(reason(solver, global.problem), "") << solver;
    }
    for (const char* solver : {"pgs_soft", "tgs_soft", "xpbd"})
        EXPECT_THAT(reason(solver, global.problem), ::testing::HasSubstr("a contact problem has no"))
            << solver;
    // These are not the masses of rigid bodies.
    ExportedProblem odd = global;
    odd.problem.M.value[0] *= 2;
    EXPECT_THAT(reason("block", odd.problem), ::testing::HasSubstr("is not one mass and one inertia"));
    EXPECT_EQ(reason("pgs", odd.problem), "");
}

// ------------------------------------------------------------------------------- published problems
class Published : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* data = std::getenv("RIGOR_DATA");
        if (data == nullptr) GTEST_SKIP() << "RIGOR_DATA is not set";
        folder_ = std::filesystem::path(data) / "fclib";
        if (!std::filesystem::exists(folder_ / "index.csv")) GTEST_SKIP() << "no fclib in RIGOR_DATA";
        std::ifstream in(folder_ / "index.csv");
        std::string line;
        for (std::getline(in, line); std::getline(in, line);) {
            std::vector<std::string> fields;
            std::istringstream row(line);
            for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
            const auto file = folder_ / "problems" / (fields.at(0) + ".json");
            if (std::filesystem::exists(file)) reached_[file] = std::stod(fields.at(10));
        }
    }
    std::filesystem::path folder_;
    std::map<std::filesystem::path, double> reached_;  ///< relative residual of the shipped solution
};

TEST_F(Published, AreReadWithTheSolutionsTheyClaim) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "problems")) {
        SCOPED_TRACE(entry.path().stem());
        ++files;
        const ExportedProblem exported = readContactProblem(entry.path());
        ASSERT_EQ(reached_.count(entry.path()), 1u);
        ASSERT_EQ(exported.storedR.size(), exported.problem.size());
        // The index was computed by another program; 1e-13: rounding of a condensation done anew.
        EXPECT_LT(contactResidual(exported.problem, exported.storedR).relative,
                  2.0 * reached_.at(entry.path()) + 1e-13);
    }
    EXPECT_GE(files, 10u);
}

/// Problems with friction may have several solutions: of this one nsgs finds another, to rounding.
const char* const kOtherSolution = "OneObject-i1028-138";

TEST_F(Published, NsgsSolvesThemAll) {
    const auto engine = loadEngineOfBuild("rigor");
    for (const auto& [file, reached] : reached_) {
        if (reached > 1e-8) continue;  // no solver has solved it
        SCOPED_TRACE(file.stem());
        const ExportedProblem exported = readContactProblem(file);
        const auto found = take(engine, "rigor:solver=nsgs", exported.problem)->run(500, 1e-12);
        EXPECT_LT(contactResidual(exported.problem, found.r).relative, 1e-8);
        const auto u = relativeVelocities(exported.problem, found.r);
        const auto stored = relativeVelocities(exported.problem, exported.storedR);
        double scale = 0.0, difference = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            scale = std::max({scale, std::abs(stored[i]), std::abs(exported.problem.q[i])});
            difference = std::max(difference, std::abs(u[i] - stored[i]));
        }
        const bool other = file.stem() == kOtherSolution;
        EXPECT_LT(difference, (other ? 1e-2 : 1e-8) * scale);
        EXPECT_GE(difference, other ? 1e-4 * scale : 0.0) << "no exception any more";
    }
}

}  // namespace
}  // namespace rigor::validation::testing
