// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/collision.hpp"

#include <algorithm>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/SimpleFrame.hpp>

#include "adapters/dart/shapes.hpp"
#include "adapters/dart/surfaces.hpp"
#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/surface_points.hpp"

namespace rigor::dart_adapter {
namespace {

using adapter::ContactPoint;

class BackFilter final : public dart::collision::CollisionFilter {
  public:
    explicit BackFilter(const Surfaces& surfaces) : surfaces_(surfaces) {}
    bool ignoresCollision(const dart::collision::CollisionObject* one,
                          const dart::collision::CollisionObject* two) const override {
        return !surfaces_.mayMeet(one->getShapeFrame(), two->getShapeFrame());
    }

  private:
    const Surfaces& surfaces_;
};

/// One side of a query.
class Side {
  public:
    Side(const adapter::Geometry& geometry, const Pose& pose, const std::string& narrowPhase,
         dart::collision::CollisionDetector& detector, Surfaces& surfaces)
        : group_(detector.createCollisionGroupAsSharedPtr()) {
        for (const DartShape& made : makeShapes(geometry, narrowPhase)) {
            auto frame = std::make_shared<dart::dynamics::SimpleFrame>(dart::dynamics::Frame::World(),
                                                                       "frame", toDart(pose * made.frame));
            frame->setShape(made.shape);
            frame->createCollisionAspect();
            group_->addShapeFrame(frame.get());
            if (made.surface) surfaces.add(frame.get(), made.back);
            frames_.push_back(std::move(frame));
        }
    }
    dart::collision::CollisionGroup& group() const { return *group_; }
    bool has(const dart::collision::CollisionObject* object) const {
        return std::any_of(frames_.begin(), frames_.end(),
                           [&](const auto& frame) { return object->getShapeFrame() == frame.get(); });
    }

  private:
    std::vector<dart::dynamics::SimpleFramePtr> frames_;
    dart::collision::CollisionGroupPtr group_;
};

}  // namespace

std::vector<std::string> DartCollisionEngine::algorithms() const {
    return {std::begin(kNarrowPhases), std::end(kNarrowPhases)};
}

adapter::CollisionAnswer DartCollisionEngine::collide(const adapter::CollisionQuery& query) const {
    adapter::checkQueryInput(query);
    std::string phase =
        query.settings != nullptr ? adapter::textSetting(*query.settings, "narrow_phase") : "ode";
    if (!query.algorithm.empty()) phase = query.algorithm;
    if (std::find(std::begin(kNarrowPhases), std::end(kNarrowPhases), phase) == std::end(kNarrowPhases))
        throw adapter::BadInput("dart: narrow_phase: found '" + phase +
                                "', expected fcl_mesh, fcl_primitive, dart or ode");
    const bool planar = query.dimension == 2;
    const adapter::Geometry a = planar ? adapter::planarGeometry(*query.a.geometry) : *query.a.geometry;
    const adapter::Geometry b = planar ? adapter::planarGeometry(*query.b.geometry) : *query.b.geometry;
    const auto detector = makeDetector(phase);
    Surfaces surfaces(phase);
    const Side one(a, query.a.pose, phase, *detector, surfaces),
        two(b, query.b.pose, phase, *detector, surfaces);
    dart::collision::CollisionResult found;
    const auto filter = std::make_shared<BackFilter>(surfaces);
    one.group().collide(&two.group(), dart::collision::CollisionOption(true, 1000, filter), &found);

    adapter::CollisionAnswer answer;
    for (const dart::collision::Contact& c : found.getContacts()) {
        if (dart::collision::Contact::isZeroNormal(c.normal) || !surfaces.pushesOut(c)) continue;
        ContactPoint point;
        point.bodyB = 1;
        point.normal = (one.has(c.collisionObject1) ? -1.0 : 1.0) * fromDart(c.normal);
        point.depth = c.penetrationDepth;
        const auto [onA, onB] = adapter::surfacePoints({&a, query.a.pose}, {&b, query.b.pose},
                                                       fromDart(c.point), point.normal, point.depth);
        point.pointA = onA;
        point.pointB = onB;
        answer.contacts.push_back(point);
    }
    adapter::orderDeepestFirst(answer.contacts);
    answer.overlap = !answer.contacts.empty();
    adapter::keepFirst(answer.contacts, query.maxContacts);
    return answer;
}

}  // namespace rigor::dart_adapter
