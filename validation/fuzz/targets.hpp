// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions that read one input each. What is wrong with an input must end as an exception of the kind that the reader
// documents, which the function catches; anything else is a finding.
#pragma once

#include <string>
#include <vector>

namespace rigor::fuzz {

#define FUZZ_TARGET(name, function, input) void function(const std::string& bytes);
#include "validation/fuzz/targets.def"
#undef FUZZ_TARGET

struct Target {
    const char* name;
    void (*read)(const std::string& bytes);
};
const std::vector<Target>& targets();

}  // namespace rigor::fuzz
