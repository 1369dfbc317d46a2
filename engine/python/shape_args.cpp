// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/shape_args.hpp"

#include "engine/shapes/surface.hpp"

namespace rigor::engine::python {
namespace {

std::vector<double> listOf(const Numbers& numbers) {
    return {numbers.data(), numbers.data() + numbers.size()};
}

template <class S>
typename S::Vec sizesAsVec(const ShapeArgs& args, const char* name) {
    if (args.sizes.size() != static_cast<std::size_t>(S::dim))
        throw EngineError("array", std::string(name) + ": found " + std::to_string(args.sizes.size()) +
                                       " numbers, expected " + std::to_string(S::dim));
    return toVec<S>(args.sizes.data());
}

[[noreturn]] void refuse(const ShapeArgs& args, int dimension) {
    throw EngineError("shape_dimension", std::string("no shape '") + shapeKindName(args.kind) + "' in " +
                                             std::to_string(dimension) + "D");
}

template <class S>
Shape<S> toPlaneShape(const ShapeArgs& args) {
    if (args.kind == ShapeKind::Chain) return makeChain<S>(toPoints<S>(args.points, "points"), args.loop);
    if (args.kind != ShapeKind::Segment) refuse(args, 2);
    const auto points = toPoints<S>(args.points, "segment");
    return Segment<S>{points.at(0), points.at(1)};
}

template <class S>
Shape<S> toHeightField(const ShapeArgs& args) {
    using R = typename S::Real;
    if (args.points.ndim() != 2)
        throw EngineError("array", "heights: expected an array of rows x columns numbers");
    std::vector<R> heights;
    for (const double height : listOf(args.points)) heights.push_back(static_cast<R>(height));
    return makeHeightField<S>(static_cast<int>(args.points.shape(1)), static_cast<int>(args.points.shape(0)),
                              static_cast<R>(args.sizes[0]), static_cast<R>(args.sizes[1]), heights,
                              static_cast<R>(args.sizes[2]));
}

template <class S>
Shape<S> toSpaceShape(const ShapeArgs& args) {
    using R = typename S::Real;
    const auto size = [&args](std::size_t i) { return static_cast<R>(args.sizes[i]); };
    switch (args.kind) {
        case ShapeKind::Cylinder:
            return Cylinder<S>{size(0), size(1)};
        case ShapeKind::Cone:
            return Cone<S>{size(0), size(1)};
        case ShapeKind::Ellipsoid:
            return Ellipsoid<S>{sizesAsVec<S>(args, "half_axes")};
        case ShapeKind::Mesh:
            return makeTriangleMesh<S>(toPoints<S>(args.points, "vertices"), args.triangles);
        case ShapeKind::HeightField:
            return toHeightField<S>(args);
        default:
            refuse(args, 3);
    }
}

/// A factory of Python: the kind, its sizes.
ShapeArgs sized(ShapeKind kind, std::vector<double> sizes) {
    ShapeArgs args;
    args.kind = kind;
    args.sizes = std::move(sizes);
    return args;
}
ShapeArgs pointed(ShapeKind kind, Numbers points) {
    ShapeArgs args;
    args.kind = kind;
    args.points = std::move(points);
    return args;
}

ShapeArgs meshOf(Numbers vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    ShapeArgs args = pointed(ShapeKind::Mesh, std::move(vertices));
    args.triangles = triangles;
    return args;
}

ShapeArgs segmentOf(const Numbers& a, const Numbers& b) {
    requireSize(a, 2, "a");
    requireSize(b, 2, "b");
    Numbers points({2, 2});
    for (int i = 0; i < 2; ++i) {
        points.mutable_at(0, i) = a.data()[i];
        points.mutable_at(1, i) = b.data()[i];
    }
    return pointed(ShapeKind::Segment, std::move(points));
}

constexpr const char* kNames[]{"sphere",     "box",  "capsule", "cylinder", "cone",          "ellipsoid",
                               "half_space", "hull", "segment", "chain",    "triangle_mesh", "height_field"};

}  // namespace

const char* shapeKindName(ShapeKind kind) {
    return kNames[static_cast<std::size_t>(kind)];
}

template <class S>
Shape<S> toShape(const ShapeArgs& args) {
    using R = typename S::Real;
    switch (args.kind) {
        case ShapeKind::Sphere:
            return Sphere<S>{static_cast<R>(args.sizes[0])};
        case ShapeKind::Box:
            return Box<S>{sizesAsVec<S>(args, "half_extents")};
        case ShapeKind::Capsule:
            return Capsule<S>{static_cast<R>(args.sizes[0]), static_cast<R>(args.sizes[1])};
        case ShapeKind::HalfSpace:
            return HalfSpace<S>{toVec<S>(args.vector, "normal"), static_cast<R>(args.sizes[0])};
        case ShapeKind::Hull:
            return makeHull<S>(toPoints<S>(args.points, "points"));
        default:
            break;
    }
    if constexpr (S::dim == 2)
        return toPlaneShape<S>(args);
    else
        return toSpaceShape<S>(args);
}

void bindShapes(py::module_& module) {
    py::class_<ShapeArgs> shape(module, "Shape", R"(A shape, for World.add_shape and queries.

Its frame has the origin at the shape's centre (of a hull: where the points have it). Lengths in metres. Half-spaces, segments,
chains, meshes and height fields are for static bodies. Which kinds a dimension has stands with each.)");
    shape.def_static(
        "sphere", [](double radius) { return sized(ShapeKind::Sphere, {radius}); }, py::arg("radius"),
        "Sphere, in 2D a disc: radius [m].");
    shape.def_static(
        "box", [](const Numbers& half) { return sized(ShapeKind::Box, listOf(half)); },
        py::arg("half_extents"), "Box: half extents along the shape's axes [m], as many as the dimension.");
    shape.def_static(
        "capsule",
        [](double r, double h) {
            return sized(ShapeKind::Capsule, {r, h});
        },
        py::arg("radius"), py::arg("half_length"),
        "Capsule along y: radius and half length of its segment [m], ends not included.");
    shape.def_static(
        "cylinder",
        [](double r, double h) {
            return sized(ShapeKind::Cylinder, {r, h});
        },
        py::arg("radius"), py::arg("half_length"), "Cylinder along y, 3D: radius and half length [m].");
    shape.def_static(
        "cone",
        [](double r, double h) {
            return sized(ShapeKind::Cone, {r, h});
        },
        py::arg("radius"), py::arg("half_length"),
        "Cone along y, 3D: apex at +half_length, base of `radius` at -half_length [m].");
    shape.def_static(
        "ellipsoid", [](const Numbers& half) { return sized(ShapeKind::Ellipsoid, listOf(half)); },
        py::arg("half_axes"), "Ellipsoid, 3D: half axes along x, y, z [m].");
    shape.def_static(
        "half_space",
        [](Numbers normal, double offset) {
            ShapeArgs args = sized(ShapeKind::HalfSpace, {offset});
            args.vector = std::move(normal);
            return args;
        },
        py::arg("normal"), py::arg("offset") = 0.0,
        "Solid where normal . x <= offset [m]; the normal is a unit vector.");
    shape.def_static(
        "hull", [](Numbers points) { return pointed(ShapeKind::Hull, std::move(points)); }, py::arg("points"),
        "Convex hull of points [m], an array of points x dimension.");
    shape.def_static("segment", &segmentOf, py::arg("a"), py::arg("b"),
                     "Two-sided segment from a to b [m], 2D.");
    shape.def_static(
        "chain",
        [](Numbers points, bool loop) {
            ShapeArgs args = pointed(ShapeKind::Chain, std::move(points));
            args.loop = loop;
            return args;
        },
        py::arg("points"), py::arg("loop") = false, "Polyline of two-sided segments, 2D: points x 2 [m].");
    shape.def_static("triangle_mesh", &meshOf, py::arg("vertices"), py::arg("triangles"),
                     "Two-sided triangles, 3D: vertices x 3 [m], triangles x 3 indices of vertices.");
    shape.def_static(
        "height_field",
        [](Numbers heights, double dx, double dz, double thickness) {
            ShapeArgs args = pointed(ShapeKind::HeightField, std::move(heights));
            args.sizes = {dx, dz, thickness};
            return args;
        },
        py::arg("heights"), py::arg("spacing_x"), py::arg("spacing_z"), py::arg("thickness") = 1.0,
        "Heights y [m] over a grid in x (columns) and z (rows) around the origin, 3D; solid down to "
        "`thickness` [m] under "
        "the lowest.");
    shape.def_property_readonly(
        "kind", [](const ShapeArgs& args) { return shapeKindName(args.kind); }, "'sphere', 'box', ...");
    shape.def("__repr__", [](const ShapeArgs& args) {
        return std::string("<rigor.Shape ") + shapeKindName(args.kind) + ">";
    });
}

#define RIGOR_INSTANTIATE(S) template Shape<S> toShape<S>(const ShapeArgs&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine::python
