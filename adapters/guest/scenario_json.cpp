// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/scenario_json.hpp"

#include <variant>

namespace rigor::guest {
namespace {

using namespace scenario;

Json listJson(const std::vector<Vec3>& vertices) {
    Json list = Json::array();
    for (const Vec3& v : vertices) list.push_back(toJson(v));
    return list;
}

/// Numbers that stand for "none" become null.
Json bounded(double value) {
    return std::abs(value) > 1e299 ? Json(nullptr) : Json(value);
}

struct Sizes {
    Json operator()(const Sphere& s) const { return {{"radius", s.radius}}; }
    Json operator()(const Box& b) const { return {{"half_extents", toJson(b.halfExtents)}}; }
    Json operator()(const Capsule& c) const { return round(c); }
    Json operator()(const Cylinder& c) const { return round(c); }
    Json operator()(const Cone& c) const { return round(c); }
    Json operator()(const ConvexHull& h) const { return {{"vertices", listJson(h.vertices)}}; }
    Json operator()(const HalfSpace& h) const { return {{"normal", toJson(h.normal)}, {"offset", h.offset}}; }
    Json operator()(const Segment& s) const { return {{"a", toJson(s.a)}, {"b", toJson(s.b)}}; }
    Json operator()(const Chain& c) const { return {{"vertices", listJson(c.vertices)}, {"loop", c.loop}}; }
    Json operator()(const TriangleMesh& m) const {
        return {{"vertices", listJson(m.vertices)}, {"triangles", m.triangles}};
    }
    Json operator()(const HeightField& f) const {
        return {{"columns", f.columns},    {"rows", f.rows},       {"spacing_x", f.spacingX},
                {"spacing_z", f.spacingZ}, {"heights", f.heights}, {"thickness", f.thickness}};
    }
    Json operator()(const Ellipsoid& e) const { return {{"half_axes", toJson(e.halfAxes)}}; }

    template <class Round>
    static Json round(const Round& r) {
        return {{"radius", r.radius}, {"half_length", r.halfLength}};
    }
};

const char* typeName(BodyType type) {
    switch (type) {
        case BodyType::Static:
            return "static";
        case BodyType::Kinematic:
            return "kinematic";
        case BodyType::Dynamic:
            return "dynamic";
    }
    return "?";
}

const char* modeName(AxisMode mode, JointType type) {
    switch (mode) {
        case AxisMode::Free:
            return "free";
        case AxisMode::Locked:
            return "locked";
        case AxisMode::Limited:
            return "limited";
        case AxisMode::Usual:
            break;
    }
    return type == JointType::Distance || type == JointType::SixDof ? "locked" : "free";
}

Json shapeJson(const Shape& shape, int dimension) {
    Json json = geometryJson(shape.geometry, dimension);
    json["position"] = toJson(shape.pose.position);
    json["orientation"] = toJson(shape.pose.orientation);
    json["material"] = shape.material;
    json["surface_velocity"] = {{"linear", toJson(shape.surfaceVelocity.linear)},
                                {"angular", toJson(shape.surfaceVelocity.angular)}};
    json["filter"] = {{"layers", shape.filter.layers},
                      {"collides_with", shape.filter.collidesWith},
                      {"group", shape.filter.group}};
    return json;
}

Json bodyJson(const Body& body, int dimension) {
    const Mat3& I = body.massProperties.inertia;
    Json shapes = Json::array(), inertia = Json::array();
    for (const Shape& shape : body.shapes) shapes.push_back(shapeJson(shape, dimension));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) inertia.push_back(I(i, j));
    return {{"name", body.name},
            {"type", typeName(body.type)},
            {"position", toJson(body.pose.position)},
            {"orientation", toJson(body.pose.orientation)},
            {"velocity", toJson(body.velocity)},
            {"angular_velocity", toJson(body.angularVelocity)},
            {"mass", body.massProperties.mass},
            {"center_of_mass", toJson(body.massProperties.centerOfMass)},
            {"inertia", std::move(inertia)},
            {"collides", body.collides},
            {"linear_velocity_kept", body.linearVelocityKept},
            {"angular_velocity_kept", body.angularVelocityKept},
            {"gravity_scale", body.gravityScale},
            {"shapes", std::move(shapes)}};
}

Json axisJson(const JointAxis& axis, JointType type, const char* name) {
    return {{"name", name},
            {"mode", modeName(axis.mode, type)},
            {"lower", bounded(axis.lower)},
            {"upper", bounded(axis.upper)},
            {"motor_speed", axis.motorSpeed},
            {"motor_max_force", axis.motorMaxForce},
            {"target", axis.target},
            {"stiffness", axis.stiffness},
            {"damping", axis.damping}};
}

Json jointJson(const Joint& joint, int dimension) {
    Json axes = Json::array();
    for (std::size_t k = 0; k < kMaxJointAxes; ++k)
        if (const char* name = jointAxisName(joint.type, dimension, k))
            axes.push_back(axisJson(joint.axes[k], joint.type, name));
    return {{"name", joint.name},
            {"type", jointName(joint.type)},
            {"body_a", joint.bodyA},
            {"body_b", joint.bodyB},
            {"anchor_a", toJson(joint.anchorA)},
            {"anchor_b", toJson(joint.anchorB)},
            {"axis_a", toJson(joint.axisA)},
            {"axis_b", toJson(joint.axisB)},
            {"normal_a", toJson(joint.normalA)},
            {"spin_axis_b", toJson(joint.spinAxisB)},
            {"length", joint.length},
            {"collide_connected", joint.collideConnected},
            {"break_force", bounded(joint.breakForce)},
            {"break_torque", bounded(joint.breakTorque)},
            {"axes", std::move(axes)}};
}

/// Coefficients of every pair of materials, a <= b.
Json pairsJson(const Scenario& scenario) {
    Json pairs = Json::array();
    const int count = static_cast<int>(scenario.materials.size());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b) {
            const PairCoefficients c = pairCoefficients(scenario, a, b);
            pairs.push_back({{"a", a},
                             {"b", b},
                             {"friction", c.friction},
                             {"restitution", c.restitution},
                             {"static_friction", c.staticFriction},
                             {"rolling_friction", c.rollingFriction},
                             {"torsional_friction", c.torsionalFriction}});
        }
    return pairs;
}

}  // namespace

Json toJson(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Json toJson(const Quat& q) {
    return {q.w, q.x, q.y, q.z};
}

Json geometryJson(const Geometry& geometry, int dimension) {
    Json json = std::visit(Sizes{}, geometry);
    json["shape"] = geometryName(geometry, dimension);
    return json;
}

Json scenarioJson(const Scenario& scenario, bool planar) {
    Json bodies = Json::array(), joints = Json::array();
    for (const Body& body : scenario.bodies) bodies.push_back(bodyJson(body, scenario.dimension));
    for (const Joint& joint : scenario.joints) joints.push_back(jointJson(joint, scenario.dimension));
    return {{"name", scenario.name},
            {"dimension", scenario.dimension},
            {"planar", planar},
            {"gravity", toJson(scenario.gravity)},
            {"duration", scenario.duration},
            {"materials", scenario.materials.size()},
            {"pairs", pairsJson(scenario)},
            {"bodies", std::move(bodies)},
            {"joints", std::move(joints)}};
}

}  // namespace rigor::guest
