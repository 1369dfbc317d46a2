// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes of heavy impacts, with the penetration measured by closest points of all pairs after every step,
// not by the contacts of the engine's own step.
#pragma once

#include <cstdint>
#include <string>

namespace rigor::engine::impacts {

/// A wall of bricks that a heavy ball hits; a turning box with bodies of mixed shapes.
enum class Scene : std::uint8_t { Wall, Tumbler };

struct Case {
    Scene scene = Scene::Wall;
    bool fast = false;    ///< preferSpeed() in place of the default settings
    bool single = false;  ///< f32
    int bodies = 500;     ///< bricks, or bodies in the tumbler
    double speed = 15;    ///< speed of the ball, or of the middles of the tumbler's walls [m/s]
    double duration = 3;  ///< [s], in steps of 1/60 s
    std::uint64_t seed = 0;
    std::string settings;  ///< settings of the world by their keys: "substeps=8,contact_frequency=60"
};

struct Outcome {
    double worst = 0;           ///< largest penetration after any step [m]
    int worstStep = 0;          ///< number of that step, from 1
    std::string worstPair;      ///< shapes of that pair
    double mean = 0;            ///< mean over the steps of the largest penetration after each [m]
    double secondsPerStep = 0;  ///< wall time, mean
};

/// `follow`: writes the largest penetration after every step.
Outcome run(const Case& what, bool follow = false);

/// Description in the form that measure_heavy_impacts reads: "scene=wall preset=default ...".
std::string describe(const Case& what);

}  // namespace rigor::engine::impacts
