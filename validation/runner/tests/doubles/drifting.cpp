// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lets bodies drift a metre in its fifth step.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    void misbehave() override {
        if (isDue()) states_.back().position.x += 1.0;
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::Faulty>)
