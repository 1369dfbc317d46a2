// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a b2World: building and stepping.
#include "adapters/box2d/world.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/box2d/joints.hpp"
#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/reach.hpp"

namespace rigor::box2d {

using adapter::notInLibrary;
using scenario::BodyType;

namespace {

/// Farther out single precision resolves no better than 0.1 mm.
constexpr double kLargestCoordinate = 1000.0;

/// Box2D's v /= 1 + dt c keeps exactly kept^dt per step with this c.
double dampingFor(double keptPerSecond, double dt) {
    return (std::pow(keptPerSecond, -dt) - 1.0) / dt;
}

void refuseFar(const Vec3& position, const std::string& what) {
    if (std::max(std::abs(position.x), std::abs(position.y)) > kLargestCoordinate)
        throw notInLibrary(
            "box2d",
            "place for " + what + " more than " + std::to_string(kLargestCoordinate) + " m from the origin",
            kSinglePrecision);
}

}  // namespace

Box2dWorld::Box2dWorld(const adapter::Scenario& scenario, double dt, const adapter::Settings& settings)
    : scenario_(adapter::withStiffness(scenario)), settings_(settings), dt_(dt), pairs_(scenario_) {
    scale_ = adapter::numberSetting(settings_, "scale");
    velocityIterations_ = adapter::integerSetting(settings_, "velocity_iterations");
    positionIterations_ = adapter::integerSetting(settings_, "position_iterations");
    shapes_ = shapeSettings();
    ContactRules::Settings rules;
    rules.scale = scale_;
    rules.dt = static_cast<float>(dt_);
    rules.correctRestitution = is("restitution", "corrected");
    rules.restitutionThreshold =
        static_cast<float>(scale_ * adapter::numberSetting(settings_, "restitution_threshold"));
    rules_ = std::make_unique<ContactRules>(pairs_, rules);
    world_ = std::make_unique<b2World>(toBox2d(scenario_.gravity, scale_));
    world_->SetContactFilter(rules_.get());
    world_->SetContactListener(rules_.get());
    world_->SetAllowSleeping(is("sleeping", "on"));
    world_->SetContinuousPhysics(is("continuous", "on"));
    world_->SetWarmStarting(is("warm_starting", "on"));
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) addBody(i);
    const b2BodyDef fixed;
    ground_ = world_->CreateBody(&fixed);
    for (const auto& joint : scenario_.joints) addJoint(joint);
}

bool Box2dWorld::is(const std::string& key, const std::string& value) const {
    return adapter::textSetting(settings_, key) == value;
}

ShapeSettings Box2dWorld::shapeSettings() const {
    ShapeSettings shapes;
    shapes.scale = scale_;
    shapes.skin = is("skin", "least") ? leastSkin() : librarySkin();
    const adapter::Reach reach = adapter::reachOf(scenario_, 50.0, 500.0);
    shapes.halfPlaneCenter = reach.middle;
    shapes.halfPlaneReach = reach.distance;
    return shapes;
}

void Box2dWorld::addBody(int index) {
    const scenario::Body& source = scenario_.bodies[index];
    refuseFar(source.pose.position, "body '" + source.name + "'");
    auto record = std::make_unique<BodyRecord>();
    // Box2D gives a kinematic body no centre of mass of its own: its origin is put there, since the
    // scenario's velocity is that of the centre of mass.
    if (source.type != BodyType::Dynamic) record->frame.position = source.massProperties.centerOfMass;
    const Pose pose = source.pose * record->frame;
    b2BodyDef def;
    def.type = source.type == BodyType::Dynamic     ? b2_dynamicBody
               : source.type == BodyType::Kinematic ? b2_kinematicBody
                                                    : b2_staticBody;
    def.position = toBox2d(pose.position, scale_);
    def.angle = static_cast<float>(angleAboutZ(pose.orientation));
    def.gravityScale = static_cast<float>(source.gravityScale);
    def.linearDamping = static_cast<float>(dampingFor(source.linearVelocityKept, dt_));
    def.angularDamping = static_cast<float>(dampingFor(source.angularVelocityKept, dt_));
    def.allowSleep = is("sleeping", "on");
    def.userData.pointer = reinterpret_cast<uintptr_t>(&record->tag);
    record->body = world_->CreateBody(&def);
    if (source.collides) addFixtures(*record, index);
    if (source.type == BodyType::Dynamic) setMass(*record->body, source);
    if (source.type != BodyType::Static) {
        // Set after the mass: setting the mass moves the velocity with the centre of mass.
        record->body->SetLinearVelocity(toBox2d(source.velocity, scale_));
        record->body->SetAngularVelocity(static_cast<float>(source.angularVelocity.z));
    }
    records_.push_back(std::move(record));
}

void Box2dWorld::addFixtures(BodyRecord& record, int index) {
    const scenario::Body& source = scenario_.bodies[index];
    const Pose toBody = inverse(record.frame);
    for (std::size_t i = 0; i < source.shapes.size(); ++i) {
        const scenario::Shape& shape = source.shapes[i];
        auto tag = std::make_unique<FixtureTag>(
            FixtureTag{index, static_cast<int>(i), shape.material, nullptr, toBody});
        if (shape.surfaceVelocity.moves()) tag->source = &shape;
        for (const auto& part :
             buildGeometry(shape.geometry, toBody * shape.pose, source.pose * record.frame, shapes_)) {
            b2FixtureDef fixture;
            fixture.shape = part.get();
            fixture.density = 0.0f;  // the mass is given as a whole
            fixture.userData.pointer = reinterpret_cast<uintptr_t>(tag.get());
            // Box2D copies a chain without its radius.
            record.body->CreateFixture(&fixture)->GetShape()->m_radius = part->m_radius;
        }
        record.fixtureTags.push_back(std::move(tag));
    }
}

/// b2MassData's inertia is about the body's origin; Box2D takes m c^2 off again, in single precision, and
/// aborts when nothing is left.
void Box2dWorld::setMass(b2Body& body, const scenario::Body& source) const {
    const auto& properties = source.massProperties;
    const Vec3 c = properties.centerOfMass;
    const double central = properties.inertia(2, 2);
    b2MassData data;
    data.mass = static_cast<float>(properties.mass);
    data.center = toBox2d(c, scale_);
    data.I = static_cast<float>(scale_ * scale_ * (central + properties.mass * dot(c, c)));
    const float left = data.I - data.mass * b2Dot(data.center, data.center);
    const double wanted = scale_ * scale_ * central;
    if (!(data.mass > 0.0f) || !(std::abs(left - wanted) < 1e-3 * wanted))
        throw notInLibrary("box2d", "number for the inertia about the body's origin", kSinglePrecision,
                           "body '" + source.name + "'");
    body.SetMassData(&data);
}

void Box2dWorld::addJoint(const scenario::Joint& joint) {
    const auto endOf = [&](int index) {
        if (index == scenario::kNone) return JointEnd{ground_, {}, {}};
        const BodyRecord& record = *records_[index];
        return JointEnd{record.body, record.frame, scenario_.bodies[index].pose};
    };
    joints_.push_back(box2d::addJoint(*world_, joint, endOf(joint.bodyA), endOf(joint.bodyB), scale_));
}

/// This follows the manual: after a step the reaction is compared with the strength, and the joint destroyed.
void Box2dWorld::breakJoints() {
    bool any = false;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const scenario::Joint& joint = scenario_.joints[i];
        if (joints_[i].empty() || (joint.breakForce > 1e299 && joint.breakTorque > 1e299)) continue;
        const Reaction reaction = reactionOf(joints_[i], dt_, scale_);
        if (reaction.force <= joint.breakForce && reaction.torque <= joint.breakTorque) continue;
        for (b2Joint* part : joints_[i]) world_->DestroyJoint(part);
        joints_[i].clear();
        any = true;
    }
    if (any) collidePairsOfBrokenJoints();
}

/// Lets bodies that a joint kept from colliding collide once it has broken. Box2D finds new pairs only of
/// fixtures that have moved or are marked to be filtered again.
void Box2dWorld::collidePairsOfBrokenJoints() {
    pairs_.keepApart(scenario_, [&](std::size_t joint) { return !joints_[joint].empty(); });
    for (auto& record : records_)
        for (b2Fixture* f = record->body->GetFixtureList(); f != nullptr; f = f->GetNext()) f->Refilter();
}

void Box2dWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    BodyRecord& record = *records_[body];
    const b2Vec2 f = toBox2d(force, scale_);
    const auto t = static_cast<float>(scale_ * scale_ * torque.z);
    record.body->ApplyForceToCenter(f, true);
    record.body->ApplyTorque(t, true);
    record.tag.force += f;
    record.tag.torque += t;
}

void Box2dWorld::step() {
    before_.resize(records_.size());
    for (std::size_t i = 0; i < records_.size(); ++i) before_[i] = records_[i]->body->GetTransform();
    world_->Step(static_cast<float>(dt_), velocityIterations_, positionIterations_);
    for (auto& record : records_) record->tag = BodyTag{};
    breakJoints();
    ++steps_;
}

}  // namespace rigor::box2d
