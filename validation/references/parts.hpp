// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions shared by references: reading parameters, the bodies with a role in the problem, checks of
// assumptions, and the way from the centre of mass to the body frame. No physics of a particular problem.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "validation/references/reference.hpp"

namespace rigor::validation {

using scenario::Body;
using scenario::Mat3;
using scenario::Pose;
using scenario::Quat;
using scenario::Scenario;
using scenario::Vec3;

/// Throws AssumptionViolated with `sentence`.
[[noreturn]] void violated(const std::string& sentence);
/// Throws AssumptionViolated with `sentence` unless `holds`.
void require(bool holds, const std::string& sentence);

/// The parameters of a reference: names of bodies and joints. Unknown keys, unknown names and parts that can
/// not be guessed throw std::invalid_argument.
class Parts {
  public:
    Parts(const Scenario& scenario, const scenario::ReferenceSpec& spec,
          std::initializer_list<const char*> allowed);

    /// The named dynamic body, or the only one not in `except`.
    int dynamicBody(const char* key, std::initializer_list<int> except = {}) const;
    /// The named body of any type.
    int anyBody(const char* key, std::initializer_list<int> except = {}) const;
    /// The named static or kinematic body that can touch `partner`, or the only one.
    int support(const char* key, int partner) const;
    /// The named bodies, or all dynamic ones.
    std::vector<int> dynamicBodies(const char* key) const;
    /// The named joint, or the only one that holds `body`.
    int joint(const char* key, int body) const;

  private:
    std::optional<std::string> text(const char* key) const;
    int byName(const char* key, const std::string& name) const;
    [[noreturn]] void bad(const std::string& what) const;

    const Scenario& scenario_;
    const scenario::ReferenceSpec& spec_;
};

/// "body 'block'", for messages.
std::string bodyTitle(const Scenario& scenario, int body);
/// "[0, 1.5, 0]" or, of two dimensions, "[0, 1.5]", for messages.
std::string shown(Vec3 v, int dimension);

// ------------------------------------------------------------------------------------------- mechanics
Vec3 centerOfMass(const Body& body);                          ///< initial, world frame [m]
Vec3 centerOfMass(const Body& body, const BodyState& state);  ///< world frame [m]
/// Gravity that acts on the body, its gravityScale included [m/s^2].
Vec3 gravityOn(const Scenario& scenario, int body);
Mat3 worldInertia(const Body& body);  ///< Inertia about the centre of mass, initial orientation [kg m^2]

/// The complete state from that of the centre of mass.
PartialState stateOf(const Body& body, Vec3 com, Quat orientation, Vec3 velocity, Vec3 angularVelocity);
/// The state where the orientation is not known: no position when the centre of mass is off the origin.
PartialState stateOf(const Body& body, Vec3 com, Vec3 velocity);

Vec3 unit(Vec3 v);  ///< v / |v|; the zero vector stays zero
/// A unit vector perpendicular to the unit vector n; in the x-y plane where n is in it.
Vec3 perpendicular(Vec3 n);
/// The orientation after turning for time t at the constant world angular velocity w.
Quat turned(Quat q, Vec3 w, double t);
/// |a| is negligible beside `scale` (1e-9 relative; the scenario's own numbers have 16 digits).
bool negligible(double a, double scale);

/// End time of references that integrate [s]: the duration and room for the last step of a run, for steps of
/// the scenario's list and any up to an eighth of the duration. Events between the duration and this time
/// decide nothing: whether something happens after the end is tested separately.
double runEnd(const Scenario& scenario);

/// The coefficient up to which a contact that does not slide holds: the static one, never below that of
/// sliding.
double holdingFriction(const scenario::PairCoefficients& pair);

// -------------------------------------------------------------------------------------------- assumptions
struct Allowed {
    bool joints = false, springs = false, constantForces = false, drag = false, events = false,
         damping = false, quadraticDrag = false;
};
/// Throws AssumptionViolated when anything but contact, gravity and what is allowed acts on the body.
void requireUndisturbed(const Scenario& scenario, int body, Allowed allowed = {});

/// A ball: one colliding sphere whose centre is the centre of mass, with the same inertia about every axis.
struct Ball {
    int body = 0;
    double radius = 0.0, mass = 0.0;
    double k = 0.0;  ///< I / (m r^2)
    int material = 0;
    Vec3 center, velocity, spin;  ///< initial
};
Ball ballOf(const Scenario& scenario, int body);

/// The flat side of a fixed body: half-space, face of a box, end of a cylinder, or segment (2D).
struct Plane {
    Vec3 normal;  ///< unit, out of the solid, world frame
    double offset = 0.0;
    int material = 0;
    struct Edge {
        Vec3 axis;
        double center = 0.0, halfLength = 0.0;
    };
    std::vector<Edge> edges;  ///< the face ends at |axis . x - center| = halfLength; none: unbounded
    Vec3 discCenter;
    double discRadius = 0.0;  ///< > 0: the face is a disc (end of a cylinder)
    double height(Vec3 p) const { return dot(normal, p) - offset; }
    bool holds(Vec3 p) const;  ///< p is over the face
};
/// The side of `floor` that faces the point `from`. Throws AssumptionViolated for other shapes.
Plane planeOf(const Scenario& scenario, int floor, Vec3 from);

/// Support of a body on a plane at its initial pose.
struct Support {
    double gap = 0.0;          ///< height of the lowest point [m]
    std::vector<Vec3> points;  ///< lowest points of the body (vertices of the contact area) [m]
    int material = 0;
};
Support supportOf(const Scenario& scenario, int body, const Plane& plane);
/// Signed distance of `p` to the border of the convex hull of `points` in the plane of normal n; > 0 inside.
double supportMargin(const std::vector<Vec3>& points, Vec3 p, Vec3 n, int dimension);

/// Throws AssumptionViolated when the body moves or turns at the start.
void requireStill(const Scenario& scenario, int body);
/// Throws AssumptionViolated unless the two bodies can touch.
void requireContact(const Scenario& scenario, int a, int b);
/// Throws AssumptionViolated when the exact motion runs through another body: through one that the reference
/// knows or one that stays where it is.
void requireClearWay(const Scenario& scenario, const Reference& reference);
/// Length that positions of this body are small beside [m]: the size of its shapes.
double sizeOf(const Body& body);

// -------------------------------------------------------------------------------------------- measuring
/// First time at which f(frame), sampled over the frames, passes zero upwards; cubic Hermite interpolation
/// with the derivative `slope`; error O(dt^4) for smooth motion. Searches from frame `from`.
std::optional<double> upwardCrossing(const Trajectory& trajectory, std::size_t from,
                                     const std::function<double(std::size_t)>& f,
                                     const std::function<double(std::size_t)>& slope);
/// The time between the first two of them: a period [s].
std::optional<double> timeBetweenCrossings(const Trajectory& trajectory,
                                           const std::function<double(std::size_t)>& f,
                                           const std::function<double(std::size_t)>& slope);

/// Time at which a linearly shrinking speed reaches zero: extrapolated from the last two frames before it
/// first falls below 5 % of `start`; exact for constant deceleration. Empty if it never falls below.
std::optional<double> extrapolatedStop(const Trajectory& trajectory, double start,
                                       const std::function<double(std::size_t)>& speed);

/// Index of the last frame at or before t (with a rounding margin); empty when there is none after frame 0.
std::optional<std::size_t> lastFrameBefore(const Trajectory& trajectory, double t);

}  // namespace rigor::validation
