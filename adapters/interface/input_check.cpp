// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/input_check.hpp"
#include "scenarios/model/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rigor::adapter {
namespace {

using scenario::Body;
using scenario::BodyType;
using scenario::kNone;

template <class T>
std::string shown(T value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw BadInput(where + ": " + what);
}

void checkFinite(const std::string& where, Vec3 v) {
    if (!isFinite(v)) refuse(where, "not finite");
}
void checkFinite(const std::string& where, double v) {
    if (!std::isfinite(v)) refuse(where, "not finite");
}
void checkPositive(const std::string& where, double v) {
    checkFinite(where, v);
    if (v <= 0.0) refuse(where, "found " + shown(v) + ", expected a value > 0");
}
void checkPose(const std::string& where, const Pose& pose) {
    checkFinite(where + ".position", pose.position);
    if (!isFinite(pose.orientation) || std::abs(norm(pose.orientation) - 1.0) > 1e-6)
        refuse(where + ".orientation",
               "found norm " + shown(norm(pose.orientation)) + ", expected a unit quaternion");
}

/// Largest extent of a point set perpendicular to what its first points span; 0 for points without volume.
double spanOf(const std::vector<Vec3>& points, int dimension) {
    const Vec3 origin = points.front();
    const auto farthest = [&](auto&& measure) {
        double best = 0.0;
        Vec3 which = origin;
        for (const Vec3& p : points)
            if (const double m = measure(p - origin); m > best) {
                best = m;
                which = p;
            }
        return std::pair(best, which - origin);
    };
    const auto [length, along] = farthest([](Vec3 d) { return norm(d); });
    if (length == 0.0) return 0.0;
    const Vec3 u = along / length;
    const auto [width, across] = farthest([&](Vec3 d) { return norm(cross(u, d)); });
    if (dimension == 2 || width == 0.0) return width / length;
    const Vec3 n = cross(u, across) / norm(cross(u, across));
    return farthest([&](Vec3 d) { return std::abs(dot(n, d)); }).first / length;
}

struct CheckGeometry {
    std::string where;
    int dimension;
    void operator()(const scenario::Sphere& s) const { checkPositive(where + ".radius", s.radius); }
    void operator()(const scenario::Box& b) const {
        checkPositive(where + ".half_extents.x", b.halfExtents.x);
        checkPositive(where + ".half_extents.y", b.halfExtents.y);
        if (dimension == 3) checkPositive(where + ".half_extents.z", b.halfExtents.z);
    }
    void operator()(const scenario::Ellipsoid& e) const {
        for (const double axis : {e.halfAxes.x, e.halfAxes.y, e.halfAxes.z})
            checkPositive(where + ".half_axes", axis);
    }
    template <class Round>
    requires requires(Round r) {
        r.radius;
        r.halfLength;
    }
    void operator()(const Round& r) const {
        checkPositive(where + ".radius", r.radius);
        checkPositive(where + ".half_length", r.halfLength);
    }
    void operator()(const scenario::ConvexHull& h) const {
        const std::size_t least = dimension == 2 ? 3 : 4;
        if (h.vertices.size() < least)
            refuse(where + ".vertices",
                   "found " + shown(h.vertices.size()) + " points, expected at least " + shown(least));
        for (const Vec3& v : h.vertices) checkFinite(where + ".vertices", v);
        if (spanOf(h.vertices, dimension) < 1e-9) refuse(where + ".vertices", "the points have no volume");
    }
    void operator()(const scenario::HalfSpace& h) const {
        checkFinite(where + ".offset", h.offset);
        if (!isFinite(h.normal) || std::abs(norm(h.normal) - 1.0) > 1e-6)
            refuse(where + ".normal", "expected a unit vector");
    }
    void operator()(const scenario::Segment& s) const {
        checkFinite(where + ".a", s.a);
        checkFinite(where + ".b", s.b);
        if (norm(s.b - s.a) <= 0.0) refuse(where, "expected two different points");
    }
    template <class Surface>
    requires requires(Surface s) { scenario::surfaceProblem(s); }
    void operator()(const Surface& s) const {
        if (const std::string problem = scenario::surfaceProblem(s); !problem.empty()) refuse(where, problem);
    }
};

/// All leading minors positive: the tensor is symmetric positive definite.
bool isPositiveDefinite(const Mat3& I) {
    const double scale = std::max({std::abs(I(0, 0)), std::abs(I(1, 1)), std::abs(I(2, 2))});
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j)
            if (!(std::abs(I(i, j) - I(j, i)) <= 1e-9 * scale)) return false;
    const double m2 = I(0, 0) * I(1, 1) - I(0, 1) * I(1, 0);
    const double m3 = I(0, 0) * (I(1, 1) * I(2, 2) - I(1, 2) * I(2, 1)) -
                      I(0, 1) * (I(1, 0) * I(2, 2) - I(1, 2) * I(2, 0)) +
                      I(0, 2) * (I(1, 0) * I(2, 1) - I(1, 1) * I(2, 0));
    return I(0, 0) > 0.0 && m2 > 0.0 && m3 > 0.0 && std::isfinite(m3);
}

void checkMass(const std::string& where, const Body& body, int dimension) {
    checkPositive(where + ".mass", body.massProperties.mass);
    checkFinite(where + ".center_of_mass", body.massProperties.centerOfMass);
    if (dimension == 2)
        checkPositive(where + ".inertia", body.massProperties.inertia(2, 2));
    else if (!isPositiveDefinite(body.massProperties.inertia))
        refuse(where + ".inertia", "expected a symmetric positive definite tensor");
}

void checkKept(const std::string& where, double kept) {
    if (!(kept > 0.0 && kept <= 1.0)) refuse(where, "found " + shown(kept) + ", expected a value in (0, 1]");
}

void checkBody(const Body& body, const Scenario& scenario) {
    const std::string where = "body '" + body.name + "'";
    checkPose(where, body.pose);
    checkFinite(where + ".velocity", body.velocity);
    checkFinite(where + ".angular_velocity", body.angularVelocity);
    checkFinite(where + ".gravity_scale", body.gravityScale);
    checkKept(where + ".damping.linear_kept_per_second", body.linearVelocityKept);
    checkKept(where + ".damping.angular_kept_per_second", body.angularVelocityKept);
    if (body.type == BodyType::Dynamic) checkMass(where, body, scenario.dimension);
    for (std::size_t i = 0; i < body.shapes.size(); ++i) {
        const std::string at = where + ".shapes[" + std::to_string(i) + "]";
        checkPose(at, body.shapes[i].pose);
        std::visit(CheckGeometry{at, scenario.dimension}, body.shapes[i].geometry);
        if (body.shapes[i].material < 0 ||
            body.shapes[i].material >= static_cast<int>(scenario.materials.size()))
            refuse(at + ".material", "index out of range");
        checkFinite(at + ".surface_velocity", body.shapes[i].surfaceVelocity.linear);
        checkFinite(at + ".surface_velocity", body.shapes[i].surfaceVelocity.angular);
        if (scenario::isStaticOnly(body.shapes[i].geometry) && body.type != BodyType::Static)
            refuse(at, "half-spaces, segments and surfaces belong to static bodies");
    }
}

void checkIndex(const std::string& where, int body, const Scenario& scenario, bool mayBeWorld) {
    if ((mayBeWorld && body == kNone) || (body >= 0 && body < static_cast<int>(scenario.bodies.size())))
        return;
    refuse(where, "body index " + std::to_string(body) + " is out of range");
}

void checkJoint(const scenario::Joint& joint, const Scenario& scenario) {
    const std::string where = "joint '" + joint.name + "'";
    checkIndex(where, joint.bodyA, scenario, true);
    checkIndex(where, joint.bodyB, scenario, false);
    if (joint.bodyA == joint.bodyB) refuse(where, "connects a body with itself");
    checkFinite(where + ".anchor", joint.anchorA);
    checkFinite(where + ".anchor", joint.anchorB);
    for (Vec3 axis : {joint.axisA, joint.axisB})
        if (!isFinite(axis) || std::abs(norm(axis) - 1.0) > 1e-6)
            refuse(where + ".axis", "expected a unit vector");
    if (joint.type == scenario::JointType::Distance) checkPositive(where + ".length", joint.length);
    for (const scenario::JointAxis& axis : joint.axes) {
        for (const double x : {axis.lower, axis.upper, axis.motorSpeed, axis.motorMaxForce, axis.target,
                               axis.frequency, axis.dampingRatio, axis.stiffness, axis.damping})
            if (!std::isfinite(x)) refuse(where + ".axes", "expected finite numbers");
        if (axis.mode == scenario::AxisMode::Limited && !(axis.lower <= axis.upper))
            refuse(where + ".limits", "expected lower <= upper");
        if (axis.motorMaxForce < 0.0 || axis.frequency < 0.0 || axis.dampingRatio < 0.0 ||
            axis.stiffness < 0.0 || axis.damping < 0.0)
            refuse(where + ".axes", "expected motors and springs that are not negative");
    }
    checkPositive(where + ".break_force", joint.breakForce);
    checkPositive(where + ".break_torque", joint.breakTorque);
}

struct CheckForce {
    const Scenario& scenario;
    void operator()(const scenario::ConstantForce& f) const {
        checkIndex("constant force", f.body, scenario, false);
        checkFinite("constant force", f.force);
        checkFinite("constant force", f.torque);
    }
    void operator()(const scenario::SpringForce& f) const {
        checkIndex("spring", f.bodyA, scenario, true);
        checkIndex("spring", f.bodyB, scenario, false);
        checkFinite("spring", f.anchorA);
        checkFinite("spring", f.anchorB);
        for (double v : {f.stiffness, f.damping, f.restLength})
            if (!(std::isfinite(v) && v >= 0.0)) refuse("spring", "expected values >= 0");
    }
    void operator()(const scenario::DragForce& f) const {
        checkIndex("drag", f.body, scenario, false);
        if (!(std::isfinite(f.coefficient) && f.coefficient >= 0.0))
            refuse("drag", "expected a coefficient >= 0");
        if (!(std::isfinite(f.quadratic) && f.quadratic >= 0.0))
            refuse("drag", "expected a quadratic coefficient >= 0");
    }
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void checkScenarioInput(const Scenario& scenario, double dt) {
    if (!(dt >= 1e-7 && dt <= 1.0))
        refuse("dt", "found " + shown(dt) + ", expected a value from 1e-7 to 1 s");
    if (scenario.dimension != 2 && scenario.dimension != 3) refuse("dimension", "expected 2 or 3");
    checkFinite("gravity", scenario.gravity);
    checkPositive("duration", scenario.duration);
    const auto coefficients = [](const std::string& where, double friction, double restitution,
                                 double sticking) {
        if (!(sticking == 0.0 || (std::isfinite(sticking) && sticking >= friction)))
            refuse(where + ".static_friction", "expected 0 or a value not below the friction");
        if (!(std::isfinite(friction) && friction >= 0.0))
            refuse(where + ".friction", "expected a value >= 0");
        if (!(restitution >= 0.0 && restitution <= 1.0))
            refuse(where + ".restitution", "expected a value in [0, 1]");
    };
    const auto lengths = [&](const std::string& where, double rolling, double torsional) {
        if (!(std::isfinite(rolling) && rolling >= 0.0))
            refuse(where + ".rolling_friction", "expected a value >= 0");
        if (!(std::isfinite(torsional) && torsional >= 0.0))
            refuse(where + ".torsional_friction", "expected a value >= 0");
        if (scenario.dimension == 2 && torsional > 0.0)
            refuse(where + ".torsional_friction", "expected 0 in two dimensions");
    };
    for (const auto& m : scenario.materials)
        lengths("material '" + m.name + "'", m.rollingFriction, m.torsionalFriction);
    for (const auto& p : scenario.pairs) lengths("material pair", p.rollingFriction, p.torsionalFriction);
    for (const auto& m : scenario.materials)
        coefficients("material '" + m.name + "'", m.friction, m.restitution, m.staticFriction);
    for (const auto& p : scenario.pairs)
        coefficients("material pair", p.friction, p.restitution, p.staticFriction);
    for (const auto& body : scenario.bodies) checkBody(body, scenario);
    for (const auto& joint : scenario.joints) checkJoint(joint, scenario);
    for (const auto& force : scenario.forces) std::visit(CheckForce{scenario}, force);
    for (const auto& event : scenario.events) {
        checkIndex("event", event.body, scenario, false);
        checkFinite("event", event.time);
        checkFinite("event", event.impulse);
        checkFinite("event", event.angularImpulse);
    }
}

void checkQueryInput(const CollisionQuery& query) {
    const std::pair<const char*, const PosedShape*> sides[] = {{"shape A", &query.a}, {"shape B", &query.b}};
    for (const auto& [where, shape] : sides) {
        if (shape->geometry == nullptr) refuse(where, "missing");
        checkPose(where, shape->pose);
        std::visit(CheckGeometry{where, query.dimension}, *shape->geometry);
    }
}

namespace {

/// Refuses what is missing by its name among Capabilities::libraryLacks.
class Lacks {
  public:
    Lacks(const Capabilities& capabilities, const std::string& engine)
        : capabilities_(capabilities), engine_(engine) {}

    [[noreturn]] void operator()(const std::string& name, const std::string& shown,
                                 const std::string& user = "") const {
        const auto documented = capabilities_.libraryLacks.find(name);
        if (documented == capabilities_.libraryLacks.end()) throw notInAdapter(engine_, shown, user);
        throw notInLibrary(engine_, shown, documented->second, user);
    }

  private:
    const Capabilities& capabilities_;
    const std::string& engine_;
};

void checkFilters(const scenario::Body& body, const std::string& user, const Capabilities& capabilities,
                  const Lacks& lacks) {
    for (const auto& shape : body.shapes) {
        if (shape.filter != scenario::ContactFilter{} && !capabilities.contactFilters)
            lacks("contact_filters", "layers and groups", user);
        if (shape.filter != body.shapes.front().filter && !capabilities.shapeFilters)
            lacks("shape_filters", "shapes of one body with different layers or groups", user);
    }
}

/// Whether shapes of each body can touch any of another. A joint that can break keeps none apart for good.
std::vector<bool> bodiesThatTouch(Scenario scenario) {
    std::erase_if(scenario.joints, [](const scenario::Joint& joint) {
        return joint.breakForce < 1e299 || joint.breakTorque < 1e299;
    });
    const int count = static_cast<int>(scenario.bodies.size());
    const auto canMeet = [&](int a, int b) {
        return !scenario.bodies[a].shapes.empty() && !scenario.bodies[b].shapes.empty() &&
               scenario::mayCollide(scenario, a, b);
    };
    std::vector<bool> touches(scenario.bodies.size());
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count && !touches[a]; ++b) touches[a] = canMeet(a, b);
    return touches;
}

/// Coefficients of materials and pairs, which an engine without shapes has no use for.
void checkSurfaces(const Scenario& scenario, const Capabilities& capabilities, const Lacks& lacks) {
    if (capabilities.shapes.empty()) return;
    if (!capabilities.staticFriction) {
        const auto sticks = [](const auto& m) { return m.staticFriction > m.friction; };
        if (std::any_of(scenario.materials.begin(), scenario.materials.end(), sticks) ||
            std::any_of(scenario.pairs.begin(), scenario.pairs.end(), sticks))
            lacks("static_friction", "static friction apart from that of sliding");
    }
    const auto anySurface = [&](auto member) {
        const auto is = [&](const auto& m) { return m.*member > 0.0; };
        return std::any_of(scenario.materials.begin(), scenario.materials.end(), is);
    };
    const auto anyPair = [&](auto member) {
        const auto is = [&](const auto& m) { return m.*member > 0.0; };
        return std::any_of(scenario.pairs.begin(), scenario.pairs.end(), is);
    };
    if (!capabilities.rollingFriction && (anySurface(&scenario::Material::rollingFriction) ||
                                          anyPair(&scenario::MaterialPair::rollingFriction)))
        lacks("rolling_friction", "rolling friction");
    if (!capabilities.torsionalFriction && (anySurface(&scenario::Material::torsionalFriction) ||
                                            anyPair(&scenario::MaterialPair::torsionalFriction)))
        lacks("torsional_friction", "torsional friction");
}

/// An engine without shapes runs bodies whose shapes only give them mass and a picture.
void checkBodies(const Scenario& scenario, const Capabilities& capabilities, const Lacks& lacks) {
    const bool hasContacts = !capabilities.shapes.empty();
    std::vector<bool> canTouch;
    if (!hasContacts) canTouch = bodiesThatTouch(scenario);
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
        const auto& body = scenario.bodies[i];
        const std::string user = "body '" + body.name + "'";
        const bool touches = hasContacts ? body.collides : canTouch[i];
        for (const auto& shape : body.shapes) {
            const std::string name = geometryName(shape.geometry, scenario.dimension);
            if (touches && !contains(capabilities.shapes, name))
                lacks(name, (hasContacts ? "shape '" : "rigid contact of shape '") + name + "'", user);
            if (touches && shape.surfaceVelocity.moves() && !capabilities.surfaceVelocity)
                lacks("surface_velocity", "velocity of a surface over its body", user);
        }
        if (touches) checkFilters(body, user, capabilities, lacks);
        if (body.type == BodyType::Kinematic && !capabilities.kinematicBodies)
            lacks("kinematic_bodies", "kinematic bodies", user);
        if ((body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0) && !capabilities.damping)
            lacks("damping", "velocity damping", user);
        if (body.gravityScale != 1.0 && !capabilities.gravityScale)
            lacks("gravity_scale", "gravity scale per body", user);
        if (body.type == BodyType::Dynamic && norm(body.massProperties.centerOfMass) > 0.0 &&
            !capabilities.centerOfMassOffset)
            lacks("center_of_mass_offset", "centre of mass offset", user);
    }
}

void checkJoints(const Scenario& scenario, const Capabilities& capabilities, const Lacks& lacks) {
    const auto require = [&](const std::string& name, const scenario::Joint& joint) {
        if (!contains(capabilities.joints, name))
            lacks(name, "joint '" + name + "'", "joint '" + joint.name + "'");
    };
    for (const auto& joint : scenario.joints) require(jointName(joint.type), joint);
    for (const auto& joint : scenario.joints)
        for (const std::string& feature : joint.features())
            require(std::string(jointName(joint.type)) + "." + feature, joint);
}

}  // namespace

void checkSupported(const Scenario& scenario, const Capabilities& capabilities, const std::string& engine) {
    const Lacks lacks(capabilities, engine);
    if (!capabilities.dynamics) lacks("dynamics", "dynamics");
    const auto& dims = capabilities.dimensions;
    const bool native = std::find(dims.begin(), dims.end(), scenario.dimension) != dims.end();
    if (!native && !(scenario.dimension == 2 && capabilities.planar)) {
        const std::string name = std::to_string(scenario.dimension) + "D";
        lacks(name, name + " dynamics");
    }
    checkSurfaces(scenario, capabilities, lacks);
    checkBodies(scenario, capabilities, lacks);
    checkJoints(scenario, capabilities, lacks);
}

}  // namespace rigor::adapter
