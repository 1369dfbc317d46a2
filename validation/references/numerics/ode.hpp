// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ordinary differential equations y' = f(t, y) to 1e-13 and better in extended precision: Gragg's modified
// midpoint rule with extrapolation in h^2 (Bulirsch-Stoer), adaptive step and order up to 16.
// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 1993, section II.9.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "validation/references/numerics/real.hpp"

namespace rigor::validation::numerics {

using OdeState = std::vector<Real>;
/// Writes f(t, y) to `dydt`, which has the size of y.
using OdeRhs = std::function<void(Real t, const OdeState& y, OdeState& dydt)>;

/// y(t1) from y(t0) = y0. `tolerance` is the local error per step relative to max(scale_i, |y_i|); `scale`:
/// what y_i is measured against where it is small, in its own unit (empty: 1 for every component, for angles
/// and other pure numbers). `firstStep` is a hint for the first step (0: chosen). Throws std::runtime_error
/// when the step shrinks to nothing beside t and t1 - t0, or after 20000 steps.
OdeState integrateOde(const OdeRhs& f, Real t0, const OdeState& y0, Real t1, Real tolerance = 1e-16L,
                      Real firstStep = 0, const OdeState& scale = {});

/// The last time in [t0, t1] up to which `holds` is true along the solution; t1 where it is to the end. Looks
/// after every step of `pace(y)` and at least `looks` times, and halves the step in which it fails, or in
/// which f cannot be integrated. `holds` must be true of y0. After `evaluations` of f it ends with the last time
/// at which `holds` was found to be true.
Real lastTimeOf(const std::function<bool(const OdeState&)>& holds, const OdeRhs& f, Real t0, OdeState y,
                Real t1, int looks, const std::function<Real(const OdeState&)>& pace, const OdeState& scale,
                std::size_t evaluations = 2'000'000);

/// Limits that end a DenseSolution before t1. All bounds are counts, so that every machine gives the same
/// solution.
struct OdeLimits {
    /// Evaluations of f, by the neighbour as well.
    std::size_t evaluations = 5'000'000;
    /// Tolerance of a neighbour, a second integration from the same start; 0: none. The distance between the
    /// two shows how much of the accuracy is left where neighbouring motions part.
    Real neighbour = 0;
    /// True while solution and neighbour agree.
    std::function<bool(const OdeState& y, const OdeState& neighbour)> agrees;

    /// No neighbour.
    static OdeLimits ofEvaluations(std::size_t most);
    /// A neighbour of this tolerance that agrees while every |y_i - neighbour_i| is at most `apart` beside
    /// max(scale_i, |y_i|).
    static OdeLimits neighbourOf(Real tolerance, Real apart, OdeState scale);
};

/// A solution over [t0, t1] that can be evaluated at any time: Chebyshev interpolation of degree 15 on panels
/// halved until the interpolated midpoints agree with the integrated ones to `tolerance` beside max(scale_i,
/// |y_i|). It is given up where a panel would be shorter than 1e-6 of a smooth part, beyond 4000 panels, and
/// beyond the evaluations of its limits: without a neighbour std::runtime_error is thrown, with one the
/// solution ends after the last panel in which the two agreed (and throws where there is none).
class DenseSolution {
  public:
    DenseSolution() = default;
    /// `breaks`: times at which f is not smooth; no panel crosses them.
    DenseSolution(const OdeRhs& f, Real t0, const OdeState& y0, Real t1, Real tolerance = 1e-14L,
                  std::vector<Real> breaks = {}, const OdeState& scale = {}, const OdeLimits& limits = {});

    /// y(t); t is clamped to [t0, end()].
    OdeState at(Real t) const;
    /// End of the solution: t1 unless the neighbour or the bounds ended it before.
    Real end() const { return panels_.empty() ? Real(0) : panels_.back().end; }
    bool isWhole() const { return whole_; }
    /// The times of its nodes, ascending: as dense as the motion is quick, for looking at all of it.
    std::vector<Real> nodes() const;
    /// The last time up to `until` to which `holds` is true at every node, found between nodes by bisection;
    /// `until` where it is to there, empty where it is false at the start.
    std::optional<Real> lastTimeOf(const std::function<bool(const OdeState&)>& holds, Real until) const;

  private:
    struct Panel {
        Real begin = 0, end = 0;
        std::vector<OdeState> nodes;  ///< values at the Chebyshev-Lobatto points of [begin, end]
    };
    void append(const OdeRhs& f, Real t0, OdeState& y, OdeState& neighbour, Real t1, Real tolerance,
                const OdeState& scale, const OdeLimits& limits);
    static OdeState evaluate(const Panel& panel, Real t);
    static bool build(const OdeRhs& f, const OdeState& y0, Real tolerance, const OdeState& scale,
                      Panel& panel);

    std::vector<Panel> panels_;
    bool whole_ = true;
};

}  // namespace rigor::validation::numerics
