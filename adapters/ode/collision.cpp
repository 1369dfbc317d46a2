// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/ode/collision.hpp"

#include <algorithm>

#include "adapters/interface/input_check.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/surface_points.hpp"
#include "adapters/ode/contacts.hpp"
#include "adapters/ode/convert.hpp"
#include "adapters/ode/library.hpp"
#include "adapters/ode/shapes.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::ode {
namespace {

adapter::Geometry solidOf(const adapter::Geometry& geometry, int dimension) {
    if (dimension == 3) return geometry;
    return adapter::planarGeometry(geometry);
}

bool isSurface(const adapter::Geometry& geometry) {
    return scenario::isStaticOnly(geometry);
}

/// dCollide with at most `maxContacts` points, as a program around the library calls it.
class OdeBatch final : public adapter::CollisionBatch {
  public:
    explicit OdeBatch(std::span<const adapter::CollisionQuery> queries)
        : most_(std::clamp(queries.front().maxContacts, 1, 64)) {
        for (const adapter::CollisionQuery& query : queries) {
            sides_.push_back(
                std::make_unique<Geom>(solidOf(*query.a.geometry, query.dimension), query.a.pose));
            sides_.push_back(
                std::make_unique<Geom>(solidOf(*query.b.geometry, query.dimension), query.b.pose));
        }
        found_.resize(most_);
    }
    std::size_t run() override {
        useLibrary();
        std::size_t contacts = 0;
        for (std::size_t i = 0; 2 * i < sides_.size(); ++i) contacts += runQuery(i);
        return contacts;
    }
    std::vector<adapter::ContactPoint> contacts(std::size_t i) override {
        useLibrary();
        std::vector<adapter::ContactPoint> all(runQuery(i));
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k].bodyB = 1;
            all[k].pointA = all[k].pointB = fromOde(found_[k].pos);
            all[k].normal = -fromOde(found_[k].normal);
            all[k].depth = found_[k].depth;
        }
        return all;
    }

  private:
    std::size_t runQuery(std::size_t i) {
        return static_cast<std::size_t>(dCollide(sides_[2 * i]->id(), sides_[2 * i + 1]->id(), most_,
                                                 found_.data(), sizeof(dContactGeom)));
    }
    int most_;
    std::vector<std::unique_ptr<Geom>> sides_;
    std::vector<dContactGeom> found_;
};

}  // namespace

std::unique_ptr<adapter::CollisionBatch> OdeCollisionEngine::batch(
    std::span<const adapter::CollisionQuery> queries) const {
    if (queries.empty()) throw adapter::BadInput("a batch of no pairs");
    for (const adapter::CollisionQuery& query : queries) adapter::checkQueryInput(query);
    useLibrary();
    return std::make_unique<OdeBatch>(queries);
}

adapter::CollisionAnswer OdeCollisionEngine::collide(const adapter::CollisionQuery& query) const {
    adapter::checkQueryInput(query);
    useLibrary();
    if (isSurface(*query.a.geometry) && isSurface(*query.b.geometry))
        throw adapter::notInAdapter("ode", "collisions of two surfaces without inside");
    const adapter::Geometry solidA = solidOf(*query.a.geometry, query.dimension);
    const adapter::Geometry solidB = solidOf(*query.b.geometry, query.dimension);
    const Geom a(solidA, query.a.pose), b(solidB, query.b.pose);
    std::vector<FoundPoint> points;
    collideGeoms(a.id(), b.id(), query.dimension == 2, points);
    if (const bool backOfA = a.back() != nullptr; backOfA || b.back() != nullptr) {
        std::vector<FoundPoint> behind;
        if (Geom::meetsBacks(backOfA ? b.id() : a.id()))
            collideGeoms(backOfA ? a.back() : a.id(), backOfA ? b.id() : b.back(), query.dimension == 2,
                         behind);
        points.insert(points.end(), behind.begin(), behind.end());
    }
    reducePoints(query.maxContacts, points);

    adapter::CollisionAnswer answer;
    answer.overlap = !points.empty();
    for (const FoundPoint& point : points) {
        const auto [onA, onB] = adapter::surfacePoints({&solidA, query.a.pose}, {&solidB, query.b.pose},
                                                       point.position, point.normal, point.depth);
        adapter::ContactPoint contact;
        contact.bodyA = 0;
        contact.bodyB = 1;
        contact.pointA = onA;
        contact.pointB = onB;
        contact.normal = point.normal;
        contact.depth = point.depth;
        answer.contacts.push_back(contact);
    }
    return answer;
}

}  // namespace rigor::ode
