// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The statements of MuJoCo about an unchanged MJCF file, and whether an imported scenario says the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"

namespace rigor::models::testing {

/// Poses are those of the start, in the world.
struct LibrarySays {
    struct Body {
        std::string name;
        scenario::Vec3 position;
        scenario::Mat3 axes;
        double mass;
        scenario::Vec3 centre;
        scenario::Mat3 inertia;  ///< about the centre, in the axes of the world
    };
    struct Joint {
        std::string name;
        scenario::Vec3 anchor, axis;
        double lower, upper;  ///< limits, counted from the start
    };
    std::vector<Body> bodies;
    std::vector<Joint> joints;
};

LibrarySays libmujocoSays(const std::filesystem::path& file);

/// The folder of @mujoco/mujoco, or "" where it is not installed.
std::filesystem::path mujoco3Package();
LibrarySays mujoco3Says(const std::filesystem::path& file);

/// Expects the mass, centre, inertia and pose of every body, and the anchor, axis and limits of every hinge and slider.
void expectAsLibrarySays(const scenario::Scenario& scenario, const LibrarySays& library);

}  // namespace rigor::models::testing
