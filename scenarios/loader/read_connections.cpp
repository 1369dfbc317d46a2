// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints, forces and events: everything that refers to bodies by name.
#include <cmath>
#include <set>

#include "scenarios/loader/node.hpp"

namespace rigor::scenario {
namespace {

Pose poseOf(const Scenario& scenario, int body) {
    return body == kNone ? Pose{} : scenario.bodies[static_cast<std::size_t>(body)].pose;
}

JointType readJointType(const Node& node) {
    for (const JointType type :
         {JointType::Ball, JointType::Hinge, JointType::Slider, JointType::Fixed, JointType::Distance})
        if (node.text() == jointName(type)) return type;
    node.problem("joint.type", "one of ball, hinge, slider, fixed, distance");
    return JointType::Ball;
}

/// "anchor" is a world point for both bodies; "anchor_a" and "anchor_b" are in the bodies' frames.
void readAnchors(const Node& node, const Scenario& scenario, Joint& joint) {
    const Pose poseA = poseOf(scenario, joint.bodyA), poseB = poseOf(scenario, joint.bodyB);
    if (const auto world = node.find("anchor")) {
        if (node.has("anchor_a") || node.has("anchor_b"))
            node.problem("joint.anchor", "anchor beside anchor_a or anchor_b", "one way of saying it");
        const Vec3 point = world->vector();
        joint.anchorA = inverse(poseA) * point;
        joint.anchorB = inverse(poseB) * point;
    } else {
        const auto a = node.require("anchor_a"), b = node.require("anchor_b");
        if (a) joint.anchorA = a->vector();
        if (b) joint.anchorB = b->vector();
    }
    const double gap = norm(poseA * joint.anchorA - poseB * joint.anchorB);
    if (joint.type != JointType::Distance && gap > 1e-9 * (1.0 + norm(poseB.position)))
        node.problem("joint.anchor", "anchors " + std::to_string(gap) + " m apart",
                     "anchors that coincide at the start");
    if (joint.type == JointType::Distance) {
        joint.length = gap;
        if (const auto length = node.find("length")) joint.length = length->positive();
        if (std::abs(gap - joint.length) > 1e-9 * (1.0 + joint.length) || joint.length <= 0.0)
            node.problem("joint.length", "anchors " + std::to_string(gap) + " m apart",
                         "anchors one rod length (> 0) apart at the start");
    } else if (node.has("length")) {
        node["length"].problem("joint.length", "none: only distance joints have a length");
    }
}

void readAxis(const Node& node, const Scenario& scenario, Joint& joint) {
    const bool needed =
        joint.type == JointType::Slider || (joint.type == JointType::Hinge && node.dimension() == 3);
    const auto axis = node.find("axis");
    if (axis && !needed) axis->problem("joint.axis", "none: this joint has no axis of its own");
    if (!needed) return;
    if (!axis) {
        node.problem("schema.missing_key", "no key 'axis'", "the world direction of the joint's axis");
        return;
    }
    const Vec3 world = axis->unitVector();
    joint.axisA = rotateInverse(poseOf(scenario, joint.bodyA).orientation, world);
    joint.axisB = rotateInverse(poseOf(scenario, joint.bodyB).orientation, world);
}

bool isDynamic(const Scenario& scenario, int body) {
    return body != kNone && scenario.bodies[static_cast<std::size_t>(body)].type == BodyType::Dynamic;
}

int readDynamicBody(const Node& node, const Scenario& scenario) {
    const int body = readBodyName(node, scenario, false);
    if (findBody(scenario, node.json().is_string() ? node.json().get<std::string>() : "") != kNone &&
        !isDynamic(scenario, body))
        node.problem("body.not_dynamic", "a dynamic body");
    return body;
}

Force readConstant(const Node& node, const Scenario& scenario) {
    node.isObject({"body", "force", "torque", "start", "end"});
    ConstantForce f;
    if (const auto n = node.require("body")) f.body = readDynamicBody(*n, scenario);
    if (const auto n = node.find("force")) f.force = n->vector();
    if (const auto n = node.find("torque")) f.torque = n->angularVector();
    if (const auto n = node.find("start")) f.start = n->number(0.0, 1e6);
    if (const auto n = node.find("end")) f.end = n->number(0.0, 1e6);
    if (!(f.end > f.start)) node.problem("force.interval", "end <= start", "an interval of time");
    return f;
}

Force readSpring(const Node& node, const Scenario& scenario) {
    node.isObject({"a", "b", "anchor_a", "anchor_b", "stiffness", "damping", "rest_length"});
    SpringForce f;
    if (const auto n = node.require("a")) f.bodyA = readBodyName(*n, scenario, true);
    if (const auto n = node.require("b")) f.bodyB = readDynamicBody(*n, scenario);
    if (f.bodyA == f.bodyB)
        node.problem("force.bodies", "a spring from a body to itself", "two bodies, or a body and \"world\"");
    if (const auto n = node.find("anchor_a")) f.anchorA = n->vector();
    if (const auto n = node.find("anchor_b")) f.anchorB = n->vector();
    if (const auto n = node.require("stiffness")) f.stiffness = n->number(0.0, 1e12);
    if (const auto n = node.find("damping")) f.damping = n->number(0.0, 1e12);
    if (const auto n = node.find("rest_length")) f.restLength = n->number(0.0, 1e6);
    return f;
}

Force readDrag(const Node& node, const Scenario& scenario) {
    node.isObject({"body", "coefficient"});
    DragForce f;
    if (const auto n = node.require("body")) f.body = readDynamicBody(*n, scenario);
    if (const auto n = node.require("coefficient")) f.coefficient = n->number(0.0, 1e12);
    return f;
}

}  // namespace

void readJoints(const Node& list, Scenario& scenario) {
    for (const Node& node : list.items()) {
        node.isObject({"name", "type", "a", "b", "anchor", "anchor_a", "anchor_b", "axis", "length",
                       "collide_connected"});
        Joint joint;
        const auto name = node.require("name"), type = node.require("type"), a = node.require("a"),
                   b = node.require("b");
        if (!name || !type || !a || !b) continue;
        const auto clean = node.context().problems.size();
        joint.name = name->name();
        for (const Joint& other : scenario.joints)
            if (other.name == joint.name) name->problem("joint.duplicate", "a name that no other joint has");
        joint.type = readJointType(*type);
        if (joint.type == JointType::Ball && node.dimension() == 2)
            type->problem("joint.type", "hinge: a ball joint in the plane is one");
        joint.bodyA = readBodyName(*a, scenario, true);
        joint.bodyB = readBodyName(*b, scenario, false);
        if (node.context().problems.size() > clean) continue;  // the rest would only repeat it
        if (joint.bodyA == joint.bodyB)
            node.problem("joint.bodies", "a body joined to itself", "two bodies, or \"world\" as a");
        if (!isDynamic(scenario, joint.bodyA) && !isDynamic(scenario, joint.bodyB))
            node.problem("joint.bodies", "no dynamic body", "at least one dynamic body");
        readAnchors(node, scenario, joint);
        readAxis(node, scenario, joint);
        if (const auto n = node.find("collide_connected")) joint.collideConnected = n->boolean();
        scenario.joints.push_back(joint);
    }
}

void readForces(const Node& list, Scenario& scenario) {
    for (const Node& node : list.items()) {
        node.isObject({"constant", "spring", "drag"});
        if (node.json().is_object() && node.json().size() != 1)
            node.problem("force.count", "one of constant, spring, drag");
        if (const auto n = node.find("constant")) scenario.forces.push_back(readConstant(*n, scenario));
        if (const auto n = node.find("spring")) scenario.forces.push_back(readSpring(*n, scenario));
        if (const auto n = node.find("drag")) scenario.forces.push_back(readDrag(*n, scenario));
    }
}

void readEvents(const Node& list, Scenario& scenario) {
    for (const Node& node : list.items()) {
        node.isObject({"time", "body", "impulse", "angular_impulse"});
        Event event;
        if (const auto n = node.require("time")) event.time = n->number(0.0, 1e6);
        if (const auto n = node.require("body")) event.body = readDynamicBody(*n, scenario);
        if (const auto n = node.find("impulse")) event.impulse = n->vector();
        if (const auto n = node.find("angular_impulse")) event.angularImpulse = n->angularVector();
        scenario.events.push_back(event);
    }
}

}  // namespace rigor::scenario
