// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tables of algorithms: one sorted .def file per family, with a line ALGORITHM(name, make, summary) for each. Who includes
// it defines ALGORITHM; the file undefines it.
#pragma once

#include <cstring>
#include <span>
#include <string>

#include "engine/core/error.hpp"

namespace rigor::engine {

/// One line of a family's table.
template <class Make>
struct AlgorithmEntry {
    const char* name;     ///< stable snake_case key used in configurations and results
    Make make;            ///< factory or function
    const char* summary;  ///< one line
};

/// The entry of that name. Throws EngineError "unknown_algorithm" listing the names there are.
template <class Make>
const AlgorithmEntry<Make>& findAlgorithm(std::span<const AlgorithmEntry<Make>> table, const char* family,
                                          const std::string& name) {
    std::string known;
    for (const AlgorithmEntry<Make>& entry : table) {
        if (name == entry.name) return entry;
        known += known.empty() ? "" : ", ";
        known += entry.name;
    }
    throw EngineError("unknown_algorithm", std::string(family) + " \"" + name + "\", known: " + known);
}

}  // namespace rigor::engine

/// Explicit instantiation of a factory `template <class S> std::unique_ptr<Base<S>> make();`.
#define RIGOR_INSTANTIATE_FACTORY(make, Base)                \
    template std::unique_ptr<Base<Space2f>> make<Space2f>(); \
    template std::unique_ptr<Base<Space2d>> make<Space2d>(); \
    template std::unique_ptr<Base<Space3f>> make<Space3f>(); \
    template std::unique_ptr<Base<Space3d>> make<Space3d>()

/// The line of a .def file as an entry of its family's table over the space S, or of the table of its traits.
#define RIGOR_ALGORITHM_ENTRY(name, make, summary) {#name, &make<S>, summary},
#define RIGOR_TRAITS_ENTRY(name, make, summary) {#name, make##Traits()},
