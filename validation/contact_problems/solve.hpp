// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems put to the solvers of every engine that has some: residual against iterations and time.
// Each solver solves each problem in a child process of its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "validation/contact_problems/residual.hpp"

namespace rigor::validation {

struct SolveOptions {
    std::filesystem::path binary;  ///< this program, run again as `rigor __solve ...`
    std::vector<int> iterations{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000};  ///< ascending
    double tolerance = 1e-14;  ///< residual at which a solver may stop, relative to max |q_i|
    double seconds = 10.0;     ///< time after which no larger number of iterations is tried
    int jobs = 1;              ///< times are meant for 1
};

/// The solution after one number of iterations.
struct SolveStep {
    int allowed = 0, done = 0;  ///< iterations
    bool gaveUp = false;
    double seconds = 0.0;  ///< median wall time of a solution from r = 0
    int runs = 0;          ///< number of runs of the median
    ContactResidual residual;
    double velocityError = -1.0;  ///< max |u - stored u| / max |stored u|; -1: nothing stored
};
/// Solutions of one problem by one solver.
struct SolveAnswer {
    std::string solver;  ///< spec, "rigor:solver=nsgs", or "stored"
    adapter::FrictionModel model;
    std::string outcome = "solved";  ///< "solved", "unsupported", "crashed", "timeout", "error"
    std::string message;
    std::vector<SolveStep> steps;
};
struct SolvedProblem {
    std::filesystem::path file;
    std::string name, description;
    int dimension = 3;
    std::size_t contacts = 0, unknowns = 0;  ///< unknowns: rows of M, 0 for a local problem
    std::vector<SolveAnswer> answers;
};

/// Specs with every solver of an engine where a spec names none; empty: those of all engines that have some.
/// Throws BadInput for engines without.
std::vector<adapter::EngineSpec> contactSolverSpecs(const std::vector<adapter::EngineSpec>& requested,
                                                    const std::filesystem::path& binary);

/// Reads all files first (BadInput), then runs. False in `complete` where it was interrupted.
std::vector<SolvedProblem> solveFiles(const std::vector<std::filesystem::path>& files,
                                      const std::vector<adapter::EngineSpec>& specs,
                                      const SolveOptions& options,
                                      const std::function<void(const std::string&)>& onStart,
                                      const std::atomic<bool>& interrupted, bool& complete);

/// No in-house solver crashed, ran out of time, or left numbers that are not finite.
bool solveIsGreen(const std::vector<SolvedProblem>& problems);

/// "cone", "box", "polygon 4".
std::string frictionModelName(const adapter::FrictionModel& model);
std::string solveText(const std::vector<SolvedProblem>& problems, bool allSteps);
nlohmann::json solveJson(const std::vector<SolvedProblem>& problems);
/// One line per number of iterations: file;solver;friction;allowed;done;gave_up;... Throws
/// std::runtime_error.
void writeSolveCsv(const std::vector<SolvedProblem>& problems, const std::filesystem::path& file);

/// The child's side: `__solve <request.json>`.
int solveChild(const std::filesystem::path& request);

}  // namespace rigor::validation
