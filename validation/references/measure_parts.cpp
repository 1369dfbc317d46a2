// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Reading events off recorded frames.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/roots.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {

std::optional<double> upwardCrossing(const Trajectory& trajectory, std::size_t from,
                                     const std::function<double(std::size_t)>& f,
                                     const std::function<double(std::size_t)>& slope) {
    for (std::size_t k = from; k + 1 < trajectory.frames(); ++k) {
        const double f0 = f(k), f1 = f(k + 1);
        if (!(f0 < 0.0 && f1 >= 0.0)) continue;
        const double step = trajectory.times[k + 1] - trajectory.times[k];
        const double m0 = slope(k) * step, m1 = slope(k + 1) * step;
        if (!std::isfinite(m0) || !std::isfinite(m1)) return std::nullopt;
        const auto hermite = [&](numerics::Real s) {
            const numerics::Real s2 = s * s, s3 = s2 * s;
            return (2 * s3 - 3 * s2 + 1) * f0 + (s3 - 2 * s2 + s) * m0 + (3 * s2 - 2 * s3) * f1 +
                   (s3 - s2) * m1;
        };
        return trajectory.times[k] + step * static_cast<double>(numerics::findRoot(hermite, 0, 1));
    }
    return std::nullopt;
}

std::optional<double> timeBetweenCrossings(const Trajectory& trajectory,
                                           const std::function<double(std::size_t)>& f,
                                           const std::function<double(std::size_t)>& slope) {
    std::optional<double> before;
    for (std::size_t k = 0; k + 1 < trajectory.frames(); ++k) {
        if (!(f(k) < 0.0 && f(k + 1) >= 0.0)) continue;
        const auto time = upwardCrossing(trajectory, k, f, slope);
        if (time && before) return *time - *before;
        before = time;
    }
    return std::nullopt;
}

std::optional<double> extrapolatedStop(const Trajectory& trajectory, double start,
                                       const std::function<double(std::size_t)>& speed) {
    for (std::size_t k = 0; k < trajectory.frames(); ++k) {
        if (!(speed(k) < 0.05 * start)) continue;
        if (k == 0) return 0.0;
        // Two frames before the fall; with only one, the two around it, which is a lower bound.
        const std::size_t b = k >= 2 ? k - 1 : k, a = b - 1;
        const double rate = (speed(a) - speed(b)) / (trajectory.times[b] - trajectory.times[a]);
        if (!(rate > 0.0)) return trajectory.times[k];
        return trajectory.times[b] + speed(b) / rate;
    }
    return std::nullopt;
}

std::optional<std::size_t> lastFrameBefore(const Trajectory& trajectory, double t) {
    const double limit = t + 1e-9 * std::max(trajectory.dt, std::abs(t));
    const auto after = std::upper_bound(trajectory.times.begin(), trajectory.times.end(), limit);
    const auto count = static_cast<std::size_t>(after - trajectory.times.begin());
    if (count < 2) return std::nullopt;
    return count - 1;
}

}  // namespace rigor::validation
