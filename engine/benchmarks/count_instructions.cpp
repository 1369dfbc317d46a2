// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs the counted work under callgrind, which dumps its counters whenever rigorCountedWork returns:
//     valgrind --tool=callgrind --toggle-collect=rigorCountedWork --dump-after=rigorCountedWork
//         engine_count_instructions [PREFIX]
// Names go to standard output in the order of the dumps. tests/instruction_count_test.cpp does all of that.
//
// The counts are those of one instruction set, SSE4, whatever the processor has: Highway's choice is made
// here.
#include <hwy/highway.h>

#include <cstdio>
#include <cstring>

#include "engine/benchmarks/counted_work.hpp"

/// A name that can be passed to callgrind, and a boundary that the compiler keeps.
extern "C" [[gnu::noinline]] void rigorCountedWork(const std::function<void()>& work) {
    work();
    asm volatile("" ::: "memory");
}

int main(int argc, char** argv) {
    const char* prefix = argc > 1 ? argv[1] : "";
    const std::int64_t wanted = HWY_SSE4;
    if ((hwy::SupportedTargets() & wanted) == 0) {
        std::fprintf(stderr, "no SSE4\n");
        return 2;
    }
    hwy::SetSupportedTargetsForTest(wanted);
    for (const auto& work : rigor::engine::counted::everything()) {
        if (std::strncmp(work.name.c_str(), prefix, std::strlen(prefix)) != 0) continue;
        rigorCountedWork(work.prepare());
        std::printf("%s\n", work.name.c_str());
        std::fflush(stdout);
    }
}
