// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as an ODE world: building it and reading its states. Stepping stands in step.cpp.
#include "adapters/ode/world.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/reach.hpp"
#include "adapters/interface/surface_points.hpp"
#include "adapters/ode/convert.hpp"
#include "adapters/ode/library.hpp"

namespace rigor::ode {

using adapter::BodyState;
using adapter::numberSetting;
using adapter::Scenario;
using adapter::Settings;
using scenario::BodyType;

OdeWorld::OdeWorld(Empty, const Scenario& scenario, double dt, const Settings& settings)
    : original_(scenario),
      scenario_(adapter::withStiffness(scenario.dimension == 2 ? adapter::planarLift(scenario) : scenario)),
      settings_(settings),
      dt_(dt),
      planar_(scenario.dimension == 2),
      quickStep_(is("stepper", "quickstep")),
      externalGyro_(!planar_ && is("gyroscopic", "external")),
      friction_(is("friction", "pyramid_velocity") ? Friction::PyramidVelocity : Friction::PyramidWorld),
      maxContacts_(adapter::integerSetting(settings, "max_contacts")),
      worldStepLimit_(adapter::integerSetting(settings, "worldstep_limit")),
      bounceThreshold_(numberSetting(settings, "bounce_threshold")),
      contactCfm_(numberSetting(settings, "contact_cfm")),
      pairs_(scenario_) {
    if (const double merge = numberSetting(settings, "ball_merge_deg"); merge > 0.0)
        ballMergeCosine_ = std::cos(merge * 3.14159265358979323846 / 180.0);
}

/// The destructor frees what has been made where a body or joint is refused, as the empty world is one already.
OdeWorld::OdeWorld(const Scenario& scenario, double dt, const Settings& settings)
    : OdeWorld(Empty{}, scenario, dt, settings) {
    useLibrary();
    configureWorld();
    createSpace();
    contactGroup_ = dJointGroupCreate(0);
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) addBody(i);
    for (const auto& joint : scenario_.joints) {
        const auto endOf = [&](int index) {
            if (index == scenario::kNone) return JointEnd{};
            const auto i = static_cast<std::size_t>(index);
            return JointEnd{records_[i]->body, scenario_.bodies[i].pose, records_[i]->com};
        };
        joints_.push_back(
            std::make_unique<OdeJoint>(world_, joint, endOf(joint.bodyA), endOf(joint.bodyB), dt_, planar_));
    }
}

OdeWorld::~OdeWorld() {
    if (broken_) {
        // Its space may still be locked, and touching that would raise the next error: left to the end of the
        // process.
        for (auto& record : records_)
            for (auto& geom : record->geoms) static_cast<void>(geom.release());
        return;
    }
    records_.clear();
    if (contactGroup_ != nullptr) dJointGroupDestroy(contactGroup_);
    if (space_ != nullptr) dSpaceDestroy(space_);
    if (world_ != nullptr) dWorldDestroy(world_);
}

bool OdeWorld::is(const std::string& key, const std::string& value) const {
    return adapter::textSetting(settings_, key) == value;
}

void OdeWorld::configureWorld() {
    world_ = dWorldCreate();
    dWorldSetGravity(world_, scenario_.gravity.x, scenario_.gravity.y, scenario_.gravity.z);
    dWorldSetERP(world_, numberSetting(settings_, "erp"));
    dWorldSetCFM(world_, numberSetting(settings_, "cfm"));
    dWorldSetQuickStepNumIterations(world_, adapter::integerSetting(settings_, "iterations"));
    dWorldSetQuickStepW(world_, numberSetting(settings_, "sor"));
    const double correcting = numberSetting(settings_, "max_correcting_velocity");
    if (correcting < 1e30) dWorldSetContactMaxCorrectingVel(world_, correcting);
    dWorldSetContactSurfaceLayer(world_, numberSetting(settings_, "surface_layer"));
    dWorldSetAutoDisableFlag(world_, 0);
}

void OdeWorld::createSpace() {
    if (is("space", "simple")) {
        space_ = dSimpleSpaceCreate(nullptr);
    } else if (is("space", "sap")) {
        space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    } else if (is("space", "quadtree")) {
        const adapter::Reach reach = adapter::reachOf(scenario_, 10.0, 1e4);
        dVector3 middle, extents;
        toOde(reach.middle, middle);
        toOde(Vec3{reach.distance, reach.distance, reach.distance}, extents);
        space_ = dQuadTreeSpaceCreate(nullptr, middle, extents, 6);
    } else {
        space_ = dHashSpaceCreate(nullptr);
    }
    dSpaceSetCleanup(space_, 0);
}

void OdeWorld::addBody(int index) {
    const scenario::Body& body = scenario_.bodies[index];
    auto record = std::make_unique<BodyRecord>();
    record->com = body.massProperties.centerOfMass;
    if (body.type != BodyType::Static) addDynamics(body, *record);
    if (body.collides) {
        for (std::size_t i = 0; i < body.shapes.size(); ++i) {
            const scenario::Shape& shape = body.shapes[i];
            auto geom = std::make_unique<Geom>(shape.geometry, body.pose * shape.pose);
            if (record->body != nullptr)
                geom->attach(record->body, Pose{shape.pose.position - record->com, shape.pose.orientation});
            geom->setTag({index, static_cast<int>(i), shape.material});
            dSpaceAdd(space_, geom->id());
            if (geom->back() != nullptr) dSpaceAdd(space_, geom->back());
            record->geoms.push_back(std::move(geom));
        }
    }
    records_.push_back(std::move(record));
}

void OdeWorld::addDynamics(const scenario::Body& body, BodyRecord& record) {
    record.body = dBodyCreate(world_);
    record.dynamic = body.type == BodyType::Dynamic;
    const Vec3 position = body.pose * record.com;
    dQuaternion q;
    toOde(body.pose.orientation, q);
    dBodySetPosition(record.body, position.x, position.y, position.z);
    dBodySetQuaternion(record.body, q);
    dBodySetLinearVel(record.body, body.velocity.x, body.velocity.y, body.velocity.z);
    dBodySetAngularVel(record.body, body.angularVelocity.x, body.angularVelocity.y, body.angularVelocity.z);
    dBodySetFiniteRotationMode(record.body, is("rotation", "finite") ? 1 : 0);
    if (!record.dynamic) {
        dBodySetKinematic(record.body);
        return;
    }
    const Mat3& I = record.inertia = body.massProperties.inertia;
    record.inverseInertia = inverseOf(I);
    dMass mass;
    dMassSetParameters(&mass, body.massProperties.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
                       I(1, 2));
    dBodySetMass(record.body, &mass);
    dBodySetGyroscopicMode(record.body, !planar_ && is("gyroscopic", "ode") ? 1 : 0);
    // ODE takes off a fixed part per step, and only above a threshold: the part that makes kept^t of it.
    dBodySetLinearDampingThreshold(record.body, 0.0);
    dBodySetAngularDampingThreshold(record.body, 0.0);
    dBodySetDamping(record.body, 1.0 - std::pow(body.linearVelocityKept, dt_),
                    1.0 - std::pow(body.angularVelocityKept, dt_));
    record.gravity = body.gravityScale * scenario_.gravity;
    record.ownGravity = body.gravityScale != 1.0;
    if (record.ownGravity) dBodySetGravityMode(record.body, 0);
    if (planar_) {
        const dJointID plane = dJointCreatePlane2D(world_, nullptr);
        dJointAttach(plane, record.body, nullptr);
    }
}

Pose OdeWorld::poseOf(int index) const {
    const auto i = static_cast<std::size_t>(index);
    const BodyRecord& record = *records_[i];
    if (record.body == nullptr) return scenario_.bodies[i].pose;
    const Quat q = quatFromOde(dBodyGetQuaternion(record.body));
    return {fromOde(dBodyGetPosition(record.body)) - rotate(q, record.com), q};
}

BodyState OdeWorld::stateOf(int index) const {
    const Pose pose = poseOf(index);
    BodyState state{pose.position, pose.orientation, {}, {}};
    const BodyRecord& record = *records_[index];
    if (record.body != nullptr) {
        state.velocity = fromOde(dBodyGetLinearVel(record.body));
        state.angularVelocity = fromOde(dBodyGetAngularVel(record.body));
    }
    return state;
}

void OdeWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = stateOf(i);
}

bool OdeWorld::jointHolds(int joint) const {
    return joints_[joint]->holds();
}

void OdeWorld::readContacts(std::vector<adapter::ContactPoint>& contacts) const {
    contacts.clear();
    for (const StepContact& c : contacts_) {
        const auto& shapesA = scenario_.bodies[c.a.body].shapes;
        const auto& shapesB = scenario_.bodies[c.b.body].shapes;
        const adapter::PosedShape a{&shapesA[c.a.shape].geometry, c.poseA};
        const adapter::PosedShape b{&shapesB[c.b.shape].geometry, c.poseB};
        const auto [onA, onB] = adapter::surfacePoints(a, b, c.point.position, c.point.normal, c.point.depth);
        const double sign = c.feedbackOnA ? -dt_ : dt_;
        const Vec3 impulse = sign * fromOde(c.feedback.f1);
        adapter::ContactPoint out;
        out.bodyA = c.a.body;
        out.bodyB = c.b.body;
        out.shapeA = c.a.shape;
        out.shapeB = c.b.shape;
        out.pointA = onA;
        out.pointB = onB;
        out.normal = c.point.normal;
        out.depth = c.point.depth;
        out.hasImpulse = true;
        out.normalImpulse = std::max(0.0, dot(impulse, c.point.normal));
        out.frictionImpulse = impulse - dot(impulse, c.point.normal) * c.point.normal;
        contacts.push_back(out);
    }
}

}  // namespace rigor::ode
