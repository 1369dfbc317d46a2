// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ordinary differential equations y' = f(t, y) to 1e-13 and better in extended precision: Gragg's modified
// midpoint rule with extrapolation in h^2 (Bulirsch-Stoer), adaptive step and order up to 16.
// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 1993, section II.9.
#pragma once

#include <functional>
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
/// which f cannot be integrated. `holds` must be true of y0.
Real lastTimeOf(const std::function<bool(const OdeState&)>& holds, const OdeRhs& f, Real t0, OdeState y,
                Real t1, int looks, const std::function<Real(const OdeState&)>& pace, const OdeState& scale);

/// A solution over [t0, t1] that can be asked at any time: Chebyshev interpolation of degree 15 on panels
/// halved until the interpolated midpoints agree with the integrated ones to `tolerance` beside
/// max(scale_i, |y_i|). Throws std::runtime_error where a panel would be shorter than 1e-6 of a
/// smooth part, and beyond 4000 panels.
class DenseSolution {
  public:
    DenseSolution() = default;
    /// `breaks`: times at which f is not smooth; no panel crosses them.
    DenseSolution(const OdeRhs& f, Real t0, const OdeState& y0, Real t1, Real tolerance = 1e-14L,
                  std::vector<Real> breaks = {}, const OdeState& scale = {});

    /// y(t); t is clamped to [t0, t1].
    OdeState at(Real t) const;

  private:
    struct Panel {
        Real begin = 0, end = 0;
        std::vector<OdeState> nodes;  ///< at the Chebyshev-Lobatto points of [begin, end]
    };
    void append(const OdeRhs& f, Real t0, OdeState& y, Real t1, Real tolerance, const OdeState& scale);
    static OdeState evaluate(const Panel& panel, Real t);
    static bool build(const OdeRhs& f, const OdeState& y0, Real tolerance, const OdeState& scale,
                      Panel& panel);

    std::vector<Panel> panels_;
};

}  // namespace rigor::validation::numerics
