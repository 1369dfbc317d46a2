// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A run in Markdown.
#pragma once

#include <string>

#include "reports/model/view_model.hpp"

namespace rigor::report {

/// Fits a pull-request comment.
std::string markdownSummary(const ViewModel& view);

}  // namespace rigor::report
