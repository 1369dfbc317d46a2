// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies and shapes of a compiled MuJoCo model. Bodies are at their poses of the start, in the world; the library
// has the inertia in principal axes.
#include <map>

#include "scenarios/exchange/geometry/hull.hpp"
#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

using scenario::Body;
using scenario::BodyType;
using scenario::kNone;
using scenario::Mat3;
using scenario::Pose;
using scenario::Vec3;

Pose worldPose(const Conversion& c, int body) {
    return {c.point(c.m.xpos, body), normalized(c.turn(c.m.xquat, body))};
}

bool isStatic(const Conversion& c, int body) {
    return c.m.body_weldid[body] == 0 && c.m.body_mocapid[body] < 0;
}

Body convert(const Conversion& c, int body) {
    Body out;
    out.pose = worldPose(c, body);
    if (c.m.body_mocapid[body] >= 0)
        out.type = BodyType::Kinematic;
    else if (isStatic(c, body))
        out.type = BodyType::Static;
    if (c.isOff("contact")) out.collides = false;
    if (out.type != BodyType::Dynamic) return out;
    const Mat3 r = toMatrix(c.turn(c.m.body_iquat, body));
    const Vec3 moments = c.point(c.m.body_inertia, body);
    out.massProperties = {c.m.body_mass[body], c.point(c.m.body_ipos, body),
                          r * Mat3::diagonal(moments.x, moments.y, moments.z) * transpose(r)};
    out.angularVelocity = c.point(c.m.body_velocity, 2 * body);
    out.velocity = c.point(c.m.body_velocity, 2 * body + 1);
    const auto& compensation = c.places.gravityCompensation;
    if (static_cast<std::size_t>(body) < compensation.size())
        out.gravityScale = 1.0 - compensation[static_cast<std::size_t>(body)];
    return out;
}

scenario::HeightField heightField(const CompiledModel& m, int id) {
    // The grid of a scenario lies along its x and z; its x is the model's y, its z the model's x.
    const double* size = m.hfield_size.from(4 * id);
    scenario::HeightField field;
    field.columns = m.hfield_nrow[id];
    field.rows = m.hfield_ncol[id];
    field.spacingX = 2.0 * size[1] / (field.columns - 1);
    field.spacingZ = 2.0 * size[0] / (field.rows - 1);
    const double* data = m.hfield_data.from(m.hfield_adr[id]);
    double lowest = 1e300;
    for (int k = 0; k < field.rows; ++k)
        for (int i = 0; i < field.columns; ++i) {
            field.heights.push_back(size[2] * data[i * field.rows + k]);
            lowest = std::min(lowest, field.heights.back());
        }
    field.thickness = size[3] + lowest;
    return field;
}

/// The convex hull with which the library collides a mesh: its vertices, and its triangles.
scenario::TriangleMesh hullOf(const CompiledModel& m, int mesh) {
    const int* graph = m.mesh_graph.from(m.mesh_graphadr[mesh]);
    const int vertices = graph[0], faces = graph[1];
    const int* global = graph + 2 + vertices;
    const int* face = global + vertices + vertices + 3 * faces;
    scenario::TriangleMesh out;
    std::map<int, int> local;
    for (int i = 0; i < vertices; ++i) {
        const double* v = m.mesh_vert.from(3 * (m.mesh_vertadr[mesh] + global[i]));
        local[global[i]] = i;
        out.vertices.push_back({v[0], v[1], v[2]});
    }
    for (int f = 0; f < faces; ++f)
        out.triangles.push_back({local[face[3 * f]], local[face[3 * f + 1]], local[face[3 * f + 2]]});
    return out;
}

class Geoms {
  public:
    explicit Geoms(Conversion& c) : c_(c) {}

    void add(int geom) {
        const int body = c_.m.geom_bodyid[geom], to = c_.bodyOf[static_cast<std::size_t>(body)];
        const Body& target = c_.builder.scene.bodies[static_cast<std::size_t>(to)];
        const Pose pose = inverse(target.pose) * worldPose(c_, body) *
                          Pose{c_.point(c_.m.geom_pos, geom), c_.turn(c_.m.geom_quat, geom)};
        const bool isSeenOnly =
            c_.m.geom_contype[geom] == 0 && c_.m.geom_conaffinity[geom] == 0 && !isInPair(geom);
        addGeometry(geom, to, target.type, pose, isSeenOnly ? -1 : geom);
    }

  private:
    bool isInPair(int geom) const {
        for (int p = 0; p < c_.m.npair; ++p)
            if (c_.m.pair_geom1[p] == geom || c_.m.pair_geom2[p] == geom) return true;
        return false;
    }
    Surface surface(int geom) const {
        const Vec3 f = c_.point(c_.m.geom_friction, geom);
        return {f.x,
                0.0,
                f.z,
                f.y,
                c_.m.geom_condim[geom],
                c_.m.geom_priority[geom],
                isInPair(geom) ? geom + 1 : 0};
    }
    void addGeometry(int geom, int to, BodyType type, const Pose& pose, int kind) {
        const Vec3 size = c_.point(c_.m.geom_size, geom);
        const Place place = c_.placeOf(c_.places.geoms, geom);
        SceneBuilder& b = c_.builder;
        const Surface law = surface(geom);
        const bool moves = type != BodyType::Static;
        switch (c_.m.geom_type[geom]) {
            case mjGEOM_PLANE:
                if (moves) return c_.report.refuse("<geom> type", place, "a plane on a moving body");
                return b.addShape(to, scenario::HalfSpace{{0.0, 0.0, 1.0}, 0.0}, pose, law, kind);
            case mjGEOM_SPHERE:
                return b.addShape(to, scenario::Sphere{size.x}, pose, law, kind);
            case mjGEOM_CAPSULE:
                return b.addRoundZ(to, scenario::Capsule{size.x, size.y}, pose, law, kind);
            case mjGEOM_CYLINDER:
                return b.addRoundZ(to, scenario::Cylinder{size.x, size.y}, pose, law, kind);
            case mjGEOM_ELLIPSOID:
                return b.addShape(to, scenario::Ellipsoid{size}, pose, law, kind);
            case mjGEOM_BOX:
                return b.addShape(to, scenario::Box{size}, pose, law, kind);
            case mjGEOM_HFIELD:
                if (moves) return c_.report.refuse("<geom> type", place, "a height field on a moving body");
                return b.addShape(to, heightField(c_.m, c_.m.geom_dataid[geom]),
                                  pose * Pose{{}, {0.5, 0.5, 0.5, 0.5}}, law, kind);
            case mjGEOM_MESH:
                return addMesh(geom, to, moves, pose, kind, place);
            default:
                return c_.report.refuse("<geom> type", place, "a kind of shape that is not read");
        }
    }
    void addMesh(int geom, int to, bool moves, const Pose& pose, int kind, const Place& place) {
        const int mesh = c_.m.geom_dataid[geom];
        if (kind < 0) return c_.report.noPhysics("<geom> mesh", place, "a mesh that collides with nothing");
        if (c_.m.mesh_graphadr[mesh] < 0)
            return c_.report.refuse("<geom> mesh", place, "a mesh without a convex hull");
        const auto hull = hullOf(c_.m, mesh);
        const std::size_t most = 64;  // corners of a scenario's hull
        if (moves || hull.vertices.size() <= most) {
            c_.report.changed("<geom> mesh", place, "its convex hull, with which MuJoCo collides it");
            return addHull(c_.builder, c_.report, to, hull.vertices, pose, surface(geom), kind,
                           c_.options.hullCorners, "<geom> mesh", "the mesh", place);
        }
        c_.report.changed(
            "<geom> mesh", place,
            "the " + std::to_string(hull.vertices.size()) + " corners of its convex hull as triangles");
        c_.builder.addShape(to, hull, pose, surface(geom), kind);
    }

    Conversion& c_;
};

}  // namespace

Place Conversion::placeOf(const std::vector<Place>& list, int index) const {
    const auto i = static_cast<std::size_t>(index);
    return i < list.size() ? list[i] : Place{options.file.filename().string(), 0};
}

int Conversion::endOf(int body) const {
    const int index = bodyOf[static_cast<std::size_t>(body)];
    if (index == kNone) return kNone;
    return builder.scene.bodies[static_cast<std::size_t>(index)].type == BodyType::Static ? kNone : index;
}

std::string Conversion::nameOf(const Array<std::string>& names, int index, const std::string& otherwise) {
    return names[index].empty() ? otherwise : names[index];
}

void addBodies(Conversion& c) {
    for (int body = 0; body < c.m.nbody; ++body) {
        const bool hasNoMass = c.m.body_mass[body] <= 0.0;
        if (isStatic(c, body) && c.m.body_geomnum[body] == 0) {
            c.bodyOf.push_back(kNone);
            continue;
        }
        const Place place = c.placeOf(c.places.bodies, body);
        if (!isStatic(c, body) && c.m.body_mocapid[body] < 0 && hasNoMass) {
            // A body without mass moves with its parent: the library allows it only without joints.
            c.report.changed("<body>", place, "a body without mass is part of the one above it");
            c.bodyOf.push_back(c.bodyOf[static_cast<std::size_t>(c.m.body_parentid[body])]);
            continue;
        }
        const std::string name =
            body == 0 ? "ground" : c.nameOf(c.m.body_names, body, "body_" + std::to_string(body));
        c.bodyOf.push_back(c.builder.addBody(name, convert(c, body), place));
    }
}

void addGeoms(Conversion& c) {
    Geoms geoms(c);
    for (int geom = 0; geom < c.m.ngeom; ++geom) geoms.add(geom);
}

}  // namespace rigor::models::mjcf
