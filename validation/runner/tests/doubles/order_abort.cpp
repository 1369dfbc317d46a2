// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Aborts in its fifth step unless the first body that it got is static.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    void misbehave() override {
        if (isDue() && scenario_.bodies.front().type != scenario::BodyType::Static) std::abort();
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::Faulty>)
