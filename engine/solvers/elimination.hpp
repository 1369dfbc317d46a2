// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// In which order to eliminate the unknowns of a sparse symmetric system, and where its factor L has entries:
// see elimination.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rigor::engine {

struct Elimination {
    std::vector<std::uint32_t> order;  ///< position -> node
    /// Connected components are ranges of positions: part[i] .. part[i + 1] - 1.
    std::vector<std::uint32_t> part;
    /// Entries of column k of L below the diagonal: row[start[k]] .. row[start[k + 1] - 1], growing
    /// positions.
    std::vector<std::size_t> start;
    std::vector<std::uint32_t> row;
};

/// `near[i]`: the nodes that node i is coupled with, growing, without i; every coupling is in both lists.
/// False, and nothing of use in `out`, where L would have more than `most` entries below the diagonal.
bool findElimination(std::vector<std::vector<std::uint32_t>> near, std::size_t most, Elimination& out);

}  // namespace rigor::engine
