// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All rows of a step by an interior-point method, contacts on Coulomb's exact cone: what is left where sweeps
// over the contacts hardly come nearer. With w = W lambda + q, De Saxce's change of variable
// [DeSaxceFeng1998] and scaled so that every cone is Lorentz's, L = {|x_t| <= x_0},
//     lambda_n = c x_0 / mu,  lambda_t = c x_t,     u_0 = c w_n / mu + |u_t|,  u_t = c w_t
// Coulomb's law is  L > u _|_ x < L,  that is x o u = 0 for the product x o u = (x . u, x_0 u_t + u_0 x_t).
// The method follows x o u = nu (1, 0, 0) to nu = 0 by Newton steps on all equations at once, scaled as
// Nesterov and Todd do and with Mehrotra's second-order correction [Vandenberghe2010, sections 4 and 5]:
//     (B W' + T^2) dx = T h + rho,     B = I + e_0 t^T,  t = u_t / |u_t|,  T x = T^-1 u
// B is what makes the law not that of a minimum: it carries the change of |u_t|. Deviation: Acary and others
// [AcaryCadouxLemarechalMalick2011] keep |u_t| fixed in an outer iteration, so that B = I and each round is
// convex; one round of this costs as much as the whole method here. Normals without friction and rows
// with bounds are half-lines, a z = nu; rows without bounds are equations.
//
// c = 1 / sqrt(W_tt) gives contacts of light and heavy bodies one scale. W_ii counts (1 + sigma) fold, for
// redundant rows. Cost: 2/3 n^3 per step, some twenty steps whatever the number of contacts or the ratio of
// masses. Known limits: no proof of convergence (a problem may have no solution); the last digits are left to
// the Newton steps of contact_newton.hpp; static friction above that of sliding, and impulses from outside
// the rows (Poisson's expansion) have no such form, nor have rolling and torsional friction.
#pragma once

#include <vector>

#include "engine/solvers/lcp/assembled.hpp"
#include "engine/solvers/lcp/dense.hpp"

namespace rigor::engine {

class ContactInterior {
  public:
    /// True where all contacts have the form that the method needs.
    static bool fits(const AssembledProblem& problem);
    /// Impulses for the problem's W and q; how good they are is for the caller to see. Starts with what the
    /// problem's lambda are, moved into the cones by `shift`, a fraction of the velocity to be stopped; from
    /// 1 on from the middle of the cones, whatever lambda is. False: there are none.
    bool solve(const AssembledProblem& problem, double shift, std::vector<double>& impulses);

  private:
    static constexpr int kDim = 3;  ///< dimension of a cone; in 2D the last component is zero
    /// A contact with friction.
    struct Cone {
        std::size_t first = 0, rows = 0;  ///< normal, tangents
        double d[kDim] = {0, 0, 0};       ///< lambda = d x, component by component
        double x[kDim] = {0, 0, 0}, u[kDim] = {0, 0, 0};
        double beta = 0, v[kDim] = {0, 0, 0}, w[kDim] = {0, 0, 0};  ///< T and T^2 are made of them
        double t[kDim] = {0, 0, 0};                                 ///< (0, u_t / |u_t|)
        double rho[kDim] = {0, 0, 0};                               ///< u - (d w + |u_t| e_0), with B applied
        double dx[kDim] = {0, 0, 0}, du[kDim] = {0, 0, 0};
    };
    /// A bound of a row: its distance to it a, and the force z that holds it off.
    struct Bound {
        std::size_t row = 0;
        double sign = 1;  ///< a = sign (lambda - bound); w = sum of sign z
        double a = 0, z = 0, da = 0, dz = 0;
    };

    void begin(const AssembledProblem& p, double shift);
    void addBounds(const AssembledProblem& p, std::size_t i, double lower, double upper, double size,
                   bool cold);
    void addCone(const AssembledProblem& p, const AssembledContact& contact, double size, bool cold);
    void evaluate(const AssembledProblem& p);
    void scaleCones();
    bool factor(const AssembledProblem& p);
    void direction(double centering, bool corrected);
    double longestStep() const;
    void advance(double step);
    double gap() const;

    std::vector<Cone> cones_;
    std::vector<Bound> bounds_;
    std::vector<double> lambda_, w_, right_, y_;
    std::vector<std::uint8_t> pinned_;
    DenseLu lu_;
    double distance_ = 0;  ///< largest error of the equations w = W lambda + q, scaled
};

}  // namespace rigor::engine
