// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MJCF, the XML of MuJoCo's models, of a scenario. Names are those of the scenario's indices: body b3, geom g3_0, joints
// j5 and (of a wheel) j5_spin, tendon t5, actuators a5 and a5_spin.
#pragma once

#include <string>

#include "adapters/mujoco/model.hpp"

namespace rigor::mujoco {

/// Pages of MuJoCo's documentation that show what its joints and constraints lack.
inline constexpr const char* kWholeRotation =
    "MuJoCo XML reference, joint/range and joint/stiffness: those of a ball are of its whole rotation";
inline constexpr const char* kEqualities =
    "MuJoCo XML reference, equality: connect, weld, joint and tendon; none of a slider, of limits or of "
    "motors, and no "
    "other constraint has a flag `active`";

std::string bodyName(int body);
std::string geomName(int body, int shape);
std::string jointTag(int joint, const char* what = "");

/// The whole text. Adds to `model` the surfaces that it has chosen.
std::string mjcfOf(const adapter::Scenario& scenario, const adapter::PairTable& pairs, bool planar, double dt,
                   const ModelSettings& settings, Model& model);

}  // namespace rigor::mujoco
