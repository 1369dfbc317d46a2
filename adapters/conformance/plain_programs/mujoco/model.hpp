// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Code of every MuJoCo program here around its model: MJCF from memory, mj_step, and the bodies' states after each step
// from qpos and qvel, or from the frames of bodies on joints.
#pragma once

#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

class MujocoModel {
  public:
    explicit MujocoModel(const std::string& mjcf) {
        const auto files = std::make_unique<mjVFS>();
        mj_defaultVFS(files.get());
        mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(mjcf.size()));
        std::memcpy(files->filedata[0], mjcf.data(), mjcf.size());
        char error[500] = "";
        model = mj_loadXML("model.xml", files.get(), error, sizeof error);
        mj_deleteVFS(files.get());
        if (model == nullptr) throw std::runtime_error(error);
        data = mj_makeData(model);
    }
    ~MujocoModel() {
        mj_deleteData(data);
        mj_deleteModel(model);
    }
    MujocoModel(const MujocoModel&) = delete;
    MujocoModel& operator=(const MujocoModel&) = delete;

    /// States of the bodies 1 and following, whose frames are those of their inertia.
    std::vector<BodyState> states() const {
        mjData* now = mj_copyData(nullptr, model, data);
        mj_kinematics(model, now);
        mj_comPos(model, now);
        mj_comVel(model, now);
        std::vector<BodyState> all;
        for (int b = 1; b < model->nbody; ++b) {
            mjtNum v[6];
            mj_objectVelocity(model, now, mjOBJ_BODY, b, v, 0);
            const mjtNum *p = now->xpos + 3 * b, *q = now->xquat + 4 * b;
            all.push_back(
                {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}, {v[3], v[4], v[5]}, {v[0], v[1], v[2]}});
        }
        mj_deleteData(now);
        return all;
    }
    Trajectory run(int steps) {
        Trajectory trajectory{states()};
        for (int i = 0; i < steps; ++i) {
            mj_step(model, data);
            trajectory.push_back(states());
        }
        return trajectory;
    }

    mjModel* model = nullptr;
    mjData* data = nullptr;
};

}  // namespace rigor::plain
