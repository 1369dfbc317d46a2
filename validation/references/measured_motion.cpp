// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The motion of a real body as it was recorded: the third kind of answer, neither exact nor scheme-exact. Its
// numbers are the recording, so they stand in the scenario itself: `times` [s], rising from 0; `positions` of
// the body frame [m], one vector after the other; and `orientations`, quaternions w x y z (3D), or `angles`
// [rad] (2D), where they were recorded. At the samples the recorded pose comes back bit for bit; between them
//   x(t) = (1 - u) x_k + u x_(k+1),  q(t) = slerp(q_k, q_(k+1), u) along the shorter way.
// Linear, because a spline overshoots at impacts; in free flight it cuts the corner by g dt^2/8.
// Source: Shoemake, Computer Graphics 19 (1985) 245.
// Assumes: the scenario starts where the recording does.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

constexpr double kUnitTolerance = 1e-3;  // of |q|: rounded to six digits and then some
constexpr double kStartTolerance =
    0.05;  // of the body's size, and in rad: a fitted start beside a recorded one
constexpr double kTimeTolerance = 1e-9;  // [s]: k dt and the recorded time round differently

using scenario::ReferenceSpec;

[[noreturn]] void bad(const std::string& key, const std::string& what) {
    throw std::invalid_argument("measured_motion: " + key + ": " + what);
}

std::vector<double> numbers(const ReferenceSpec& spec, const char* key) {
    const auto it = spec.parameters.find(key);
    if (it == spec.parameters.end()) return {};
    const auto* values = std::get_if<std::vector<double>>(&it->second);
    if (values == nullptr)
        bad(key, "found no list of numbers, expected one (the recording stands in the scenario)");
    return *values;
}

void requireCount(const char* key, std::size_t found, std::size_t samples, std::size_t each) {
    if (found != samples * each)
        bad(key, "found " + std::to_string(found) + " numbers, expected " + std::to_string(samples * each) +
                     ": " + std::to_string(each) + " for each of the " + std::to_string(samples) + " times");
}

std::vector<double> readTimes(const ReferenceSpec& spec) {
    std::vector<double> times = numbers(spec, "times");
    if (times.size() < 2)
        bad("times", "found " + std::to_string(times.size()) + " numbers, expected at least 2");
    if (times[0] != 0.0) bad("times", "found " + std::to_string(times[0]) + " first, expected 0");
    for (std::size_t k = 1; k < times.size(); ++k)
        if (!(times[k] > times[k - 1]))
            bad("times", "found " + std::to_string(times[k]) + " behind " + std::to_string(times[k - 1]) +
                             ", expected rising times");
    return times;
}

std::vector<Vec3> readPositions(const ReferenceSpec& spec, std::size_t samples, int dimension) {
    const std::vector<double> flat = numbers(spec, "positions");
    const auto each = static_cast<std::size_t>(dimension);
    requireCount("positions", flat.size(), samples, each);
    std::vector<Vec3> positions;
    for (std::size_t k = 0; k < samples; ++k)
        positions.push_back({flat[each * k], flat[each * k + 1], dimension == 3 ? flat[each * k + 2] : 0.0});
    return positions;
}

/// Unit quaternions, neighbours on the same half of the sphere; empty when none were recorded.
std::vector<Quat> readOrientations(const ReferenceSpec& spec, std::size_t samples, int dimension) {
    const char* key = dimension == 3 ? "orientations" : "angles";
    if (spec.parameters.count(dimension == 3 ? "angles" : "orientations") > 0)
        bad(dimension == 3 ? "angles" : "orientations",
            std::string("expected ") + key + " in this dimension");
    const std::vector<double> flat = numbers(spec, key);
    if (flat.empty()) return {};
    requireCount(key, flat.size(), samples, dimension == 3 ? 4 : 1);
    std::vector<Quat> orientations;
    for (std::size_t k = 0; k < samples; ++k) {
        const double* v = flat.data() + (dimension == 3 ? 4 * k : k);
        Quat q = dimension == 3 ? Quat{v[0], v[1], v[2], v[3]} : scenario::fromAxisAngle({0, 0, 1}, v[0]);
        if (!(std::abs(norm(q) - 1.0) <= kUnitTolerance))
            bad(key, "found a quaternion of length " + std::to_string(norm(q)) + " as number " +
                         std::to_string(k) + ", expected 1");
        q = normalized(q);
        if (k > 0) {
            const Quat& p = orientations.back();
            if (p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
        }
        orientations.push_back(q);
    }
    return orientations;
}

Quat slerp(const Quat& a, const Quat& b, double u) {
    const Quat turn = conjugate(a) * b;
    const Vec3 axis{turn.x, turn.y, turn.z};
    const double sine = norm(axis);
    if (sine == 0.0) return a;
    return normalized(a * scenario::fromAxisAngle(axis / sine, u * 2.0 * std::atan2(sine, turn.w)));
}

class MeasuredMotion : public Reference {
  public:
    MeasuredMotion(const Scenario& scenario, int body, const ReferenceSpec& spec)
        : body_(body),
          times_(readTimes(spec)),
          positions_(readPositions(spec, times_.size(), scenario.dimension)),
          orientations_(readOrientations(spec, times_.size(), scenario.dimension)) {
        const Body& cast = scenario.bodies[static_cast<std::size_t>(body)];
        require(norm(cast.pose.position - positions_[0]) <= kStartTolerance * sizeOf(cast),
                bodyTitle(scenario, body) + " starts at " + shown(cast.pose.position, scenario.dimension) +
                    ", its recording at " + shown(positions_[0], scenario.dimension));
        if (orientations_.empty()) return;
        const Quat turn = conjugate(cast.pose.orientation) * orientations_[0];
        require(2.0 * std::atan2(norm(Vec3{turn.x, turn.y, turn.z}), std::abs(turn.w)) <= kStartTolerance,
                bodyTitle(scenario, body) + " starts in another attitude than its recording");
    }

    std::vector<int> bodies() const override { return {body_}; }
    double validUntil() const override { return times_.back() + kTimeTolerance; }

    std::optional<PartialState> measured(int, double t) const override {
        const std::size_t last = times_.size() - 1;
        const auto next = std::upper_bound(times_.begin(), times_.end(), t);
        const auto k =
            std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - times_.begin(), 1)) - 1, last);
        const double u = k == last ? 0.0 : std::max(0.0, (t - times_[k]) / (times_[k + 1] - times_[k]));
        PartialState state;
        state.position = u > 0.0 ? (1.0 - u) * positions_[k] + u * positions_[k + 1] : positions_[k];
        if (!orientations_.empty())
            state.orientation = u > 0.0 ? slerp(orientations_[k], orientations_[k + 1], u) : orientations_[k];
        return state;
    }

  private:
    int body_;
    std::vector<double> times_;
    std::vector<Vec3> positions_;
    std::vector<Quat> orientations_;
};

}  // namespace

std::unique_ptr<Reference> makeMeasuredMotion(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "times", "positions", "orientations", "angles"});
    return std::make_unique<MeasuredMotion>(scenario, parts.dynamicBody("body"), spec);
}

}  // namespace rigor::validation
