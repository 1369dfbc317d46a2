// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts: penetration as the engine reports it, overlap as the poses show it, normals against closed forms.
// Source: Ericson, Real-Time Collision Detection, 2005, chapter 5.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "validation/metrics/closed_forms.hpp"
#include "validation/metrics/metric_parts.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

bool anyContactPossible(const Scenario& scenario) {
    const int count = scenario.bodies.size();
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b)
            if (mayCollide(scenario, a, b)) return true;
    return false;
}

std::vector<MetricValue> bodyRows(const MetricInput& input, const std::map<int, Worst>& worst) {
    std::vector<MetricValue> rows;
    for (const auto& [body, value] : worst) rows.push_back(value.row(bodyName(input, body)));
    return withWorst(std::move(rows));
}

Pose poseOf(const BodyState& state, const Shape& shape) {
    return Pose{state.position, state.orientation} * shape.pose;
}

std::optional<PairGeometry> exactPair(const MetricInput& input, const ContactPoint& contact,
                                      std::size_t frame) {
    const auto shapeOf = [&](int body, int shape) -> const Shape* {
        if (body < 0 || static_cast<std::size_t>(body) >= input.scenario.bodies.size()) return nullptr;
        const auto& shapes = input.scenario.bodies[body].shapes;
        return shape >= 0 && static_cast<std::size_t>(shape) < shapes.size() ? &shapes[shape] : nullptr;
    };
    const Shape *a = shapeOf(contact.bodyA, contact.shapeA), *b = shapeOf(contact.bodyB, contact.shapeB);
    if (!a || !b) return std::nullopt;
    return closedFormPair(a->geometry, poseOf(input.trajectory.state(frame, contact.bodyA), *a), b->geometry,
                          poseOf(input.trajectory.state(frame, contact.bodyB), *b), input.scenario.dimension);
}

/// Engines that do not report which shape touched give 0: only bodies of one shape are judged.
bool shapesAreKnown(const MetricInput& input, const ContactPoint& contact) {
    return input.scenario.bodies[contact.bodyA].shapes.size() == 1 &&
           input.scenario.bodies[contact.bodyB].shapes.size() == 1;
}

/// The median as the row of the whole scene; none of nothing.
std::vector<MetricValue> medianRow(std::vector<double> values) {
    if (values.empty()) return {};
    return {{"", median(std::move(values)), -1.0}};
}

/// Calls `look(contact, angle to the closed form's normal, time)` for every contact that has one.
template <class Look>
void overNormals(const MetricInput& input, Look&& look) {
    const int bodies = input.scenario.bodies.size();
    const std::size_t frames = std::min(input.trajectory.frames(), input.trajectory.contacts.size());
    for (std::size_t k = 0; k < frames; ++k)
        for (const auto& contact : input.trajectory.contacts[k]) {
            if (contact.bodyA < 0 || contact.bodyB < 0 || contact.bodyA >= bodies ||
                contact.bodyB >= bodies || !shapesAreKnown(input, contact))
                continue;
            if (const auto pair = exactPair(input, contact, k))
                look(contact, angleBetween(contact.normal, pair->normal), input.trajectory.times[k]);
        }
}

}  // namespace

std::vector<MetricValue> penetrationMax(const MetricInput& input) {
    if (input.trajectory.frames() < 2 || !anyContactPossible(input.scenario)) return {};
    std::map<int, Worst> worst;
    for (const int body : observedDynamic(input)) worst[body].add(0.0, -1.0);
    const std::size_t frames = std::min(input.trajectory.frames(), input.trajectory.contacts.size());
    Worst all;
    all.add(0.0, -1.0);
    for (std::size_t k = 0; k < frames; ++k)
        for (const auto& contact : input.trajectory.contacts[k]) {
            all.add(contact.depth, input.trajectory.times[k]);
            for (const int body : {contact.bodyA, contact.bodyB})
                if (const auto it = worst.find(body); it != worst.end())
                    it->second.add(contact.depth, input.trajectory.times[k]);
        }
    auto rows = bodyRows(input, worst);
    if (rows.empty()) return {all.row("")};
    rows.front() = all.row("");
    return rows;
}

std::vector<MetricValue> overlapMax(const MetricInput& input) {
    const auto& bodies = input.scenario.bodies;
    const int count = bodies.size();
    std::map<int, Worst> worst;
    if (input.trajectory.frames() < 2) return {};
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b) {
            if (!mayCollide(input.scenario, a, b)) continue;
            for (const auto& sa : bodies[a].shapes)
                for (const auto& sb : bodies[b].shapes) {
                    if (!mayTouch(sa, sb)) continue;
                    for (std::size_t k = 0; k < input.trajectory.frames(); ++k) {
                        const auto pair = closedFormPair(
                            sa.geometry, poseOf(input.trajectory.state(k, a), sa), sb.geometry,
                            poseOf(input.trajectory.state(k, b), sb), input.scenario.dimension);
                        if (!pair) continue;
                        const double overlap = pair->distance > 0.0 ? 0.0 : -pair->distance;
                        for (const int body : {a, b})
                            if (isDynamic(input.scenario, body))
                                worst[body].add(overlap, input.trajectory.times[k]);
                    }
                }
        }
    return bodyRows(input, worst);
}

std::vector<MetricValue> normalError(const MetricInput& input) {
    std::map<int, Worst> worst;
    overNormals(input, [&](const ContactPoint& contact, double error, double time) {
        for (const int body : {contact.bodyA, contact.bodyB})
            if (isDynamic(input.scenario, body)) worst[body].add(error, time);
    });
    return bodyRows(input, worst);
}

std::vector<MetricValue> normalErrorMedian(const MetricInput& input) {
    std::vector<double> errors;
    overNormals(input, [&](const ContactPoint&, double error, double) {
        errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
    });
    return medianRow(std::move(errors));
}

std::vector<MetricValue> contactInconsistency(const MetricInput& input) {
    constexpr double kShallow = 1e-6;  // [m]
    std::vector<double> errors;
    for (const auto& contacts : input.trajectory.contacts)
        for (const ContactPoint& c : contacts) {
            if (std::abs(c.depth) < kShallow) continue;
            const double error = std::abs(dot(c.pointA - c.pointB, c.normal) - c.depth) / std::abs(c.depth);
            errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
        }
    return medianRow(std::move(errors));
}

}  // namespace rigor::validation
