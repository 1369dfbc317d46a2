// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Compiles the text of a model, and writes into it what the text can not hold exactly: moments of inertia, elevations of
// height fields, damping of single bodies.
#include "adapters/mujoco/model.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/mujoco/geoms.hpp"
#include "adapters/mujoco/mjcf.hpp"

namespace rigor::mujoco {
namespace {

using scenario::Body;
using scenario::BodyType;

int idOf(const mjModel& model, mjtObj kind, const std::string& name) {
    return mj_name2id(&model, kind, name.c_str());
}

void findIds(const adapter::Scenario& scenario, Model& out) {
    const mjModel& model = *out.model;
    out.shapes.resize(model.ngeom);
    for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
        const int body = static_cast<int>(b);
        out.bodies.push_back(idOf(model, mjOBJ_BODY, bodyName(body)));
        out.geoms.emplace_back(scenario.bodies[b].shapes.size(), -1);
        if (!scenario.bodies[b].collides) continue;
        for (std::size_t i = 0; i < scenario.bodies[b].shapes.size(); ++i) {
            const int geom = idOf(model, mjOBJ_GEOM, geomName(body, static_cast<int>(i)));
            out.geoms[b][i] = geom;
            out.shapes[geom] = {body, static_cast<int>(i)};
        }
    }
}

void fillHeightFields(const adapter::Scenario& scenario, Model& out) {
    mjModel& model = *out.model;
    for (std::size_t b = 0; b < scenario.bodies.size(); ++b)
        for (std::size_t i = 0; i < scenario.bodies[b].shapes.size(); ++i) {
            const auto* field = std::get_if<scenario::HeightField>(&scenario.bodies[b].shapes[i].geometry);
            if (field == nullptr || out.geoms[b][i] < 0) continue;
            const auto data = elevations(*field);
            std::copy(data.begin(), data.end(),
                      model.hfield_data + model.hfield_adr[model.geom_dataid[out.geoms[b][i]]]);
        }
}

/// Part c of the velocity that damping takes per second, as MuJoCo's damping c M: implicit in Euler's step and in the
/// implicit one, v / (1 + h c).
double dampingFor(double kept, double dt, bool explicitly) {
    return explicitly ? -std::log(kept) : (std::pow(kept, -dt) - 1.0) / dt;
}

void setBodies(const adapter::Scenario& scenario, bool planar, double dt, bool explicitly, Model& out) {
    mjModel& model = *out.model;
    for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
        const Body& body = scenario.bodies[b];
        if (body.type != BodyType::Dynamic) continue;
        const Link& link = out.forest.links[b];
        toMujoco(link.moments, model.body_inertia + 3 * out.bodies[b]);
        if (body.linearVelocityKept == 1.0 && body.angularVelocityKept == 1.0) continue;
        if (link.joint != kNone) continue;  // a force (world.cpp)
        const double linear = dampingFor(body.linearVelocityKept, dt, explicitly);
        const double angular = dampingFor(body.angularVelocityKept, dt, explicitly);
        mjtNum* damping = model.dof_damping + model.body_dofadr[out.bodies[b]];
        const int travels = planar ? 2 : 3;
        for (int i = 0; i < travels; ++i) damping[i] = linear * body.massProperties.mass;
        if (planar) {
            damping[2] = angular * link.moments.z;
            continue;
        }
        damping[3] = angular * link.moments.x;
        damping[4] = angular * link.moments.y;
        damping[5] = angular * link.moments.z;
    }
}

/// The solvers end when their improvement, by the mean inertia of the model, is small: kinematic bodies do not count.
void setMeanInertia(const adapter::Scenario& scenario, Model& out) {
    mjModel& model = *out.model;
    double sum = 0.0;
    int count = 0;
    bool kinematic = false;
    for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
        const Body& body = scenario.bodies[b];
        kinematic = kinematic || body.type == BodyType::Kinematic;
        if (body.type != BodyType::Dynamic) continue;
        const Vec3& moments = out.forest.links[b].moments;
        sum += 3.0 * body.massProperties.mass + moments.x + moments.y + moments.z;
        count += 6;
    }
    if (kinematic && count > 0) model.stat.meaninertia = sum / count;
}

}  // namespace

Model buildModel(const adapter::Scenario& scenario, const adapter::PairTable& pairs, bool planar, double dt,
                 const ModelSettings& settings) {
    Model out;
    out.forest = spanningForest(scenario, planar);
    out.model = compile(mjcfOf(scenario, pairs, planar, dt, settings, out));
    findIds(scenario, out);
    fillHeightFields(scenario, out);
    setBodies(scenario, planar, dt, settings.integrator == "RK4", out);
    const DataOwner data(mj_makeData(out.model.get()));
    mj_setConst(out.model.get(), data.get());
    setMeanInertia(scenario, out);
    return out;
}

}  // namespace rigor::mujoco
