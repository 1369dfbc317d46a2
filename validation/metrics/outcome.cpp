// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Outcome of a scene without a reference: numbers of a heap that depend on every impact before, so that one
// run of them is neither right nor wrong. Engines can agree on their distribution over many starts.
// Quantities as in Radjai and Dubois (eds.), Discrete-element Modeling of Granular Materials, 2011, ch. 8.
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/metrics/energy.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

bool isHeap(const MetricInput& input) {
    const Scenario& s = input.scenario;
    if (input.reference != nullptr || s.reference || norm(s.gravity) == 0.0 || input.trajectory.frames() < 2)
        return false;
    std::vector<int> dynamic;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
        if (isDynamic(s, i) && !s.bodies[i].shapes.empty()) dynamic.push_back(i);
    if (dynamic.size() < 3) return false;
    for (const int a : dynamic)
        for (const int b : dynamic)
            if (a < b && mayCollide(s, a, b)) return true;
    return false;
}

/// Largest coordinate of a shape along the unit direction u of its frame, from its origin [m].
struct Reach {
    Vec3 u;
    double across(double along) const { return std::sqrt(std::max(0.0, 1.0 - along * along)); }
    double operator()(const Sphere& g) const { return g.radius; }
    double operator()(const Box& g) const {
        return std::abs(u.x) * g.halfExtents.x + std::abs(u.y) * g.halfExtents.y +
               std::abs(u.z) * g.halfExtents.z;
    }
    double operator()(const Ellipsoid& g) const {
        return norm(Vec3{u.x * g.halfAxes.x, u.y * g.halfAxes.y, u.z * g.halfAxes.z});
    }
    double operator()(const Capsule& g) const { return g.radius + std::abs(u.y) * g.halfLength; }
    double operator()(const Cylinder& g) const {
        return std::abs(u.y) * g.halfLength + across(u.y) * g.radius;
    }
    double operator()(const Cone& g) const {
        return std::max(u.y * g.halfLength, across(u.y) * g.radius - u.y * g.halfLength);
    }
    double operator()(const ConvexHull& g) const {
        double most = -std::numeric_limits<double>::infinity();
        for (const Vec3& v : g.vertices) most = std::max(most, dot(u, v));
        return most;
    }
    template <class StaticOnly>
    double operator()(const StaticOnly&) const {
        return 0.0;
    }
};

/// Farthest point of a body along a world direction [m].
double farthest(const Body& body, const BodyState& state, const Vec3& direction) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Shape& shape : body.shapes) {
        const Pose X = Pose{state.position, state.orientation} * shape.pose;
        const Vec3 u = rotateInverse(X.orientation, direction);
        most = std::max(most, dot(direction, X.position) + std::visit(Reach{u}, shape.geometry));
    }
    return most;
}

template <class Visit>
void eachDynamic(const MetricInput& input, std::size_t frame, Visit visit) {
    for (int i = 0; i < static_cast<int>(input.scenario.bodies.size()); ++i)
        if (isDynamic(input.scenario, i)) visit(input.scenario.bodies[i], input.trajectory.state(frame, i));
}

bool isSettled(const MetricInput& input, std::size_t frame) {
    constexpr double kSlow = 0.05;  // fraction of the speed after a fall by the body's own size
    bool settled = true;
    eachDynamic(input, frame, [&](const Body& body, const BodyState& state) {
        const double R = reachOf(body);
        const double speed = norm(state.velocity) + norm(state.angularVelocity) * R;
        if (!(speed <= kSlow * std::sqrt(2.0 * norm(input.scenario.gravity) * R))) settled = false;
    });
    return settled;
}

}  // namespace

std::vector<MetricValue> pileHeight(const MetricInput& input) {
    if (!isHeap(input)) return {};
    const Vec3 up = -input.scenario.gravity / norm(input.scenario.gravity);
    double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
    eachDynamic(input, input.trajectory.frames() - 1, [&](const Body& body, const BodyState& state) {
        if (body.shapes.empty()) return;
        highest = std::max(highest, farthest(body, state, up));
        lowest = std::min(lowest, -farthest(body, state, -up));
    });
    return {{"", highest - lowest, input.trajectory.times.back()}};
}

std::vector<MetricValue> spreadRadius(const MetricInput& input) {
    if (!isHeap(input)) return {};
    const Vec3 up = -input.scenario.gravity / norm(input.scenario.gravity);
    std::vector<Vec3> places;
    Vec3 mean;
    eachDynamic(input, input.trajectory.frames() - 1, [&](const Body& body, const BodyState& state) {
        const Vec3 x = centerOfMassOf(body, state);
        places.push_back(x - dot(up, x) * up);
        mean += places.back();
    });
    mean = mean / places.size();
    double sum = 0.0;
    for (const Vec3& x : places) sum += dot(x - mean, x - mean);
    return {{"", std::sqrt(sum / places.size()), input.trajectory.times.back()}};
}

std::vector<MetricValue> settlingTime(const MetricInput& input) {
    if (!isHeap(input)) return {};
    for (std::size_t k = input.trajectory.frames(); k-- > 0;)
        if (!isSettled(input, k)) return {{"", input.trajectory.times[k], input.trajectory.times[k]}};
    return {{"", 0.0, 0.0}};
}

std::vector<MetricValue> dissipatedEnergy(const MetricInput& input) {
    if (!isHeap(input) || !isPassive(input.scenario)) return {};
    const Trajectory& run = input.trajectory;
    const auto energy = [&](std::size_t frame) {
        return mechanicsOf(input.scenario, run.frame(frame)).energy();
    };
    return {{"", energy(0) - energy(run.frames() - 1), run.times.back()}};
}

}  // namespace rigor::validation
