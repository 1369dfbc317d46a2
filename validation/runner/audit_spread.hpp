// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

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
    std::optional<double> median() {
        if (values_.empty()) return std::nullopt;
        const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
        std::nth_element(values_.begin(), middle, values_.end());
        return *middle;
    }

  private:
    std::vector<double> values_;
    double largest_ = -1.0;
};

}  // namespace rigor::validation
