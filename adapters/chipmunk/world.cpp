// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a cpSpace: building and stepping.
//
// cpSpaceStep moves the bodies with the velocities of the step before, finds contacts, adds forces and solves. With
// positions=last the bodies do not move in it and are moved afterwards by cpBodyUpdatePosition: the same two halves of
// a step with the boundary between steps put elsewhere, which makes the scheme symplectic Euler as other engines have it.
#include "adapters/chipmunk/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/chipmunk/library.hpp"
#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/reach.hpp"

namespace rigor::chipmunk {

using scenario::BodyType;

ChipmunkWorld::ChipmunkWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings)
    : scenario_(adapter::withStiffness(scenario)),
      settings_(settings),
      dt_(dt),
      positionsLast_(is("positions", "last")),
      pairs_(scenario_),
      ground_(cpBodyNewStatic()) {
    useLibrary();
    space_.reset(cpSpaceNew());
    cpSpace* space = space_.get();
    cpSpaceSetIterations(space, adapter::integerSetting(settings_, "iterations"));
    cpSpaceSetGravity(space, toChipmunk(scenario_.gravity));
    cpSpaceSetCollisionSlop(space, number("slop"));
    cpSpaceSetCollisionBias(space, number("bias"));
    if (is("space", "spatial_hash")) cpSpaceUseSpatialHash(space, number("hash_cell"), 1000);
    cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space);
    handler->preSolveFunc = preSolve;
    handler->postSolveFunc = postSolve;
    handler->userData = this;
    const adapter::Reach reach = adapter::reachOf(scenario_, 50.0, 1e4);
    halfPlane_ = {reach.middle, reach.distance, std::max(10.0, 0.1 * reach.distance)};
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) addBody(i);
    cpSpaceAddBody(space, ground_.get());
    for (const auto& joint : scenario_.joints) addJoint(joint);
}

bool ChipmunkWorld::is(const char* key, const char* value) const {
    return adapter::textSetting(settings_, key) == value;
}
double ChipmunkWorld::number(const char* key) const {
    return adapter::numberSetting(settings_, key);
}

void ChipmunkWorld::addBody(int index) {
    const scenario::Body& source = scenario_.bodies[index];
    auto record = std::make_unique<BodyRecord>();
    record->dynamic = source.type == BodyType::Dynamic;
    record->moves = source.type != BodyType::Static;
    record->linearKept = std::pow(source.linearVelocityKept, dt_);
    record->angularKept = std::pow(source.angularVelocityKept, dt_);
    record->gravityScale = source.gravityScale;
    const auto& properties = source.massProperties;
    record->body.reset(record->dynamic ? cpBodyNew(properties.mass, properties.inertia(2, 2))
                       : record->moves ? cpBodyNewKinematic()
                                       : cpBodyNewStatic());
    cpBody* body = record->body.get();
    // The centre of mass and the angle decide where the position is.
    cpBodySetCenterOfGravity(body, toChipmunk(properties.centerOfMass));
    cpBodySetAngle(body, angleAboutZ(source.pose.orientation));
    cpBodySetPosition(body, toChipmunk(source.pose.position));
    cpBodySetUserData(body, record.get());
    cpBodySetVelocityUpdateFunc(body, updateVelocity);
    if (positionsLast_) cpBodySetPositionUpdateFunc(body, stay);
    if (record->moves) {
        cpBodySetVelocity(body, toChipmunk(source.velocity));
        cpBodySetAngularVelocity(body, source.angularVelocity.z);
    }
    cpSpaceAddBody(space_.get(), body);
    if (source.collides) addShapes(*record, index);
    records_.push_back(std::move(record));
}

void ChipmunkWorld::addShapes(BodyRecord& record, int index) {
    const scenario::Body& source = scenario_.bodies[index];
    for (std::size_t i = 0; i < source.shapes.size(); ++i) {
        const scenario::Shape& shape = source.shapes[i];
        record.tags.push_back(std::make_unique<ShapeTag>(ShapeTag{
            index, static_cast<int>(i), shape.material, shape.surfaceVelocity.moves() ? &shape : nullptr}));
        for (auto& part :
             buildShapes(record.body.get(), shape.geometry, shape.pose, source.pose, halfPlane_)) {
            cpShapeSetUserData(part.get(), record.tags.back().get());
            cpSpaceAddShape(space_.get(), part.get());
            record.shapes.push_back(std::move(part));
        }
    }
}

void ChipmunkWorld::addJoint(const scenario::Joint& joint) {
    const auto endOf = [&](int index) {
        if (index == scenario::kNone) return JointEnd{ground_.get(), {}};
        return JointEnd{records_[index]->body.get(), scenario_.bodies[index].pose};
    };
    joints_.push_back(buildJoint(joint, endOf(joint.bodyA), endOf(joint.bodyB)));
    for (auto* parts : {&joints_.back().forces, &joints_.back().torques})
        for (auto& part : *parts) cpSpaceAddConstraint(space_.get(), part.get());
}

void ChipmunkWorld::breakJoints() {
    bool any = false;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const scenario::Joint& joint = scenario_.joints[i];
        if (joints_[i].empty() || (joint.breakForce > 1e299 && joint.breakTorque > 1e299)) continue;
        const Reaction reaction = reactionOf(joints_[i], dt_);
        if (reaction.force <= joint.breakForce && reaction.torque <= joint.breakTorque) continue;
        for (auto* parts : {&joints_[i].forces, &joints_[i].torques})
            for (auto& part : *parts) cpSpaceRemoveConstraint(space_.get(), part.get());
        joints_[i] = {};
        any = true;
    }
    if (!any) return;
    // Bodies that a joint kept from colliding collide once it has broken.
    pairs_.keepApart(scenario_, [&](std::size_t joint) { return !joints_[joint].empty(); });
}

/// Called when two shapes overlap, before their contacts are solved. Chipmunk would multiply the coefficients of the
/// shapes.
cpBool ChipmunkWorld::preSolve(cpArbiter* arbiter, cpSpace*, cpDataPointer data) {
    const auto& self = *static_cast<const ChipmunkWorld*>(data);
    cpShape *a = nullptr, *b = nullptr;
    cpArbiterGetShapes(arbiter, &a, &b);
    const auto& ofA = *static_cast<const ShapeTag*>(cpShapeGetUserData(a));
    const auto& ofB = *static_cast<const ShapeTag*>(cpShapeGetUserData(b));
    if (!self.pairs_.mayCollide(ofA.body, ofB.body) ||
        !self.pairs_.shapesMayTouch(ofA.body, ofA.shape, ofB.body, ofB.shape))
        return cpFalse;
    const auto& pair = self.pairs_.coefficients(ofA.material, ofB.material);
    cpArbiterSetFriction(arbiter, pair.friction);
    cpArbiterSetRestitution(arbiter, pair.restitution);
    if (ofA.source != nullptr || ofB.source != nullptr)
        cpArbiterSetSurfaceVelocity(arbiter, self.surfaceVelocity(arbiter, a, b));
    return cpTrue;
}

/// Velocity of B's surface against A's over their bodies; one serves all points of an arbiter: the mean of theirs.
cpVect ChipmunkWorld::surfaceVelocity(cpArbiter* arbiter, const cpShape* a, const cpShape* b) const {
    const cpContactPointSet points = cpArbiterGetContactPointSet(arbiter);
    const auto of = [&](const cpShape* shape, const cpVect& point) {
        const auto& tag = *static_cast<const ShapeTag*>(cpShapeGetUserData(shape));
        if (tag.source == nullptr) return Vec3{};
        const adapter::BodyState state = stateOf(*records_[tag.body]);
        return surfaceVelocityAt(*tag.source, {state.position, state.orientation}, fromChipmunk(point));
    };
    Vec3 sum;
    for (int i = 0; i < points.count; ++i)
        sum += of(b, points.points[i].pointB) - of(a, points.points[i].pointA);
    return toChipmunk(sum / std::max(points.count, 1));
}

void ChipmunkWorld::postSolve(cpArbiter* arbiter, cpSpace*, cpDataPointer data) {
    static_cast<ChipmunkWorld*>(data)->touching_.push_back(arbiter);
}

/// v = kept v + dt (scale g + f / m); Chipmunk's own has one damping for both velocities and all bodies.
void ChipmunkWorld::updateVelocity(cpBody* body, cpVect gravity, cpFloat, cpFloat dt) {
    const auto& record = *static_cast<const BodyRecord*>(cpBodyGetUserData(body));
    if (!record.dynamic) return;
    if (record.angularKept != record.linearKept)
        cpBodySetAngularVelocity(body,
                                 cpBodyGetAngularVelocity(body) * (record.angularKept / record.linearKept));
    cpBodyUpdateVelocity(body, cpvmult(gravity, record.gravityScale), record.linearKept, dt);
}

void ChipmunkWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    cpBody* object = records_[body]->body.get();
    cpBodySetForce(object, cpvadd(cpBodyGetForce(object), toChipmunk(force)));
    cpBodySetTorque(object, cpBodyGetTorque(object) + torque.z);
}

void ChipmunkWorld::step() {
    touching_.clear();
    const auto keepCenters = [&] {
        centers_.clear();
        for (const auto& record : records_)
            centers_.push_back(
                cpBodyLocalToWorld(record->body.get(), cpBodyGetCenterOfGravity(record->body.get())));
    };
    if (positionsLast_) keepCenters();
    cpSpaceStep(space_.get(), dt_);
    if (!positionsLast_) keepCenters();
    if (positionsLast_)
        for (const auto& record : records_)
            if (record->moves) cpBodyUpdatePosition(record->body.get(), dt_);
    breakJoints();
}

adapter::Scheme ChipmunkWorld::scheme() const {
    return positionsLast_ ? adapter::Scheme::SymplecticEuler : adapter::Scheme::ExplicitEuler;
}

void ChipmunkWorld::setStates(std::span<const adapter::BodyState> states) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < records_.size(); ++i) {
        if (!records_[i]->dynamic) continue;
        cpBody* body = records_[i]->body.get();
        const adapter::BodyState& state = states[i];
        // Angles count turns, and the limits of joints with them.
        const double angle = angleAboutZ(state.orientation), now = cpBodyGetAngle(body);
        cpBodySetAngle(body, angle + kTurn * std::round((now - angle) / kTurn));
        cpBodySetPosition(body, toChipmunk(state.position));
        cpBodySetVelocity(body, toChipmunk(state.velocity));
        cpBodySetAngularVelocity(body, state.angularVelocity.z);
        cpSpaceReindexShapesForBody(space_.get(), body);
    }
}

}  // namespace rigor::chipmunk
