// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/statistics/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rigor::validation {
namespace {

struct Place {
    std::size_t low = 0;  ///< index of the value below, from 0
    double part = 0.0;    ///< fraction of the way to the next
};
Place placeOf(std::size_t n, double q) {
    const double place = q * (n - 1);
    const auto low = std::min(static_cast<std::size_t>(place), n - 1);
    return {low, place - low};
}

double between(double low, double high, double part) {
    if (part <= 0.0) return low;
    if (!std::isfinite(high)) return high;
    if (!std::isfinite(low)) return low;
    return low * (1.0 - part) + high * part;  // no difference of values that may be huge is taken
}

}  // namespace

double quantile(std::vector<double> values, double q) {
    const Place place = placeOf(values.size(), q);
    const auto at = values.begin() + place.low;
    std::nth_element(values.begin(), at, values.end());
    return at + 1 == values.end() ? *at : between(*at, *std::min_element(at + 1, values.end()), place.part);
}

double quantileOfSorted(const std::vector<double>& ascending, double q) {
    const Place place = placeOf(ascending.size(), q);
    const std::size_t next = std::min(place.low + 1, ascending.size() - 1);
    return between(ascending[place.low], ascending[next], place.part);
}

double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

}  // namespace rigor::validation
