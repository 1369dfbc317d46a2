// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Soft errors, then relaxation [Catto2024], with any velocity solver: the rows treat overlap and joint drift
// as damped springs [Catto2011] (soft.hpp); after the bodies have moved, the solver runs again on rigid rows
// without the bias of the errors, so that the velocity that pushed bodies apart does not stay in them.
//     solve   J v + (omega / a) C + gamma lambda = 0
//     move    x += h v
//     relax   J v = 0, from the impulses of the first solve
// Frequencies and damping ratios are the world's. Cost: up to another solve per step. Known limit: while a
// load changes, bodies give way by what the spring needs to carry it; at most a quarter of the step rate is
// resolved.
#include <limits>

#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class SoftCorrection final : public PositionCorrection<S> {
  public:
    std::unique_ptr<PositionCorrection<S>> clone() const override {
        return std::make_unique<SoftCorrection>(*this);
    }
    BiasRule<typename S::Real> bias() const override { return softBiasRule<typename S::Real>(); }
    int relaxIterations() const override { return std::numeric_limits<int>::max(); }
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeSoftCorrection() {
    return std::make_unique<SoftCorrection<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeSoftCorrection, PositionCorrection);

}  // namespace rigor::engine
