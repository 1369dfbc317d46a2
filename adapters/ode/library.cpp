// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/ode/library.hpp"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace rigor::ode {
namespace {

thread_local std::int64_t messages = 0;

__attribute__((format(printf, 2, 0))) void throwError(int number, const char* format, va_list arguments) {
    char text[512] = "";
    std::vsnprintf(text, sizeof text, format, arguments);
    throw std::runtime_error("ODE error " + std::to_string(number) + ": " + text);
}

void countMessage(int, const char*, va_list) {
    ++messages;
}

}  // namespace

void useLibrary() {
    static std::once_flag once;
    std::call_once(once, [] {
        if (dInitODE2(0) == 0) throw std::runtime_error("ODE could not be initialised");
        dSetErrorHandler(throwError);
        dSetDebugHandler(throwError);
        dSetMessageHandler(countMessage);
    });
    thread_local const bool allocated = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
    if (!allocated) throw std::runtime_error("ODE could not allocate its thread data");
}

std::int64_t messageCount() {
    return messages;
}

std::mutex& randomMutex() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace rigor::ode
