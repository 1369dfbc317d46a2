// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A case run once more for each of some other orders in which its bodies, shapes, joints and forces are
// passed to the engine (validation/symmetry/listing.hpp): what of its result is the order's. The value of the
// order as written stays the value of the case; least and greatest stand beside it, for every engine alike.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"
#include "validation/results/types.hpp"

namespace rigor::validation {

/// Orders beside the one as written that `--orders N` runs a scenario in: N - 1, or as many as there are.
int otherOrders(const scenario::Scenario& scenario, int requested);

/// End of a run in another order.
struct OrderEnd {
    int number = 0;         ///< 1 for the first of otherListings()
    results::CaseRow row;   ///< outcome, reason, metrics and grade; of the scenario as written
    std::string reference;  ///< reason why its reference gave no solution; "" if it did or there is none
};

/// Other orders are run of whatever the engine can build: one that fails as written may go well in another.
bool isRunInOrders(const results::CaseRow& row);

/// Writes what the other orders gave beside the row of the order as written.
void addOrders(results::CaseRow& row, std::vector<OrderEnd> others);
/// The row of a case that has no other order says so.
void addNoOrders(results::CaseRow& row);

/// Rows of cases whose other orders still run.
class OpenOrders {
  public:
    void open(std::size_t index, results::CaseRow row, int others);
    /// Forgets a case of which an order was disturbed from outside.
    void abandon(std::size_t index) { cases_.erase(index); }
    /// The whole row when this was the last of its orders; none for a case that was abandoned.
    std::optional<results::CaseRow> ended(std::size_t index, OrderEnd end);

  private:
    struct Case {
        results::CaseRow row;
        int missing = 0;
        std::vector<OrderEnd> ends;
    };
    std::map<std::size_t, Case> cases_;  ///< cases by place in the plan
};

}  // namespace rigor::validation
