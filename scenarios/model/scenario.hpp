// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario model: plain data in SI units and double precision that every engine is built from.
// Conventions: right-handed axes; two-dimensional scenarios lie in the x-y plane, z = 0, rotations about +z.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenarios/model/bench.hpp"
#include "scenarios/model/contact_filter.hpp"
#include "scenarios/model/math.hpp"

namespace rigor::scenario {

/// A value with no physical counterpart that marks "nothing was given".
inline constexpr int kNone = -1;

// ---------------------------------------------------------------------------------------------- shapes
// Axis of capsule, cylinder and cone: local y. half_length of a capsule excludes the caps.

/// 3D ball, 2D disc. radius > 0 [m].
struct Sphere {
    double radius = 0.0;
};
/// Half extents > 0 [m]; in 2D z is ignored (0).
struct Box {
    Vec3 halfExtents;
};
/// Segment from (0,-halfLength,0) to (0,+halfLength,0) [m], grown by radius [m]; both > 0.
struct Capsule {
    double radius = 0.0;
    double halfLength = 0.0;
};
/// Solid cylinder along local y, 3D only. [m], both > 0.
struct Cylinder {
    double radius = 0.0;
    double halfLength = 0.0;
};
/// Solid cone along local y, 3D only: apex at +halfLength, base disc of `radius` at -halfLength. [m]
struct Cone {
    double radius = 0.0;
    double halfLength = 0.0;
};
/// Convex hull of at least 4 (2D: 3) points [m], local frame. The loader has removed interior points; in 2D
/// the vertices are in counter-clockwise order.
struct ConvexHull {
    std::vector<Vec3> vertices;
};
/// Solid where dot(normal, x) <= offset, local frame, unit normal. Static bodies only. It is a half-plane in
/// 2D.
struct HalfSpace {
    Vec3 normal{0.0, 1.0, 0.0};
    double offset = 0.0;
};
/// 2D only, static bodies only: two-sided segment from a to b [m].
struct Segment {
    Vec3 a, b;
};

/// 2D only, static bodies only: two-sided segments from vertex to vertex [m], at least 2; with `loop` also
/// from the last to the first, at least 3. Inner vertices do not catch what slides over them.
struct Chain {
    std::vector<Vec3> vertices;
    bool loop = false;
};
/// 3D only, static bodies only: two-sided triangles over shared vertices [m]; may be open.
struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
};
/// 3D only, static bodies only: heights along local y over a grid in x and z centred on the origin, vertex
/// (column i, row k) at height heights[k columns + i]; every cell is two triangles, split from (i + 1, k) to
/// (i, k + 1). Solid below the surface, down to `thickness` under its lowest point.
struct HeightField {
    int columns = 0, rows = 0;              ///< vertices along x and z, >= 2
    double spacingX = 0.0, spacingZ = 0.0;  ///< [m], > 0
    std::vector<double> heights;            ///< [m]
    double thickness = 1.0;                 ///< [m], > 0
};

/// 3D only: half axes > 0 along the local axes [m].
struct Ellipsoid {
    Vec3 halfAxes;
};

using Geometry = std::variant<Sphere, Box, Capsule, Cylinder, Cone, ConvexHull, HalfSpace, Segment, Chain,
                              TriangleMesh, HeightField, Ellipsoid>;

/// Names used in files, capabilities and reports, by Geometry index: "sphere" ("circle" in 2D), "box",
/// "capsule", "cylinder", "cone", "hull" ("polygon" in 2D), "half_space" ("half_plane" in 2D), "segment",
/// "chain", "triangle_mesh", "height_field", "ellipsoid".
const char* geometryName(const Geometry& geometry, int dimension);

/// Velocity of a shape's surface over its body, as of a conveyor belt or a turntable: a point x of the body frame moves
/// with linear + angular x x, in the axes of the body frame. Friction acts on surfaces; the normal does not see it.
struct SurfaceVelocity {
    Vec3 linear;   ///< at the origin of the body frame [m/s]
    Vec3 angular;  ///< [rad/s]; in 2D z alone
    bool moves() const { return norm(linear) > 0.0 || norm(angular) > 0.0; }
};

struct Shape {
    Geometry geometry;
    Pose pose;         ///< shape frame in the body frame
    int material = 0;  ///< index into Scenario::materials
    SurfaceVelocity surfaceVelocity = {};
    ContactFilter filter = {};
};

// -------------------------------------------------------------------------------------------- materials
struct Material {
    std::string name;
    double friction = 0.0;        ///< Coulomb coefficient, >= 0
    double restitution = 0.0;     ///< Newton's coefficient, in [0, 1]
    double density = 1000.0;      ///< [kg/m^3] (2D: [kg/m^2]); used when a body gives no mass
    double staticFriction = 0.0;  ///< contacts stick up to this; 0: up to friction; else >= friction
    double rollingFriction =
        0.0;  ///< rolling resistance as a length [m]: a moment of up to this times the normal
              ///< force opposes the relative angular velocity in the tangent plane
    double torsionalFriction = 0.0;  ///< 3D, the same about the normal [m]
};

/// Coefficients that replace the combination rule for one unordered pair of materials.
struct MaterialPair {
    int a = 0, b = 0;  ///< indices into Scenario::materials
    double friction = 0.0;
    double restitution = 0.0;
    double staticFriction = 0.0;
    double rollingFriction = 0.0, torsionalFriction = 0.0;  ///< [m]
};

/// Coefficients of a pair of touching surfaces. Every adapter makes its engine use exactly these.
struct PairCoefficients {
    double friction = 0.0;
    double restitution = 0.0;
    double staticFriction = 0.0;                            ///< 0: the same as friction
    double rollingFriction = 0.0, torsionalFriction = 0.0;  ///< [m]
};

// ---------------------------------------------------------------------------------------------- bodies
enum class BodyType { Static, Kinematic, Dynamic };

/// Mass, and inertia about the centre of mass, axes of the body frame.
struct MassProperties {
    double mass = 0.0;  ///< [kg]; 0 for static and kinematic bodies
    Vec3 centerOfMass;  ///< centre of mass in the body frame [m]
    Mat3 inertia;       ///< [kg m^2]; in 2D only inertia(2,2) is meaningful
};

struct Body {
    std::string name;
    BodyType type = BodyType::Dynamic;
    Pose pose;             ///< initial pose of the body frame in the world
    Vec3 velocity;         ///< velocity of the centre of mass, world frame [m/s]
    Vec3 angularVelocity;  ///< world frame [rad/s]
    std::vector<Shape> shapes;
    MassProperties massProperties;     ///< complete after loading: given, or computed from the shapes
    bool collides = true;              ///< false: shapes give mass and a picture, never contacts
    double linearVelocityKept = 1.0;   ///< damping: v(t) = v0 * kept^t without forces; (0, 1], per second
    double angularVelocityKept = 1.0;  ///< fraction kept per second for the angular velocity
    double gravityScale = 1.0;         ///< factor on the scenario's gravity
};

// ---------------------------------------------------------------------------------------------- joints
enum class JointType { Ball, Hinge, Slider, Fixed, Distance, ConeTwist, SixDof, Wheel };
inline constexpr JointType kJointTypes[] = {JointType::Ball,   JointType::Hinge,    JointType::Slider,
                                            JointType::Fixed,  JointType::Distance, JointType::ConeTwist,
                                            JointType::SixDof, JointType::Wheel};
const char* jointName(JointType type);

enum class AxisMode {
    Usual,  ///< the joint's own: locked for distance and six_dof, else free
    Free,
    Locked,
    Limited,  ///< limited to [lower, upper]
};
/// Stops, motor and spring along one coordinate of a joint; u is [m] or [rad].
struct JointAxis {
    AxisMode mode = AxisMode::Usual;
    double lower = -1e300, upper = 1e300;  ///< Limited; beyond 1e299: none [u]
    double motorSpeed = 0.0;               ///< [u/s]
    double motorMaxForce = 0.0;            ///< [N] or [N m]; 0: no motor
    double target = 0.0;                   ///< rest value of the spring [u]
    double frequency = 0.0;  ///< undamped frequency of the spring on the coordinate's effective mass [Hz]
    double dampingRatio = 0.0;
    double stiffness = 0.0, damping = 0.0;  ///< spring given by these [N/m, N s/m] or [N m/rad, N m s/rad]

    bool hasMotor() const { return motorMaxForce > 0.0; }
    bool hasSpring() const { return frequency > 0.0 || stiffness > 0.0 || damping > 0.0; }
};
inline constexpr std::size_t kMaxJointAxes = 6;
/// Name of coordinate k in files: hinge "angle", slider "travel", distance "length", ball (3D) "swing",
/// cone_twist "twist" and "swing", wheel "travel" and "angle", six_dof "x", "y", "z", "twist", "swing_y",
/// "swing_z" (2D: "x", "y", "angle"). Null where the joint has no such coordinate.
const char* jointAxisName(JointType type, int dimension, std::size_t k);

/// A constraint between two bodies. Anchors coincide at the initial poses except for Distance. In 2D a hinge
/// turns about +z (axis ignored), a slider slides along `axis`. Coordinates are zero at the initial poses
/// (distance: the distance of the anchors) and grow when B turns or moves along the axis against A.
struct Joint {
    std::string name;
    JointType type = JointType::Ball;
    int bodyA = kNone;  ///< kNone: the world
    int bodyB = kNone;
    Vec3 anchorA;               ///< anchor in A's body frame (world frame when bodyA is kNone) [m]
    Vec3 anchorB;               ///< anchor in B's body frame [m]
    Vec3 axisA{0.0, 0.0, 1.0};  ///< unit; hinge and slider; A's body frame
    Vec3 axisB{0.0, 0.0, 1.0};  ///< the same world direction initially; B's body frame
    double length = 0.0;        ///< distance joint: rod length between the anchors [m], > 0
    bool collideConnected = false;
    Vec3 normalA{1.0, 0.0, 0.0};    ///< six_dof: unit, its y axis, normal to axisA; A's body frame
    Vec3 spinAxisB{0.0, 0.0, 1.0};  ///< wheel (3D): unit; B's body frame
    std::array<JointAxis, kMaxJointAxes> axes;
    double breakForce = 1e300;   ///< a step's mean force above this breaks the joint [N]; beyond 1e299: never
    double breakTorque = 1e300;  ///< largest torque about B's anchor [N m]

    /// "limit", "motor", "spring", "break": its requirements beyond its type.
    std::vector<std::string> features() const;
};

// ---------------------------------------------------------------------------------------------- forces
/// Constant force and torque, world frame, acting at the centre of mass during [start, end).
struct ConstantForce {
    int body = 0;
    Vec3 force;                       ///< [N]
    Vec3 torque;                      ///< [N m]
    double start = 0.0, end = 1e300;  ///< [s]
};
/// Linear spring and damper between two anchors (bodyA kNone: the world).
struct SpringForce {
    int bodyA = kNone, bodyB = 0;
    Vec3 anchorA, anchorB;    ///< anchors in the body frames (world frame for kNone) [m]
    double stiffness = 0.0;   ///< [N/m], >= 0
    double damping = 0.0;     ///< [N s/m], >= 0
    double restLength = 0.0;  ///< [m], >= 0
};
/// F = -(coefficient + quadratic * |v|) * v at the centre of mass.
struct DragForce {
    int body = 0;
    double coefficient = 0.0;  ///< [N s/m], >= 0
    double quadratic = 0.0;    ///< [N s^2/m^2], >= 0
};
using Force = std::variant<ConstantForce, SpringForce, DragForce>;

/// An impulse at the centre of mass given in the first step that starts at or after `time`.
struct Event {
    double time = 0.0;  ///< [s]
    int body = 0;
    Vec3 impulse;         ///< [N s], world frame
    Vec3 angularImpulse;  ///< [N m s], world frame
};

// ------------------------------------------------------------------------------- references and bounds
using ParameterValue = std::variant<double, bool, std::string, std::vector<double>, std::vector<std::string>>;

/// A reference solution by name; the parameters name the bodies that play its parts, never physical values.
struct ReferenceSpec {
    std::string name;
    std::map<std::string, ParameterValue> parameters;
};

/// min <= value <= max * (dt / first dt of the scenario)^order
struct Bound {
    std::string engine;  ///< engine name ("rigor"), or "*" for every engine not named
    std::string preset;  ///< "default", "matched", or "" for both
    std::string metric;
    double max = 0.0;
    double order = 0.0;
    double min = -std::numeric_limits<double>::infinity();
};

/// A recorded deviation: where `metric` misses its bound but stays below `max`, the verdict is "known
/// deviation".
struct KnownDeviation {
    std::string engine, preset, metric;  ///< selection as in Bound
    double max = 0.0;
    std::string reason;
};

// -------------------------------------------------------------------------------------------- scenario
struct Scenario {
    std::string name, title, description, source;
    std::vector<std::string> isolates, tags;
    int dimension = 3;
    Vec3 gravity{0.0, -9.81, 0.0};  ///< [m/s^2]
    double duration = 1.0;          ///< [s]
    std::vector<double> timeSteps;  ///< [s], in the order of the file
    std::vector<Material> materials;
    std::vector<MaterialPair> pairs;
    std::vector<std::string> layers;  ///< names, "default" first; empty for a file that names none
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    std::vector<Force> forces;
    std::vector<Event> events;
    std::vector<int> observed;  ///< bodies whose trajectories are compared; never empty after loading
    std::optional<ReferenceSpec> reference;  ///< reference; none: cross-engine comparison only
    std::vector<std::string>
        metrics;  ///< metrics that matter here, in order of importance; never empty after loading
    std::vector<Bound> accept;
    std::vector<KnownDeviation> knownDeviations;
    double timeLimit = 60.0;         ///< [s] wall time for one case
    std::optional<int> size;         ///< N of a scene that grows with it; bodies are those of this N
    std::optional<BenchPlan> bench;  ///< plan for scenes that are timed
};

/// Velocity of the surface of a shape over its body at a point, when the body has this pose: world frame [m/s].
Vec3 surfaceVelocityAt(const Shape& shape, const Pose& body, Vec3 point);

/// Coefficients of two materials: the pair table's, else min(e_a, e_b) of restitution and sqrt(x_a x_b) of all
/// kinds of friction.
PairCoefficients pairCoefficients(const Scenario& scenario, int materialA, int materialB);

/// Index of the named body, or kNone.
int findBody(const Scenario& scenario, const std::string& name);

/// True where contacts between the two bodies are possible: both collide, at least one is dynamic, no joint with
/// collideConnected = false connects them, and the filters of some two shapes agree (where both have shapes).
bool mayCollide(const Scenario& scenario, int bodyA, int bodyB);
/// True where the filters of two shapes of such bodies agree.
inline bool mayTouch(const Shape& a, const Shape& b) {
    return mayTouch(a.filter, b.filter);
}

/// Mass, centre of mass and inertia from the shapes, each of the density of its material [kg/m^3] (2D:
/// [kg/m^2]). `dimension` 2 takes areas. Throws std::invalid_argument for shapes without volume (half-space,
/// segment, chain, mesh, height field).
MassProperties massPropertiesFromShapes(const std::vector<Shape>& shapes,
                                        const std::vector<Material>& materials, int dimension);

/// `properties` scaled to `mass` (same shape, uniform factor on the density).
MassProperties scaledToMass(MassProperties properties, double mass);

}  // namespace rigor::scenario
