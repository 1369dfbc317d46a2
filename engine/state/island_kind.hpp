// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The kind of an island decides by which of a world's methods it is solved (pipeline/island_method.hpp).
#pragma once

#include <cstdint>

namespace rigor::engine {

enum class IslandKind : std::uint8_t {
    Usual,
    Large,    ///< many contacts
    Violent,  ///< fewer, between bodies that close in fast
};

/// A value for each kind of islands.
template <class T>
struct PerIslandKind {
    T usual{}, large{}, violent{};

    T& operator[](IslandKind kind) {
        return kind == IslandKind::Usual ? usual : kind == IslandKind::Large ? large : violent;
    }
    const T& operator[](IslandKind kind) const { return const_cast<PerIslandKind&>(*this)[kind]; }
};

}  // namespace rigor::engine
