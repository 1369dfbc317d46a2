// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// FNV-1a, 64 bit (Fowler, Noll, Vo; draft-eastlake-fnv): small, stable everywhere, good enough to distinguish
// cases and final states.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace rigor::validation {

class Fnv1a {
  public:
    void byte(std::uint8_t b) { hash_ = (hash_ ^ b) * 0x100000001b3ull; }
    void word(std::uint64_t w) {
        for (int i = 0; i < 8; ++i) byte(static_cast<std::uint8_t>(w >> (8 * i)));
    }
    void number(double value) { word(std::bit_cast<std::uint64_t>(value)); }
    void bytes(std::string_view s) {
        for (const char c : s) byte(static_cast<std::uint8_t>(c));
    }
    /// Length first, so that "ab"+"c" and "a"+"bc" differ.
    void text(std::string_view s) {
        word(s.size());
        bytes(s);
    }
    std::string hex() const {
        constexpr const char* digits = "0123456789abcdef";
        std::string out(16, '0');
        for (std::size_t i = 0; i < 16; ++i) out[15 - i] = digits[(hash_ >> (4 * i)) & 15];
        return out;
    }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace rigor::validation
