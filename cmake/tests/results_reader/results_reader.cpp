// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Prints how many cases a run folder has.
#include <cstdio>

#include "validation/results/store.hpp"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const rigor::results::Run run = rigor::results::readRun(argv[1]);
    std::printf("%zu\n", run.cases.size());
}
