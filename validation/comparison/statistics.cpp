// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>

namespace rigor::validation {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::optional<Interval> medianInterval(std::vector<double> values) {
    const auto n = values.size();
    if (n < 6) return std::nullopt;
    const boost::math::binomial distribution(static_cast<double>(n), 0.5);
    std::size_t k = 0;  // P(Bin < k + 1) = cdf(k)
    while (boost::math::cdf(distribution, static_cast<double>(k)) <= 0.025) ++k;
    std::sort(values.begin(), values.end());
    return Interval{values[k - 1], values[n - k]};
}

double signTest(int one, int other) {
    const int n = one + other;
    if (n == 0) return 1.0;
    const boost::math::binomial distribution(n, 0.5);
    return std::min(1.0, 2.0 * boost::math::cdf(distribution, std::min(one, other)));
}

}  // namespace rigor::validation
