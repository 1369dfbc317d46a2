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

#include "adapters/ode/convert.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {
namespace {

class Writer {
  public:
    explicit Writer(std::vector<unsigned char>& bytes) : bytes_(bytes) { bytes_.clear(); }
    void put(double value) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof value);
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
    void put(const dReal* values, int count) {
        for (int i = 0; i < count; ++i) put(values[i]);
    }

  private:
    std::vector<unsigned char>& bytes_;
};

class Reader {
  public:
    explicit Reader(const std::vector<unsigned char>& bytes) : bytes_(bytes) {}
    double get() {
        if (at_ + sizeof(double) > bytes_.size())
            throw std::runtime_error("ode: a snapshot that is too short");
        double value = 0.0;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    template <std::size_t N>
    std::array<double, N> get() {
        std::array<double, N> values;
        for (double& value : values) value = get();
        return values;
    }

  private:
    const std::vector<unsigned char>& bytes_;
    std::size_t at_ = 0;
};

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
    Writer out(bytes);
    for (const auto& joint : joints_)
        for (const double value : joint->memory()) out.put(value);
    for (const auto& record : records_) {
        if (record->body == nullptr) continue;
        out.put(dBodyGetPosition(record->body), 3);
        out.put(dBodyGetQuaternion(record->body), 4);
        out.put(dBodyGetLinearVel(record->body), 3);
        out.put(dBodyGetAngularVel(record->body), 3);
        out.put(dBodyGetForce(record->body), 3);
        out.put(dBodyGetTorque(record->body), 3);
        out.put(record->turnPending ? 1.0 : 0.0);
        const Quat& from = record->turnFrom;
        for (const double c : {from.w, from.x, from.y, from.z}) out.put(c);
    }
}

bool OdeWorld::restore(const std::vector<unsigned char>& bytes) {
    Reader in(bytes);
    std::vector<std::vector<double>> memories;
    for (const auto& joint : joints_) {
        std::vector<double> memory = joint->memory();
        const double held = memory.front();
        for (double& value : memory) value = in.get();
        if (memory.front() != held) return false;
        memories.push_back(std::move(memory));
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->setMemory(memories[i]);
    for (const auto& record : records_) {
        if (record->body == nullptr) continue;
        const dBodyID body = record->body;
        const auto p = in.get<3>();
        const auto q = in.get<4>();
        const auto v = in.get<3>(), w = in.get<3>(), f = in.get<3>(), t = in.get<3>();
        dBodySetPosition(body, p[0], p[1], p[2]);
        if (!setOrientation(body, q)) throw std::runtime_error("ode: an orientation that ODE does not take");
        dBodySetLinearVel(body, v[0], v[1], v[2]);
        dBodySetAngularVel(body, w[0], w[1], w[2]);
        dBodySetForce(body, f[0], f[1], f[2]);
        dBodySetTorque(body, t[0], t[1], t[2]);
        record->turnPending = in.get() != 0.0;
        const auto from = in.get<4>();
        record->turnFrom = {from[0], from[1], from[2], from[3]};
    }
    return true;
}

}  // namespace rigor::ode
