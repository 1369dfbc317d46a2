// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No position correction: overlap and joint drift stay as the velocity solver leaves them.
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {
namespace {

template <class S>
class NoCorrection final : public PositionCorrection<S> {
  public:
    std::unique_ptr<PositionCorrection<S>> clone() const override {
        return std::make_unique<NoCorrection>(*this);
    }
};

}  // namespace

template <class S>
std::unique_ptr<PositionCorrection<S>> makeNoCorrection() {
    return std::make_unique<NoCorrection<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeNoCorrection, PositionCorrection);

}  // namespace rigor::engine
