// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/statistics/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdlib>

namespace rigor::validation {

std::optional<Interval> medianInterval(std::vector<double> values) {
    const auto n = values.size();
    if (n < 6) return std::nullopt;
    const boost::math::binomial distribution(static_cast<double>(n), 0.5);
    // P(Bin < k + 1) = cdf(k). Below n/2 - 2 sqrt(n) it is at most e^-8 (Hoeffding): nothing to compare
    // there.
    const double size = n;
    auto k = static_cast<std::size_t>(std::max(0.0, size / 2 - 2 * std::sqrt(size)));
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

KolmogorovSmirnov kolmogorovSmirnov(std::vector<double> one, std::vector<double> other) {
    std::sort(one.begin(), one.end());
    std::sort(other.begin(), other.end());
    const auto n = static_cast<long long>(one.size()), m = static_cast<long long>(other.size());
    // The distance in units of 1/(n m), an integer.
    long long largest = 0;
    for (std::size_t i = 0, j = 0; i < one.size() && j < other.size();) {
        const double x = std::min(one[i], other[j]);
        while (i < one.size() && one[i] <= x) ++i;
        while (j < other.size() && other[j] <= x) ++j;
        largest = std::max(largest, std::abs(static_cast<long long>(i) * m - static_cast<long long>(j) * n));
    }
    // beyond[j] is the fraction of the paths to (i, j) that have been as far from the diagonal; no difference
    // from one is taken, so that small probabilities keep their digits.
    std::vector<double> beyond(other.size() + 1, 0.0);
    for (long long i = 0; i <= n; ++i)
        for (long long j = 0; j <= m; ++j) {
            const auto k = static_cast<std::size_t>(j);
            const double steps = std::max(1LL, i + j);
            const double below = j > 0 ? beyond[k - 1] * static_cast<double>(j) / steps : 0.0;
            beyond[k] = beyond[k] * static_cast<double>(i) / steps + below;
            if (std::abs(i * m - j * n) >= largest) beyond[k] = 1.0;
        }
    const double scale = static_cast<double>(n) * static_cast<double>(m);
    const double p = beyond.back();
    return {largest / scale, std::min(p, 1.0)};
}

}  // namespace rigor::validation
