// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Base of every test of the kit: the engine under test, the arenas it is tested in (preset, dimension,
// precision), scenarios of one or two bodies, and comparisons that know the documented deviations.
#pragma once

#include <gtest/gtest.h>

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"

namespace rigor::conformance {

using adapter::BodyState;
using adapter::ContactPoint;
using scenario::Body;
using scenario::BodyType;
using scenario::fromAxisAngle;
using scenario::Geometry;
using scenario::Joint;
using scenario::JointType;
using scenario::MassProperties;
using scenario::Mat3;
using scenario::Pose;
using scenario::Quat;
using scenario::Scenario;
using scenario::toMatrix;
using scenario::Vec3;

inline constexpr double kPi = 3.14159265358979323846;

/// Loads the engine of a spec ("bullet", "bullet:precision=f32") for the rest of the process.
void useEngine(const std::string& spec);
const adapter::Engine& engine();
const adapter::EngineSpec& engineSpec();

/// One way to run the engine.
struct Arena {
    std::string preset;     ///< one of presetNames()
    int dimension = 3;      ///< dimension of the scenarios
    std::string precision;  ///< "f32", "f64"
    bool f64() const { return precision == "f64"; }
};
std::ostream& operator<<(std::ostream& out, const Arena& arena);
/// Every preset in every dimension, native or planar, at every precision the loaded module can select; empty
/// for engines without dynamics.
std::vector<Arena> dynamicsArenas();
/// Dimensions of collision queries and broad phases.
std::vector<int> queryDimensions();
std::string arenaName(const testing::TestParamInfo<Arena>& info);
std::string dimensionName(const testing::TestParamInfo<int>& info);

// ------------------------------------------------------------------------------------ known deviations
// Something a library is known not to do. A check that is within its ordinary tolerance all the same fails at
// the end of the run: the line has to go.
struct Deviation {
    const char* engine;
    const char* precision;  ///< "" for any
    const char* preset;     ///< "" for all and for queries
    int dimension;          ///< 0 for both
    const char* check;
    double max;  ///< replaces the check's tolerance
    const char* reason;
};
/// Fails unless error <= tolerance, or <= that of the known deviation of this name.
void expectWithin(const std::string& check, double error, double tolerance, const Arena& arena);
/// Failures for deviations that were checked but never needed.
std::vector<std::string> needlessDeviations();

// ------------------------------------------------------------------------------------------ scenarios
/// The base of all dynamics tests.
class DynamicsTest : public testing::TestWithParam<Arena> {
  protected:
    const Arena& arena() const { return GetParam(); }
    bool is2d() const { return arena().dimension == 2; }
    bool matched() const { return arena().preset == "matched"; }
    double tol(double f64, double f32) const { return arena().f64() ? f64 : f32; }
    void within(const std::string& check, double error, double tolerance) const {
        expectWithin(check, error, tolerance, arena());
    }
    bool hasShape(const std::string& name) const;
    bool hasJoint(const std::string& name) const;

    /// An empty scenario without gravity, one material, in the arena's dimension.
    Scenario scene(double friction = 0.0, double restitution = 0.0) const;
    /// Shapes in the arena's dimension.
    Geometry ball(double radius) const { return scenario::Sphere{radius}; }
    Geometry block(const Vec3& half) const;
    /// The z component vanishes in two dimensions.
    Vec3 flat(const Vec3& v) const { return is2d() ? Vec3{v.x, v.y, 0.0} : v; }
    /// A dynamic body of one shape with these principal moments, colliding where the engine has the shape;
    /// returns its index.
    int addBody(Scenario& s, const Geometry& geometry, const Vec3& position, double mass = 1.0,
                const Vec3& moments = {0.1, 0.1, 0.1}) const;
    int addStatic(Scenario& s, const Geometry& geometry, const Vec3& position = {},
                  Quat orientation = {}) const;
    std::unique_ptr<adapter::World> build(const Scenario& s, double dt) const;
    /// In this engine, which is the one under test, loaded once more.
    std::unique_ptr<adapter::World> buildIn(const adapter::Engine& of, const Scenario& s, double dt) const;
};

/// Moments of a solid box of these half extents.
Vec3 boxMoments(double mass, const Vec3& half);
/// State of one body.
BodyState stateOf(const adapter::World& world, const Scenario& s, int body);
std::vector<ContactPoint> contactsOf(const adapter::World& world);
void run(adapter::World& world, int steps);
/// Angle of the rotation between two orientations [rad].
double angleBetween(const Quat& a, const Quat& b);

}  // namespace rigor::conformance
