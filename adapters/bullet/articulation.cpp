// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conventions of btMultiBody (Bullet 3.24), found by experiment: rotations of links go from the parent's
// frame to the link's; offsets are in the parent's frame up to the joint and in the link's from it; a
// spherical joint's velocity is in the link's frame, and so is that of a planar one (setupPlanar), whose body
// gains speed where it turns; the cached poses lag by a step until forwardKinematics; tree velocities are in
// the links' frames.
#include "adapters/bullet/articulation.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyFixedConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "adapters/bullet/convert.hpp"
#include "adapters/bullet/six_dof.hpp"

namespace rigor::bullet {

using adapter::Scenario;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointType;

/// A joint of the tree: from its parent (kNone: the fixed base) to its child; `turned` where the child is the
/// joint's A.
struct Articulations::Edge {
    const Joint* joint = nullptr;
    int parent = scenario::kNone, child = scenario::kNone;
    bool turned = false;
};
/// The links by which a body floats in 2D.
constexpr int kRootLinks = 3;

struct Articulations::Tree {
    int base = scenario::kNone;  ///< a body; kNone: fixed
    std::vector<Edge> edges;     ///< parents before children
    std::vector<const Joint*> loops;
};

namespace {

bool moves(const Scenario& scenario, int body) {
    return body != scenario::kNone && scenario.bodies[body].type == BodyType::Dynamic;
}

void refuseMissing(const Joint& joint, const Scenario& scenario) {
    const auto refuse = [&](const std::string& what) {
        throw adapter::notInAdapter("bullet", what + " of a btMultiBody", "joint '" + joint.name + "'");
    };
    const bool known = joint.type == JointType::Ball || joint.type == JointType::Hinge ||
                       joint.type == JointType::Slider || joint.type == JointType::Fixed;
    if (!known)
        throw adapter::notInLibrary(
            "bullet", std::string("joint '") + jointName(joint.type) + "' of a btMultiBody",
            "btMultiBodyLink.h, enum eFeatherstoneJointType", "joint '" + joint.name + "'");
    for (const auto& axis : joint.axes) {
        const bool driven = axis.hasMotor() || axis.hasSpring() || axis.mode == scenario::AxisMode::Limited;
        if (joint.type == JointType::Ball && driven) refuse("limit, motor or spring of a spherical joint");
    }
    if (joint.breakForce < 1e299 || joint.breakTorque < 1e299) refuse("breaking joint");
    for (const int body : {joint.bodyA, joint.bodyB})
        if (body != scenario::kNone && scenario.bodies[body].type == BodyType::Kinematic)
            throw adapter::notInAdapter("bullet", "btMultiBody on a kinematic body",
                                        "joint '" + joint.name + "'");
}

btScalar scalar(double x) {
    return static_cast<btScalar>(x);
}

}  // namespace

std::vector<bool> Articulations::linkedBodies(const Scenario& scenario) {
    std::vector<bool> linked(scenario.bodies.size());
    for (const Joint& joint : scenario.joints) {
        refuseMissing(joint, scenario);
        for (const int body : {joint.bodyA, joint.bodyB})
            if (moves(scenario, body)) linked[body] = true;
    }
    for (std::size_t i = 0; i < linked.size(); ++i) {
        const scenario::Body& body = scenario.bodies[i];
        if (linked[i] && (body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0))
            throw adapter::notInLibrary("bullet", "damping of single links of a btMultiBody",
                                        "btMultiBody.h, setLinearDamping: one value for all links",
                                        "body '" + body.name + "'");
    }
    return linked;
}

Articulations::Articulations(const Scenario& scenario, std::vector<LinkSource> sources,
                             btMultiBodyDynamicsWorld& world, const ArticulationSettings& settings)
    : scenario_(scenario),
      sources_(std::move(sources)),
      world_(world),
      settings_(settings),
      links_(scenario.bodies.size()) {
    const std::vector<bool> linked = linkedBodies(scenario);
    std::vector<bool> placed(linked.size());
    std::vector<bool> used(scenario.joints.size());
    // Breadth first over joints in the scenario's order, from the world, then from each body still left.
    const auto grow = [&](int base) {
        Tree tree;
        tree.base = base;
        std::deque<int> open{base};
        if (base != scenario::kNone) placed[base] = true;
        while (!open.empty()) {
            const int parent = open.front();
            open.pop_front();
            for (std::size_t j = 0; j < scenario.joints.size(); ++j) {
                const Joint& joint = scenario.joints[j];
                const auto standsFor = [&](int body) {
                    return parent == scenario::kNone ? !moves(scenario, body) : body == parent;
                };
                const bool fromA = standsFor(joint.bodyA);
                if (used[j] || (!fromA && !standsFor(joint.bodyB))) continue;
                const int child = fromA ? joint.bodyB : joint.bodyA;
                used[j] = true;
                if (!moves(scenario, child)) {
                    if (parent != scenario::kNone) tree.loops.push_back(&joint);
                } else if (placed[child]) {
                    tree.loops.push_back(&joint);
                } else {
                    placed[child] = true;
                    tree.edges.push_back({&joint, parent, child, !fromA});
                    open.push_back(child);
                }
            }
        }
        if (base != scenario::kNone || !tree.edges.empty()) build(tree);
    };
    grow(scenario::kNone);
    for (std::size_t i = 0; i < linked.size(); ++i)
        if (linked[i] && !placed[i]) grow(i);
    update();
}

Articulations::~Articulations() {
    for (auto& constraint : constraints_) world_.removeMultiBodyConstraint(constraint.get());
    for (auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    for (auto& multiBody : multiBodies_) world_.removeMultiBody(multiBody.get());
}

btTransform Articulations::startPose(int body) const {
    if (!moves(scenario_, body)) return btTransform::getIdentity();
    const auto i = static_cast<std::size_t>(body);
    return toBullet(scenario_.bodies[i].pose * sources_[i].comFrame);
}

void Articulations::build(const Tree& tree) {
    const bool held = tree.base == scenario::kNone, rooted = !held && settings_.planar;
    const bool fixed = held || rooted;
    const auto base = static_cast<std::size_t>(std::max(tree.base, 0));
    const int first = rooted ? kRootLinks : 0;
    const btScalar mass = fixed ? btScalar(0) : scalar(scenario_.bodies[base].massProperties.mass);
    multiBodies_.push_back(std::make_unique<btMultiBody>(first + static_cast<int>(tree.edges.size()), mass,
                                                         fixed ? btVector3(0, 0, 0) : sources_[base].moments,
                                                         fixed, settings_.maySleep));
    btMultiBody& multiBody = *multiBodies_.back();
    multiBody.setBaseWorldTransform(fixed ? btTransform::getIdentity() : startPose(tree.base));
    if (!held) links_[base] = {&multiBody, first - 1};
    if (rooted) addFloatingRoot(multiBody, tree.base);
    const auto linkOf = [first](std::size_t edge) { return first + static_cast<int>(edge); };
    for (std::size_t i = 0; i < tree.edges.size(); ++i) {
        links_[tree.edges[i].child] = {&multiBody, linkOf(i)};
        addLink(multiBody, linkOf(i), tree.edges[i]);
    }
    multiBody.finalizeMultiDof();
    multiBody.setHasSelfCollision(true);  // the pair filter decides
    multiBody.setLinearDamping(scalar(settings_.damping));
    multiBody.setAngularDamping(scalar(settings_.damping));
    multiBody.setMaxCoordinateVelocity(scalar(settings_.maximalVelocity));
    multiBody.setUseGyroTerm(settings_.gyroscopic);
    multiBody.useRK4Integration(settings_.rungeKutta);
    if (!fixed) {
        multiBody.setBaseVel(toBullet(scenario_.bodies[base].velocity));
        multiBody.setBaseOmega(toBullet(scenario_.bodies[base].angularVelocity));
    }
    if (rooted) {
        const scenario::Body& body = scenario_.bodies[base];
        multiBody.setJointVel(0, scalar(body.velocity.x));
        multiBody.setJointVel(1, scalar(body.velocity.y));
        multiBody.setJointVel(2, scalar(body.angularVelocity.z));
    }
    for (std::size_t i = 0; i < tree.edges.size(); ++i) setCoordinates(multiBody, linkOf(i), tree.edges[i]);
    world_.addMultiBody(&multiBody);
    if (!held) addCollider(tree.base);
    for (const Edge& edge : tree.edges) addCollider(edge.child);
    for (std::size_t i = 0; i < tree.edges.size(); ++i) addDrives(multiBody, linkOf(i), tree.edges[i]);
    for (const Joint* joint : tree.loops) closeLoop(multiBody, *joint);
}

/// Two links without mass that travel, then the body on a hinge: in frames that do not turn, where the
/// velocity of free flight stays as it is.
void Articulations::addFloatingRoot(btMultiBody& multiBody, int body) {
    const auto i = static_cast<std::size_t>(body);
    const btTransform pose = startPose(body);
    const btQuaternion straight = btQuaternion::getIdentity();
    const btVector3 none(0, 0, 0);
    multiBody.setupPrismatic(0, 0, none, -1, straight, btVector3(1, 0, 0), pose.getOrigin(), none, false);
    multiBody.setupPrismatic(1, 0, none, 0, straight, btVector3(0, 1, 0), none, none, false);
    multiBody.setupRevolute(2, scalar(scenario_.bodies[i].massProperties.mass), sources_[i].moments, 1,
                            pose.getRotation().inverse(), pose.getBasis().transpose() * btVector3(0, 0, 1),
                            none, none);
}

void Articulations::addLink(btMultiBody& multiBody, int index, const Edge& edge) {
    const Joint& joint = *edge.joint;
    const auto child = static_cast<std::size_t>(edge.child);
    const scenario::Body& body = scenario_.bodies[child];
    const btTransform parentPose = startPose(edge.parent), childPose = startPose(edge.child);
    const btVector3 anchor = toBullet(body.pose * (edge.turned ? joint.anchorA : joint.anchorB));
    const btVector3 axis = toBullet(rotate(body.pose.orientation, edge.turned ? joint.axisA : joint.axisB));
    const btVector3 axisHere = childPose.getBasis().transpose() * axis;
    const btQuaternion turn = childPose.getRotation().inverse() * parentPose.getRotation();
    const btVector3 toJoint = parentPose.inverse() * anchor;
    const btVector3 fromJoint = -(childPose.inverse() * anchor);
    const btScalar mass = scalar(body.massProperties.mass);
    const btVector3& moments = sources_[child].moments;
    const int parent = edge.parent == scenario::kNone ? -1 : links_[edge.parent].index;
    if (joint.type == JointType::Hinge || (joint.type == JointType::Ball && settings_.planar))
        multiBody.setupRevolute(index, mass, moments, parent, turn, axisHere, toJoint, fromJoint);
    else if (joint.type == JointType::Slider)
        multiBody.setupPrismatic(index, mass, moments, parent, turn, axisHere, toJoint, fromJoint, false);
    else if (joint.type == JointType::Ball)
        multiBody.setupSpherical(index, mass, moments, parent, turn, toJoint, fromJoint);
    else
        multiBody.setupFixed(index, mass, moments, parent, turn, toJoint, fromJoint, false);
}

/// The rates of the joint's coordinates, from the velocities of its bodies; they have to agree with the
/// joint.
void Articulations::setCoordinates(btMultiBody& multiBody, int index, const Edge& edge) {
    const Joint& joint = *edge.joint;
    const scenario::Body& body = scenario_.bodies[edge.child];
    const Vec3 anchor = body.pose * (edge.turned ? joint.anchorA : joint.anchorB);
    const auto at = [&](int i) {
        if (!moves(scenario_, i)) return Vec3{};
        const scenario::Body& b = scenario_.bodies[i];
        return b.velocity + cross(b.angularVelocity, anchor - b.pose * b.massProperties.centerOfMass);
    };
    const auto turnOf = [&](int i) {
        return moves(scenario_, i) ? scenario_.bodies[i].angularVelocity : Vec3{};
    };
    const Vec3 axis = rotate(body.pose.orientation, edge.turned ? joint.axisA : joint.axisB);
    const Vec3 turn = turnOf(edge.child) - turnOf(edge.parent);
    const bool planarBall = joint.type == JointType::Ball && settings_.planar;
    if (joint.type == JointType::Hinge || planarBall) multiBody.setJointVel(index, scalar(dot(turn, axis)));
    if (joint.type == JointType::Slider)
        multiBody.setJointVel(index, scalar(dot(at(edge.child) - at(edge.parent), axis)));
    if (joint.type == JointType::Ball && !planarBall) {
        const btVector3 here = startPose(edge.child).getBasis().transpose() * toBullet(turn);
        const btScalar rates[] = {here.x(), here.y(), here.z()};
        multiBody.setJointVelMultiDof(index, rates);
    }
}

/// Limits, motors and springs; the coordinate of a turned joint runs backwards.
void Articulations::addDrives(btMultiBody& multiBody, int index, const Edge& edge) {
    const scenario::JointAxis& axis = edge.joint->axes[0];
    const double sign = edge.turned ? -1.0 : 1.0;
    if (axis.mode == scenario::AxisMode::Limited) {
        const auto bound = [](double x) { return std::clamp(x, -1e9, 1e9); };
        const double lower = edge.turned ? -bound(axis.upper) : bound(axis.lower);
        const double upper = edge.turned ? -bound(axis.lower) : bound(axis.upper);
        addConstraint(std::make_unique<btMultiBodyJointLimitConstraint>(&multiBody, index, scalar(lower),
                                                                        scalar(upper)));
    }
    if (axis.hasMotor())
        addConstraint(std::make_unique<btMultiBodyJointMotor>(
            &multiBody, index, scalar(sign * axis.motorSpeed), scalar(axis.motorMaxForce * settings_.dt)));
    if (!axis.hasSpring()) return;
    springs_.push_back({&multiBody, index, axis.stiffness, axis.damping, sign * axis.target});
}

void Articulations::pullSprings() {
    for (const Spring& spring : springs_) {
        btMultiBody& multiBody = *spring.multiBody;
        const btScalar stretch = multiBody.getJointPos(spring.index) - scalar(spring.target);
        const btScalar pull =
            scalar(spring.stiffness) * stretch + scalar(spring.damping) * multiBody.getJointVel(spring.index);
        multiBody.addJointTorque(spring.index, -pull);
    }
}

/// A ball joint is one coincident point, a hinge two of its axis (one row of six is then redundant), in 2D
/// one.
void Articulations::closeLoop(btMultiBody& multiBody, const Joint& joint) {
    // The first end is one that moves.
    const bool fromB = moves(scenario_, joint.bodyB);
    const int first = fromB ? joint.bodyB : joint.bodyA, second = fromB ? joint.bodyA : joint.bodyB;
    const Pose& pose = scenario_.bodies[first].pose;
    const Vec3 anchor = pose * (fromB ? joint.anchorB : joint.anchorA);
    const Vec3 axis = rotate(pose.orientation, fromB ? joint.axisB : joint.axisA);
    const auto linkOf = [&](int body) { return moves(scenario_, body) ? links_[body].index : -1; };
    const btTransform poseA = startPose(first), poseB = startPose(second);
    const auto pin = [&](const Vec3& point) {
        addConstraint(std::make_unique<btMultiBodyPoint2Point>(
            &multiBody, linkOf(first), &multiBody, linkOf(second), poseA.inverse() * toBullet(point),
            poseB.inverse() * toBullet(point)));
    };
    const scenario::JointAxis& drive = joint.axes[0];
    if (drive.hasMotor() || drive.hasSpring() || drive.mode == scenario::AxisMode::Limited)
        throw adapter::notInAdapter("bullet",
                                    "limit, motor or spring of a joint that closes a loop of a btMultiBody",
                                    "joint '" + joint.name + "'");
    if (joint.type == JointType::Ball || (joint.type == JointType::Hinge && settings_.planar)) {
        pin(anchor);
    } else if (joint.type == JointType::Hinge) {
        pin(anchor + 0.5 * axis);
        pin(anchor - 0.5 * axis);
    } else {
        throw adapter::notInAdapter(
            "bullet", std::string("loop of a btMultiBody closed by a '") + jointName(joint.type) + "'",
            "joint '" + joint.name + "'");
    }
    ++loops_;
}

void Articulations::addConstraint(std::unique_ptr<btMultiBodyConstraint> constraint) {
    constraint->finalizeMultiDof();
    world_.addMultiBodyConstraint(constraint.get());
    constraints_.push_back(std::move(constraint));
}

void Articulations::addCollider(int body) {
    const auto i = static_cast<std::size_t>(body);
    Link& link = links_[i];
    auto collider = std::make_unique<btMultiBodyLinkCollider>(link.multiBody, link.index);
    collider->setCollisionShape(sources_[i].shape);
    collider->setWorldTransform(startPose(body));
    collider->setUserPointer(sources_[i].tag);
    collider->setCollisionFlags(collider->getCollisionFlags() |
                                btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    collider->setContactProcessingThreshold(sources_[i].contactProcessingThreshold);
    if (!settings_.maySleep) collider->setActivationState(DISABLE_DEACTIVATION);
    if (link.index < 0)
        link.multiBody->setBaseCollider(collider.get());
    else
        link.multiBody->getLink(link.index).m_collider = collider.get();
    world_.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    colliders_.push_back(std::move(collider));
}

void Articulations::update() {
    btAlignedObjectArray<btQuaternion> rotations;
    btAlignedObjectArray<btVector3> origins;
    std::vector<btVector3> turns, velocities;
    for (auto& multiBody : multiBodies_) {
        multiBody->forwardKinematics(rotations, origins);
        const auto count = static_cast<std::size_t>(multiBody->getNumLinks()) + 1;
        turns.resize(count);
        velocities.resize(count);
        multiBody->compTreeLinkVelocities(turns.data(), velocities.data());
        for (Link& link : links_) {
            if (link.multiBody != multiBody.get()) continue;
            const auto slot = static_cast<std::size_t>(link.index + 1);
            link.pose = link.index < 0 ? multiBody->getBaseWorldTransform()
                                       : multiBody->getLink(link.index).m_cachedWorldTransform;
            link.velocity = link.pose.getBasis() * velocities[slot];
            link.angularVelocity = link.pose.getBasis() * turns[slot];
        }
    }
}

btTransform Articulations::pose(int body) const {
    return links_[body].pose;
}
btVector3 Articulations::velocity(int body) const {
    return links_[body].velocity;
}
btVector3 Articulations::angularVelocity(int body) const {
    return links_[body].angularVelocity;
}
double Articulations::mass(int body) const {
    const Link& link = links_[body];
    return static_cast<double>(link.index < 0 ? link.multiBody->getBaseMass()
                                              : link.multiBody->getLinkMass(link.index));
}
btVector3 Articulations::moments(int body) const {
    const Link& link = links_[body];
    return link.index < 0 ? link.multiBody->getBaseInertia() : link.multiBody->getLinkInertia(link.index);
}

void Articulations::addForce(int body, const btVector3& force, const btVector3& torque) {
    Link& link = links_[body];
    link.multiBody->wakeUp();
    if (link.index < 0) {
        link.multiBody->addBaseForce(force);
        link.multiBody->addBaseTorque(torque);
        return;
    }
    link.multiBody->addLinkForce(link.index, force);
    link.multiBody->addLinkTorque(link.index, torque);
}

bool Articulations::asleep(int body) const {
    return !links_[body].multiBody->isAwake();
}

}  // namespace rigor::bullet
