// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Outlines of shapes: straight edges as they are, round shapes as circles of their main sections and the lines
// between them.
#include <cmath>
#include <numbers>
#include <variant>

#include "engine/embedding/debug_lines.hpp"
#include "engine/shapes/hull.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

template <class S>
class ShapeOutline {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    ShapeOutline(const Pose<S>& pose, BodyId body, const DebugOptions<S>& options, LineSink<S>& sink)
        : pose_(pose), body_(body), options_(options), sink_(sink) {}

    void operator()(const Sphere<S>& sphere) const {
        if constexpr (S::dim == 2) {
            circle(Vec::Zero(), Vec::Unit(0), Vec::Unit(1), sphere.radius);
            line(Vec::Zero(), sphere.radius * Vec::Unit(0));
        } else {
            for (int axis = 0; axis < 3; ++axis)
                circle(Vec::Zero(), Vec::Unit((axis + 1) % 3), Vec::Unit((axis + 2) % 3), sphere.radius);
        }
    }
    /// Two corners of a box are the ends of an edge where they differ in one sign.
    void operator()(const Box<S>& box) const {
        const auto corner = [&](int signs) {
            Vec v = box.halfExtents;
            for (int i = 0; i < S::dim; ++i)
                if ((signs >> i & 1) == 0) v[i] = -v[i];
            return v;
        };
        for (int signs = 0; signs < 1 << S::dim; ++signs)
            for (int i = 0; i < S::dim; ++i)
                if ((signs >> i & 1) == 0) line(corner(signs), corner(signs | 1 << i));
    }
    void operator()(const Capsule<S>& capsule) const {
        const Vec along = capsule.halfLength * Vec::Unit(1);
        const auto side = [&](const Vec& across) {
            const Vec out = capsule.radius * across;
            line(Vec(out - along), Vec(out + along));
            line(Vec(-out - along), Vec(-out + along));
            arc(along, across, Vec::Unit(1), capsule.radius, Real(0.5));
            arc(Vec(-along), across, Vec(-Vec::Unit(1)), capsule.radius, Real(0.5));
        };
        side(Vec::Unit(0));
        if constexpr (S::dim == 3) {
            side(Vec::Unit(2));
            circle(along, Vec::Unit(0), Vec::Unit(2), capsule.radius);
            circle(Vec(-along), Vec::Unit(0), Vec::Unit(2), capsule.radius);
        }
    }
    void operator()(const HalfSpace<S>& plane) const {
        const Vec foot = plane.offset * plane.normal;
        const auto across = [&](const Vec& through, const Vec& direction) {
            const Vec reach = options_.planeSize * direction;
            line(Vec(through - reach), Vec(through + reach));
        };
        if constexpr (S::dim == 2) {
            across(foot, Vec(-plane.normal.y(), plane.normal.x()));
        } else {  // a grid of four by four squares
            const Vec axis = std::abs(plane.normal.x()) < Real(0.7) ? Vec::Unit(0) : Vec::Unit(1);
            const Vec u = axis.cross(plane.normal).normalized(), v = plane.normal.cross(u);
            for (int i = -2; i <= 2; ++i) {
                const Real aside = Real(0.5 * i) * options_.planeSize;
                across(Vec(foot + aside * v), u);
                across(Vec(foot + aside * u), v);
            }
        }
        line(foot, Vec(foot + options_.normalLength * plane.normal));
    }
    void operator()(const Hull<S>& hull) const {
        const HullData<S>& data = *hull.data;
        if constexpr (S::dim == 2) {
            for (std::size_t i = 0; i < data.vertices.size(); ++i)
                line(data.vertices[i], data.vertices[(i + 1) % data.vertices.size()]);
        } else {
            for (const HullEdge& edge : data.edges)
                line(data.vertices[static_cast<std::size_t>(edge.v0)],
                     data.vertices[static_cast<std::size_t>(edge.v1)]);
        }
    }
    void operator()(const Cylinder<S>& cylinder) const {
        const Vec along = cylinder.halfLength * Vec::Unit(1);
        for (const Vec& end : {along, Vec(-along)}) circle(end, Vec::Unit(0), Vec::Unit(2), cylinder.radius);
        for (const Vec& out : quarters(cylinder.radius)) line(Vec(out - along), Vec(out + along));
    }
    void operator()(const Cone<S>& cone) const {
        const Vec along = cone.halfLength * Vec::Unit(1);
        circle(Vec(-along), Vec::Unit(0), Vec::Unit(2), cone.radius);
        for (const Vec& out : quarters(cone.radius)) line(Vec(out - along), along);
    }
    void operator()(const Ellipsoid<S>& ellipsoid) const {
        const Vec h = ellipsoid.halfAxes;
        for (int axis = 0; axis < S::dim; ++axis) {
            const int i = (axis + 1) % S::dim, k = (axis + 2) % S::dim;
            ellipse(Vec(h[i] * Vec::Unit(i)), Vec(h[k] * Vec::Unit(k)));
        }
    }
    void operator()(const Segment<S>& segment) const { line(segment.a, segment.b); }
    void operator()(const Triangle<S>& triangle) const {
        for (std::size_t i = 0; i < 3; ++i) line(triangle.v[i], triangle.v[(i + 1) % 3]);
    }
    /// Pieces of surfaces; each edge between two triangles is drawn once.
    template <class Composite>
    void operator()(const Composite& composite) const {
        const auto& data = *composite.data;
        for (std::uint32_t piece = 0; piece < data.pieceCount(); ++piece) {
            const auto corners = data.corners(piece);
            if constexpr (S::dim == 2) {
                line(data.point(corners[0]), data.point(corners[1]));
            } else {
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
                    if (from < to || data.across(piece, static_cast<int>(i)) == kNullIndex)
                        line(data.point(from), data.point(to));
                }
            }
        }
    }

  private:
    void line(const Vec& from, const Vec& to) const {
        sink_.line(toWorld<S>(pose_, from), toWorld<S>(pose_, to), DebugKind::Outline, body_);
    }
    /// About the origin, through u and v.
    void ellipse(const Vec& u, const Vec& v) const { arc(Vec::Zero(), u, v, Real(1), Real(1)); }
    void circle(const Vec& center, const Vec& u, const Vec& v, Real radius) const {
        arc(center, u, v, radius, Real(1));
    }
    /// An arc from u over v; `turns` is its share of a whole turn.
    void arc(const Vec& center, const Vec& u, const Vec& v, Real radius, Real turns) const {
        const int count = std::max(1, static_cast<int>(turns * Real(options_.segments)));
        const auto at = [&](int i) {
            const Real angle = Real(2) * std::numbers::pi_v<Real> * turns * Real(i) / Real(count);
            return Vec(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
        };
        for (int i = 0; i < count; ++i) line(at(i), at(i + 1));
    }
    static std::array<Vec, 4> quarters(Real radius) {
        const Vec x = radius * Vec::Unit(0), z = radius * Vec::Unit(S::dim - 1);
        return {x, z, Vec(-x), Vec(-z)};
    }

    const Pose<S>& pose_;
    BodyId body_;
    const DebugOptions<S>& options_;
    LineSink<S>& sink_;
};

}  // namespace

template <class S>
void drawShape(const Shape<S>& shape, const Pose<S>& pose, BodyId body, const DebugOptions<S>& options,
               LineSink<S>& sink) {
    std::visit(ShapeOutline<S>(pose, body, options, sink), shape);
}

#define RIGOR_INSTANTIATE(S) \
    template void drawShape<S>(const Shape<S>&, const Pose<S>&, BodyId, const DebugOptions<S>&, LineSink<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
