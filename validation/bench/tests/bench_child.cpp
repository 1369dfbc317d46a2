// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The smallest program that can be a bench's binary.
#include "validation/bench/exchange.hpp"
#include "validation/runner/runner.hpp"

int main(int argc, char** argv) {
    return rigor::validation::childMain({argv + 1, argv + argc},
                                        {{"__bench", rigor::validation::benchChild}});
}
