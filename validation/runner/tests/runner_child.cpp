// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The smallest program that can be a run's binary: what `rigor` does with `__case`, `__audit`, `__describe`,
// `__reference`, with references that break down beside the real ones.
#include "validation/runner/runner.hpp"
#include "validation/runner/tests/reference_doubles.hpp"

int main(int argc, char** argv) {
    return rigor::validation::childMain({argv + 1, argv + argc}, {}, rigor::doubles::makeReference);
}
