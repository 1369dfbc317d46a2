// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The files of web/ and Chart.js, built into the binary so that a report needs nothing beside it.
#pragma once

#include <string_view>

namespace rigor::report {

/// Content of an embedded file by its name ("style.css"). Throws std::out_of_range for an unknown one.
std::string_view webAsset(std::string_view name);

}  // namespace rigor::report
