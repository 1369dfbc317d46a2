// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parameters, bodies and assumptions. Geometry is in geometry_parts.cpp, measuring in measure_parts.cpp.
#include "validation/references/parts.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace rigor::validation {

using scenario::BodyType;

void violated(const std::string& sentence) {
    throw AssumptionViolated(sentence);
}

void require(bool holds, const std::string& sentence) {
    if (!holds) violated(sentence);
}

std::string shown(Vec3 v, int dimension) {
    std::ostringstream text;
    text.precision(10);
    text << '[' << v.x << ", " << v.y;
    if (dimension == 3) text << ", " << v.z;
    text << ']';
    return text.str();
}

std::string bodyTitle(const Scenario& scenario, int body) {
    return "body '" + scenario.bodies[body].name + "'";
}

// ------------------------------------------------------------------------------------------- parameters
Parts::Parts(const Scenario& scenario, const scenario::ReferenceSpec& spec,
             std::initializer_list<const char*> allowed)
    : scenario_(scenario), spec_(spec) {
    for (const auto& [key, value] : spec.parameters) {
        if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
        std::string names;
        for (const char* name : allowed) names += (names.empty() ? "" : ", ") + std::string(name);
        bad("unknown parameter '" + key + "'; known: " + names);
    }
}

void Parts::bad(const std::string& what) const {
    throw std::invalid_argument("reference '" + spec_.name + "': " + what);
}

std::optional<std::string> Parts::text(const char* key) const {
    const auto it = spec_.parameters.find(key);
    if (it == spec_.parameters.end()) return std::nullopt;
    if (const auto* name = std::get_if<std::string>(&it->second)) return *name;
    if (const auto* names = std::get_if<std::vector<std::string>>(&it->second); names && names->size() == 1)
        return names->front();
    bad("parameter '" + std::string(key) + "' must be one name");
}

int Parts::byName(const char* key, const std::string& name) const {
    const int body = scenario::findBody(scenario_, name);
    if (body == scenario::kNone) bad("parameter '" + std::string(key) + "': there is no body '" + name + "'");
    return body;
}

int Parts::anyBody(const char* key, std::initializer_list<int> except) const {
    if (const auto name = text(key)) return byName(key, *name);
    int found = scenario::kNone;
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) {
        if (std::find(except.begin(), except.end(), i) != except.end()) continue;
        if (found != scenario::kNone) bad("parameter '" + std::string(key) + "' is missing");
        found = i;
    }
    if (found == scenario::kNone) bad("no body for parameter '" + std::string(key) + "'");
    return found;
}

int Parts::dynamicBody(const char* key, std::initializer_list<int> except) const {
    const auto isDynamic = [&](int i) { return scenario_.bodies[i].type == BodyType::Dynamic; };
    if (const auto name = text(key)) {
        const int body = byName(key, *name);
        if (!isDynamic(body))
            bad("parameter '" + std::string(key) + "': body '" + *name + "' is not dynamic");
        return body;
    }
    int found = scenario::kNone;
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) {
        if (!isDynamic(i) || std::find(except.begin(), except.end(), i) != except.end()) continue;
        if (found != scenario::kNone) bad("parameter '" + std::string(key) + "' is missing");
        found = i;
    }
    if (found == scenario::kNone) bad("no dynamic body for parameter '" + std::string(key) + "'");
    return found;
}

int Parts::support(const char* key, int partner) const {
    if (const auto name = text(key)) {
        const int body = byName(key, *name);
        if (scenario_.bodies[body].type == BodyType::Dynamic)
            bad("parameter '" + std::string(key) + "': body '" + *name + "' is dynamic");
        return body;
    }
    int found = scenario::kNone;
    for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) {
        if (scenario_.bodies[i].type == BodyType::Dynamic) continue;
        if (!scenario::mayCollide(scenario_, i, partner)) continue;
        if (found != scenario::kNone) bad("parameter '" + std::string(key) + "' is missing");
        found = i;
    }
    if (found == scenario::kNone) bad("no fixed body for parameter '" + std::string(key) + "'");
    return found;
}

std::vector<int> Parts::dynamicBodies(const char* key) const {
    std::vector<int> bodies;
    const auto it = spec_.parameters.find(key);
    if (it == spec_.parameters.end()) {
        for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i)
            if (scenario_.bodies[i].type == BodyType::Dynamic) bodies.push_back(i);
    } else if (const auto* name = std::get_if<std::string>(&it->second)) {
        bodies.push_back(byName(key, *name));
    } else if (const auto* names = std::get_if<std::vector<std::string>>(&it->second)) {
        for (const auto& one : *names) bodies.push_back(byName(key, one));
    } else {
        bad("parameter '" + std::string(key) + "' must be a list of names");
    }
    if (bodies.empty()) bad("no dynamic body for parameter '" + std::string(key) + "'");
    for (const int body : bodies)
        if (scenario_.bodies[body].type != BodyType::Dynamic)
            bad("parameter '" + std::string(key) + "': " + bodyTitle(scenario_, body) + " is not dynamic");
    return bodies;
}

int Parts::joint(const char* key, int body) const {
    const auto name = text(key);
    int found = scenario::kNone;
    for (int i = 0; i < static_cast<int>(scenario_.joints.size()); ++i) {
        const auto& joint = scenario_.joints[i];
        if (name ? joint.name != *name : (joint.bodyA != body && joint.bodyB != body)) continue;
        if (found != scenario::kNone) bad("parameter '" + std::string(key) + "' is missing");
        found = i;
    }
    if (found == scenario::kNone)
        bad(name ? "there is no joint '" + *name + "'" : "no joint for parameter '" + std::string(key) + "'");
    return found;
}

// -------------------------------------------------------------------------------------------- mechanics
Vec3 centerOfMass(const Body& body) {
    return body.pose * body.massProperties.centerOfMass;
}

Vec3 centerOfMass(const Body& body, const BodyState& state) {
    return state.position + rotate(state.orientation, body.massProperties.centerOfMass);
}

Vec3 gravityOn(const Scenario& scenario, int body) {
    return scenario.bodies[body].gravityScale * scenario.gravity;
}

Mat3 worldInertia(const Body& body) {
    const Mat3 r = toMatrix(body.pose.orientation);
    return r * body.massProperties.inertia * transpose(r);
}

PartialState stateOf(const Body& body, Vec3 com, Quat orientation, Vec3 velocity, Vec3 angularVelocity) {
    PartialState state;
    state.position = com - rotate(orientation, body.massProperties.centerOfMass);
    state.orientation = orientation;
    state.velocity = velocity;
    state.angularVelocity = angularVelocity;
    return state;
}

PartialState stateOf(const Body& body, Vec3 com, Vec3 velocity) {
    PartialState state;
    if (body.massProperties.centerOfMass == Vec3{}) state.position = com;
    state.velocity = velocity;
    return state;
}

Vec3 unit(Vec3 v) {
    const double length = norm(v);
    return length > 0.0 ? v / length : Vec3{};
}

Vec3 perpendicular(Vec3 n) {
    if (n.z == 0.0) return unit({n.y, -n.x, 0.0});
    return unit(std::abs(n.x) < 0.6 ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}));
}

Quat turned(Quat q, Vec3 w, double t) {
    const double rate = norm(w);
    return rate > 0.0 ? scenario::normalized(scenario::fromAxisAngle(w / rate, rate * t) * q) : q;
}

bool negligible(double a, double scale) {
    return std::abs(a) <= 1e-9 * std::abs(scale);
}

double runEnd(const Scenario& scenario) {
    // A run ends at the multiple of its step next to the duration: half a step beyond it at most.
    double step = scenario.duration / 8.0;
    for (const double dt : scenario.timeSteps) step = std::max(step, dt);
    return scenario.duration + 0.5 * step;
}

double holdingFriction(const scenario::PairCoefficients& pair) {
    return std::max(pair.staticFriction, pair.friction);
}

// ------------------------------------------------------------------------------------------ assumptions
namespace {

struct Influence {
    int body;
    const Allowed& allowed;

    bool allows(const scenario::ConstantForce& f) const { return f.body != body || allowed.constantForces; }
    bool allows(const scenario::SpringForce& f) const {
        return (f.bodyA != body && f.bodyB != body) || allowed.springs ||
               (f.stiffness == 0 && f.damping == 0);
    }
    bool allows(const scenario::DragForce& f) const {
        const bool known = allowed.quadraticDrag || f.quadratic == 0.0;
        return f.body != body || (known && (allowed.drag || f.coefficient == 0.0));
    }
};

}  // namespace

void requireUndisturbed(const Scenario& scenario, int index, Allowed allowed) {
    const Body& body = scenario.bodies[index];
    const std::string subject = bodyTitle(scenario, index);
    if (!allowed.joints)
        for (const auto& joint : scenario.joints)
            require(joint.bodyA != index && joint.bodyB != index,
                    "joint '" + joint.name + "' holds " + subject + ", which this reference takes as free");
    for (const auto& force : scenario.forces)
        require(std::visit(
                    [&](const auto& f) {
                        return Influence{index, allowed}.allows(f);
                    },
                    force),
                "a force acts on " + subject + " that this reference does not know");
    if (!allowed.events)
        for (const auto& event : scenario.events)
            require(event.body != index, "an event gives an impulse to " + subject);
    if (!allowed.damping)
        require(body.linearVelocityKept == 1.0 && body.angularVelocityKept == 1.0, subject + " is damped");
    require(body.massProperties.mass > 0.0, subject + " has no mass");
}

void requireStill(const Scenario& scenario, int body) {
    const Body& b = scenario.bodies[body];
    require(b.velocity == Vec3{} && b.angularVelocity == Vec3{}, bodyTitle(scenario, body) + " moves");
}

void requireContact(const Scenario& scenario, int a, int b) {
    require(scenario::mayCollide(scenario, a, b), bodyTitle(scenario, a) + " and " + bodyTitle(scenario, b) +
                                                      " never touch: contacts between them are off");
}

Ball ballOf(const Scenario& scenario, int index) {
    const Body& body = scenario.bodies[index];
    const std::string subject = bodyTitle(scenario, index);
    require(body.shapes.size() == 1 && std::holds_alternative<scenario::Sphere>(body.shapes[0].geometry),
            subject + " is not a single sphere");
    Ball ball;
    ball.body = index;
    ball.radius = std::get<scenario::Sphere>(body.shapes[0].geometry).radius;
    ball.mass = body.massProperties.mass;
    ball.material = body.shapes[0].material;
    require(negligible(norm(body.shapes[0].pose.position - body.massProperties.centerOfMass), ball.radius),
            "the centre of mass of " + subject + " is not the centre of its sphere");
    const Mat3& inertia = body.massProperties.inertia;
    const double moment = inertia(2, 2);
    if (scenario.dimension == 3)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                require(negligible(inertia(i, j) - (i == j ? moment : 0.0), moment),
                        subject + " has different moments of inertia about different axes");
    ball.k = moment / (ball.mass * ball.radius * ball.radius);
    ball.center = centerOfMass(body);
    ball.velocity = body.velocity;
    ball.spin = body.angularVelocity;
    return ball;
}

}  // namespace rigor::validation
