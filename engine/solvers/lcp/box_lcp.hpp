// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The linear complementarity problem with bounds,
//     w = A x + q,   lower <= x <= upper,   w_i >= 0 at lower, w_i <= 0 at upper, w_i = 0 between,
// for a symmetric positive definite A, by Dantzig's principal pivoting [CottleDantzig1968], in the form that
// Baraff gave it for contact forces [Baraff1994] and Lacoursiere for bounds.
//
// Indices are taken in one after the other, those without bounds first (all at once). Index d moves x_d in
// the direction that brings w_d to zero, while the free indices F follow so that their w stays zero:
//     dx_F = -A_FF^-1 A_Fd,   dw = A_d + A_F dx_F
// until w_d is zero (d becomes free), x_d meets a bound, a free x_i meets one (i leaves F), or the w_i of an
// index at a bound comes to zero (i joins F); then the next piece of the way begins. w_d never grows, so that
// no set of free indices occurs twice and the method ends; degenerate problems can stand still for several
// pieces, and a limit on pieces guards against rounding making that a cycle.
//
// The sets of the last solve are tried first, and improved a few times by exchanging all indices that are
// wrong at once (block principal pivoting [JudicePires1994]): in a steady step they are right. Cost: O(n^2)
// per piece, some n pieces. Positive semi-definite matrices are the caller's to regularise.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/solvers/lcp/dense.hpp"

namespace rigor::engine {

enum class BoxState : std::uint8_t { Lower, Free, Upper };

class BoxLcp {
  public:
    /// A + diag(shift), A n x n row by row. False where pivoting gave up: x is then within its bounds, no
    /// more.
    bool solve(std::size_t n, const double* A, const double* shift, const double* q, const double* lower,
               const double* upper, double* x);
    /// States of the last solve.
    const std::vector<BoxState>& states() const { return state_; }
    /// The next solve starts from nothing.
    void forget() { state_.clear(); }

  private:
    struct Problem {
        std::size_t n;
        const double *A, *shift, *q, *lower, *upper;
        double* x;
    };
    bool tryStates(const Problem& p);
    std::size_t solveForStates(const Problem& p);
    bool pivot(const Problem& p);
    bool takeIn(const Problem& p, std::size_t d, std::size_t& pieces);
    void follow(const Problem& p, std::size_t d, double direction);
    void updateFree(const Problem& p);
    double row(const Problem& p, std::size_t i) const;

    GrowingCholesky factor_;
    std::vector<BoxState> state_;
    std::vector<std::uint8_t> taken_;
    std::vector<double> w_, dw_, part_;
    double tolerance_ = 0;
};

}  // namespace rigor::engine
