// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Builds bodies of twice the given mass.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    ReadBack readBack() const override {
        ReadBack back = FreeFlightWorld::readBack();
        for (auto& body : back.bodies) body.mass *= 2.0;
        return back;
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::Faulty>)
