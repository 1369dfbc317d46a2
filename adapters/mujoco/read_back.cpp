// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything that is read out of MuJoCo's model and data: states, contacts, what was built, counters.
#include <algorithm>
#include <limits>

#include "adapters/mujoco/world.hpp"

namespace rigor::mujoco {

using adapter::BodyState;
using adapter::ContactPoint;
using scenario::BodyType;

BodyState MujocoWorld::stateOf(int body) const {
    const Link& link = model_.forest.links[body];
    if (link.fixed) return {start_[body].position, start_[body].orientation, {}, {}};
    if (reset_) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const Vec3 none{nan, nan, nan};
        return {none, {nan, nan, nan, nan}, none, none};
    }
    const int id = model_.bodies[body];
    Pose pose{fromMujoco(data_->xpos + 3 * id), quatFromMujoco(data_->xquat + 4 * id)};
    mjtNum velocity[6];
    mj_objectVelocity(model_.model.get(), data_.get(), mjOBJ_BODY, id, velocity, 0);
    BodyState state{{}, {}, fromMujoco(velocity + 3), fromMujoco(velocity)};
    if (link.joint == kNone) {
        // Without the rounding of MuJoCo's spatial velocities.
        const mjtNum* v = data_->qvel + model_.model->body_dofadr[id];
        state.velocity = planar_ ? Vec3{v[0], v[1], 0.0} : fromMujoco(v);
        state.angularVelocity = planar_ ? Vec3{0.0, 0.0, v[2]} : rotate(pose.orientation, fromMujoco(v + 3));
    }
    pose = pose * inverse(link.frame);
    state.position = pose.position;
    state.orientation = pose.orientation;
    return state;
}

void MujocoWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = stateOf(static_cast<int>(i));
}

void MujocoWorld::readContacts(std::vector<ContactPoint>& contacts) const {
    contacts.clear();
    if (steps_ == 0 || reset_) return;
    for (int i = 0; i < data_->ncon; ++i) {
        const mjContact& c = data_->contact[i];
        if (c.exclude != 0 || c.efc_address < 0) continue;
        const auto &first = model_.shapes[c.geom1], &second = model_.shapes[c.geom2];
        const bool ordered = first.body < second.body;
        const double sign = ordered ? 1.0 : -1.0;
        mjtNum force[6];
        mj_contactForce(model_.model.get(), data_.get(), i, force);
        // Rows of the frame: the normal from geom1 to geom2, and two tangents.
        const Vec3 normal = sign * fromMujoco(c.frame);
        const Vec3 tangential = force[1] * fromMujoco(c.frame + 3) + force[2] * fromMujoco(c.frame + 6);
        const Vec3 middle = fromMujoco(c.pos);
        ContactPoint point;
        point.bodyA = std::min(first.body, second.body);
        point.bodyB = std::max(first.body, second.body);
        point.shapeA = ordered ? first.shape : second.shape;
        point.shapeB = ordered ? second.shape : first.shape;
        point.normal = normal;
        point.depth = -c.dist;
        point.pointA = middle + 0.5 * point.depth * normal;
        point.pointB = middle - 0.5 * point.depth * normal;
        point.hasImpulse = true;
        point.normalImpulse = dt_ * force[0];
        point.frictionImpulse = sign * dt_ * tangential;
        contacts.push_back(point);
    }
    std::stable_sort(contacts.begin(), contacts.end(), [](const ContactPoint& a, const ContactPoint& b) {
        return std::pair(a.bodyA, a.bodyB) < std::pair(b.bodyA, b.bodyB);
    });
}

adapter::ReadBack MujocoWorld::readBack() const {
    const mjModel& model = *model_.model;
    adapter::ReadBack back;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
        const Link& link = model_.forest.links[i];
        const int id = model_.bodies[i];
        adapter::BodyReadBack entry;
        entry.state = stateOf(static_cast<int>(i));
        entry.centerOfMass = link.frame * fromMujoco(model.body_ipos + 3 * id);
        if (scenario_.bodies[i].type == BodyType::Dynamic) {
            entry.mass = model.body_mass[id];
            const mjtNum* m = model.body_inertia + 3 * id;
            const Mat3 axes = toMatrix(link.frame.orientation);
            const Mat3 inertia = axes * Mat3::diagonal(m[0], m[1], m[2]) * transpose(axes);
            if (planar_)
                entry.inertia(2, 2) = inertia(2, 2);
            else
                entry.inertia = inertia;
            entry.gravity = scenario_.bodies[i].gravityScale * fromMujoco(model.opt.gravity);
        } else {
            entry.centerOfMass = scenario_.bodies[i].massProperties.centerOfMass;
        }
        back.bodies.push_back(entry);
    }
    for (const auto& example : pairs_.examples()) {
        const int a = model_.geoms[example.a.body][example.a.shape],
                  b = model_.geoms[example.b.body][example.b.shape];
        double friction = std::max(model.geom_friction[3 * a], model.geom_friction[3 * b]);
        int dimension = std::max(model.geom_condim[a], model.geom_condim[b]);
        const mjtNum* solref = model.geom_solref + mjNREF * a;
        for (int p = 0; p < model.npair; ++p) {
            const int one = model.pair_geom1[p], two = model.pair_geom2[p];
            if (!((one == a && two == b) || (one == b && two == a))) continue;
            friction = model.pair_friction[5 * p];
            dimension = model.pair_dim[p];
            solref = model.pair_solref + mjNREF * p;
        }
        back.pairs.push_back(
            {example.materialA, example.materialB, dimension > 1 ? friction : 0.0, restitutionOf(solref)});
    }
    return back;
}

adapter::StepCounters MujocoWorld::counters() const {
    adapter::StepCounters counters;
    counters.contacts = data_->ncon;
    counters.solverIterations = data_->solver_iter;
    if (data_->solver_iter > 0) {
        const int last = std::min(data_->solver_iter, static_cast<int>(mjNSOLVER)) - 1;
        counters.residual = data_->solver[last].improvement;
    }
    return counters;
}

}  // namespace rigor::mujoco
