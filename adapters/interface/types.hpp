// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data passed to and from an engine. SI units, world frame unless said, double precision throughout.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/interface/unsupported.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::adapter {

using scenario::Geometry;
using scenario::Mat3;
using scenario::Pose;
using scenario::Quat;
using scenario::Scenario;
using scenario::Vec3;

/// State of one body. The position is that of the body frame's origin; the velocity is that of the centre of
/// mass.
struct BodyState {
    Vec3 position;         ///< [m]
    Quat orientation;      ///< body to world, unit
    Vec3 velocity;         ///< [m/s]
    Vec3 angularVelocity;  ///< [rad/s]
};

/// One point of contact. A is the body with the lower index in the scenario.
struct ContactPoint {
    int bodyA = 0, bodyB = 0;    ///< scenario indices
    int shapeA = 0, shapeB = 0;  ///< index within Body::shapes; 0 if the engine does not report it
    Vec3 pointA, pointB;         ///< points on the surfaces of A and B [m]; the program takes z as 0 in 2D
    Vec3 normal;                 ///< unit, from A to B
    double depth = 0.0;          ///< penetration [m], > 0 when overlapping; minus the signed distance
    bool hasImpulse = false;     ///< true if the engine reported the impulses of the last step
    double normalImpulse = 0.0;  ///< [N s], >= 0, pushes B along +normal
    Vec3 frictionImpulse;        ///< [N s] on B, tangential
};

/// The poses that the contacts of a step lie at, and that its laws of contact are about.
enum class ContactInstant {
    StepStart,  ///< contacts are found at the poses at which the step began
    StepEnd     ///< bodies move before contacts are found, or the engine finds or moves them to the end
};

/// Degree to which a requested setting was realised.
enum class Realisation { Exact, Approximate, Unsupported };
const char* realisationName(Realisation r);

/// One line of the parity ledger: the requested value, what the engine really does, and why they differ.
struct LedgerEntry {
    std::string topic;  ///< short snake_case key: "friction_law", "collision_margin", "sleeping", ...
    std::string requested;
    std::string resolved;
    Realisation realisation = Realisation::Exact;
    std::string reason;  ///< empty when Exact
};

/// Properties of a body as the engine has them, read from the engine's own objects after the build.
struct BodyReadBack {
    double mass = 0.0;  ///< [kg]; 0 for bodies the engine does not move
    Vec3 centerOfMass;  ///< centre of mass in the body frame [m]
    Mat3 inertia;       ///< inertia about the centre of mass, body axes [kg m^2]; in 2D only (2,2)
    BodyState state;
    Vec3 gravity;  ///< acceleration acting on this body [m/s^2]
};
struct PairReadBack {
    int materialA = 0, materialB = 0;
    double friction = 0.0, restitution = 0.0;  ///< coefficients as the engine will use them between these two
                                               ///< materials
};
struct ReadBack {
    std::vector<BodyReadBack> bodies;  ///< bodies by scenario index
    std::vector<PairReadBack> pairs;   ///< every pair of materials that can touch
};

/// Work counters of the last step; -1 if the engine does not report them.
struct StepCounters {
    std::int64_t pairTests = -1;           ///< box tests of the broad phase
    std::int64_t narrowPhaseQueries = -1;  ///< queries of pairs of shapes or pieces of surfaces
    std::int64_t pairs = -1, contacts = -1, islands = -1, solverIterations = -1;
    double residual = -1.0;                      ///< residual of the velocity solver, engine's own measure
    std::map<std::string, double> phaseSeconds;  ///< wall time by phase name, where the engine measures it
    /// Wall time of the step by the engine's own clock, where the caller's would measure an exchange between two
    /// processes as well; -1 otherwise.
    double stepSeconds = -1.0;
};

/// Free-flight scheme of an engine, so that scheme-exact references know what an ideal run of it would give.
/// Forces are evaluated at the start of the step (Euler), in the middle (Moreau's midpoint rule: at x0 +
/// h/2 v0, with the velocity v0 + h/2 a(v0)), at its start and end (Verlet: at the end with the velocity v0
/// + h a0), or at the classical four stages.
enum class Scheme { Unknown, SymplecticEuler, ExplicitEuler, MoreauMidpoint, VelocityVerlet, RungeKutta4 };
const char* schemeName(Scheme s);
bool isEuler(Scheme s);  ///< one evaluation per step, at its start

/// Features of an engine. Names are those of the scenario format.
struct Capabilities {
    bool dynamics = false, collision = false, broadPhase = false;
    std::vector<int> dimensions;  ///< native: {2}, {3} or {2,3}
    bool planar = false;          ///< runs 2D scenarios in the x-y plane of a 3D world
    std::vector<std::string>
        shapes;  ///< geometry names of 3D ("sphere", ...) and 2D ("circle", "polygon", ...)
    /// "ball", "hinge", ...; what they may have besides: "hinge.limit", "slider.motor", "distance.spring",
    /// "fixed.break", ...
    std::vector<std::string> joints;
    bool contactImpulses = false;
    bool signedDistance = false;  ///< CollisionEngine gives the distance of separated shapes too
    /// Keys of options that collision queries heed, `narrow_phase` apart.
    std::vector<std::string> queryOptions;
    bool kinematicBodies = false, damping = false, gravityScale = false, centerOfMassOffset = false;
    bool contactSolvers = false;  ///< solves contact problems (contact_problem.hpp)
    bool staticFriction = false;  ///< contacts that stick up to a coefficient above that of sliding
    bool rollingFriction = false,
         torsionalFriction = false;  ///< moments bounded by a length times the normal force
    bool surfaceVelocity = false;    ///< shapes whose surfaces move over their bodies
    bool contactFilters = false;     ///< layers, masks and groups of bodies
    bool shapeFilters = false;       ///< other ones for each shape of a body
    /// Features that the library itself does not have, each with the document of its authors that says so
    /// (manual and chapter, or header and declaration), by name: of `shapes` and `joints` as above,
    /// "dynamics", "2D", "3D", or a flag above in snake_case ("static_friction"). Everything else that is
    /// missing is missing in the adapter.
    std::map<std::string, std::string> libraryLacks;
};

/// One key of an engine spec.
struct Option {
    std::string key;
    std::vector<std::string> values;  ///< allowed values; empty: a number
    double min = 0.0, max = 0.0;      ///< range of a number
    bool integer = false;
    std::string defaultValue;  ///< value of preset=default
    std::string matchedValue;  ///< value of preset=matched
    std::string help;
};

/// Identity of the engine, read from the library itself if it reports it.
struct EngineInfo {
    std::string name;        ///< "bullet"
    std::string version;     ///< "3.24"
    std::string precision;   ///< "f32" or "f64", of the library's state (the default one if selectable)
    std::string title;       ///< "Bullet Physics"
    std::string buildNotes;  ///< flags that matter: "asserts off, SSE2"
    /// Version of the package it was built against, where that is another than the library says; "" else.
    std::string package = {};
    /// Label of the engine's timings where they are not those of native code in this process: "guest", "guest, wasm";
    /// "" otherwise.
    std::string clock = {};
};

/// Key/value pairs of a spec after defaults and the preset were applied; every key of Option is present.
using Settings = std::map<std::string, std::string>;
double numberSetting(const Settings& settings, const std::string& key);
int integerSetting(const Settings& settings, const std::string& key);
const std::string& textSetting(const Settings& settings, const std::string& key);

/// Input that must never reach a library: NaN, zero mass, degenerate shape, unknown key.
class BadInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A shape with a pose, for a collision query.
struct PosedShape {
    const Geometry* geometry = nullptr;
    Pose pose;  ///< shape to world
};

struct CollisionQuery {
    PosedShape a, b;
    int dimension = 3;
    int maxContacts = 8;
    std::string algorithm;  ///< one of CollisionEngine::algorithms(); empty: the engine's default
    /// Settings of a spec for a query in the way its worlds are simulated; null: as exactly as possible.
    /// Capabilities::queryOptions lists the keys that matter.
    const Settings* settings = nullptr;
};

/// Result of a query. Contacts have depth > 0 (or the engine's own tolerance); bodyA/bodyB are 0 and 1.
struct CollisionAnswer {
    bool overlap = false;
    std::vector<ContactPoint> contacts;
    std::optional<double>
        signedDistance;  ///< [m], < 0 when overlapping; only with Capabilities::signedDistance
    std::optional<Vec3> witnessA, witnessB;
};

struct Aabb {
    Vec3 min, max;  ///< [m]; in 2D z is 0
};
struct Pair {
    int a = 0, b = 0;  ///< a < b
    friend auto operator<=>(const Pair&, const Pair&) = default;
};

}  // namespace rigor::adapter
