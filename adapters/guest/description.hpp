// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A guest's answer to `hello`: who it is, and what it has.
#pragma once

#include <string>
#include <vector>

#include "adapters/guest/connection.hpp"
#include "adapters/interface/presets.hpp"

namespace rigor::guest {

struct Description {
    adapter::EngineInfo info;
    adapter::Capabilities capabilities;
    std::vector<adapter::Option> options;
    std::vector<adapter::Preset> presets;
};

/// Throws EngineFailure for a guest of another protocol or name, and for an answer that lacks something.
Description sayHello(Connection& connection);

}  // namespace rigor::guest
