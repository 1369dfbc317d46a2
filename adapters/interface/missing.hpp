// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Features of the scenario format that an engine does not have, listed for users before a run.
#pragma once

#include <string>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// Shapes, joints and what joints may have besides ("hinge.spring"), of the dimensions that the engine runs,
/// that are neither among its capabilities nor among Capabilities::libraryLacks: not in the adapter yet.
/// Without dynamics the joints are left out, and without queries of pairs as well the shapes.
std::vector<std::string> notInAdapterYet(const Capabilities& capabilities);

}  // namespace rigor::adapter
