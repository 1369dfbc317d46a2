// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries with known results, one JSON object per line:
//
//   id              any text
//   a, b            {type: sphere, radius} {type: box, half} {type: capsule|cylinder|cone, radius,
//   half_height}
//                   {type: convex, vertices} {type: halfspace, normal, offset} {type: ellipsoid, radii}
//   pose_a, pose_b  {p: [x, y, z], q: [w, x, y, z]}, body to world
//   expected        {signed_distance, overlap, normal (a to b), normal_unique, other_normals, accuracy,
//                   normal_tolerance}; missing or null where not known
//
// The axis of capsule, cylinder and cone is local z (Rigor's format: local y). Ellipsoids and hulls without
// volume are kept as cases that cannot be queried.
#include "scenarios/loader/collision_lines.hpp"

#include <cmath>
#include <stdexcept>

#include "scenarios/model/hull.hpp"

namespace rigor::scenario {
namespace {

constexpr double kSqrtHalf = 0.70710678118654752440;
/// Rotation by +90 degrees about x: takes the format's axis (y) to that of the file (z).
constexpr Quat kAxisYToZ{kSqrtHalf, kSqrtHalf, 0.0, 0.0};

double requiredPositive(const Node& node, const char* key) {
    const auto n = node.require(key);
    return n ? n->positive() : 1.0;
}

template <class Round>
Shape readRoundSize(const Node& node) {
    Shape shape;
    const double radius = requiredPositive(node, "radius");
    shape.geometry = Round{radius, requiredPositive(node, "half_height")};
    shape.pose.orientation = kAxisYToZ;
    return shape;
}

Shape readConvex(const Node& node, std::string& unsupported) {
    ConvexHull hull;
    if (const auto list = node.require("vertices"))
        for (const Node& point : list->items()) hull.vertices.push_back(point.vector());
    if (!node.context().problems.empty()) return {hull, {}, 0};
    try {
        hull.vertices = convexHull3d(hull.vertices).vertices;
    } catch (const std::invalid_argument& error) {
        unsupported = std::string("convex: ") + error.what();
    }
    return {hull, {}, 0};
}

/// A shape in its own frame; what turns its axis is in the pose.
Shape readLineShape(const Node& node, std::string& unsupported) {
    const auto type = node.require("type");
    const std::string kind = type ? type->text() : "";
    if (kind == "sphere") return {Sphere{requiredPositive(node, "radius")}, {}, 0};
    if (kind == "capsule") return readRoundSize<Capsule>(node);
    if (kind == "cylinder") return readRoundSize<Cylinder>(node);
    if (kind == "cone") return readRoundSize<Cone>(node);
    if (kind == "convex") return readConvex(node, unsupported);
    if (kind == "box") {
        const auto half = node.require("half");
        if (half && half->isArray())
            for (const Node& extent : half->items()) (void)extent.positive();
        return {Box{half ? half->vector() : Vec3{1, 1, 1}}, {}, 0};
    }
    if (kind == "halfspace") {
        const auto normal = node.require("normal"), offset = node.require("offset");
        return {HalfSpace{normal ? normal->unitVector() : Vec3{0, 1, 0},
                          offset ? offset->number(-1e9, 1e9) : 0.0},
                {},
                0};
    }
    if (kind == "ellipsoid") {
        const auto radii = node.require("radii");
        if (radii && radii->isArray())
            for (const Node& radius : radii->items()) (void)radius.positive();
        return {Ellipsoid{radii ? radii->vector() : Vec3{1, 1, 1}}, {}, 0};
    }
    if (type)
        type->problem("shape.missing",
                      "sphere, box, capsule, cylinder, cone, convex, halfspace or ellipsoid");
    return {Sphere{1.0}, {}, 0};
}

Pose readLinePose(const Node& node) {
    Pose pose;
    if (const auto p = node.require("p")) pose.position = p->vector();
    if (const auto q = node.require("q")) {
        const auto v = q->numbers(4);
        pose.orientation = {v[0], v[1], v[2], v[3]};
        if (std::abs(norm(pose.orientation) - 1.0) > 1e-3) {
            q->problem("orientation.unit", "norm " + std::to_string(norm(pose.orientation)),
                       "unit quaternion [w, x, y, z]");
            return {};
        }
        pose.orientation = normalized(pose.orientation);
    }
    return pose;
}

const Json* known(const Node& node, const char* key) {
    if (!node.has(key) || node.json().at(key).is_null()) return nullptr;
    return &node.json().at(key);
}

ExpectedContact readLineExpected(const Node& node) {
    ExpectedContact expected;
    if (known(node, "signed_distance")) expected.signedDistance = node["signed_distance"].number(-1e15, 1e15);
    if (known(node, "overlap")) expected.overlap = node["overlap"].boolean();
    if (known(node, "accuracy")) expected.accuracy = node["accuracy"].number(0.0, 1e3);
    if (known(node, "normal_tolerance"))
        expected.normalTolerance = node["normal_tolerance"].number(0.0, 10.0);
    if (known(node, "normal")) expected.normals.push_back(node["normal"].unitVector());
    if (known(node, "other_normals"))
        for (const Node& normal : node["other_normals"].items())
            expected.normals.push_back(normal.unitVector());
    // A tie that is not spelled out: the one normal that is given decides nothing.
    if (const Json* unique = known(node, "normal_unique");
        unique && *unique == false && expected.normals.size() == 1)
        expected.normals.clear();
    return expected;
}

}  // namespace

CollisionCase readCollisionLine(const Node& node) {
    CollisionCase c;
    if (!node.json().is_object()) {
        node.problem("schema.type", "object with the keys a, b, pose_a, pose_b");
        return c;
    }
    if (const auto id = node.find("id")) c.name = id->text();
    const auto a = node.require("a"), b = node.require("b");
    const auto poseA = node.require("pose_a"), poseB = node.require("pose_b");
    if (!a || !b || !poseA || !poseB) return c;
    c.a = readLineShape(*a, c.unsupported);
    c.b = readLineShape(*b, c.unsupported);
    c.a.pose = readLinePose(*poseA) * c.a.pose;
    c.b.pose = readLinePose(*poseB) * c.b.pose;
    if (known(node, "expected")) c.expected = readLineExpected(node["expected"]);
    if (known(node, "tags")) c.tags = node["tags"].texts();
    return c;
}

CollisionFile readCollisionLines(const std::string& text, const std::filesystem::path& file) {
    CollisionFile result;
    result.file = file;
    result.name = file.stem().string();
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        ++number;
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        ReadContext context{file.string(), nullptr, {}, 3};
        CollisionCase c;
        try {
            const JsonDocument document = parseDocument(line, file.string());
            c = readCollisionLine(Node(document.value, "", context));
        } catch (const LoadError& error) {
            context.problems = error.problems();
        }
        for (Problem& problem : context.problems) problem.line = number;
        if (!context.problems.empty()) throw LoadError(std::move(context.problems));
        c.line = number;
        c.text = line;
        if (c.name.empty()) c.name = "line-" + std::to_string(number);
        result.cases.push_back(std::move(c));
    }
    return result;
}

}  // namespace rigor::scenario
