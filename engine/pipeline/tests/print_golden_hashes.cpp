// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Prints the state hashes of the golden scenes, "2d_default 0x0123456789abcdef" a line:
// for processors other than the one that the recorded hashes are of (cmake/cross/README.md).
//     engine_print_golden_hashes [one-thread]
#include <cinttypes>
#include <cstdio>
#include <string_view>

#include "engine/pipeline/tests/golden_scenes.hpp"

int main(int argc, char** argv) {
    using namespace rigor::engine::test;
    const bool oneThread = argc > 1 && std::string_view(argv[1]) == "one-thread";
    forEachGolden(
        [](const std::string& name, const GoldenResult& result) {
            std::printf("%s 0x%016" PRIx64 "%s\n", name.c_str(), result.hash,
                        result.finite ? "" : " not finite");
            std::fflush(stdout);
        },
        oneThread);
}
