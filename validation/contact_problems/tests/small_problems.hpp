// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems with solutions known by hand, and the engines to solve them.
#pragma once

#include <cstdlib>

#include "adapters/interface/registry.hpp"
#include "validation/contact_problems/problem.hpp"

namespace rigor::validation::testing {

/// A point of mass m over a floor with free velocity v: W = 1/m, q = v (normal first).
inline ExportedProblem massPoint(double m, double mu, const std::vector<double>& v) {
    ExportedProblem exported;
    exported.title = "mass point";
    ContactProblem& p = exported.problem;
    p.dimension = v.size();
    p.mu = {mu};
    p.q = v;
    p.W.assign(v.size() * v.size(), 0.0);
    for (std::size_t i = 0; i < v.size(); ++i) p.W[i * v.size() + i] = 1.0 / m;
    return exported;
}

/// The same as bodies: mass 2 kg and some inertia, impulses at its centre of mass.
inline ExportedProblem bodyPoint(double mu, const std::vector<double>& v) {
    ExportedProblem exported;
    exported.title = "body";
    exported.isGlobal = true;
    ContactProblem& p = exported.problem;
    const int d = v.size(), dofs = d == 3 ? 6 : 3;
    p.dimension = d;
    p.mu = {mu};
    std::vector<Triplet> M, H;
    for (int i = 0; i < dofs; ++i) {
        M.push_back({i, i, i < d ? 2.0 : 0.5});
        p.f.push_back(i < d ? 2.0 * v[i] : 0.25);
    }
    for (int i = 0; i < d; ++i) H.push_back({i, i, 1.0});
    p.M = fromTriplets(dofs, dofs, M);
    p.H = fromTriplets(dofs, d, H);
    p.w.assign(static_cast<std::size_t>(d), 0.0);
    complete(exported, "body");
    return exported;
}

inline adapter::LoadedEngine loadEngineOfBuild(const std::string& spec) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/bin/adapters").c_str(), 1);
    return adapter::loadEngine(adapter::parseSpec(spec));
}

inline std::unique_ptr<adapter::ContactSolve> take(const adapter::LoadedEngine& engine,
                                                   const std::string& spec, const ContactProblem& problem) {
    return engine->contactSolvers()->take(problem,
                                          adapter::resolveSettings(adapter::parseSpec(spec), *engine));
}

}  // namespace rigor::validation::testing
