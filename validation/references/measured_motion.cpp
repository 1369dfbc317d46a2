// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The motion of one or more real bodies as it was recorded: the third kind of solution, neither exact nor
// scheme-exact. Its numbers are the recording, so they stand in the scenario itself: `times` [s], rising from
// 0; `positions` of the body frame [m], `orientations`, quaternions w x y z (3D), or `angles` [rad] (2D).
// Either positions or orientations may be missing: encoders at joints measure angles alone. With several
// bodies (`bodies`) each sample holds the values of all of them, in the order of the list. At the samples the
// recorded pose comes back bit for bit; between them
//   x(t) = (1 - u) x_k + u x_(k+1),  q(t) = slerp(q_k, q_(k+1), u) along the shorter way.
// Linear, because a spline overshoots at impacts; in free flight it cuts the corner by g dt^2/8.
// Source: Shoemake, Computer Graphics 19 (1985) 245.
// Assumes: the scenario starts where the recording does.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

constexpr double kUnitTolerance = 1e-3;  // tolerance of |q|: rounding to six digits, with some head-room
constexpr double kStartTolerance =
    0.05;  // tolerance relative to the body's size, and in rad, of a fitted start against a recorded one
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

/// Every `stride`-th group of `each` numbers from group `first` on: the samples of one body.
std::vector<double> ofBody(const std::vector<double>& flat, std::size_t first, std::size_t stride,
                           std::size_t each) {
    std::vector<double> own;
    for (std::size_t begin = first * each; begin < flat.size(); begin += stride * each)
        own.insert(own.end(), flat.begin() + begin, flat.begin() + (begin + each));
    return own;
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

std::vector<Vec3> toPositions(const std::vector<double>& flat, int dimension) {
    const auto each = static_cast<std::size_t>(dimension);
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < flat.size(); i += each)
        positions.push_back({flat[i], flat[i + 1], dimension == 3 ? flat[i + 2] : 0.0});
    return positions;
}

/// Unit quaternions, neighbours on the same half of the sphere.
std::vector<Quat> toOrientations(const std::vector<double>& flat, int dimension) {
    std::vector<Quat> orientations;
    const std::size_t each = dimension == 3 ? 4 : 1;
    for (std::size_t i = 0; i < flat.size(); i += each) {
        const double* v = flat.data() + i;
        Quat q = dimension == 3 ? Quat{v[0], v[1], v[2], v[3]} : scenario::fromAxisAngle({0, 0, 1}, v[0]);
        if (!(std::abs(norm(q) - 1.0) <= kUnitTolerance))
            bad("orientations", "found a quaternion of length " + std::to_string(norm(q)) + " as number " +
                                    std::to_string(i / each) + ", expected 1");
        q = normalized(q);
        if (!orientations.empty()) {
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

/// The recorded poses of one body.
struct Track {
    int body = 0;
    std::vector<Vec3> positions;     ///< one per sample; none: not recorded
    std::vector<Quat> orientations;  ///< one per sample; none: not recorded
};

std::vector<Track> readTracks(const ReferenceSpec& spec, const std::vector<int>& bodies, std::size_t samples,
                              int dimension) {
    const char* attitude = dimension == 3 ? "orientations" : "angles";
    const char* other = dimension == 3 ? "angles" : "orientations";
    if (spec.parameters.count(other) > 0)
        bad(other, std::string("expected ") + attitude + " in this dimension");
    const std::vector<double> places = numbers(spec, "positions");
    const std::vector<double> turns = numbers(spec, attitude);
    const auto perPlace = static_cast<std::size_t>(dimension);
    const std::size_t perTurn = dimension == 3 ? 4 : 1;
    if (turns.empty() || !places.empty())
        requireCount("positions", places.size(), samples, perPlace * bodies.size());
    if (!turns.empty()) requireCount(attitude, turns.size(), samples, perTurn * bodies.size());
    std::vector<Track> tracks;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        tracks.push_back({bodies[i], toPositions(ofBody(places, i, bodies.size(), perPlace), dimension),
                          toOrientations(ofBody(turns, i, bodies.size(), perTurn), dimension)});
    return tracks;
}

class MeasuredMotion : public Reference {
  public:
    MeasuredMotion(const Scenario& scenario, std::vector<int> bodies, const ReferenceSpec& spec)
        : bodies_(std::move(bodies)),
          times_(readTimes(spec)),
          tracks_(readTracks(spec, bodies_, times_.size(), scenario.dimension)) {
        for (const Track& track : tracks_) requireStart(scenario, track);
    }

    std::vector<int> bodies() const override { return bodies_; }
    double validUntil() const override { return times_.back() + kTimeTolerance; }

    std::optional<PartialState> measured(int body, double t) const override {
        const auto it =
            std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& x) { return x.body == body; });
        if (it == tracks_.end()) return std::nullopt;
        const std::size_t last = times_.size() - 1;
        const auto next = std::upper_bound(times_.begin(), times_.end(), t);
        const auto k =
            std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - times_.begin(), 1)) - 1, last);
        const double u = k == last ? 0.0 : std::max(0.0, (t - times_[k]) / (times_[k + 1] - times_[k]));
        PartialState state;
        if (const auto& p = it->positions; !p.empty())
            state.position = u > 0.0 ? (1.0 - u) * p[k] + u * p[k + 1] : p[k];
        if (const auto& q = it->orientations; !q.empty())
            state.orientation = u > 0.0 ? slerp(q[k], q[k + 1], u) : q[k];
        return state;
    }

  private:
    static void requireStart(const Scenario& scenario, const Track& track) {
        const Body& body = scenario.bodies[track.body];
        if (!track.positions.empty())
            require(norm(body.pose.position - track.positions[0]) <= kStartTolerance * sizeOf(body),
                    bodyTitle(scenario, track.body) + " starts at " +
                        shown(body.pose.position, scenario.dimension) + ", its recording at " +
                        shown(track.positions[0], scenario.dimension));
        if (track.orientations.empty()) return;
        const Quat turn = conjugate(body.pose.orientation) * track.orientations[0];
        require(2.0 * std::atan2(norm(Vec3{turn.x, turn.y, turn.z}), std::abs(turn.w)) <= kStartTolerance,
                bodyTitle(scenario, track.body) + " starts in another attitude than its recording");
    }

    std::vector<int> bodies_;
    std::vector<double> times_;
    std::vector<Track> tracks_;
};

}  // namespace

std::unique_ptr<Reference> makeMeasuredMotion(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "bodies", "times", "positions", "orientations", "angles"});
    const bool several = spec.parameters.count("bodies") > 0;
    if (several && spec.parameters.count("body") > 0)
        bad("body", "found beside bodies, expected one of them");
    std::vector<int> bodies =
        several ? parts.dynamicBodies("bodies") : std::vector<int>{parts.dynamicBody("body")};
    return std::make_unique<MeasuredMotion>(scenario, std::move(bodies), spec);
}

}  // namespace rigor::validation
