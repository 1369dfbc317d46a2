// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Traits: properties that algorithms declare. Beside its factory `make`, the file of an algorithm defines a
// function `makeTraits`; the family's table calls both by its .def file, so that a missing one is a link
// error. Code that depends on what an algorithm does reads its traits, never its name. Each of them is
// measured (pipeline/tests/traits_test.cpp).
#pragma once

#include <span>
#include <string>

#include "engine/core/error.hpp"

namespace rigor::engine {

template <class T>
struct TraitsEntry {
    const char* name;  ///< name in the family's table of algorithms
    T traits;
};

/// The traits of the algorithm of that name. Throws EngineError "unknown_algorithm".
template <class T>
const T& findTraits(std::span<const TraitsEntry<T>> table, const char* family, const std::string& name) {
    for (const TraitsEntry<T>& entry : table)
        if (name == entry.name) return entry.traits;
    throw EngineError("unknown_algorithm", std::string(family) + " \"" + name + "\"");
}

}  // namespace rigor::engine
