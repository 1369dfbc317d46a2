// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Nature keeps no list. Solvers that go through one (projected Gauss-Seidel) give another answer for another
// order wherever they are not iterated to the end.
#include <algorithm>
#include <random>

#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr std::uint32_t kSeed = 43;

std::vector<int> placesOf(const Scenario& s, bool dynamic) {
    std::vector<int> places;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
        if ((s.bodies[static_cast<std::size_t>(i)].type == BodyType::Dynamic) == dynamic) places.push_back(i);
    return places;
}

/// `place[i]`: where body i goes.
void moveBodies(Scenario& s, const std::vector<int>& place) {
    const auto to = [&](int& body) {
        if (body != kNone) body = place[static_cast<std::size_t>(body)];
    };
    std::vector<Body> bodies(s.bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        bodies[static_cast<std::size_t>(place[i])] = std::move(s.bodies[i]);
    s.bodies = std::move(bodies);
    for (Joint& j : s.joints) to(j.bodyA), to(j.bodyB);
    for (Force& force : s.forces) {
        if (auto* f = std::get_if<ConstantForce>(&force)) to(f->body);
        if (auto* f = std::get_if<DragForce>(&force)) to(f->body);
        if (auto* f = std::get_if<SpringForce>(&force)) to(f->bodyA), to(f->bodyB);
    }
    for (Event& e : s.events) to(e.body);
    for (int& body : s.observed) to(body);
}

std::vector<int> reversedPlaces(const Scenario& s) {
    const std::vector<int> dynamic = placesOf(s, true), fixed = placesOf(s, false);
    std::vector<int> place(s.bodies.size());
    int next = 0;
    for (const int i : dynamic) place[static_cast<std::size_t>(i)] = next++;
    for (auto it = fixed.rbegin(); it != fixed.rend(); ++it) place[static_cast<std::size_t>(*it)] = next++;
    return place;
}

}  // namespace

std::string permutationObstacle(const Scenario& s) {
    return placesOf(s, true).size() < 2 ? "there is one dynamic body" : "";
}

Transformed permutation(const Scenario& scenario, const Trajectory*) {
    require(permutationObstacle(scenario));
    Scenario s = bare(scenario);
    const std::vector<int> before = placesOf(s, true);
    std::vector<int> after = before;
    // Fisher and Yates with the engine alone: the distributions of the library differ between machines.
    std::mt19937 random(kSeed);
    for (std::size_t i = after.size() - 1; i > 0; --i) std::swap(after[i], after[random() % (i + 1)]);
    if (after == before) std::rotate(after.begin(), after.begin() + 1, after.end());
    std::vector<int> place(s.bodies.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<int>(i);
    for (std::size_t i = 0; i < before.size(); ++i) place[static_cast<std::size_t>(before[i])] = after[i];
    moveBodies(s, place);
    return {s, 1.0, [place](const Trajectory& t) { return reordered(t, place); }};
}

std::string insertionOrderObstacle(const Scenario& s) {
    const std::vector<int> fixed = placesOf(s, false);
    const bool shapes =
        std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.shapes.size() > 1; });
    if (!fixed.empty() || shapes || s.joints.size() > 1 || s.forces.size() > 1) return "";
    return "there is nothing but dynamic bodies of one shape";
}

Transformed insertionOrder(const Scenario& scenario, const Trajectory*) {
    require(insertionOrderObstacle(scenario));
    Scenario s = bare(scenario);
    const std::vector<int> place = reversedPlaces(s);
    moveBodies(s, place);
    std::reverse(s.joints.begin(), s.joints.end());
    std::reverse(s.forces.begin(), s.forces.end());
    std::vector<int> shapes;
    for (Body& b : s.bodies) {
        std::reverse(b.shapes.begin(), b.shapes.end());
        shapes.push_back(static_cast<int>(b.shapes.size()));
    }
    return {s, 1.0, [place, shapes](const Trajectory& t) {
                return reordered(mapped(
                                     t, [](const BodyState& b, double) { return b; },
                                     [&](ContactPoint c, double) {
                                         c.shapeA = shapes[static_cast<std::size_t>(c.bodyA)] - 1 - c.shapeA;
                                         c.shapeB = shapes[static_cast<std::size_t>(c.bodyB)] - 1 - c.shapeB;
                                         return c;
                                     }),
                                 place);
            }};
}

}  // namespace rigor::validation
