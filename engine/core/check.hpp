// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// RIGOR_CHECK: programming errors end the process with the place and the condition, in every build.
#pragma once

namespace rigor::engine {

/// Prints "file:line: check failed: condition (message)" to standard error and aborts.
[[noreturn]] void checkFailed(const char* file, int line, const char* condition, const char* message);

}  // namespace rigor::engine

#define RIGOR_CHECK(condition, message) \
    ((condition) ? static_cast<void>(0) \
                 : ::rigor::engine::checkFailed(__FILE__, __LINE__, #condition, message))
