// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An engine without a fault.
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::FreeFlightWorld>)
