// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The known names nearest to a name that is not known, for error messages.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rigor::scenario {

/// Insertions, deletions, substitutions and swaps of neighbours that make one text the other, no part being
/// edited twice (optimal string alignment; Damerau, Communications of the ACM 7, 1964, 171).
std::size_t editDistance(const std::string& a, const std::string& b);

/// The known name with the least edit distance, the first of several; empty when every one differs in more
/// than a third of the letters of the longer name.
std::optional<std::string> nearestName(const std::string& found, const std::vector<std::string>& known);

/// "; did you mean 'NAME'?" for the nearest name, "" without one: the end of a message.
std::string didYouMean(const std::string& found, const std::vector<std::string>& known);

}  // namespace rigor::scenario
