// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Nature keeps no list. Solvers that go through one (projected Gauss-Seidel) give another result for another
// order wherever they are not iterated to the end.
#include <algorithm>
#include <random>

#include "validation/symmetry/listing.hpp"
#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr std::uint32_t kSeed = 43;

std::vector<int> placesOf(const Scenario& s, bool dynamic) {
    std::vector<int> places;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
        if ((s.bodies[i].type == BodyType::Dynamic) == dynamic) places.push_back(i);
    return places;
}

std::vector<int> reversedPlaces(const Scenario& s) {
    const std::vector<int> dynamic = placesOf(s, true), fixed = placesOf(s, false);
    std::vector<int> place(s.bodies.size());
    int next = 0;
    for (const int i : dynamic) place[i] = next++;
    for (auto it = fixed.rbegin(); it != fixed.rend(); ++it) place[*it] = next++;
    return place;
}

}  // namespace

std::string permutationObstacle(const Scenario& s) {
    return placesOf(s, true).size() < 2 ? "there is one dynamic body" : "";
}

Transformed permutation(const Scenario& scenario, const Trajectory*) {
    require(permutationObstacle(scenario));
    const std::vector<int> before = placesOf(scenario, true);
    std::vector<int> after = before;
    // Fisher and Yates with the engine alone: the distributions of the library differ between machines.
    std::mt19937 random(kSeed);
    for (std::size_t i = after.size() - 1; i > 0; --i) std::swap(after[i], after[random() % (i + 1)]);
    if (after == before) std::rotate(after.begin(), after.begin() + 1, after.end());
    Listing listing = asWritten(scenario);
    for (std::size_t i = 0; i < before.size(); ++i) listing.bodies[before[i]] = after[i];
    return listed(scenario, listing);
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
    Listing listing = reversed(scenario);
    listing.bodies = reversedPlaces(scenario);
    return listed(scenario, listing);
}

}  // namespace rigor::validation
