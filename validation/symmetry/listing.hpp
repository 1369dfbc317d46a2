// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order in which a scenario lists its bodies, shapes, joints and forces. Newton's equations do not see
// it; a solver that goes through a list does, wherever it is not iterated to the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "validation/symmetry/symmetry.hpp"

namespace rigor::validation {

/// Permutation of each list of the scenario: element i goes to place [i].
struct Listing {
    std::vector<int> bodies, joints, forces;
    std::vector<std::vector<int>> shapes;  ///< shapes of each body, bodies as the scenario has them

    friend bool operator==(const Listing&, const Listing&) = default;
};

Listing asWritten(const scenario::Scenario& scenario);
Listing reversed(const scenario::Scenario& scenario);
/// Every list shuffled (Fisher and Yates with a Mersenne twister), the same on every machine.
Listing shuffled(const scenario::Scenario& scenario, std::uint32_t seed);

/// Number of orders, counted up to `most`: 1 if every list has one element at most.
std::size_t listingCount(const scenario::Scenario& scenario, std::size_t most);

/// At most `count` orders beside the one as written, all different: everything reversed, then shuffles from
/// seeds 1, 2, .... The k-th is the same for every count. There are fewer if not so many exist.
std::vector<Listing> otherListings(const scenario::Scenario& scenario, std::size_t count);

/// The scenario listed otherwise. `listing` must be of this scenario.
Transformed listed(const scenario::Scenario& scenario, const Listing& listing);

}  // namespace rigor::validation
