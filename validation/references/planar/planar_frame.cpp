// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion of a scenario to a planar body over a floor and back; see planar_motion.hpp.
#include <algorithm>
#include <cmath>

#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation {
namespace {

/// A corner in 3D: a vertex, or the centre of a sphere or cap.
struct SpaceCorner {
    Vec3 point;  ///< world, initial pose
    double radius = 0.0;
};

std::vector<SpaceCorner> cornersOf(const Scenario& scenario, const Body& body) {
    std::vector<SpaceCorner> corners;
    for (const auto& shape : body.shapes) {
        const Pose pose = body.pose * shape.pose;
        const auto add = [&](Vec3 local, double radius) { corners.push_back({pose * local, radius}); };
        if (const auto* s = std::get_if<scenario::Sphere>(&shape.geometry)) {
            add({}, s->radius);
        } else if (const auto* c = std::get_if<scenario::Capsule>(&shape.geometry)) {
            for (const double y : {-c->halfLength, c->halfLength}) add({0, y, 0}, c->radius);
        } else if (const auto* b = std::get_if<scenario::Box>(&shape.geometry)) {
            const Vec3 h = b->halfExtents;
            for (const double x : {-h.x, h.x})
                for (const double y : {-h.y, h.y}) {
                    if (scenario.dimension == 2) add({x, y, 0}, 0.0);
                    if (scenario.dimension == 3)
                        for (const double z : {-h.z, h.z}) add({x, y, z}, 0.0);
                }
        } else if (const auto* h = std::get_if<scenario::ConvexHull>(&shape.geometry)) {
            for (const Vec3 v : h->vertices) add(v, 0.0);
        } else {
            violated("body '" + body.name + "' has a shape without corners");
        }
    }
    return corners;
}

}  // namespace

PlanarFrame::PlanarFrame(const Scenario& scenario, int index, int floor)
    : body_(scenario.bodies[index]), plane_(planeOf(scenario, floor, centerOfMass(body_))) {
    const std::string subject = bodyTitle(scenario, index);
    requireUndisturbed(scenario, index, {.constantForces = true});
    requireContact(scenario, index, floor);
    requireStill(scenario, floor);
    require(!body_.shapes.empty(), subject + " has no shape");
    above_ = plane_.normal;
    chooseAxis(scenario);
    along_ = cross(above_, axis_);
    origin_ = plane_.offset * plane_.normal;
    const Vec3 com = centerOfMass(body_);
    origin_ += dot(axis_, com - origin_) * axis_;
    const Vec3 v = body_.velocity, w = body_.angularVelocity, g = gravityOn(scenario, index);
    const double fast = norm(v) + sizeOf(body_) * norm(w);
    require(std::abs(dot(v, axis_)) <= 1e-9 * fast && norm(w - dot(w, axis_) * axis_) <= 1e-9 * norm(w) &&
                std::abs(dot(g, axis_)) <= 1e-9 * norm(g),
            subject + " does not move in a plane across the floor");
    double moment = body_.massProperties.inertia(2, 2);
    if (scenario.dimension == 3) {
        const Vec3 m = worldInertia(body_) * axis_;
        moment = dot(axis_, m);
        require(norm(m - moment * axis_) <= 1e-9 * moment, subject + " does not turn about a principal axis");
    }
    setup_.mass = body_.massProperties.mass;
    setup_.inertia = moment;
    setup_.pullAlong = dot(g, along_);
    setup_.pullAbove = dot(g, above_);
    setup_.size = sizeOf(body_);
    const auto pair = pairCoefficients(scenario, body_.shapes[0].material, plane_.material);
    for (const auto& shape : body_.shapes) {
        const auto one = pairCoefficients(scenario, shape.material, plane_.material);
        require(one.friction == pair.friction, subject + " has shapes of different friction");
        require(holdingFriction(one) == one.friction,
                "the static friction of " + subject +
                    " is above that of sliding, which this motion from event to " + "event does not know");
    }
    setup_.friction = pair.friction;
    setup_.restitution = pair.restitution;
    addForces(scenario, index);
    addCorners(scenario);
    start_ = {dot(along_, com - origin_),
              dot(above_, com - origin_),
              0,
              dot(along_, v),
              dot(above_, v),
              dot(axis_, w)};
}

/// The axis across the plane of motion: of the spin, else of what would make it turn.
void PlanarFrame::chooseAxis(const Scenario& scenario) {
    if (scenario.dimension == 2) return;
    const Vec3 com = centerOfMass(body_), w = body_.angularVelocity;
    if (w != Vec3{}) {
        axis_ = unit(w);
    } else {
        double low = 1e300;
        Vec3 foot;
        int count = 0;
        for (const auto& corner : cornersOf(scenario, body_)) {
            const double height = plane_.height(corner.point) - corner.radius;
            if (height < low - 1e-6 * sizeOf(body_)) {
                low = height;
                foot = {};
                count = 0;
            }
            if (height < low + 1e-6 * sizeOf(body_)) {
                foot += corner.point;
                ++count;
            }
        }
        Vec3 g = scenario.gravity;
        for (const auto& force : scenario.forces) {
            const auto* f = std::get_if<scenario::ConstantForce>(&force);
            if (f && &scenario.bodies[f->body] == &body_) g += f->force / body_.massProperties.mass;
        }
        const Vec3 lever = foot / std::max(count, 1) - com;
        const Vec3 byLever = cross(plane_.normal, lever), byPull = cross(plane_.normal, g);
        const bool leans = norm(byLever) > 1e-9 * sizeOf(body_);
        const Vec3 byMotion = cross(plane_.normal, body_.velocity);
        const bool pulled = norm(byPull) > 1e-9 * norm(g),
                   moves = norm(byMotion) > 1e-9 * norm(body_.velocity);
        require(leans || pulled || moves, "nothing says in which plane the body moves");
        axis_ = unit(leans ? byLever : pulled ? byPull : byMotion);
    }
    require(std::abs(dot(axis_, plane_.normal)) <= 1e-9, "the body turns about the normal of the floor");
}

void PlanarFrame::addForces(const Scenario& scenario, int index) {
    for (const auto& force : scenario.forces) {
        const auto* f = std::get_if<scenario::ConstantForce>(&force);
        if (!f || f->body != index) continue;
        require(f->start <= 0.0 && f->end >= scenario.duration, "a force does not act all the time");
        require(std::abs(dot(f->force, axis_)) <= 1e-9 * norm(f->force) &&
                    norm(f->torque - dot(f->torque, axis_) * axis_) <= 1e-9 * norm(f->torque),
                "a force acts out of the plane of motion");
        setup_.pullAlong += dot(f->force, along_) / setup_.mass;
        setup_.pullAbove += dot(f->force, above_) / setup_.mass;
        setup_.torque += dot(f->torque, axis_);
    }
}

/// Corners that lie behind one another count once; their middle must be in the plane of the centre of mass.
void PlanarFrame::addCorners(const Scenario& scenario) {
    const Vec3 com = centerOfMass(body_);
    struct Group {
        PlanarMotion::Corner corner;
        double offset = 0.0;
    };
    std::vector<Group> groups;
    const double tolerance = 1e-7 * setup_.size;
    for (const auto& c : cornersOf(scenario, body_)) {
        const Vec3 arm = c.point - com;
        const PlanarMotion::Corner corner{dot(along_, arm), dot(above_, arm), c.radius};
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
            return std::abs(g.corner.along - corner.along) < tolerance &&
                   std::abs(g.corner.above - corner.above) < tolerance &&
                   std::abs(g.corner.radius - corner.radius) < tolerance;
        });
        if (same == groups.end()) {
            groups.push_back({corner, dot(axis_, arm)});
        } else {
            same->offset += dot(axis_, arm);
        }
    }
    for (const Group& g : groups) {
        require(std::abs(g.offset) < 4 * tolerance,
                "body '" + body_.name + "' is not the same on both sides of its plane of motion");
        setup_.corners.push_back(g.corner);
    }
}

PartialState PlanarFrame::lift(const PlanarMotion::State& s) const {
    const auto d = [](numerics::Real v) { return static_cast<double>(v); };
    const Quat q = scenario::fromAxisAngle(axis_, d(s.angle)) * body_.pose.orientation;
    return stateOf(body_, origin_ + d(s.x) * along_ + d(s.z) * above_, scenario::normalized(q),
                   d(s.vx) * along_ + d(s.vz) * above_, d(s.rate) * axis_);
}

PlanarMotion::State PlanarFrame::read(const BodyState& state) const {
    const Vec3 com = centerOfMass(body_, state) - origin_;
    const Quat turn = state.orientation * scenario::conjugate(body_.pose.orientation);
    const double angle = 2.0 * std::atan2(dot(axis_, Vec3{turn.x, turn.y, turn.z}), turn.w);
    return {dot(along_, com),
            dot(above_, com),
            std::remainder(angle, 6.28318530717958647692),
            dot(along_, state.velocity),
            dot(above_, state.velocity),
            dot(axis_, state.angularVelocity)};
}

}  // namespace rigor::validation
