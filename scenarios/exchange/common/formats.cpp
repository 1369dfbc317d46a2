// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/formats.hpp"

namespace rigor::models {

const std::vector<Format>& formats() {
    static const std::vector<Format> all{
        {"mjcf", "MuJoCo's model files", "libmujoco-dev libqhull-dev libtinyxml2-dev"},
        {"urdf", "robots of ROS", "liburdfdom-dev libassimp-dev libqhull-dev libtinyxml2-dev"},
        {"sdf", "worlds and models of Gazebo", "libsdformat-dev libassimp-dev libqhull-dev libtinyxml2-dev"},
        {"mesh", "OBJ, STL, glTF and other meshes", "libassimp-dev libqhull-dev libtinyxml2-dev"},
    };
    return all;
}

const Format* findFormat(const std::string& name) {
    for (const Format& format : formats())
        if (name == format.name) return &format;
    return nullptr;
}

}  // namespace rigor::models
