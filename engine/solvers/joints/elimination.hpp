// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Order of elimination of the unknowns of a sparse symmetric system, and the pattern of its factor L: see
// elimination.cpp.
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

    /// Cost of computing L in products of entries: the sum over the columns of c (c + 3) / 2 for c entries.
    std::size_t products() const;
};

/// `near[i]`: the nodes that node i is coupled with, growing, without i; every coupling is in both lists.
/// False, and nothing of use in `out`, where L would have more than `most` entries below the diagonal.
bool findElimination(std::vector<std::vector<std::uint32_t>> near, std::size_t most, Elimination& out);
/// The same for an order that is given, up to what leaves the entries of L as they are.
bool findElimination(std::vector<std::vector<std::uint32_t>> near, const std::vector<std::uint32_t>& order,
                     std::size_t most, Elimination& out);

}  // namespace rigor::engine
