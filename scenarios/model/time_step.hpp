// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time steps as people write them.
#pragma once

#include <optional>
#include <string_view>

namespace rigor::scenario {

/// The seconds of "0.004" or "1/240"; nothing for what is neither, or is not finite.
std::optional<double> parseTimeStep(std::string_view text);

}  // namespace rigor::scenario
