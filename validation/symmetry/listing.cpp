// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/symmetry/listing.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "validation/symmetry/transforms.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

std::vector<int> identity(std::size_t size) {
    std::vector<int> places(size);
    std::iota(places.begin(), places.end(), 0);
    return places;
}

template <class Change>
Listing changed(const Scenario& s, Change change) {
    Listing listing = asWritten(s);
    change(listing.bodies);
    for (auto& shapes : listing.shapes) change(shapes);
    change(listing.joints);
    change(listing.forces);
    return listing;
}

template <class T>
void moveTo(std::vector<T>& list, const std::vector<int>& places) {
    std::vector<T> moved(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) moved[places[i]] = std::move(list[i]);
    list = std::move(moved);
}

std::vector<int> inverse(const std::vector<int>& places) {
    std::vector<int> at(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) at[places[i]] = i;
    return at;
}

/// Whatever names a body by its index names it by its new one.
void renameBodies(Scenario& s, const std::vector<int>& places) {
    const auto rename = [&](int& body) {
        if (body != kNone) body = places[body];
    };
    for (Joint& j : s.joints) {
        rename(j.bodyA);
        rename(j.bodyB);
    }
    for (Force& force : s.forces) {
        if (auto* f = std::get_if<ConstantForce>(&force)) rename(f->body);
        if (auto* f = std::get_if<DragForce>(&force)) rename(f->body);
        if (auto* f = std::get_if<SpringForce>(&force)) {
            rename(f->bodyA);
            rename(f->bodyB);
        }
    }
    for (Event& e : s.events) rename(e.body);
    for (int& body : s.observed) rename(body);
}

}  // namespace

Listing asWritten(const Scenario& s) {
    Listing listing{identity(s.bodies.size()), identity(s.joints.size()), identity(s.forces.size()), {}};
    for (const Body& b : s.bodies) listing.shapes.push_back(identity(b.shapes.size()));
    return listing;
}

Listing reversed(const Scenario& s) {
    return changed(s, [](std::vector<int>& places) { std::reverse(places.begin(), places.end()); });
}

Listing shuffled(const Scenario& s, std::uint32_t seed) {
    std::mt19937 random(seed);
    return changed(s, [&](std::vector<int>& places) {
        // Uses the random engine alone: the distributions of the library differ between machines.
        for (std::size_t i = places.size(); i-- > 1;) std::swap(places[i], places[random() % (i + 1)]);
    });
}

std::size_t listingCount(const Scenario& s, std::size_t most) {
    std::size_t count = 1;
    changed(s, [&](const std::vector<int>& places) {
        for (std::size_t i = 2; i <= places.size(); ++i) count = std::min(count * i, most);
    });
    return std::min(count, most);
}

std::vector<Listing> otherListings(const Scenario& s, std::size_t count) {
    const std::size_t others = listingCount(s, count + 1) - 1;
    std::vector<Listing> found{asWritten(s)};
    const auto add = [&](Listing listing) {
        if (std::find(found.begin(), found.end(), listing) == found.end())
            found.push_back(std::move(listing));
    };
    if (others > 0) add(reversed(s));
    for (std::uint32_t seed = 1; found.size() < others + 1; ++seed) add(shuffled(s, seed));
    found.erase(found.begin());
    return found;
}

Transformed listed(const Scenario& scenario, const Listing& listing) {
    Scenario s = bare(scenario);
    for (std::size_t i = 0; i < s.bodies.size(); ++i) moveTo(s.bodies[i].shapes, listing.shapes[i]);
    moveTo(s.bodies, listing.bodies);
    moveTo(s.joints, listing.joints);
    moveTo(s.forces, listing.forces);
    renameBodies(s, listing.bodies);
    std::vector<std::vector<int>> shapes;
    for (const auto& places : listing.shapes) shapes.push_back(inverse(places));
    const auto back = [bodies = listing.bodies, shapes](const Trajectory& t) {
        const auto name = [&](int body, int& shape) { shape = shapes[body][shape]; };
        return mapped(
            reordered(t, bodies), [](const BodyState& state, double) { return state; },
            [&](ContactPoint c, double) {
                name(c.bodyA, c.shapeA);
                name(c.bodyB, c.shapeB);
                return c;
            });
    };
    return {std::move(s), 1.0, back};
}

}  // namespace rigor::validation
