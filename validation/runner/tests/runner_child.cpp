// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The smallest program that can be a run's binary: what `rigor` does with `__case`, `__audit`, `__describe`.
#include "validation/runner/runner.hpp"

int main(int argc, char** argv) {
    return rigor::validation::childMain({argv + 1, argv + argc});
}
