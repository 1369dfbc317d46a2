// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The one place that names engines: what their libraries are known not to do, measured.
#include <cstring>
#include <map>
#include <sstream>

#include "adapters/conformance/kit.hpp"

namespace rigor::conformance {
namespace {

// engine, precision, preset, dimension, check, tolerance instead, reason
constexpr Deviation kDeviations[] = {
    {"bullet", "", "default", 3, "rest_creep", 2e-3, "btStaticPlaneShape: boxes drift by lateral impulses"},
    {"bullet", "f64", "default", 0, "contact_points_aside", 1e-3, "cached points move with their bodies"},
    {"bullet", "", "default", 0, "hinge_spring", 0.035, "ten sweeps share the spring out between its rows"},
    {"bullet", "", "default", 2, "perch_polygon", 0.045, "hulls are grown by their margin of 0.04 m"},
    {"bullet", "", "default", 3, "perch_hull", 0.045, "hulls are grown by their margin of 0.04 m"},
    {"bullet", "", "default", 3, "perch_cone", 0.045, "cones are grown by their margin of 0.04 m"},
    {"bullet", "", "matched", 0, "instant_plank_normal_ball", 0.051, "a point cached once keeps its normal"},
    {"bullet", "", "default", 0, "instant_plank_normal_ball", 0.151,
     "points cached thrice keep their normal"},
    {"bullet", "", "default", 0, "instant_plank_normal_box", 0.241, "cached points keep their normal"},
    {"bullet", "", "default", 2, "line_normal", 0.25, "inner edges catch balls beside them from afar"},
    {"box2d", "", "default", 2, "line_height_circle", 0.01, "circle and chain skins less slop"},
    {"box2d", "", "default", 2, "line_height_box", 0.021, "polygon and chain skins of 0.01 m"},
    {"box2d", "", "default", 2, "rest_height", 0.019, "polygon skins of 0.01 m less 0.005 m of slop"},
    {"box2d", "", "default", 2, "contact_within_face", 0.025, "faces are clipped with their skins"},
    {"box2d", "", "default", 2, "perch_box", 0.01, "circle and polygon skins of 0.01 m less 0.005 m of slop"},
    {"box2d", "", "default", 2, "perch_capsule", 0.01, "circle and polygon skins of 0.01 m less slop"},
    {"box2d", "", "default", 2, "perch_polygon", 0.01, "circle and polygon skins of 0.01 m less slop"},
    {"rigor", "", "fast", 0, "rest_height", 1.7e-4, "damped springs of 45 Hz carry the weight by overlap"},
    {"bullet", "f32", "", 0, "belt_pulls", 0.04,
     "0.036 in single precision alone; the cause is not isolated"},
    {"rigor", "f64", "fast", 3, "contact_points_aside", 2e-7, "contacts are kept in f32"},
    {"rigor", "f64", "fast", 0, "collision_momentum", 4e-7, "impulses of contacts are f32"},
    {"rigor", "f32", "fast", 0, "free_flight_velocity", 5e-5, "rounding of five sub-steps in a step"},
    {"rigor", "f32", "fast", 0, "center_of_mass_line", 1e-4, "rounding of five sub-steps in a step"},
    {"planck", "", "default", 2, "line_height_circle", 0.01, "circle and segment skins less slop"},
    {"planck", "", "default", 2, "line_height_box", 0.021, "polygon and segment skins of 0.01 m"},
    {"planck", "", "default", 2, "rest_height", 0.019, "polygon skins of 0.01 m less 0.005 m of slop"},
    {"planck", "", "default", 2, "contact_within_face", 0.025, "faces are clipped with their skins"},
    {"planck", "", "default", 2, "perch_box", 0.01,
     "circle and polygon skins of 0.01 m less 0.005 m of slop"},
    {"planck", "", "default", 2, "perch_capsule", 0.01, "circle and polygon skins of 0.01 m less slop"},
    {"planck", "", "default", 2, "perch_polygon", 0.01,
     "circle and polygon skins of 0.01 m less 0.005 m of slop"},
    {"box2d3", "", "", 2, "fixed_sag", 6e-3, "weld joints are soft constraints: 5.6 mm at 1 m and 2 kg"},
    {"rapier3d", "", "", 3, "center_of_mass_line", 1e-4, "rounding of four sub-steps in a step"},
    {"rapier2d", "", "", 2, "center_of_mass_line", 1e-4, "rounding of four sub-steps in a step"},
    {"chipmunk", "", "default", 2, "rest_height", 1e-3, "0.1 m of overlap are not corrected"},
    {"mujoco", "", "", 0, "box_box_depth", 0.0251, "two boxes report half of their overlap"},
    {"mujoco", "", "", 0, "box_box_depths", 0.0251, "two boxes report half of their overlap"},
    {"mujoco", "", "", 0, "box_box_points", 0.39, "two boxes report half of their overlap"},
    {"mujoco", "", "", 0, "joint_momentum", 0.015, "Euler's step in reduced coordinates, of first order"},
    {"mujoco", "", "default", 0, "hinge_limit_beyond", 0.013, "stops are springs of 0.02 s"},
    {"mujoco", "", "default", 0, "rolling_friction", 0.22, "friction is regularised, impratio 1"},
    {"mujoco", "", "default", 0, "rolling_stops", 0.015, "friction is regularised, impratio 1"},
    {"mujoco", "", "default", 3, "torsional_stops", 0.32, "friction is regularised, impratio 1"},
    {"mujoco", "", "matched", 0, "rolling_friction", 0.03,
     "2.9 % too much or too little; the cause is not isolated"},
    {"mujoco", "", "matched", 0, "pair_restitution", 0.0285,
     "e 0 is pushed out at 1 / (4 z^2) of the entry speed, others by steps of their spring"},
    {"cannon", "", "default", 0, "rest_creep", 5e-4, "contacts are soft and friction is found in ten sweeps"},
    {"cannon", "", "default", 3, "rest_speed", 4e-3, "contacts are soft and friction is found in ten sweeps"},
    {"cannon", "", "default", 0, "pair_friction", 1.0,
     "the bound of the friction force is taken for one of the impulse: bodies stop at once"},
    {"cannon", "", "matched", 0, "pair_friction", 0.84,
     "every point of a contact has friction for the whole weight"},
    {"cannon", "", "matched", 3, "friction_straight", 0.05,
     "friction is a pyramid of two tangents: what slides along neither nor between them is turned"},
    {"mujoco3", "", "", 0, "hull_ball_overlap", 1.0,
     "native convex collision misses balls on the axis of a cubic mesh"},
    {"mujoco3", "", "", 0, "hull_ball_depth_distance", 0.51,
     "native convex collision misses balls on the axis of a cubic mesh"},
    {"mujoco3", "", "matched", 0, "pair_restitution", 0.05, "bounces are springs of ten time steps"},
    {"mujoco3", "", "default", 0, "hinge_limit_beyond", 0.015, "limits are soft: 0.02 s"},
    {"mujoco3", "", "", 0, "joint_momentum", 0.02,
     "joints are coordinates: Euler's step of them turns momentum"},
    {"mujoco3", "", "default", 0, "rolling_friction", 0.25, "friction is soft"},
    {"mujoco3", "", "matched", 0, "rolling_friction", 0.05, "friction is soft"},
    {"mujoco3", "", "default", 0, "rolling_stops", 0.02, "friction is soft"},
    {"mujoco3", "", "default", 3, "torsional_stops", 0.35, "friction is soft"},
    {"dart", "", "", 0, "hull_hull_normal", 1.42,
     "hulls are meshes, whose contacts have normals of triangles"},
    {"dart", "", "", 0, "box_hull_normal", 1.42,
     "hulls are meshes, whose contacts have normals of triangles"},
    {"dart", "", "", 2, "hull_hull_depth", 0.76,
     "hulls are meshes, whose contacts have normals of triangles"},
    {"dart", "", "", 0, "joint_momentum", 0.015, "Euler's step in reduced coordinates, of first order"},
    {"dart", "", "", 3, "force_velocity", 1e-13, "velocities are kept in the axes of the body: rounding"},
    {"dart", "", "", 3, "force_ends", 1e-11, "velocities are kept in the axes of the body: rounding"},
    {"dart", "", "matched", 3, "pair_friction", 0.31, "friction is a pyramid of two directions"},
    {"dart", "", "matched", 3, "friction_straight", 0.19, "friction is a pyramid of two directions"},
    {"dart", "", "default", 0, "ball_found", 1.0, "balls are meshes of facets"},
    {"dart", "", "default", 0, "instant_pass_found", 1.0, "balls are meshes of facets"},
    {"dart", "", "default", 0, "instant_pass_points", 0.22, "balls are meshes of facets"},
    {"dart", "", "default", 0, "instant_pass_normal", 0.22, "balls are meshes of facets"},
    {"dart", "", "default", 0, "instant_plank_points_ball", 0.012, "balls are meshes of facets"},
    {"dart", "", "default", 3, "perch_cylinder", 0.04, "cylinders are meshes of facets"},
    {"fcl", "", "", 0, "half_space_ball_distance_told", 1.0, "no distances from unbounded shapes"},
    {"fcl", "", "", 0, "half_space_box_distance_told", 1.0, "no distances from unbounded shapes"},
    {"fcl", "", "", 0, "half_space_capsule_side_distance_told", 1.0, "no distances from unbounded shapes"},
    {"fcl", "", "", 0, "half_space_capsule_end_distance_told", 1.0, "no distances from unbounded shapes"},
    {"fcl", "", "", 0, "half_space_hull_distance_told", 1.0, "no distances from unbounded shapes"},
    {"fcl", "", "", 0, "box_capsule_side_gap", 1e-4, "libccd's distance iteration stops at 1e-6"},
    {"fcl", "", "", 0, "box_capsule_end_gap", 1e-4, "libccd's distance iteration stops at 1e-6"},
    {"fcl", "", "", 0, "hull_ball_gap", 5e-4, "libccd's distance iteration stops at 1e-6"},
};

struct Use {
    bool needed = false;
};
std::map<const Deviation*, Use>& uses() {
    static std::map<const Deviation*, Use> all;
    return all;
}

bool matches(const Deviation& d, const std::string& check, const Arena& arena) {
    const auto is = [](const char* pattern, const std::string& value) {
        return *pattern == '\0' || value == pattern;
    };
    return engineSpec().engine == d.engine && is(d.precision, arena.precision) &&
           (arena.preset.empty() || is(d.preset, arena.preset)) &&
           (d.dimension == 0 || d.dimension == arena.dimension) && check == d.check;
}

const Deviation* find(const std::string& check, const Arena& arena) {
    for (const Deviation& d : kDeviations)
        if (matches(d, check, arena)) return &d;
    return nullptr;
}

}  // namespace

void expectWithin(const std::string& check, double error, double tolerance, const Arena& arena) {
    const Deviation* known = find(check, arena);
    if (known == nullptr) {
        EXPECT_LE(error, tolerance) << "check '" << check << "'";
        return;
    }
    Use& use = uses()[known];
    if (!(error <= tolerance)) use.needed = true;
    EXPECT_LE(error, known->max) << "check '" << check << "', known deviation: " << known->reason;
}

std::vector<std::string> needlessDeviations() {
    std::vector<std::string> needless;
    for (const auto& [d, use] : uses()) {
        if (use.needed) continue;
        std::ostringstream line;
        line << "needless line of adapters/conformance/deviations.cpp: {\"" << d->engine << "\", \""
             << d->precision << "\", \"" << d->preset << "\", " << d->dimension << ", \"" << d->check
             << "\", " << d->max << "}: the check is within its own tolerance";
        needless.push_back(line.str());
    }
    return needless;
}

}  // namespace rigor::conformance
