// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A model as a library has compiled it, at its start: what libmujoco 2.2.2 and MuJoCo 3 give alike. Numbers of kinds (mjtGeom,
// mjtJoint, mjEQ_CONNECT and mjEQ_WELD, mjWRAP_SITE) are the same in both.
#pragma once

#include <mujoco/mujoco.h>

#include <set>
#include <string>
#include <vector>

namespace rigor::models::mjcf {

/// Values with the signed numbers of MuJoCo as places.
template <class T>
class Array {
  public:
    std::vector<T> values;
    const T& operator[](int index) const { return values[static_cast<std::size_t>(index)]; }
    const T* from(int index) const { return values.data() + index; }
    bool empty() const { return values.empty(); }
};

struct CompiledModel {
    std::string library;  ///< name and version of what compiled it
#define SIZE(name) int name = 0;
#define MODEL_FIELD(type, name, count, width) Array<type> name;
#define NEWER_FIELD(type, name, count, width) Array<type> name;
#define START_FIELD(type, name, count, width) Array<type> name;
#include "scenarios/exchange/mjcf/compiled_fields.def"
    /// Angular velocity [rad/s] and velocity of the centre of mass [m/s] of each body, in the world.
    Array<double> body_velocity;
    /// Largest violation [m, rad] of each equality at the start.
    Array<double> eq_violation;
    Array<std::string> body_names, joint_names, equality_names, tendon_names;  ///< "" without a name
    double timestep = 0.0;
    Array<double> gravity;
    bool onlyPairs = false, onlyDynamic = false;  ///< `collision` of <option>, until 2.3
    std::set<std::string> off;                    ///< flags of <option> that are switched off

    /// Throws std::runtime_error where an array has not the size of its list.
    void requireSizes() const;
    /// Whether all that becomes a number of the scenario is finite and below 1e15.
    bool isFinite() const;
};

}  // namespace rigor::models::mjcf
