// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints, forces and events: everything that refers to bodies by name.
#include <cmath>
#include <set>

#include "scenarios/loader/read_parts.hpp"

namespace rigor::scenario {
namespace {

Pose poseOf(const Scenario& scenario, int body) {
    return body == kNone ? Pose{} : scenario.bodies[body].pose;
}

JointType readJointType(const Node& node) {
    for (const JointType type : kJointTypes)
        if (node.text() == jointName(type)) return type;
    node.problem("joint.type", "one of ball, hinge, slider, fixed, distance, cone_twist, six_dof, wheel");
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
        const bool rod = joint.axes[0].mode == AxisMode::Usual || joint.axes[0].mode == AxisMode::Locked;
        if ((rod && std::abs(gap - joint.length) > 1e-9 * (1.0 + joint.length)) || joint.length <= 0.0)
            node.problem("joint.length", "anchors " + std::to_string(gap) + " m apart",
                         "anchors one rod length (> 0) apart at the start");
    } else if (node.has("length")) {
        node["length"].problem("joint.length", "none: only distance joints have a length");
    }
}

void readAxis(const Node& node, const Scenario& scenario, Joint& joint) {
    const bool solid = node.dimension() == 3;
    const bool cone = joint.type == JointType::Ball && joint.axes[0].mode != AxisMode::Usual;
    const bool needed = joint.type == JointType::Slider || joint.type == JointType::Wheel ||
                        joint.type == JointType::SixDof || joint.type == JointType::ConeTwist || cone ||
                        (joint.type == JointType::Hinge && solid);
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
    const auto second = [&](const char* key, JointType type) -> std::optional<Vec3> {
        if (joint.type != type || !solid) return std::nullopt;
        if (const auto n = node.find(key)) return n->unitVector();
        node.problem("schema.missing_key", std::string("no key '") + key + "'",
                     "a second world direction of the joint");
        return std::nullopt;
    };
    if (const auto normal = second("normal", JointType::SixDof)) {
        if (std::abs(dot(*normal, world)) > 1e-6)
            node["normal"].problem("joint.axis", "a direction normal to the axis");
        joint.normalA = rotateInverse(poseOf(scenario, joint.bodyA).orientation, *normal);
    }
    if (const auto spin = second("spin_axis", JointType::Wheel))
        joint.spinAxisB = rotateInverse(poseOf(scenario, joint.bodyB).orientation, *spin);
}

bool isAngle(const std::string& axis) {
    return axis == "angle" || axis.starts_with("twist") || axis.starts_with("swing");
}

void readLimits(const Node& node, JointAxis& axis) {
    axis.mode = AxisMode::Limited;
    const auto ends = node.items();
    if (ends.size() != 2) {
        node.problem("joint.limits", "[lower, upper]; null: none on that side");
        return;
    }
    if (!ends[0].json().is_null()) axis.lower = ends[0].number(-1e6, 1e6);
    if (!ends[1].json().is_null()) axis.upper = ends[1].number(-1e6, 1e6);
    if (!(axis.lower <= axis.upper)) node.problem("joint.limits", "lower <= upper");
}

void readMotor(const Node& node, bool angle, JointAxis& axis) {
    const char* most = angle ? "max_torque" : "max_force";
    node.isObject({"speed", most});
    if (const auto n = node.require("speed")) axis.motorSpeed = n->number(-1e6, 1e6);
    if (const auto n = node.require(most)) axis.motorMaxForce = n->positive();
}

void readJointSpring(const Node& node, JointAxis& axis) {
    node.isObject({"frequency", "damping_ratio", "stiffness", "damping", "target"});
    if (node.has("frequency") == node.has("stiffness"))
        node.problem("joint.spring", "frequency (and damping_ratio), or stiffness (and damping)");
    if (node.has(node.has("frequency") ? "damping" : "damping_ratio"))
        node.problem("joint.spring", "damping_ratio with frequency, damping with stiffness");
    if (const auto n = node.find("frequency")) axis.frequency = n->positive();
    if (const auto n = node.find("damping_ratio")) axis.dampingRatio = n->number(0.0, 1e6);
    if (const auto n = node.find("stiffness")) axis.stiffness = n->number(0.0, 1e12);
    if (const auto n = node.find("damping")) axis.damping = n->number(0.0, 1e12);
    if (node.has("stiffness") && axis.stiffness == 0.0 && axis.damping == 0.0)
        node.problem("joint.spring", "a stiffness or a damping above 0");
    if (const auto n = node.find("target")) axis.target = n->number(-1e6, 1e6);
}

/// "limits", "motor", "spring" of an object: the joint itself, or one of its "axes".
void readControl(const Node& node, const std::string& name, const Joint& joint, JointAxis& axis) {
    if (const auto n = node.find("limits")) readLimits(*n, axis);
    if (const auto n = node.find("motor")) readMotor(*n, isAngle(name), axis);
    if (const auto n = node.find("spring")) readJointSpring(*n, axis);
    // A coordinate with a motor or a spring is not locked by default.
    if (axis.mode == AxisMode::Usual && (axis.hasMotor() || axis.hasSpring())) axis.mode = AxisMode::Free;
    if (axis.mode == AxisMode::Limited && axis.lower == axis.upper && (axis.hasMotor() || axis.hasSpring()))
        node.problem("joint.limits", "lower < upper where there is a motor or spring");
    const bool cone =
        joint.type == JointType::Ball || (joint.type == JointType::ConeTwist && name == "swing");
    if (cone && axis.hasMotor()) node["motor"].problem("joint.motor", "none: a cone has no motor");
    if (cone && axis.target != 0.0) node["spring"].problem("joint.spring", "no target: it pulls to zero");
    if (cone && axis.mode == AxisMode::Limited &&
        !(axis.upper > 0.0 && axis.upper < 3.14159 && axis.lower <= 0.0))
        node["limits"].problem("joint.limits", "[null, half angle of the cone in (0, pi)]");
    if (joint.type == JointType::Distance && axis.mode == AxisMode::Limited && !(axis.upper > 0.0))
        node["limits"].problem("joint.limits", "a longest distance > 0");
}

void readAxes(const Node& node, Joint& joint) {
    const int dimension = node.dimension();
    const bool single = jointAxisName(joint.type, dimension, 0) && !jointAxisName(joint.type, dimension, 1) &&
                        joint.type != JointType::Ball;
    for (const char* key : {"limits", "motor", "spring"})
        if (node.has(key) && !single)
            node[key].problem("joint.axes", "none here: name the coordinate in 'axes', if the joint has any");
    if (single) readControl(node, jointAxisName(joint.type, dimension, 0), joint, joint.axes[0]);
    const auto axes = node.find("axes");
    if (!axes) return;
    std::string known;
    for (std::size_t k = 0; const char* name = jointAxisName(joint.type, dimension, k); ++k)
        known += (known.empty() ? "" : ", ") + std::string(name);
    for (const auto& [name, control] : axes->members()) {
        std::size_t k = 0;
        const char* axis = nullptr;
        while ((axis = jointAxisName(joint.type, dimension, k)) && name != axis) ++k;
        if (!axis) {
            control.problem("joint.axes", "coordinate '" + name + "'",
                            known.empty() ? "none: this joint has no coordinates" : "one of " + known);
            continue;
        }
        if (control.json().is_string()) {
            const std::string mode = control.text();
            if (joint.type != JointType::SixDof || (mode != "free" && mode != "locked"))
                control.problem("joint.axes", "an object, or of six_dof free or locked");
            joint.axes[k].mode = mode == "free" ? AxisMode::Free : AxisMode::Locked;
            continue;
        }
        control.isObject({"limits", "motor", "spring"});
        readControl(control, name, joint, joint.axes[k]);
    }
}

bool isDynamic(const Scenario& scenario, int body) {
    return body != kNone && scenario.bodies[body].type == BodyType::Dynamic;
}

int readDynamicBody(const Node& node, const Scenario& scenario) {
    const int body = readBodyName(node, scenario, false);
    const bool isKnown =
        node.json().is_string() && node.context().bodyIndex.contains(node.json().get<std::string>());
    if (isKnown && !isDynamic(scenario, body)) node.problem("body.not_dynamic", "a dynamic body");
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
    node.isObject({"body", "coefficient", "quadratic"});
    DragForce f;
    if (const auto n = node.require("body")) f.body = readDynamicBody(*n, scenario);
    if (const auto n = node.require("coefficient")) f.coefficient = n->number(0.0, 1e12);
    if (const auto n = node.find("quadratic")) f.quadratic = n->number(0.0, 1e12);
    return f;
}

}  // namespace

void readJoints(const Node& list, Scenario& scenario) {
    for (const Node& node : list.items()) {
        node.isObject({"name", "type", "a", "b", "anchor", "anchor_a", "anchor_b", "axis", "normal",
                       "spin_axis", "length", "limits", "motor", "spring", "axes", "break_force",
                       "break_torque", "collide_connected"});
        Joint joint;
        const auto name = node.require("name"), type = node.require("type"), a = node.require("a"),
                   b = node.require("b");
        if (!name || !type || !a || !b) continue;
        const auto clean = node.context().problems.size();
        joint.name = name->name();
        if (!node.context().jointNames.insert(joint.name).second)
            name->problem("joint.duplicate", "a name that no other joint has");
        joint.type = readJointType(*type);
        if (joint.type == JointType::Ball && node.dimension() == 2)
            type->problem("joint.type", "hinge: a ball joint in 2D is one");
        if (joint.type == JointType::ConeTwist && node.dimension() == 2)
            type->problem("joint.type", "hinge: a cone-twist joint in 2D is one");
        joint.bodyA = readBodyName(*a, scenario, true);
        joint.bodyB = readBodyName(*b, scenario, false);
        if (node.context().problems.size() > clean) continue;  // the rest would only repeat it
        if (joint.bodyA == joint.bodyB)
            node.problem("joint.bodies", "a body joined to itself", "two bodies, or \"world\" as a");
        if (!isDynamic(scenario, joint.bodyA) && !isDynamic(scenario, joint.bodyB))
            node.problem("joint.bodies", "no dynamic body", "at least one dynamic body");
        // First: what a distance joint may do says whether its anchors must be one length apart.
        readAxes(node, joint);
        readAnchors(node, scenario, joint);
        if (joint.type == JointType::Distance && joint.axes[0].hasSpring() && !node["spring"].has("target"))
            joint.axes[0].target = joint.length;
        readAxis(node, scenario, joint);
        if (const auto n = node.find("break_force")) joint.breakForce = n->positive();
        if (const auto n = node.find("break_torque")) joint.breakTorque = n->positive();
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
