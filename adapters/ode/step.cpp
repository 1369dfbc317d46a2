// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step: contacts at the pose of the start of the step, contact joints from them, then dWorldStep (the
// direct Dantzig LCP) or dWorldQuickStep (projected Gauss-Seidel with over-relaxation).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "adapters/ode/convert.hpp"
#include "adapters/ode/library.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {

using adapter::Scenario;

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Speed below which a contact has no sliding direction [m/s].
constexpr double kNoDirection = 1e-12;

}  // namespace

void OdeWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    const BodyRecord& record = *records_[body];
    if (!record.dynamic) return;
    dBodyAddForce(record.body, force.x, force.y, force.z);
    dBodyAddTorque(record.body, torque.x, torque.y, torque.z);
}

void OdeWorld::step() {
    if (broken_) throw std::runtime_error("ODE failed in an earlier step of this world");
    try {
        doStep();
    } catch (...) {
        broken_ = true;
        throw;
    }
}

void OdeWorld::doStep() {
    useLibrary();
    const std::int64_t messagesBefore = messageCount();
    for (auto& record : records_) {
        if (record->turnPending) turnAngularMomentum(*record, record->turnFrom);
        record->turnPending = false;
    }
    pushGravity();
    const auto start = std::chrono::steady_clock::now();
    findContacts();
    counters_.phaseSeconds["collision"] = secondsSince(start);
    createContactJoints();
    for (const auto& joint : joints_) joint->beforeStep();
    const auto solving = std::chrono::steady_clock::now();
    advance();
    breakJoints();
    counters_.phaseSeconds["solve_and_integrate"] = secondsSince(solving);
    dJointGroupEmpty(contactGroup_);
    counters_.contacts = contacts_.size();
    messages_ += messageCount() - messagesBefore;
    ++steps_;
}

void OdeWorld::pushGravity() {
    for (const auto& record : records_) {
        if (!record->dynamic || !record->ownGravity) continue;
        dMass mass;
        dBodyGetMass(record->body, &mass);
        const Vec3 weight = mass.mass * record->gravity;
        dBodyAddForce(record->body, weight.x, weight.y, weight.z);
    }
}

void OdeWorld::breakJoints() {
    bool any = false;
    for (const auto& joint : joints_) any = joint->breakIfOverloaded() || any;
    if (any) collidePairsOfBrokenJoints();
}

/// Lets bodies that a joint kept from colliding collide once it has broken.
void OdeWorld::collidePairsOfBrokenJoints() {
    pairs_.keepApart(scenario_, [&](std::size_t joint) { return joints_[joint]->holds(); });
}

void OdeWorld::nearPair(void* self, dGeomID a, dGeomID b) {
    auto& world = *static_cast<OdeWorld*>(self);
    const GeomTag &tagA = Geom::tagOf(a), &tagB = Geom::tagOf(b);
    if (tagA.body == tagB.body || !world.pairs_.mayCollide(tagA.body, tagB.body)) return;
    if (!world.pairs_.shapesMayTouch(tagA.body, tagA.shape, tagB.body, tagB.shape)) return;
    if ((tagA.back && !Geom::meetsBacks(b)) || (tagB.back && !Geom::meetsBacks(a))) return;
    if (tagA.body < tagB.body)
        world.near_.emplace_back(a, b);
    else
        world.near_.emplace_back(b, a);
}

/// Pairs come from the space in an order of its own; sorted by scenario index every space gives the same
/// steps.
void OdeWorld::findContacts() {
    near_.clear();
    contacts_.clear();
    dSpaceCollide(space_, this, &OdeWorld::nearPair);
    const auto key = [](const std::pair<dGeomID, dGeomID>& pair) {
        const GeomTag &a = Geom::tagOf(pair.first), &b = Geom::tagOf(pair.second);
        return std::tuple(a.body, b.body, a.shape, b.shape, a.back, b.back);
    };
    std::sort(near_.begin(), near_.end(), [&](const auto& p, const auto& q) { return key(p) < key(q); });
    counters_.pairs = near_.size();
    for (const auto& [a, b] : near_) {
        findPoints(a, b);
        if (found_.empty()) continue;
        const GeomTag &tagA = Geom::tagOf(a), &tagB = Geom::tagOf(b);
        const auto shapePose = [&](const GeomTag& tag) {
            const auto& shapes = scenario_.bodies[tag.body].shapes;
            return poseOf(tag.body) * shapes[tag.shape].pose;
        };
        for (const FoundPoint& point : found_)
            contacts_.push_back({tagA, tagB, point, shapePose(tagA), shapePose(tagB), {}, false});
    }
}

void OdeWorld::findPoints(dGeomID a, dGeomID b) {
    collideGeoms(a, b, planar_, found_);
    const int kinds[] = {dGeomGetClass(a), dGeomGetClass(b)};
    const auto has = [&](int kind) { return kinds[0] == kind || kinds[1] == kind; };
    if (ballMergeCosine_ <= 1.0 && has(dSphereClass) && (has(dTriMeshClass) || has(dHeightfieldClass)))
        mergeNormals(ballMergeCosine_, found_);
    reducePoints(maxContacts_, found_);
}

/// All of `contacts_` exists before the first joint does, because ODE writes the forces back into it.
void OdeWorld::createContactJoints() {
    for (StepContact& c : contacts_) {
        const dBodyID bodyA = records_[c.a.body]->body;
        const dBodyID bodyB = records_[c.b.body]->body;
        dContact contact{};
        contact.surface =
            surfaceFor(pairs_.coefficients(c.a.material, c.b.material), bounceThreshold_, contactCfm_);
        toOde(c.point.position, contact.geom.pos);
        toOde(-c.point.normal, contact.geom.normal);
        contact.geom.depth = c.point.depth;
        if (friction_ == Friction::PyramidVelocity) chooseFrictionDirection(c, contact);
        const Vec3 belt = surfaceSlip(c);
        if (norm(belt) > 0.0) setSurfaceMotion(c, belt, bodyA != nullptr, contact);
        const dJointID joint = dJointCreateContact(world_, contactGroup_, &contact);
        dJointAttach(joint, bodyA, bodyB);
        // The first force is that on the first body there is.
        c.feedbackOnA = bodyA != nullptr;
        dJointSetFeedback(joint, &c.feedback);
    }
}

/// The velocity that a point of a body would have at the end of the step without contacts and joints.
Vec3 OdeWorld::freeVelocityAt(int body, const Vec3& point) const {
    const BodyRecord& record = *records_[body];
    if (record.body == nullptr) return {};
    Vec3 velocity = fromOde(dBodyGetLinearVel(record.body));
    Vec3 turning = fromOde(dBodyGetAngularVel(record.body));
    if (record.dynamic) {
        dMass mass;
        dBodyGetMass(record.body, &mass);
        velocity += dt_ / mass.mass * fromOde(dBodyGetForce(record.body));
        if (!record.ownGravity) velocity += dt_ * record.gravity;
        const Quat q = quatFromOde(dBodyGetQuaternion(record.body));
        const Vec3 torque = rotateInverse(q, fromOde(dBodyGetTorque(record.body)));
        turning += dt_ * rotate(q, record.inverseInertia * torque);
    }
    return velocity + cross(turning, point - fromOde(dBodyGetPosition(record.body)));
}

/// friction=pyramid_velocity: the first axis of the square points where the surfaces are about to slide. The
/// velocity they have now would not do: at rest on a slope it is zero or noise.
void OdeWorld::chooseFrictionDirection(const StepContact& c, dContact& out) const {
    const Vec3 p = c.point.position;
    const Vec3 relative = freeVelocityAt(c.b.body, p) - freeVelocityAt(c.a.body, p) + surfaceSlip(c);
    const Vec3 sliding = relative - dot(relative, c.point.normal) * c.point.normal;
    const double speed = norm(sliding);
    if (speed < kNoDirection) return;
    out.surface.mode |= dContactFDir1;
    toOde(sliding / speed, out.fdir1);
}

/// Velocity of B's surface against A's over their bodies, in the tangent plane.
Vec3 OdeWorld::surfaceSlip(const StepContact& c) const {
    const auto at = [&](const GeomTag& tag) {
        const scenario::Shape& shape = scenario_.bodies[tag.body].shapes[tag.shape];
        return shape.surfaceVelocity.moves() ? surfaceVelocityAt(shape, poseOf(tag.body), c.point.position)
                                             : Vec3{};
    };
    const Vec3 slip = at(c.b) - at(c.a);
    return slip - dot(slip, c.point.normal) * c.point.normal;
}

/// dContactMotion1 and 2 are the velocities that the first body of the joint should have against the second along
/// fdir1 and the joint's normal times fdir1. The first body is A, or B where A has none; the normal then turns.
void OdeWorld::setSurfaceMotion(const StepContact& c, const Vec3& belt, bool firstIsA, dContact& out) const {
    const bool chosen = (out.surface.mode & dContactFDir1) != 0;
    const Vec3 t1 = chosen ? fromOde(out.fdir1) : belt / norm(belt);
    const Vec3 t2 = cross(firstIsA ? -c.point.normal : c.point.normal, t1);
    const Vec3 wanted = firstIsA ? belt : -belt;
    toOde(t1, out.fdir1);
    out.surface.mode |= dContactFDir1 | dContactMotion1 | dContactMotion2;
    out.surface.motion1 = dot(wanted, t1);
    out.surface.motion2 = dot(wanted, t2);
}

void OdeWorld::advance() {
    std::vector<Quat> before;
    std::vector<bool> held;
    if (externalGyro_)
        for (const auto& record : records_) {
            before.push_back(record->dynamic ? quatFromOde(dBodyGetQuaternion(record->body)) : Quat{});
            held.push_back(record->dynamic && dBodyGetNumJoints(record->body) > 0);
        }
    const bool tooMany = !quickStep_ && worldStepLimit_ > 0 && contacts_.size() > worldStepLimit_;
    if (quickStep_ || tooMany) {
        const std::lock_guard lock(randomMutex());
        dRandSetSeed(adapter::integerSetting(settings_, "seed"));
        dWorldQuickStep(world_, dt_);
        counters_.solverIterations = dWorldGetQuickStepNumIterations(world_);
        if (tooMany) ++fallbackSteps_;
    } else {
        dWorldStep(world_, dt_);
        counters_.solverIterations = -1;
    }
    for (std::size_t i = 0; i < records_.size(); ++i) {
        BodyRecord& record = *records_[i];
        if (!record.dynamic) continue;
        if (planar_) keepInPlane(record);
        if (!externalGyro_) continue;
        if (held[i]) {
            record.turnPending = true;
            record.turnFrom = before[i];
        } else
            turnAngularMomentum(record, before[i]);
    }
}

/// gyroscopic=external: w := I(R1)^-1 I(R0) w, with I(R) = R I R^T, keeps the angular momentum of a body
/// that turned from R0 to R1. Free bodies at once; bodies in contacts or joints at the start of the next
/// step, so that their constraints see the change.
void OdeWorld::turnAngularMomentum(BodyRecord& record, const Quat& from) {
    const Quat now = quatFromOde(dBodyGetQuaternion(record.body));
    const Vec3 w = fromOde(dBodyGetAngularVel(record.body));
    const Vec3 momentum = rotate(from, record.inertia * rotateInverse(from, w));
    const Vec3 turned = rotate(now, record.inverseInertia * rotateInverse(now, momentum));
    dBodySetAngularVel(record.body, turned.x, turned.y, turned.z);
}

/// Plane2D holds a body to the plane up to its error reduction; what rounding leaves is taken away.
void OdeWorld::keepInPlane(BodyRecord& record) {
    const dBodyID body = record.body;
    const dReal* p = dBodyGetPosition(body);
    dBodySetPosition(body, p[0], p[1], 0.0);
    const dReal* v = dBodyGetLinearVel(body);
    dBodySetLinearVel(body, v[0], v[1], 0.0);
    dBodySetAngularVel(body, 0.0, 0.0, dBodyGetAngularVel(body)[2]);
    const Quat q = quatFromOde(dBodyGetQuaternion(body));
    dQuaternion flat;
    toOde(normalized(Quat{q.w, 0.0, 0.0, q.z}), flat);
    dBodySetQuaternion(body, flat);
}

}  // namespace rigor::ode
