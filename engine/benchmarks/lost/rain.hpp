// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies on uneven ground, to count those that get through it. A case is fixed by its description alone: the
// same case has the same bodies in the same order, so that a body that was lost can be followed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rigor::engine::lost {

/// Plate: a box of 1 mm, flat or a slope, in place of a surface.
enum class Ground : std::uint8_t { Mesh, Field, Chain, Plate };
/// Motion of the bodies: they fall from a height, fall into a heap, roll, slide over the edges between
/// triangles, or are shot at the ground from all sides at 300 m/s.
enum class Motion : std::uint8_t { Drop, Pile, Roll, Slide, Shoot };
enum class Continuous : std::uint8_t { None, ConservativeAdvancement, Speculative };
/// Heights of the ground over the side c of its squares: none; random, up to 0.3 c; a slope of 20 degrees;
/// ridges and gullies of 45 degrees; random over rectangles of 1 : 20, whose triangles are slivers.
enum class Form : std::uint8_t { Flat, Rough, Slope, Ridges, Slivers };

struct Case {
    Ground ground = Ground::Mesh;
    Motion motion = Motion::Drop;
    Form form = Form::Flat;
    bool fast = false;    ///< preferSpeed() in place of the default settings
    bool single = false;  ///< f32
    Continuous continuous = Continuous::None;
    double squares = 1;  ///< side of the ground's squares over the mean size of the bodies (0.3 m)
    int bodies = 1000;
    double duration = 3;  ///< [s], in steps of 1/60 s
    std::uint64_t seed = 0;
};

/// A body that was more than twice its radius under the ground.
struct Loss {
    int body = 0;  ///< its place in the order of bodies, from 0
    int step = 0;  ///< first step after which it was found there
    std::string shape;
};

/// A body on the ground at the end whose middle is less than half its inner radius over it: it overlaps the
/// ground by more than half of what it can without being lost.
struct Sunk {
    int body = 0;
    std::string shape;
    double height = 0;  ///< height of the middle over the ground, in inner radii
};

struct Outcome {
    std::vector<Loss> lost;
    std::vector<Sunk> sunk;
    int away = 0;  ///< bodies that have left the ground over its border; they are not followed any more
    double secondsPerStep = 0;  ///< wall time, mean
};

/// `follow`: the body whose height over the ground, speed and contacts are written to standard output after
/// every step; -1: none.
Outcome run(const Case& what, int follow = -1);

/// Description in the form that count_lost_bodies reads: "ground=mesh motion=drop ...".
std::string describe(const Case& what);
/// The form and the size of squares that belong to a seed: all combinations of them in 25 seeds.
void setGroundOfSeed(Case& what);

}  // namespace rigor::engine::lost
