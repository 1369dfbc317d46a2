// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bullet's solvers of mixed linear complementarity problems (btMLCPSolverInterface), each on its own:
//     A x = b + w,   lo <= x <= hi,   w the slack;   A = W, b = -q, x = r
// Friction is |r_T1|, |r_T2| <= mu r_N. btDantzigSolver and btSolveProjectedGaussSeidel take that as bounds
// that depend on another row ("limitDependency": lo = -mu, hi = mu times that row's x). btLemkeSolver knows
// fixed bounds only; so that it can take part, each of its iterations is one solution with the bounds that
// the normals of the one before set, starting without friction: the fixed point of these rounds obeys the law
// (Haslinger 1983, as for Rigor's direct solvers). In Bullet's own steps its friction has fixed bounds. The
// precision is that of the library.
#include "adapters/bullet/contact_solver.hpp"

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btLemkeSolver.h>
#include <BulletDynamics/MLCPSolvers/btSolveProjectedGaussSeidel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigor::bullet {
namespace {

using adapter::ContactProblem;
using adapter::ContactSolution;

constexpr btScalar kUnbounded = std::numeric_limits<btScalar>::infinity();

class BulletSolve final : public adapter::ContactSolve {
  public:
    BulletSolve(const ContactProblem& p, std::unique_ptr<btMLCPSolverInterface> solver, bool dependentLimits,
                bool direct)
        : solver_(std::move(solver)),
          dependentLimits_(dependentLimits),
          direct_(direct),
          dimension_(p.dimension),
          n_(p.size()),
          mu_(p.mu) {
        A_.resize(n_, n_);
        b_.resize(n_);
        x_.resize(n_);
        lo_.resize(n_);
        hi_.resize(n_);
        limits_.resize(n_);
        for (int i = 0; i < n_; ++i) {
            const auto row = i * p.size();
            for (int j = 0; j < n_; ++j) A_.setElem(i, j, static_cast<btScalar>(p.W[row + j]));
            b_[i] = static_cast<btScalar>(-p.q[i]);
            limits_[i] = i % dimension_ == 0 ? -1 : i - i % dimension_;
        }
    }
    ContactSolution run(int iterations, double tolerance) override {
        ContactSolution found;
        x_.setZero();
        if (dependentLimits_) {
            found.gaveUp = !solve(1.0, iterations);
            found.iterations = direct_ ? 1 : iterations;
        } else {
            rounds(iterations, tolerance, found);
        }
        for (int i = 0; i < n_; ++i) found.r.push_back(x_[i]);
        return found;
    }
    adapter::FrictionModel friction() const override { return {adapter::FrictionModel::Kind::Box}; }

  private:
    double limitOf(int row) const {
        const auto mu = mu_[row / dimension_];
        return dependentLimits_ ? mu : mu * std::max(0.0, static_cast<double>(x_[row - row % dimension_]));
    }
    /// Solves with the limits of friction of the present normal impulses, times `share`. Solvers may overwrite
    /// their input.
    bool solve(double share, int iterations) {
        for (int i = 0; i < n_; ++i) {
            const bool normal = i % dimension_ == 0;
            hi_[i] = normal ? kUnbounded : static_cast<btScalar>(share * limitOf(i));
            lo_[i] = normal ? btScalar(0) : -hi_[i];
        }
        btMatrixXu A = A_;
        btVectorXu b = b_;
        return solver_->solveMLCP(A, b, x_, lo_, hi_, limits_, iterations);
    }
    void rounds(int iterations, double tolerance, ContactSolution& found) {
        for (int i = 0; i < n_; ++i) limits_[i] = -1;
        btVectorXu before;
        for (int k = 0; k < iterations; ++k) {
            before = x_;
            constexpr int kPivots = 1000;
            found.gaveUp = !solve(1.0, kPivots);
            found.iterations = k + 1;
            double change = 0.0;  // change as a velocity
            for (int i = 0; i < n_; ++i)
                change = std::max(change, std::abs(static_cast<double>(A_(i, i) * (x_[i] - before[i]))));
            if (found.gaveUp || change <= tolerance) return;
        }
    }

    std::unique_ptr<btMLCPSolverInterface> solver_;
    bool dependentLimits_, direct_;
    int dimension_, n_;
    std::vector<double> mu_;
    btMatrixXu A_;
    btVectorXu b_, x_, lo_, hi_;
    btAlignedObjectArray<int> limits_;
};

}  // namespace

std::vector<std::string> BulletContactSolvers::solvers() const {
    return {"mlcp_dantzig", "mlcp_lemke", "mlcp_pgs", "nncg", "si"};
}

std::unique_ptr<adapter::ContactSolve> BulletContactSolvers::take(const ContactProblem& problem,
                                                                  const adapter::Settings& settings) const {
    const std::string& name = adapter::textSetting(settings, "solver");
    if (name == "mlcp_dantzig")
        return std::make_unique<BulletSolve>(problem, std::make_unique<btDantzigSolver>(), true, true);
    if (name == "mlcp_pgs")
        return std::make_unique<BulletSolve>(problem, std::make_unique<btSolveProjectedGaussSeidel>(), true,
                                             false);
    if (name == "mlcp_lemke")
        return std::make_unique<BulletSolve>(problem, std::make_unique<btLemkeSolver>(), false, true);
    throw adapter::Unsupported(name + " takes bodies and manifolds of a world, and no matrix");
}

}  // namespace rigor::bullet
