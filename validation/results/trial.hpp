// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Work that may crash or never end, tried in a child first.
#pragma once

#include <functional>
#include <string>

namespace rigor::results {

/// Runs `work` in a copy of this process. Returns "" if it came to its end there, otherwise the message of its
/// exception or the way in which it ended ("it crashes the library: Segmentation fault"). Throws EnvironmentError if
/// no child can be started.
std::string failureInChild(const std::function<void()>& work);

}  // namespace rigor::results
