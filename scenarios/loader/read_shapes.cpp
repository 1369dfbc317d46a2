// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cmath>
#include <stdexcept>

#include "scenarios/loader/read_parts.hpp"
#include "scenarios/model/hull.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::scenario {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr std::size_t kMaxHullPoints = 64;

std::optional<double> roundRadius(const Node& node) {
    node.isObject({"radius", "half_length"});
    const auto radius = node.require("radius");
    return radius ? std::optional(radius->positive()) : std::nullopt;
}

template <class Round>
Geometry readRound(const Node& node) {
    const double radius = roundRadius(node).value_or(1.0);
    const auto length = node.require("half_length");
    return Round{radius, length ? length->positive() : 1.0};
}

Geometry readSphere(const Node& node) {
    node.isObject({"radius"});
    const auto radius = node.require("radius");
    return Sphere{radius ? radius->positive() : 1.0};
}

Geometry readBox(const Node& node) {
    node.isObject({"half_extents"});
    const auto half = node.require("half_extents");
    if (!half) return Box{{1, 1, 1}};
    const auto before = node.context().problems.size();
    const Vec3 h = half->vector();
    if (node.context().problems.size() == before)
        for (const Node& extent : half->items()) (void)extent.positive();
    return Box{h};
}

Geometry readEllipsoid(const Node& node) {
    node.isObject({"half_axes"});
    const auto half = node.require("half_axes");
    if (!half) return Ellipsoid{{1, 1, 1}};
    const auto before = node.context().problems.size();
    const Vec3 h = half->vector();
    if (node.context().problems.size() == before)
        for (const Node& axis : half->items()) (void)axis.positive();
    return Ellipsoid{h};
}

Geometry readHull(const Node& node) {
    node.isObject({"vertices"});
    const auto list = node.require("vertices");
    ConvexHull hull;
    if (!list) return hull;
    if (list->json().is_array() && list->json().size() > kMaxHullPoints) {
        list->problem("value.range", "at most " + std::to_string(kMaxHullPoints) + " points");
        return hull;
    }
    for (const Node& point : list->items()) hull.vertices.push_back(point.vector());
    try {
        hull.vertices =
            node.dimension() == 2 ? convexHull2d(hull.vertices) : convexHull3d(hull.vertices).vertices;
    } catch (const std::invalid_argument& error) {
        list->problem("shape.degenerate", error.what(), "points that span a solid");
    }
    return hull;
}

Geometry readHalfSpace(const Node& node) {
    node.isObject({"normal", "offset"});
    const auto normal = node.require("normal");
    const auto offset = node.find("offset");
    return HalfSpace{normal ? normal->unitVector() : Vec3{0, 1, 0}, offset ? offset->number(-1e9, 1e9) : 0.0};
}

Geometry readSegment(const Node& node) {
    node.isObject({"a", "b"});
    const auto a = node.require("a"), b = node.require("b");
    Segment segment{a ? a->vector() : Vec3{}, b ? b->vector() : Vec3{1, 0, 0}};
    if (norm(segment.b - segment.a) <= 0.0)
        node.problem("shape.degenerate", "two equal points", "two different points");
    return segment;
}

/// The value stays where it is wrong: nothing half-loads, and the other mistakes of the file are found too.
template <class Surface>
Geometry checked(const Node& node, std::size_t problemsBefore, Surface surface) {
    if (node.context().problems.size() == problemsBefore)
        if (const std::string problem = surfaceProblem(surface); !problem.empty())
            node.problem("shape.degenerate", problem, "a proper surface");
    return surface;
}

Geometry readChain(const Node& node) {
    const auto before = node.context().problems.size();
    node.isObject({"vertices", "loop"});
    Chain chain;
    if (const auto list = node.require("vertices"))
        for (const Node& point : list->items()) chain.vertices.push_back(point.vector());
    if (const auto loop = node.find("loop")) chain.loop = loop->boolean();
    return checked(node, before, chain);
}

Geometry readMesh(const Node& node) {
    const auto before = node.context().problems.size();
    node.isObject({"vertices", "triangles"});
    TriangleMesh mesh;
    if (const auto list = node.require("vertices"))
        for (const Node& point : list->items()) mesh.vertices.push_back(point.vector());
    const int most = static_cast<int>(mesh.vertices.size()) - 1;
    if (const auto list = node.require("triangles"))
        for (const Node& triangle : list->items()) {
            const std::vector<Node> corners = triangle.items();
            if (corners.size() != 3) {
                triangle.problem("value.range", "three vertex indices");
                continue;
            }
            mesh.triangles.push_back({corners[0].integer(0, std::max(most, 0)),
                                      corners[1].integer(0, std::max(most, 0)),
                                      corners[2].integer(0, std::max(most, 0))});
        }
    return checked(node, before, mesh);
}

/// Rows of heights: as many columns in each.
Geometry readHeightField(const Node& node) {
    const auto before = node.context().problems.size();
    node.isObject({"spacing", "heights", "thickness"});
    HeightField field;
    if (const auto spacing = node.require("spacing")) {
        const std::vector<double> s = spacing->numbers(2);
        field.spacingX = s[0];
        field.spacingZ = s[1];
    }
    if (const auto list = node.require("heights"))
        for (const Node& row : list->items()) {
            const std::vector<Node> heights = row.items();
            if (field.rows++ == 0) field.columns = static_cast<int>(heights.size());
            if (static_cast<int>(heights.size()) != field.columns)
                row.problem("value.range",
                            "as many heights as the first row has, " + std::to_string(field.columns));
            for (const Node& height : heights) field.heights.push_back(height.number(-1e9, 1e9));
        }
    if (const auto thickness = node.find("thickness")) field.thickness = thickness->positive();
    return checked(node, before, field);
}

struct Kind {
    const char* key;
    int dimension;  ///< 0: both
    Geometry (*read)(const Node&);
};
constexpr Kind kKinds[] = {{"sphere", 3, readSphere},
                           {"circle", 2, readSphere},
                           {"box", 0, readBox},
                           {"capsule", 0, readRound<Capsule>},
                           {"cylinder", 3, readRound<Cylinder>},
                           {"cone", 3, readRound<Cone>},
                           {"ellipsoid", 3, readEllipsoid},
                           {"hull", 3, readHull},
                           {"polygon", 2, readHull},
                           {"half_space", 3, readHalfSpace},
                           {"half_plane", 2, readHalfSpace},
                           {"segment", 2, readSegment},
                           {"chain", 2, readChain},
                           {"triangle_mesh", 3, readMesh},
                           {"height_field", 3, readHeightField}};

std::string kindNames(int dimension) {
    std::string names;
    for (const Kind& kind : kKinds)
        if (kind.dimension == 0 || kind.dimension == dimension)
            names += (names.empty() ? "" : ", ") + std::string(kind.key);
    return names;
}

Shape readShape(const Node& node, const Scenario& scenario, const Shape& usual) {
    Shape shape = usual;
    node.isObject({"ellipsoid", "sphere",           "circle",         "box",
                   "capsule",   "cylinder",         "cone",           "hull",
                   "polygon",   "half_space",       "half_plane",     "segment",
                   "chain",     "triangle_mesh",    "height_field",   "material",
                   "position",  "orientation",      "axis_angle_deg", "angle",
                   "angle_deg", "surface_velocity", "layers",         "collides_with",
                   "group"});
    const Kind* found = nullptr;
    for (const Kind& kind : kKinds) {
        if (!node.has(kind.key)) continue;
        if (kind.dimension != 0 && kind.dimension != node.dimension())
            node[kind.key].problem("shape.dimension", std::string("the shape '") + kind.key + "'",
                                   "one of " + kindNames(node.dimension()));
        else if (found != nullptr)
            node.problem("shape.count", "more than one shape", "one shape for each entry");
        found = &kind;
    }
    if (found == nullptr) {
        node.problem("shape.missing", "no shape", "one of " + kindNames(node.dimension()));
        return shape;
    }
    if (found->dimension == 0 || found->dimension == node.dimension())
        shape.geometry = found->read(node[found->key]);
    if (const auto position = node.find("position")) shape.pose.position = position->vector();
    shape.pose.orientation = readOrientation(node);
    shape.filter = readFilter(node, scenario, usual.filter);
    if (const auto material = node.find("material")) shape.material = readMaterialName(*material, scenario);
    if (const auto surface = node.find("surface_velocity")) {
        surface->isObject({"linear", "angular"});
        if (const auto n = surface->find("linear")) shape.surfaceVelocity.linear = n->vector();
        if (const auto n = surface->find("angular")) shape.surfaceVelocity.angular = n->angularVector();
    }
    if (shape.material == kNone) {
        node.problem("material.missing", "no material", "the key 'material' here or at the body");
        shape.material = 0;
    }
    return shape;
}

}  // namespace

Quat readOrientation(const Node& object) {
    int given = 0;
    Quat q;
    for (const char* key : {"orientation", "axis_angle_deg", "angle", "angle_deg"})
        given += object.has(key) ? 1 : 0;
    if (given > 1)
        object.problem("orientation.count", "several orientations",
                       "one of orientation, axis_angle_deg, angle, angle_deg");
    const auto only = [&](const Node& node, int dimension) {
        if (node.dimension() != dimension)
            node.problem("orientation.dimension", "a key for " + std::to_string(dimension) + "D",
                         node.dimension() == 2 ? "angle or angle_deg" : "orientation or axis_angle_deg");
        return node.dimension() == dimension;
    };
    if (const auto node = object.find("orientation"); node && only(*node, 3)) {
        const auto v = node->numbers(4);
        q = {v[0], v[1], v[2], v[3]};
        if (std::abs(norm(q) - 1.0) > 1e-3) {
            node->problem("orientation.unit", "norm " + std::to_string(norm(q)),
                          "unit quaternion [w, x, y, z]");
            return {};
        }
        return normalized(q);
    }
    if (const auto node = object.find("axis_angle_deg"); node && only(*node, 3)) {
        node->isObject({"axis", "angle_deg"});
        const auto axis = node->require("axis"), angle = node->require("angle_deg");
        if (axis && angle) return fromAxisAngle(axis->unitVector(), kDegree * angle->number(-1e6, 1e6));
    }
    if (const auto node = object.find("angle"); node && only(*node, 2))
        return fromAxisAngle({0, 0, 1}, node->number(-1e6, 1e6));
    if (const auto node = object.find("angle_deg"); node && only(*node, 2))
        return fromAxisAngle({0, 0, 1}, kDegree * node->number(-1e6, 1e6));
    return {};
}

std::vector<Shape> readShapes(const Node& list, const Scenario& scenario, const Shape& usual) {
    std::vector<Shape> shapes;
    for (const Node& item : list.items()) shapes.push_back(readShape(item, scenario, usual));
    return shapes;
}

Shape readPosedShape(const Node& node) {
    return readShape(node, Scenario{}, {});
}

int readMaterialName(const Node& node, const Scenario& scenario) {
    const std::string name = node.text();
    std::string known;
    for (std::size_t i = 0; i < scenario.materials.size(); ++i) {
        if (scenario.materials[i].name == name) return static_cast<int>(i);
        known += (known.empty() ? "" : ", ") + scenario.materials[i].name;
    }
    if (node.json().is_string()) node.problem("material.unknown", "a material of the file: " + known);
    return 0;
}

}  // namespace rigor::scenario
