// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/interrupt.hpp"

namespace rigor::cli {
namespace {

std::atomic<bool> caught{false};

extern "C" void onInterrupt(int) {
    caught = true;
}

}  // namespace

const std::atomic<bool>& catchInterrupts(std::initializer_list<int> signals) {
    for (const int signal : signals) std::signal(signal, onInterrupt);
    return caught;
}

void releaseInterrupts(std::initializer_list<int> signals) {
    for (const int signal : signals) std::signal(signal, SIG_DFL);
}

}  // namespace rigor::cli
