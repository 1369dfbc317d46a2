// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Moves the body of index i by i mm along x in its fifth step: what a run gives depends on the order in which
// its bodies were passed, by a known amount.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    void misbehave() override {
        if (!isDue()) return;
        for (std::size_t i = 0; i < states_.size(); ++i)
            if (scenario_.bodies[i].type == scenario::BodyType::Dynamic) states_[i].position.x += 1e-3 * i;
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::Faulty>)
