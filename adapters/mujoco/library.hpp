// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Process-wide state of MuJoCo: errors become exceptions, warnings stay silent and are read from mjData, and a filter
// of contacts reads the world.
#pragma once

#include "adapters/interface/pair_table.hpp"
#include "adapters/mujoco/convert.hpp"

namespace rigor::mujoco {

/// Tables of a world that the filter of contacts reads.
struct ContactFilterData {
    const adapter::PairTable* pairs = nullptr;
    std::vector<adapter::PairTable::ShapeRef> shapes;  ///< shapes by geom
};

/// Installs the handlers, once in the process.
void useLibrary();

/// Makes the filter use `filter` for this data; its model has room for one number of the user's
/// (mjModel::nuserdata).
void setFilter(mjData& data, const ContactFilterData* filter);

/// The model of an MJCF text. Throws std::runtime_error with the compiler's message.
ModelOwner compile(const std::string& mjcf);

}  // namespace rigor::mujoco
