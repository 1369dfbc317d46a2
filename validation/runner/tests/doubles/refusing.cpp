// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Refuses in the build: in one preset for want of an adapter, in the other of a library.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Refusing : public FreeFlightWorld {
  public:
    Refusing(const Scenario& scenario, double dt, const Settings& settings)
        : FreeFlightWorld(scenario, dt, settings) {
        if (textSetting(settings, "preset") == "matched") throw notInAdapter("refusing", "balls", "'ball'");
        throw notInLibrary("refusing", "balls", "refusing.h, shapes", "'ball'");
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::Refusing>)
