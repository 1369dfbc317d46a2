// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shards of a plan, run apart, become the run that the whole plan would have made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

struct MergeOptions {
    std::vector<std::filesystem::path> shards;
    std::filesystem::path out;
    bool partial = false;  ///< missing and unfinished shards are no reason to refuse
    std::string command;
};

/// Writes the run into `out`, which holds nothing or an earlier merge of the same plan; one that was interrupted goes on.
/// The cases, their trajectories and the order are those of the whole plan; orders of convergence and fairness are
/// computed from all of them. With `partial` a run of which something is missing stays unfinished. Throws
/// std::invalid_argument that names what does not fit: other versions, texts or plans, equal ids with unequal rows,
/// damaged files, and without `partial` missing shards.
results::Run mergeShards(const MergeOptions& options);

/// Name of the first field in which two rows of a case differ, but for times, memory, place and command; "" for none.
std::string differenceOfCases(const results::CaseRow& a, const results::CaseRow& b);

}  // namespace rigor::validation
