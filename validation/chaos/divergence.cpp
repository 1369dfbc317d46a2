// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/chaos/divergence.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <set>
#include <stdexcept>

#include "validation/metrics/mechanics.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using scenario::BodyType;
using scenario::Scenario;
using scenario::Vec3;

/// Largest distance between bodies and anchors at the start.
double spreadOf(const Scenario& s) {
    std::vector<Vec3> points;
    for (const auto& b : s.bodies)
        if (b.type != BodyType::Static) points.push_back(b.pose.position);
    for (const auto& j : s.joints) {
        const auto pose = j.bodyB == scenario::kNone ? scenario::Pose{} : s.bodies[j.bodyB].pose;
        points.push_back(pose * j.anchorB);
    }
    double most = 0.0;
    for (const Vec3& p : points)
        for (const Vec3& q : points) most = std::max(most, norm(p - q));
    return most;
}

using Pairs = std::set<std::pair<int, int>>;

Pairs touching(const Trajectory& t, std::size_t frame) {
    Pairs pairs;
    if (frame < t.contacts.size())
        for (const ContactPoint& c : t.contacts[frame])
            if (c.hasImpulse ? c.normalImpulse > 0.0 : c.depth >= 0.0)
                pairs.insert({std::min(c.bodyA, c.bodyB), std::max(c.bodyA, c.bodyB)});
    return pairs;
}

/// A pair of `one` that `other` has in none of the frames around.
std::optional<std::pair<int, int>> missing(const Pairs& one, const std::vector<Pairs>& other,
                                           std::size_t frame) {
    for (const auto& pair : one) {
        bool found = false;
        const std::size_t last = std::min(frame + 1, other.size() - 1);
        for (std::size_t f = frame > 0 ? frame - 1 : 0; f <= last; ++f) found |= other[f].contains(pair);
        if (!found) return pair;
    }
    return std::nullopt;
}

std::optional<ContactSplit> firstSplit(const Trajectory& a, const Trajectory& b, std::size_t frames,
                                       std::size_t stride) {
    std::vector<double> times;
    std::vector<Pairs> inA, inB;
    for (std::size_t f = 0; f + 1 < frames; f += stride) {  // no step begins at the last frame
        times.push_back(a.times[f]);
        inA.push_back(touching(a, f));
        inB.push_back(touching(b, f));
    }
    // The last frame has no later one to excuse it.
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        if (const auto pair = missing(inA[k], inB, k))
            return ContactSplit{times[k], pair->first, pair->second, true};
        if (const auto pair = missing(inB[k], inA, k))
            return ContactSplit{times[k], pair->first, pair->second, false};
    }
    return std::nullopt;
}

}  // namespace

double sceneLength(const Scenario& s) {
    std::vector<double> sizes;
    for (const auto& b : s.bodies)
        if (b.type == BodyType::Dynamic && !b.shapes.empty()) sizes.push_back(2.0 * reachOf(b));
    return std::max(1e-6, sizes.empty() ? spreadOf(s) : median(sizes));
}

std::optional<Growth> growthOf(const std::vector<double>& times, const std::vector<double>& values) {
    const std::size_t n = times.size();
    if (n < 3 || values.size() != n) return std::nullopt;
    const double count = n;
    double meanX = 0.0, meanY = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        meanX += times[i] / count;
        meanY += std::log(values[i]) / count;
    }
    double sxx = 0.0, sxy = 0.0, syy = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = times[i] - meanX, y = std::log(values[i]) - meanY;
        sxx += x * x;
        sxy += x * y;
        syy += y * y;
    }
    if (!(sxx > 0.0) || !std::isfinite(sxy)) return std::nullopt;
    Growth g;
    g.rate = sxy / sxx;
    g.from = times.front();
    g.until = times.back();
    g.points = n;
    const double left = std::max(0.0, syy - g.rate * sxy) / (count - 2.0);
    const boost::math::students_t distribution(count - 2.0);
    const double half = boost::math::quantile(distribution, 0.975) * std::sqrt(left / sxx);
    g.low = g.rate - half;
    g.high = g.rate + half;
    return g;
}

Divergence divergenceOf(const Scenario& scenario, const Trajectory& a, const Trajectory& b,
                        const DivergenceOptions& options) {
    const std::size_t frames = std::min(a.frames(), b.frames());
    if (a.bodyCount != scenario.bodies.size() || b.bodyCount != a.bodyCount || frames < 2 ||
        std::abs(a.times[frames - 1] - b.times[frames - 1]) > 1e-6 * a.dt)
        throw std::invalid_argument("runs of other bodies, or recorded at other times");
    Divergence d;
    d.length = sceneLength(scenario);
    std::vector<double> times, distances;
    for (std::size_t f = 0; f < frames; ++f) {
        double largest = 0.0, sum = 0.0;
        int farthest = scenario::kNone;
        for (int i = 0; i < static_cast<int>(a.bodyCount); ++i) {
            if (scenario.bodies[i].type != BodyType::Dynamic) continue;
            const double distance = norm(a.state(f, i).position - b.state(f, i).position);
            sum += distance * distance;
            if (distance > largest) {
                largest = distance;
                farthest = i;
            }
        }
        d.largest = std::max(d.largest, largest);
        if (!d.divergenceTime && sum > 0.0) {
            times.push_back(a.times[f]);
            distances.push_back(std::sqrt(sum));
        }
        if (!d.divergenceTime && largest > options.threshold * d.length) {
            d.divergenceTime = a.times[f];
            d.body = farthest;
        }
    }
    constexpr std::size_t kFewest = 10;
    if (times.size() >= kFewest && distances.back() >= 10.0 * distances.front())
        d.growth = growthOf(times, distances);
    const auto stride = static_cast<std::size_t>(std::max(options.contactStrideA, options.contactStrideB));
    d.split = firstSplit(a, b, frames, stride);
    return d;
}

}  // namespace rigor::validation
