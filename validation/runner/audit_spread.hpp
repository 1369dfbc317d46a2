// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <optional>
#include <vector>

#include "validation/statistics/quantile.hpp"

namespace rigor::validation {

/// The largest value and the median of what was measured.
class Spread {
  public:
    bool add(double value) {
        values_.push_back(value);
        if (!(value <= largest_)) {
            largest_ = value;
            return true;
        }
        return false;
    }
    std::optional<double> max() const { return values_.empty() ? std::nullopt : std::optional(largest_); }
    std::optional<double> median() const {
        return values_.empty() ? std::nullopt : std::optional(validation::median(values_));
    }

  private:
    std::vector<double> values_;
    double largest_ = -1.0;
};

}  // namespace rigor::validation
