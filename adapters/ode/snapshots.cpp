// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The state of an ODE world as bytes. dWorldStep keeps nothing from step to step but poses, velocities and
// forces (contact joints are made anew, random numbers are seeded before each step); angles of user-mode
// motors are the adapter's. Positions, velocities and forces go in as they came out; orientations do not: ODE
// normalises what it is given, which changes the last bit of most unit quaternions. A factor is looked for
// with which the normalised product is the requested quaternion.
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "adapters/interface/snapshot_numbers.hpp"
#include "adapters/ode/convert.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {
namespace {

bool holds(dBodyID body, const std::array<double, 4>& q) {
    return std::memcmp(dBodyGetQuaternion(body), q.data(), sizeof q) == 0;
}

/// Gives the body exactly this orientation; false where no factor was found.
bool setOrientation(dBodyID body, const std::array<double, 4>& q) {
    if (holds(body, q)) return true;
    for (int i = 0; i < 100000; ++i) {
        const double factor = 1.0 + 0.000007 * i;
        const dQuaternion scaled = {factor * q[0], factor * q[1], factor * q[2], factor * q[3]};
        dBodySetQuaternion(body, scaled);
        if (holds(body, q)) return true;
    }
    return false;
}

}  // namespace

void OdeWorld::save(std::vector<unsigned char>& bytes) const {
    adapter::NumberWriter out(bytes);
    const auto put = [&](const dReal* values, std::size_t count) { out.put(std::span(values, count)); };
    for (const auto& joint : joints_) out.put(joint->memory());
    for (const auto& record : records_) {
        if (record->body == nullptr) continue;
        put(dBodyGetPosition(record->body), 3);
        put(dBodyGetQuaternion(record->body), 4);
        put(dBodyGetLinearVel(record->body), 3);
        put(dBodyGetAngularVel(record->body), 3);
        put(dBodyGetForce(record->body), 3);
        put(dBodyGetTorque(record->body), 3);
        out.put(record->turnPending ? 1.0 : 0.0);
        out.put(record->turnFrom);
    }
}

bool OdeWorld::restore(const std::vector<unsigned char>& bytes) {
    adapter::NumberReader in(bytes);
    std::vector<std::vector<double>> memories;
    for (const auto& joint : joints_) {
        std::vector<double> memory = joint->memory();
        const double held = memory.front();
        in.take(memory);
        if (memory.front() != held) return false;
        memories.push_back(std::move(memory));
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->setMemory(memories[i]);
    for (const auto& record : records_) {
        if (record->body == nullptr) continue;
        const dBodyID body = record->body;
        const Vec3 p = in.takeVector();
        std::array<double, 4> q;
        in.take(q);
        const Vec3 v = in.takeVector(), w = in.takeVector(), f = in.takeVector(), t = in.takeVector();
        dBodySetPosition(body, p.x, p.y, p.z);
        if (!setOrientation(body, q)) throw std::runtime_error("ode: an orientation that ODE does not take");
        dBodySetLinearVel(body, v.x, v.y, v.z);
        dBodySetAngularVel(body, w.x, w.y, w.z);
        dBodySetForce(body, f.x, f.y, f.z);
        dBodySetTorque(body, t.x, t.y, t.z);
        record->turnPending = in.take() != 0.0;
        record->turnFrom = in.takeQuat();
    }
    return true;
}

}  // namespace rigor::ode
