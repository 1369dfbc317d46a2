// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An honest small engine of known order: rigid bodies in 3D, spheres and boxes on half-spaces, balls on
// balls. The faulty engines of rigid.cpp are this one with one injected fault each.
//
//   velocity   v += h (g + F/m), x += h v: symplectic Euler, first order, exact for its own scheme
//   rotation   L += h T; q = exp(h w(q')) q, q' = exp(h/2 w(q)) q, w(q) = R I^-1 R^T L: the explicit midpoint
//              rule, second order; keeps L to rounding
//   contact    at a gap of nothing or less, Newton restitution, Coulomb's cone, by sweeps over the points
//
// Joints are not held: a scene with joints has to be at rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {

using scenario::HalfSpace;
using scenario::PairCoefficients;
using scenario::Sphere;

inline Mat3 inverseOf(const Mat3& m) {
    Mat3 r;
    const auto row = [&](int i) { return Vec3{m(i, 0), m(i, 1), m(i, 2)}; };
    const Vec3 a = row(0), b = row(1), c = row(2);
    const Vec3 columns[3] = {cross(b, c), cross(c, a), cross(a, b)};
    for (int j = 0; j < 3; ++j) {
        const Vec3 x = columns[j] / dot(a, cross(b, c));
        r(0, j) = x.x;
        r(1, j) = x.y;
        r(2, j) = x.z;
    }
    return r;
}

/// The orientation after turning by the rotation vector `turn` [rad], world frame.
inline Quat turnedBy(const Quat& q, const Vec3& turn) {
    const double angle = norm(turn);
    return angle > 0.0 ? normalized(scenario::fromAxisAngle(turn / angle, angle) * q) : q;
}

class RigidWorld : public World {
  public:
    RigidWorld(const Scenario& scenario, double dt, const Settings&)
        : scenario_(scenario), dt_(dt), loads_(scenario.bodies.size()) {
        for (const auto& b : scenario.bodies)
            bodies_.push_back(
                {b.pose * b.massProperties.centerOfMass, b.pose.orientation, b.velocity, {}, {}});
    }

    void applyForce(int body, const Vec3& force, const Vec3& torque) override {
        loads_[index(body)].force += force;
        loads_[index(body)].torque += torque;
    }
    void step() override {
        start();
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (isDynamic(i)) kick(i);
        findContacts();
        solveContacts();
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (isDynamic(i)) move(i);
        endOfStep();
    }
    void readStates(std::span<BodyState> states) const override {
        for (std::size_t i = 0; i < states.size(); ++i) states[i] = reported(i);
    }
    void readContacts(std::vector<ContactPoint>& contacts) const override {
        contacts.clear();
        for (const Contact& c : contacts_) contacts.push_back(reported(c));
    }
    ReadBack readBack() const override {
        ReadBack back;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const auto& m = scenario_.bodies[i].massProperties;
            back.bodies.push_back({m.mass, m.centerOfMass, reportedInertia(i), stateOf(i), gravityOn(i)});
        }
        return back;
    }
    std::vector<LedgerEntry> ledger() const override { return {}; }
    Scheme scheme() const override { return Scheme::SymplecticEuler; }

  protected:
    struct Moving {
        Vec3 position;  ///< position of the centre of mass
        Quat orientation;
        Vec3 velocity, momentum;  ///< angular momentum about the centre of mass, world frame
        Vec3 velocityBefore;      ///< velocity at the start of the step
    };
    struct Contact {
        ContactPoint point;
        double aim = 0.0;  ///< normal velocity that restitution requires
        double normalImpulse = 0.0;
        Vec3 friction;
    };

    // Functions that faulty engines override.
    virtual Vec3 gravityOn(std::size_t i) const {
        return scenario_.bodies[i].gravityScale * scenario_.gravity;
    }
    virtual double stepOf() const { return dt_; }
    virtual Mat3 inertiaOf(std::size_t i) const { return scenario_.bodies[i].massProperties.inertia; }
    virtual Mat3 reportedInertia(std::size_t i) const { return inertiaOf(i); }
    virtual Quat frameOfInertia(const Quat& q) const { return q; }
    virtual PairCoefficients coefficients(int a, int b) const {
        return pairCoefficients(scenario_, scenario_.bodies[index(a)].shapes[0].material,
                                scenario_.bodies[index(b)].shapes[0].material);
    }
    /// Coulomb's law: a tangential impulse of at most `limit`.
    virtual Vec3 limited(const Vec3& impulse, double limit) const {
        const double size = norm(impulse);
        return size > limit ? (limit / size) * impulse : impulse;
    }
    /// Impulse on B if A gets -impulse.
    virtual Vec3 reaction(const Vec3& impulse) const { return impulse; }
    virtual double gapSeen(double gap) const { return gap; }
    virtual void movePosition(Moving& m) const { m.position += stepOf() * m.velocity; }
    virtual void endOfStep() {}
    virtual BodyState reported(std::size_t i) const { return stateOf(i); }
    virtual ContactPoint reported(const Contact& c) const { return c.point; }

    static std::size_t index(int body) { return body; }
    bool isDynamic(std::size_t i) const { return scenario_.bodies[i].type == scenario::BodyType::Dynamic; }
    Vec3 spin(std::size_t i, const Quat& q) const {
        const Quat f = frameOfInertia(q);
        return rotate(f, inverseOf(inertiaOf(i)) * rotateInverse(f, bodies_[i].momentum));
    }
    BodyState stateOf(std::size_t i) const {
        const auto& b = scenario_.bodies[i];
        const Moving& m = bodies_[i];
        const Vec3 offset = rotate(m.orientation, b.massProperties.centerOfMass);
        if (!isDynamic(i) || !started_)
            return {m.position - offset, m.orientation, m.velocity, b.angularVelocity};
        return {m.position - offset, m.orientation, m.velocity, spin(i, m.orientation)};
    }

    Scenario scenario_;
    double dt_;
    std::vector<Moving> bodies_;
    std::vector<Contact> contacts_;
    int steps_ = 0;

  private:
    struct Load {
        Vec3 force, torque;
    };

    /// Momenta need the inertia, which a constructor cannot get from a derived class.
    void start() {
        ++steps_;
        if (started_) return;
        started_ = true;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!isDynamic(i)) continue;
            const Quat f = frameOfInertia(bodies_[i].orientation);
            bodies_[i].momentum =
                rotate(f, inertiaOf(i) * rotateInverse(f, scenario_.bodies[i].angularVelocity));
        }
    }
    void kick(std::size_t i) {
        Moving& m = bodies_[i];
        m.velocityBefore = m.velocity;
        m.velocity += stepOf() * (gravityOn(i) + loads_[i].force / scenario_.bodies[i].massProperties.mass);
        m.momentum += stepOf() * loads_[i].torque;
        loads_[i] = {};
    }
    void move(std::size_t i) {
        Moving& m = bodies_[i];
        movePosition(m);
        const Quat middle = turnedBy(m.orientation, 0.5 * stepOf() * spin(i, m.orientation));
        m.orientation = turnedBy(m.orientation, stepOf() * spin(i, middle));
    }

    void findContacts() {
        contacts_.clear();
        const int n = bodies_.size();
        for (int a = 0; a < n; ++a)
            for (int b = a + 1; b < n; ++b)
                if (mayCollide(scenario_, a, b)) meet(a, b);
        for (Contact& c : contacts_) {
            const double approach = dot(c.point.normal, relativeVelocity(c));
            // Slower than a few steps of gravity is resting.
            const double resting = 4.0 * dt_ * norm(scenario_.gravity);
            const PairCoefficients pair = coefficients(c.point.bodyA, c.point.bodyB);
            if (approach < -resting) c.aim = -pair.restitution * approach;
        }
    }
    void meet(int a, int b) {
        const auto& ga = scenario_.bodies[index(a)].shapes[0].geometry;
        const auto& gb = scenario_.bodies[index(b)].shapes[0].geometry;
        if (const auto* floor = std::get_if<HalfSpace>(&ga)) return onFloor(a, *floor, b, false);
        if (const auto* floor = std::get_if<HalfSpace>(&gb)) return onFloor(b, *floor, a, true);
        const auto *sa = std::get_if<Sphere>(&ga), *sb = std::get_if<Sphere>(&gb);
        const Vec3 span = bodies_[index(b)].position - bodies_[index(a)].position;
        if (norm(span) > reachOf(ga) + reachOf(gb)) return;
        if (sa == nullptr || sb == nullptr)
            throw Unsupported("only half-spaces with balls and boxes, balls with balls");
        const Vec3 n = span / norm(span);
        add(a, b, n, bodies_[index(a)].position + sa->radius * n,
            bodies_[index(b)].position - sb->radius * n);
    }
    static double reachOf(const Geometry& geometry) {
        if (const auto* ball = std::get_if<Sphere>(&geometry)) return ball->radius;
        const auto* box = std::get_if<scenario::Box>(&geometry);
        return box != nullptr ? norm(box->halfExtents) : std::numeric_limits<double>::infinity();
    }
    void onFloor(int floor, const HalfSpace& half, int body, bool floorIsB) {
        const Pose& where = scenario_.bodies[index(floor)].pose;
        const Vec3 n = rotate(where.orientation, half.normal);
        const Moving& m = bodies_[index(body)];
        const auto touch = [&](const Vec3& p) {
            const Vec3 foot = p - (dot(n, p - where.position) - half.offset) * n;
            if (floorIsB)
                add(body, floor, -n, p, foot);
            else
                add(floor, body, n, foot, p);
        };
        const auto& geometry = scenario_.bodies[index(body)].shapes[0].geometry;
        if (const auto* ball = std::get_if<Sphere>(&geometry)) touch(m.position - ball->radius * n);
        if (const auto* box = std::get_if<scenario::Box>(&geometry))
            for (const double x : {-1.0, 1.0})
                for (const double y : {-1.0, 1.0})
                    for (const double z : {-1.0, 1.0}) {
                        const Vec3 h = box->halfExtents;
                        touch(m.position + rotate(m.orientation, {x * h.x, y * h.y, z * h.z}));
                    }
    }
    void add(int a, int b, const Vec3& n, const Vec3& onA, const Vec3& onB) {
        const double gap = gapSeen(dot(n, onB - onA));
        constexpr double kTouching = 1e-9;
        if (gap > kTouching) return;
        Contact c;
        c.point.bodyA = a;
        c.point.bodyB = b;
        c.point.normal = n;
        c.point.depth = -gap;
        c.point.pointA = onA;
        c.point.pointB = onB;
        contacts_.push_back(c);
    }

    Vec3 velocityAt(int body, const Vec3& at) const {
        if (!isDynamic(index(body))) return {};
        const Moving& m = bodies_[index(body)];
        return m.velocity + cross(spin(index(body), m.orientation), at - m.position);
    }
    Vec3 relativeVelocity(const Contact& c) const {
        const Vec3 at = 0.5 * (c.point.pointA + c.point.pointB);
        return velocityAt(c.point.bodyB, at) - velocityAt(c.point.bodyA, at);
    }
    void push(int body, const Vec3& at, const Vec3& impulse) {
        if (!isDynamic(index(body))) return;
        Moving& m = bodies_[index(body)];
        m.velocity += impulse / scenario_.bodies[index(body)].massProperties.mass;
        m.momentum += cross(at - m.position, impulse);
    }
    /// Change of the relative velocity along n for a unit impulse along n.
    double mobility(const Contact& c, const Vec3& n) const {
        double k = 0.0;
        for (const int body : {c.point.bodyA, c.point.bodyB}) {
            const std::size_t i = index(body);
            if (!isDynamic(i)) continue;
            const Moving& m = bodies_[i];
            const Vec3 arm = 0.5 * (c.point.pointA + c.point.pointB) - m.position, turn = cross(arm, n);
            const Quat f = frameOfInertia(m.orientation);
            const Vec3 w = rotate(f, inverseOf(inertiaOf(i)) * rotateInverse(f, turn));
            k += 1.0 / scenario_.bodies[i].massProperties.mass + dot(turn, w);
        }
        return k;
    }
    void apply(const Contact& c, const Vec3& impulse) {
        const Vec3 at = 0.5 * (c.point.pointA + c.point.pointB);
        push(c.point.bodyA, at, -impulse);
        push(c.point.bodyB, at, reaction(impulse));
    }
    void solveContacts() {
        constexpr int kSweeps = 200;
        for (int sweep = 0; sweep < kSweeps; ++sweep)
            for (Contact& c : contacts_) {
                const Vec3& n = c.point.normal;
                const double defect = dot(n, relativeVelocity(c)) - c.aim;
                const double now = std::max(0.0, c.normalImpulse - defect / mobility(c, n));
                apply(c, (now - c.normalImpulse) * n);
                c.normalImpulse = now;
                const Vec3 u = relativeVelocity(c), slip = u - dot(u, n) * n;
                if (norm(slip) == 0.0) continue;
                const double mu = coefficients(c.point.bodyA, c.point.bodyB).friction;
                const Vec3 wanted = c.friction - slip / mobility(c, slip / norm(slip));
                const Vec3 friction = limited(wanted, mu * now);
                apply(c, friction - c.friction);
                c.friction = friction;
            }
        for (Contact& c : contacts_) {
            c.point.hasImpulse = true;
            c.point.normalImpulse = c.normalImpulse;
            c.point.frictionImpulse = c.friction;
        }
    }

    std::vector<Load> loads_;
    bool started_ = false;
};

}  // namespace rigor::doubles
