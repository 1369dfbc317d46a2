// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A contact problem as Siconos' FrictionContactProblem. Both have the normal first and velocities u = W r + q; Siconos
// keeps W by columns. Every run starts from r = 0 with options of its own, since some solvers change theirs.
//
// Iterations are those that Siconos counts: sweeps over the contacts for the Gauss-Seidel methods, Newton steps, outer
// iterations of fixed points. A tolerance of the interface is absolute, as a velocity; Siconos' is relative to |q|.
// The friction is Coulomb's cone, exact in 2D and 3D.
#include "adapters/siconos/solvers.hpp"

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <SolverOptions.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rigor::siconos {
namespace {

using adapter::ContactProblem;
using adapter::ContactSolution;

struct Method {
    const char* name;
    int in2d, in3d;  ///< Siconos' numbers; 0: none
};
constexpr Method kMethods[] = {
    {"nsgs", SICONOS_FRICTION_2D_NSGS, SICONOS_FRICTION_3D_NSGS},
    {"nsn_ac", 0, SICONOS_FRICTION_3D_NSN_AC},
    {"nsn_fb", 0, SICONOS_FRICTION_3D_NSN_FB},
    {"nsn_nm", 0, SICONOS_FRICTION_3D_NSN_NM},
    {"admm", 0, SICONOS_FRICTION_3D_ADMM},
    {"proximal", 0, SICONOS_FRICTION_3D_PROX},
    {"tresca", 0, SICONOS_FRICTION_3D_TFP},
    {"vi_fpp", 0, SICONOS_FRICTION_3D_VI_FPP},
    {"vi_eg", 0, SICONOS_FRICTION_3D_VI_EG},
    {"cpg", SICONOS_FRICTION_2D_CPG, 0},
    {"lemke", SICONOS_FRICTION_2D_LEMKE, 0},
};

/// solver_options_delete frees what the options point to, and leaves the structure itself to its owner.
struct OptionsDeleter {
    void operator()(SolverOptions* options) const {
        solver_options_delete(options);
        std::free(options);
    }
};

class SiconosSolve final : public adapter::ContactSolve {
  public:
    SiconosSolve(const ContactProblem& p, int method)
        : method_(method), dimension_(p.dimension), q_(p.q), mu_(p.mu) {
        const int n = static_cast<int>(p.size());
        // frictionContactProblem_new_with_data would free arrays that it has not allocated.
        W_ = NM_create(NM_DENSE, n, n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) W_->matrix0[j * n + i] = p.W[static_cast<std::size_t>(i) * n + j];
        problem_.dimension = dimension_;
        problem_.numberOfContacts = static_cast<int>(p.contacts());
        problem_.M = W_;
        problem_.q = q_.data();
        problem_.mu = mu_.data();
        for (const double x : q_) normOfQ_ += x * x;
        normOfQ_ = std::sqrt(normOfQ_);
    }
    ~SiconosSolve() override { NM_free(W_); }
    SiconosSolve(const SiconosSolve&) = delete;
    SiconosSolve& operator=(const SiconosSolve&) = delete;

    ContactSolution run(int iterations, double tolerance) override {
        const std::unique_ptr<SolverOptions, OptionsDeleter> options(solver_options_create(method_));
        options->iparam[SICONOS_IPARAM_MAX_ITER] = iterations;
        options->dparam[SICONOS_DPARAM_TOL] =
            std::max(normOfQ_ > 0.0 ? tolerance / normOfQ_ : tolerance, 1e-300);
        ContactSolution found;
        found.r.assign(q_.size(), 0.0);
        std::vector<double> u(q_.size(), 0.0);
        if (dimension_ == 2)
            fc2d_driver(&problem_, found.r.data(), u.data(), options.get());
        else
            fc3d_driver(&problem_, found.r.data(), u.data(), options.get());
        found.iterations = std::clamp(options->iparam[SICONOS_IPARAM_ITER_DONE], 0, iterations);
        if (!std::all_of(found.r.begin(), found.r.end(), [](double x) { return std::isfinite(x); })) {
            found.gaveUp = true;
            found.r.assign(q_.size(), 0.0);
        }
        return found;
    }

  private:
    int method_, dimension_;
    std::vector<double> q_, mu_;
    NumericsMatrix* W_ = nullptr;
    FrictionContactProblem problem_{};
    double normOfQ_ = 0.0;
};

}  // namespace

std::vector<std::string> SiconosContactSolvers::solvers() const {
    std::vector<std::string> names;
    for (const Method& method : kMethods) names.emplace_back(method.name);
    return names;
}

std::unique_ptr<adapter::ContactSolve> SiconosContactSolvers::take(const ContactProblem& problem,
                                                                   const adapter::Settings& settings) const {
    numerics_set_verbose(0);
    const std::string& name = adapter::textSetting(settings, "solver");
    for (const Method& method : kMethods) {
        if (name != method.name) continue;
        const int number = problem.dimension == 2 ? method.in2d : method.in3d;
        if (number == 0)
            throw adapter::notInLibrary("siconos", name + " in " + std::to_string(problem.dimension) + "D",
                                        "siconos/numerics/Friction_cst.h, enum FRICTION_SOLVER");
        return std::make_unique<SiconosSolve>(problem, number);
    }
    throw adapter::BadInput("siconos: no solver '" + name + "'");
}

}  // namespace rigor::siconos
