// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The main() of the benchmark programs. Exit code 2: an option that Google Benchmark does not know.
#include <benchmark/benchmark.h>

#include "engine/core/benchmarks/register.hpp"

int main(int argc, char** argv) {
    rigor::engine::registerBenchmarks();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
}
