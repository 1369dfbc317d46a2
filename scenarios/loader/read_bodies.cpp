// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cmath>
#include <stdexcept>

#include "scenarios/loader/read_parts.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::scenario {
namespace {

BodyType readType(const Node& body) {
    const auto node = body.find("type");
    if (!node) return BodyType::Dynamic;
    const std::string text = node->text();
    if (text == "static") return BodyType::Static;
    if (text == "kinematic") return BodyType::Kinematic;
    if (text != "dynamic" && node->json().is_string())
        node->problem("body.type", "one of static, kinematic, dynamic");
    return BodyType::Dynamic;
}

/// Leading minors of a symmetric tensor, and the triangle inequality of its trace: I_ii <= sum of the other
/// two for a real body.
bool isInertia(const Mat3& I) {
    const double scale = std::max({std::abs(I(0, 0)), std::abs(I(1, 1)), std::abs(I(2, 2))});
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j)
            if (std::abs(I(i, j) - I(j, i)) > 1e-9 * scale) return false;
    const double m2 = I(0, 0) * I(1, 1) - I(0, 1) * I(1, 0);
    const double m3 = I(0, 0) * (I(1, 1) * I(2, 2) - I(1, 2) * I(2, 1)) -
                      I(0, 1) * (I(1, 0) * I(2, 2) - I(1, 2) * I(2, 0)) +
                      I(0, 2) * (I(1, 0) * I(2, 1) - I(1, 1) * I(2, 0));
    if (!(I(0, 0) > 0.0 && m2 > 0.0 && m3 > 0.0)) return false;
    const double trace = I(0, 0) + I(1, 1) + I(2, 2);
    for (int i = 0; i < 3; ++i)
        if (2.0 * I(i, i) > trace * (1.0 + 1e-9)) return false;
    return true;
}

Mat3 readInertia(const Node& node) {
    if (node.dimension() == 2) return Mat3::diagonal(0.0, 0.0, node.positive());
    Mat3 inertia;
    if (node.json().is_array() && node.json().size() == 3 && node.json()[0].is_array()) {
        for (int i = 0; i < 3; ++i) {
            const auto row = node[i].numbers(3);
            for (int j = 0; j < 3; ++j) inertia(i, j) = row[j];
        }
    } else {
        const auto d = node.numbers(3);
        inertia = Mat3::diagonal(d[0], d[1], d[2]);
    }
    if (!isInertia(inertia))
        node.problem("body.inertia",
                     "symmetric positive definite tensor whose largest principal moment is at most the sum "
                     "of the others");
    return inertia;
}

void readMass(const Node& node, const Scenario& scenario, Body& body) {
    const auto mass = node.find("mass"), inertia = node.find("inertia"), center = node.find("center_of_mass");
    if (body.type != BodyType::Dynamic) {
        for (const char* key : {"mass", "inertia", "center_of_mass"})
            if (node.has(key))
                node[key].problem("body.mass", std::string("the key '") + key + "'",
                                  "none: only dynamic bodies have mass");
        return;
    }
    if (inertia || center) {
        if (!mass)
            node.problem("body.mass", "inertia or center_of_mass without mass", "the key 'mass' as well");
        if (!inertia)
            node.problem("body.inertia", "center_of_mass without inertia", "the key 'inertia' as well");
        body.massProperties.mass = mass ? mass->positive() : 1.0;
        if (inertia) body.massProperties.inertia = readInertia(*inertia);
        if (center) body.massProperties.centerOfMass = center->vector();
        return;
    }
    const double given = mass ? mass->positive() : 0.0;
    try {
        if (body.shapes.empty()) throw std::invalid_argument("no shapes to compute mass and inertia from");
        body.massProperties = massPropertiesFromShapes(body.shapes, scenario.materials, scenario.dimension);
        if (mass) body.massProperties = scaledToMass(body.massProperties, given);
        const Mat3& tensor = body.massProperties.inertia;
        const bool solid = scenario.dimension == 2 ? tensor(2, 2) > 0.0 : isInertia(tensor);
        if (!solid || !std::isfinite(body.massProperties.mass * tensor(2, 2)))
            throw std::invalid_argument("shapes too thin or too large for an inertia in double precision");
    } catch (const std::invalid_argument& error) {
        node.problem("body.mass", error.what(), "solid shapes, or mass and inertia");
    }
}

void readDamping(const Node& node, Body& body) {
    node.isObject({"linear_kept_per_second", "angular_kept_per_second"});
    if (const auto n = node.find("linear_kept_per_second")) body.linearVelocityKept = n->number(1e-6, 1.0);
    if (const auto n = node.find("angular_kept_per_second")) body.angularVelocityKept = n->number(1e-6, 1.0);
}

void checkStaticShapes(const Node& node, const Body& body) {
    if (body.type == BodyType::Static) return;
    for (std::size_t i = 0; i < body.shapes.size(); ++i) {
        const Geometry& g = body.shapes[i].geometry;
        if (isStaticOnly(g))
            node["shapes"][i].problem(
                "shape.static", std::string("a ") + geometryName(g, node.dimension()) + " on a moving body",
                "a solid shape, or \"type\": \"static\"");
    }
}

}  // namespace

Body readBody(const Node& node, const Scenario& scenario) {
    Body body;
    node.isObject({"name",    "type",           "position", "orientation",      "axis_angle_deg",
                   "angle",   "angle_deg",      "velocity", "angular_velocity", "mass",
                   "inertia", "center_of_mass", "shapes",   "material",         "collides",
                   "damping", "gravity_scale",  "layers",   "collides_with",    "group"});
    if (!node.json().is_object()) return body;
    if (const auto name = node.require("name")) body.name = name->name();
    if (body.name == "world")
        node["name"].problem("body.name", "a name other than 'world', which joints use for the fixed frame");
    body.type = readType(node);
    if (const auto n = node.find("position")) body.pose.position = n->vector();
    body.pose.orientation = readOrientation(node);
    if (const auto n = node.find("velocity")) body.velocity = n->vector();
    if (const auto n = node.find("angular_velocity")) body.angularVelocity = n->angularVector();
    if (body.type == BodyType::Static && (norm(body.velocity) > 0.0 || norm(body.angularVelocity) > 0.0))
        node.problem("body.static", "a velocity on a static body", "no velocity, or \"type\": \"kinematic\"");
    Shape usual;
    usual.material = scenario.materials.size() == 1 ? 0 : kNone;
    if (const auto n = node.find("material")) usual.material = readMaterialName(*n, scenario);
    usual.filter = readFilter(node, scenario, {});
    if (const auto n = node.find("shapes")) body.shapes = readShapes(*n, scenario, usual);
    if (const auto n = node.find("collides")) body.collides = n->boolean();
    if (const auto n = node.find("damping")) readDamping(*n, body);
    if (const auto n = node.find("gravity_scale")) body.gravityScale = n->number(-1e6, 1e6);
    if (node.context().problems.empty()) {
        checkStaticShapes(node, body);
        if (node.context().problems.empty()) readMass(node, scenario, body);
    }
    return body;
}

int readBodyName(const Node& node, const Scenario& scenario, bool mayBeWorld) {
    const std::string name = node.text();
    if (mayBeWorld && name == "world") return kNone;
    // Searching all bodies for each joint would take minutes for the largest nets.
    auto& known = node.context().bodyIndex;
    if (known.size() != scenario.bodies.size())
        for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
            known.emplace(scenario.bodies[i].name, static_cast<int>(i));
    const auto found = known.find(name);
    const int index = found == known.end() ? kNone : found->second;
    if (index == kNone && node.json().is_string())
        node.problem("body.unknown", mayBeWorld ? "the name of a body of the file, or \"world\""
                                                : "the name of a body of the file");
    return index == kNone ? 0 : index;
}

}  // namespace rigor::scenario
