// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Loaded before a program (LD_PRELOAD), lets the kernels of the in-house engine use no other instruction set than that
// which RIGOR_INSTRUCTION_SET names: AVX3, AVX2, SSE4, SSE2, EMU128 (scalar code). Without the set, or on a machine that
// lacks it, the program ends with code 9.
#include <hwy/targets.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

__attribute__((constructor)) void choose() {
    const char* wanted = std::getenv("RIGOR_INSTRUCTION_SET");
    if (wanted == nullptr) return;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1)
        if (std::strcmp(hwy::TargetName(left & -left), wanted) == 0) {
            hwy::SetSupportedTargetsForTest(left & -left);
            return;
        }
    std::fprintf(stderr, "no instruction set '%s' here\n", wanted);
    std::_Exit(9);
}

}  // namespace
