// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/order.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace rigor::validation {
namespace {

struct DescendingPoints {
    std::vector<RefinementPoint> points;  ///< points from fine to coarse
    int roundOff = 0, flat = 0;
};

/// Drops what is no number, round-off, and the fine end where errors grow or stay as dt shrinks.
DescendingPoints keepDescending(std::vector<RefinementPoint> refinement, double roundOff) {
    std::erase_if(refinement,
                  [](const RefinementPoint& p) { return !(p.dt > 0.0) || !std::isfinite(p.error); });
    std::sort(refinement.begin(), refinement.end(),
              [](const RefinementPoint& a, const RefinementPoint& b) { return a.dt < b.dt; });
    DescendingPoints kept;
    const auto isNoise = [&](const RefinementPoint& p) { return p.error <= roundOff; };
    kept.roundOff = std::count_if(refinement.begin(), refinement.end(), isNoise);
    std::erase_if(refinement, isNoise);
    // The least error ends the descent; what lies below it in dt has left the power law.
    const auto least = std::min_element(
        refinement.begin(), refinement.end(),
        [](const RefinementPoint& a, const RefinementPoint& b) { return a.error < b.error; });
    if (refinement.end() - least >= 3) {
        kept.flat = least - refinement.begin();
        refinement.erase(refinement.begin(), least);
    }
    kept.points = std::move(refinement);
    return kept;
}

std::string noteOf(const DescendingPoints& kept) {
    std::string note;
    if (kept.roundOff > 0) note = std::to_string(kept.roundOff) + " at round-off";
    if (kept.flat > 0)
        note += (note.empty() ? "" : ", ") + std::to_string(kept.flat) + " no longer shrinking";
    return note.empty() ? "" : "left out: " + note;
}

}  // namespace

std::optional<ObservedOrder> observedOrder(std::vector<RefinementPoint> refinement, double roundOff) {
    const DescendingPoints kept = keepDescending(std::move(refinement), roundOff);
    const auto n = kept.points.size();
    if (n < 2) return std::nullopt;
    double meanX = 0.0, meanY = 0.0;
    for (const auto& p : kept.points) {
        meanX += std::log(p.dt) / n;
        meanY += std::log(p.error) / n;
    }
    double sxx = 0.0, sxy = 0.0;
    for (const auto& p : kept.points) {
        const double x = std::log(p.dt) - meanX;
        sxx += x * x;
        sxy += x * (std::log(p.error) - meanY);
    }
    if (sxx <= 0.0) return std::nullopt;  // one time step, several times

    ObservedOrder fit;
    fit.order = sxy / sxx;
    fit.points = n;
    fit.finest = kept.points.front().dt;
    fit.coarsest = kept.points.back().dt;
    fit.note = noteOf(kept);
    if (n < 3) return fit;
    double squares = 0.0;
    for (const auto& p : kept.points) {
        const double residual = std::log(p.error) - meanY - fit.order * (std::log(p.dt) - meanX);
        squares += residual * residual;
    }
    const auto freedom = static_cast<double>(n - 2);
    const boost::math::students_t distribution(freedom);
    const double half = boost::math::quantile(distribution, 0.975) * std::sqrt(squares / freedom / sxx);
    fit.low = fit.order - half;
    fit.high = fit.order + half;
    return fit;
}

}  // namespace rigor::validation
