// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// FNV-1a over the bytes of a state, 64 bits (Fowler, Noll, Vo; public domain parameters).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rigor::engine {

class Hasher {
  public:
    void bytes(const void* data, std::size_t size) {
        const auto* p = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ull;
    }
    /// Scalars only: padding bytes would make the hash depend on what was in memory before.
    template <class T>
    void add(T value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        bytes(&value, sizeof value);
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace rigor::engine
