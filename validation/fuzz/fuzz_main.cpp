// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Entry point of libFuzzer for the target RIGOR_FUZZ_TARGET.
#include <cstddef>
#include <cstdint>
#include <string>

#include "validation/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    rigor::fuzz::RIGOR_FUZZ_TARGET(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
