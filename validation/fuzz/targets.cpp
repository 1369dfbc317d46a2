// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/fuzz/targets.hpp"

namespace rigor::fuzz {

const std::vector<Target>& targets() {
#define FUZZ_TARGET(name, function, input) {#name, function},
    static const std::vector<Target> table{
#include "validation/fuzz/targets.def"
    };
#undef FUZZ_TARGET
    return table;
}

}  // namespace rigor::fuzz
