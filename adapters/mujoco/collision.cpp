// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/mujoco/collision.hpp"

#include <algorithm>

#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/surface_points.hpp"
#include "adapters/mujoco/geoms.hpp"
#include "adapters/mujoco/library.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::mujoco {
namespace {

using adapter::ContactPoint;

/// A static body with a geom for a surface, a free one for a solid: MuJoCo tests no pair of static bodies.
std::string bodyOf(const adapter::PosedShape& side, const adapter::Geometry& solid, const char* name,
                   std::string& assets) {
    const GeomText geom = geomText(solid, name);
    assets += geom.asset;
    const Pose pose = side.pose * geom.frame;
    const bool surface = scenario::isStaticOnly(solid);
    return std::string("<body>") +
           (surface ? "" : "<freejoint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>") +
           "<geom name=\"" + name + "\" " + geom.attributes + " pos=\"" + exact(pose.position) +
           "\" quat=\"" + exact(pose.orientation) + "\"/></body>";
}

/// Room for the 50 contacts that a pair of geoms has at most, their rows, and the stack that a step of them takes, which
/// the compiler makes one of. MuJoCo itself would clear 13 MB for each model.
constexpr const char* kRoom = "<size nconmax=\"100\" njmax=\"250\" nstack=\"150000\"/>";

}  // namespace

adapter::CollisionAnswer MujocoCollisionEngine::collide(const adapter::CollisionQuery& query) const {
    adapter::checkQueryInput(query);
    useLibrary();
    const bool planar = query.dimension == 2;
    const adapter::Geometry a = planar ? adapter::planarGeometry(*query.a.geometry) : *query.a.geometry;
    const adapter::Geometry b = planar ? adapter::planarGeometry(*query.b.geometry) : *query.b.geometry;
    if (scenario::isStaticOnly(a) && scenario::isStaticOnly(b))
        throw adapter::notInAdapter("mujoco", "collisions of two surfaces without inside");
    std::string assets;
    const std::string bodies = bodyOf(query.a, a, "a", assets) + bodyOf(query.b, b, "b", assets);
    const ModelOwner model = compile(std::string("<mujoco><compiler angle=\"radian\"/>") + kRoom + "<asset>" +
                                     assets + "</asset><worldbody>" + bodies + "</worldbody></mujoco>");
    const DataOwner data(mj_makeData(model.get()));
    if (const auto* field = std::get_if<scenario::HeightField>(scenario::isStaticOnly(a) ? &a : &b)) {
        const auto heights = elevations(*field);
        std::copy(heights.begin(), heights.end(), model->hfield_data);
    }
    mj_kinematics(model.get(), data.get());
    mj_comPos(model.get(), data.get());
    mj_collision(model.get(), data.get());

    adapter::CollisionAnswer answer;
    const int first = mj_name2id(model.get(), mjOBJ_GEOM, "a");
    for (int i = 0; i < data->ncon; ++i) {
        const mjContact& c = data->contact[i];
        if (c.dist > 0.0) continue;
        ContactPoint point;
        point.bodyB = 1;
        point.normal = (c.geom1 == first ? 1.0 : -1.0) * fromMujoco(c.frame);
        point.depth = -c.dist;
        const auto [onA, onB] = adapter::surfacePoints({&a, query.a.pose}, {&b, query.b.pose},
                                                       fromMujoco(c.pos), point.normal, point.depth);
        point.pointA = onA;
        point.pointB = onB;
        answer.contacts.push_back(point);
    }
    adapter::orderDeepestFirst(answer.contacts);
    answer.overlap = !answer.contacts.empty();
    adapter::keepFirst(answer.contacts, query.maxContacts);
    return answer;
}

}  // namespace rigor::mujoco
