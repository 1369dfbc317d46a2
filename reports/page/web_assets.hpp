// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The template and the bundles of web/, built into the binary.
#pragma once

#include <string_view>

namespace rigor::report {

/// Content of an embedded file by its name ("report.css"). Throws std::out_of_range for an unknown one.
std::string_view webAsset(std::string_view name);

}  // namespace rigor::report
