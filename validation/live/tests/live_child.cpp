// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_child.hpp"
#include "validation/runner/runner.hpp"

int main(int argc, char** argv) {
    return rigor::validation::childMain({argv + 1, argv + argc},
                                        {{"__instance", rigor::validation::instanceChild}});
}
