// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Common part of the demos of ODE (the manual's "how to use", chapter 3.10): a world, a space, a group for
// contact joints, a near callback, and the loop collide, step, empty the group. No adapter code and no
// scenario. Pairs are taken in the order in which their geoms were made: spaces have orders of their own, and
// with the library's CFM of 1e-10 a stack's result depends on it. Moments that dMassSetBox and the scenario
// would round differently are given in both.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

class OdeSimulation {
  public:
    OdeSimulation() {
        [[maybe_unused]] static const int initialised = dInitODE2(0);
        world = dWorldCreate();
        space = dSimpleSpaceCreate(nullptr);
        contacts_ = dJointGroupCreate(0);
        dWorldSetGravity(world, 0, -9.81, 0);
        dWorldSetCFM(world, 1e-10);
        surface.mode = dContactApprox1;
    }
    ~OdeSimulation() {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space);
        dWorldDestroy(world);
    }
    OdeSimulation(const OdeSimulation&) = delete;
    OdeSimulation& operator=(const OdeSimulation&) = delete;

    /// A geom in the space; a later one is the second of a pair.
    dGeomID inSpace(dGeomID geom) {
        const int number = order_.size();
        order_[geom] = number;
        dSpaceAdd(space, geom);
        return geom;
    }
    /// A body of this mass at rest; null, a fixed object, if the mass is null.
    dBodyID addBody(const dMass* mass, const Vec3& position) {
        dBodyID body = nullptr;
        if (mass != nullptr) {
            body = dBodyCreate(world);
            dBodySetMass(body, mass);
            dBodySetPosition(body, position.x, position.y, position.z);
        }
        bodies.push_back(body);
        fixed_.push_back(position);
        return body;
    }
    /// One state of every body, in the order of creation.
    std::vector<BodyState> states() const {
        std::vector<BodyState> all;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            BodyState state;
            state.position = fixed_[i];
            if (bodies[i] != nullptr) {
                const dReal* q = dBodyGetQuaternion(bodies[i]);
                state.position = vector(dBodyGetPosition(bodies[i]));
                state.orientation = {q[0], q[1], q[2], q[3]};
                state.velocity = vector(dBodyGetLinearVel(bodies[i]));
                state.angularVelocity = vector(dBodyGetAngularVel(bodies[i]));
            }
            all.push_back(state);
        }
        return all;
    }
    void step(dReal dt) {
        pairs_.clear();
        dSpaceCollide(space, this, [](void* self, dGeomID a, dGeomID b) {
            static_cast<OdeSimulation*>(self)->pairs_.emplace_back(a, b);
        });
        for (auto& [a, b] : pairs_)
            if (order_[a] > order_[b]) std::swap(a, b);
        std::sort(pairs_.begin(), pairs_.end(), [&](const auto& p, const auto& q) {
            return std::pair(order_[p.first], order_[p.second]) <
                   std::pair(order_[q.first], order_[q.second]);
        });
        for (const auto& [a, b] : pairs_) touch(a, b);
        dWorldStep(world, dt);
        dJointGroupEmpty(contacts_);
    }
    Trajectory run(dReal dt, int steps) {
        Trajectory trajectory{states()};
        for (int i = 0; i < steps; ++i) {
            step(dt);
            trajectory.push_back(states());
        }
        return trajectory;
    }

    dWorldID world = nullptr;
    dSpaceID space = nullptr;
    dSurfaceParameters surface{};  ///< surface of every contact
    std::vector<dBodyID> bodies;

  private:
    static Vec3 vector(const dReal* v) { return {v[0], v[1], v[2]}; }

    void touch(dGeomID a, dGeomID b) {
        constexpr int kMost = 8;
        dContact contact[kMost];
        const int count = dCollide(a, b, kMost, &contact[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            contact[i].surface = surface;
            const dJointID joint = dJointCreateContact(world, contacts_, contact + i);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
        }
    }

    dJointGroupID contacts_ = nullptr;
    std::map<dGeomID, int> order_;
    std::vector<std::pair<dGeomID, dGeomID>> pairs_;
    std::vector<Vec3> fixed_;
};

}  // namespace rigor::plain
