// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small scenes for the tests of the step, alike in both dimensions.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "engine/pipeline/world.hpp"

namespace rigor::engine::test {

inline constexpr double kGravity = 9.81;

template <class S>
WorldDef<S> earth() {
    WorldDef<S> def;
    def.gravity[1] = -static_cast<typename S::Real>(kGravity);
    return def;
}
/// Settings of tests whose closed forms are those of steps of symplectic Euler.
template <class S>
WorldDef<S> euler() {
    WorldDef<S> def;
    def.integrator = "symplectic_euler";
    return def;
}
template <class S>
WorldDef<S> earthByEuler() {
    WorldDef<S> def = earth<S>();
    def.integrator = "symplectic_euler";
    return def;
}
/// Member of WorldDef that holds the choice of a family of algorithmFamilies(). Null for faults, which break
/// the tested code.
template <class S>
std::string* choiceOf(WorldDef<S>& def, const std::string& family) {
    return family == "broad_phase"            ? &def.broadPhase
           : family == "narrow_phase"         ? &def.narrowPhase
           : family == "manifold"             ? &def.manifold
           : family == "integrator"           ? &def.integrator
           : family == "rotation"             ? &def.rotation
           : family == "bounding_volume"      ? &def.boundingVolume
           : family == "orientation_update"   ? &def.orientationUpdate
           : family == "solver"               ? &def.solver
           : family == "friction"             ? &def.friction
           : family == "restitution"          ? &def.restitution
           : family == "friction_combine"     ? &def.frictionCombine
           : family == "restitution_combine"  ? &def.restitutionCombine
           : family == "position_correction"  ? &def.positionCorrection
           : family == "continuous_collision" ? &def.continuousCollision
           : family == "sleeping"             ? &def.sleeping
                                              : nullptr;
}
template <class S>
typename S::Vec at(double x, double y) {
    typename S::Vec v = S::Vec::Zero();
    v[0] = static_cast<typename S::Real>(x);
    v[1] = static_cast<typename S::Real>(y);
    return v;
}
/// Angular velocity about +z.
template <class S>
typename S::Ang spin(double w) {
    if constexpr (S::dim == 2)
        return static_cast<typename S::Real>(w);
    else
        return typename S::Ang(0, 0, static_cast<typename S::Real>(w));
}
template <class S>
double spinOf(const typename S::Ang& w) {
    if constexpr (S::dim == 2)
        return static_cast<double>(w);
    else
        return static_cast<double>(w.z());
}
template <class S>
typename S::Inertia isotropic(double value) {
    const auto v = static_cast<typename S::Real>(value);
    if constexpr (S::dim == 2)
        return v;
    else
        return typename S::Inertia(S::Inertia::Identity() * v);
}
template <class S>
ShapeId attach(World<S>& world, BodyId body, const Shape<S>& shape, std::uint32_t material) {
    ShapeDef<S> def;
    def.shape = shape;
    def.material = material;
    return world.addShape(body, def);
}
/// Solid below y = 0.
template <class S>
BodyId addGround(World<S>& world, std::uint32_t material) {
    BodyDef<S> def;
    def.type = BodyType::Static;
    const BodyId id = world.addBody(def);
    attach<S>(world, id, HalfSpace<S>{S::Vec::Unit(1), 0}, material);
    return id;
}
/// Sphere with the inertia of a solid sphere in both dimensions, so that the plane and space agree.
template <class S>
BodyId addBall(World<S>& world, double x, double y, double radius, double mass, std::uint32_t material,
               double vx = 0, double vy = 0, double w = 0) {
    BodyDef<S> def;
    def.mass = static_cast<typename S::Real>(mass);
    def.inertia = isotropic<S>(0.4 * mass * radius * radius);
    def.pose.p = at<S>(x, y);
    def.velocity = at<S>(vx, vy);
    def.angularVelocity = spin<S>(w);
    const BodyId id = world.addBody(def);
    attach<S>(world, id, Sphere<S>{static_cast<typename S::Real>(radius)}, material);
    return id;
}
/// Cube (2D: square) of half extent `half`.
template <class S>
BodyId addCube(World<S>& world, double x, double y, double half, double mass, std::uint32_t material,
               double vx = 0) {
    BodyDef<S> def;
    def.mass = static_cast<typename S::Real>(mass);
    def.inertia = isotropic<S>(2.0 / 3.0 * mass * half * half);
    def.pose.p = at<S>(x, y);
    def.velocity = at<S>(vx, 0);
    const BodyId id = world.addBody(def);
    attach<S>(world, id, Box<S>{S::Vec::Constant(static_cast<typename S::Real>(half))}, material);
    return id;
}
/// Tolerance by precision.
template <class S>
constexpr double tol(double forDouble, double forFloat) {
    return sizeof(typename S::Real) == 8 ? forDouble : forFloat;
}
/// Tolerance for the contacts of a solver: patches of `wide` have impulses in f32 (solvers/wide/patch.hpp).
template <class S>
constexpr double tol(std::string_view solver, double forDouble, double forFloat) {
    constexpr double kPatch = 1e-6;
    return tol<S>(solver == "wide" ? std::max(forDouble, kPatch) : forDouble, forFloat);
}

}  // namespace rigor::engine::test
