// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every choice a world has, as the tables list it.
#pragma once

#include <string>
#include <vector>

namespace rigor::engine {

struct AlgorithmInfo {
    std::string name, summary;
};
/// A stage of the step and what can be chosen for it.
struct AlgorithmFamily {
    std::string name;                       ///< the key of a spec: "solver"
    std::string summary;                    ///< one line
    std::string defaultChoice;              ///< default of WorldDef
    std::vector<AlgorithmInfo> algorithms;  ///< sorted by name
};
/// All families, in the order in which the step uses them.
std::vector<AlgorithmFamily> algorithmFamilies();

}  // namespace rigor::engine
