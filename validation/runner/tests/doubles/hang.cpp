// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Never returns from a step.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    void misbehave() override {
        volatile bool forever = isDue();
        while (forever) {
        }
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::Faulty>)
