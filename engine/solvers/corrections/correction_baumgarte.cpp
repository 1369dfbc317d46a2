// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Baumgarte stabilisation [Baumgarte1972]: the velocity rows aim at J v = -beta C / h, so a fraction beta of
// the error goes per step. Simple, but the bias velocity stays in the bodies: it adds energy.
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Baumgarte final : public PositionCorrection<S> {
  public:
    std::unique_ptr<PositionCorrection<S>> clone() const override {
        return std::make_unique<Baumgarte>(*this);
    }
    BiasRule<typename S::Real> bias() const override {
        BiasRule<typename S::Real> rule;
        rule.baumgarte = typename S::Real(0.2);
        return rule;
    }
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeBaumgarte() {
    return std::make_unique<Baumgarte<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeBaumgarte, PositionCorrection);

}  // namespace rigor::engine
