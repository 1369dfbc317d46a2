// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body that slides or rolls over a plane made of pieces (triangle mesh, height field, chain), beside the
// same body on the same plane in one piece (half-space): what the inner edges do to it. The pieces are laid
// only where the body comes. A case is fixed by its description alone.
#pragma once

#include <cstdint>
#include <string>

namespace rigor::engine::edges {

enum class Ground : std::uint8_t { Mesh, Field, Chain };
/// A chain has circles, squares and 2D capsules in their place. A capsule lies along its way, or across it.
enum class Body : std::uint8_t { Sphere, Box, CapsuleAlong, CapsuleAcross };

struct Case {
    Ground ground = Ground::Mesh;
    Body body = Body::Sphere;
    double angle = 0;  ///< angle from the grid of the pieces to the way of the body, about its normal [rad]
    double slope =
        0;  ///< slope of the plane along the way; the vertices of a mesh are turned, and rounded [rad]
    double speed = 3;     ///< speed at the start [m/s]
    double squares = 1;   ///< side of the squares over the size of the body (0.3 m)
    double friction = 0;  ///< coefficient of the pair
    double duration = 1;  ///< [s], in steps of 1/60 s
    bool jitter =
        false;  ///< vertices of a mesh or chain are moved within the ground by up to a quarter of a square
    bool fast = false;     ///< preferSpeed() in place of the default settings
    bool single = false;   ///< f32
    std::string settings;  ///< settings of the world in place of the preset's: "substeps=8,slop=0"
};

/// Greatest differences over the run from the body on the half-space.
struct Outcome {
    double position = 0;        ///< over the length of the way until then, at least the size of the body
    double velocity = 0;        ///< over the speed at the start
    double spin = 0;            ///< [rad/s]
    double way = 0;             ///< length of the way on the half-space [m]
    int pieces = 0;             ///< number of pieces of the ground
    double secondsPerStep = 0;  ///< wall time on the pieces, mean
};

/// `follow`: writes both bodies to standard output after every step.
Outcome run(const Case& what, bool follow = false);

/// Description in the form that measure_inner_edges reads: "ground=mesh body=sphere ...".
std::string describe(const Case& what);

}  // namespace rigor::engine::edges
