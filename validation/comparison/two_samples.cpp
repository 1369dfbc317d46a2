// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/two_samples.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "validation/statistics/bootstrap.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

constexpr std::size_t kExactUpTo =
    50;  ///< values of both samples: counting then takes n m (n + m) / 2 additions

/// U of the first sample: pairs in which it is larger, ties count half.
double largerPairs(const std::vector<double>& one, const std::vector<double>& other) {
    double u = 0.0;
    for (const double x : one)
        for (const double y : other) u += x > y ? 1.0 : x < y ? 0.0 : 0.5;
    return u;
}

/// Sum of t^3 - t over groups of t equal values.
double tieSum(std::vector<double> all) {
    std::sort(all.begin(), all.end());
    double sum = 0.0;
    for (std::size_t i = 0; i < all.size();) {
        std::size_t j = i;
        while (j < all.size() && all[j] <= all[i]) ++j;
        const double t = j - i;
        sum += t * t * t - t;
        i = j;
    }
    return sum;
}

/// Share of the orders of n and m values in which U is at most u. The number of orders with U = k is that of
/// partitions of k into at most n parts of at most m: w(n, m, k) = w(n - 1, m, k - m) + w(n, m - 1, k).
double shareUpTo(std::size_t n, std::size_t m, std::size_t u) {
    const std::size_t most = n * m;
    // rows[i]: number of orders of i and j values by U, for the j of the outer loop; as doubles, exact
    // enough.
    std::vector<std::vector<double>> rows(n + 1, std::vector<double>(most + 1, 0.0));
    for (std::size_t i = 0; i <= n; ++i) rows[i][0] = 1.0;  // j = 0
    for (std::size_t j = 1; j <= m; ++j)
        for (std::size_t i = 1; i <= n; ++i)
            for (std::size_t k = most; k >= j; --k) rows[i][k] += rows[i - 1][k - j];
    return std::accumulate(rows[n].begin(), rows[n].begin() + u + 1, 0.0) /
           std::accumulate(rows[n].begin(), rows[n].end(), 0.0);
}

}  // namespace

double mannWhitney(const std::vector<double>& one, const std::vector<double>& other) {
    if (one.empty() || other.empty()) return 1.0;
    const double n = one.size(), m = other.size();
    const double u = largerPairs(one, other), smaller = std::min(u, n * m - u);
    std::vector<double> all = one;
    all.insert(all.end(), other.begin(), other.end());
    const double ties = tieSum(all);
    if (ties <= 0.0 && all.size() <= kExactUpTo)
        return std::min(1.0, 2.0 * shareUpTo(one.size(), other.size(), static_cast<std::size_t>(smaller)));
    const double total = n + m;
    const double variance = n * m / 12.0 * (total + 1.0 - ties / (total * (total - 1.0)));
    if (!(variance > 0.0)) return 1.0;
    const double z = std::max(0.0, n * m / 2.0 - smaller - 0.5) / std::sqrt(variance);
    return std::min(1.0, 2.0 * boost::math::cdf(boost::math::complement(boost::math::normal(), z)));
}

RatioOfMedians ratioOfMedians(const std::vector<double>& one, const std::vector<double>& other,
                              std::uint64_t seed, int resamples) {
    const auto medianOf = [](const std::vector<double>& values, const std::vector<std::size_t>& picks) {
        std::vector<double> drawn;
        for (const std::size_t i : picks) drawn.push_back(values[i]);
        return median(std::move(drawn));
    };
    const auto intervals = bootstrap({one.size(), other.size()}, seed, resamples, [&](const Picks& picks) {
        return std::vector<double>{medianOf(other, picks[1]) / medianOf(one, picks[0])};
    });
    return {median(other) / median(one), intervals[0]};
}

PairedRatio pairedRatio(const std::vector<double>& one, const std::vector<double>& other) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < one.size(); ++i) ratios.push_back(other[i] / one[i]);
    return {median(ratios), medianInterval(ratios)};
}

std::vector<double> holm(const std::vector<double>& probabilities) {
    std::vector<std::size_t> order(probabilities.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return probabilities[a] < probabilities[b]; });
    std::vector<double> corrected(probabilities.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        largest = std::max(largest, static_cast<double>(order.size() - i) * probabilities[order[i]]);
        corrected[order[i]] = std::min(1.0, largest);
    }
    return corrected;
}

}  // namespace rigor::validation
