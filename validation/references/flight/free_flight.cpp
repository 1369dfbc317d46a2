// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Free flight of one or more bodies that touch nothing.
//   x = x0 + v0 t + a t^2/2, v = v0 + a t, a = gravityScale g + F/m; rotation torque-free about the centre of
//   mass; impulses of events at their time.
// Scheme-exact (n steps of h): symplectic Euler x = x0 + v0 t + a t (t + h)/2; explicit Euler
// x = x0 + v0 t + a t (t - h)/2; v exact in both.
// Source: Galilei 1638; Landau and Lifshitz, Mechanics, 1976, sections 35-37; Hairer, Lubich, Wanner,
// Geometric Numerical Integration, 2006, I.1.
// Assumes: no contact, joint, drag, damping or torque. Contact with a fixed half-space ends the validity.
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/references/flight/rotation.hpp"

namespace rigor::validation {
namespace {

struct Push {
    Vec3 acceleration;
    double start, end;
};
struct Kick {
    Vec3 velocity;
    double time;
};

/// Integrals over [0, t] of a pulse: time on, and its second integral.
double timeOn(const Push& p, double t) {
    return std::max(0.0, std::min(t, p.end) - std::max(0.0, p.start));
}
double momentOn(const Push& p, double t) {
    const auto half = [](double s) { return s > 0.0 ? 0.5 * s * s : 0.0; };
    return half(t - std::max(0.0, p.start)) - half(t - p.end);
}

struct Flight {
    int index = 0;
    const Body* body = nullptr;
    Vec3 com, velocity, gravity;
    std::vector<Push> pushes;
    std::vector<Kick> kicks;
    TorqueFreeMotion rotation;

    Vec3 comAt(double t) const {
        Vec3 x = com + t * velocity + (0.5 * t * t) * gravity;
        for (const auto& p : pushes) x += momentOn(p, t) * p.acceleration;
        for (const auto& k : kicks)
            if (t > k.time) x += (t - k.time) * k.velocity;
        return x;
    }
    Vec3 velocityAt(double t) const {
        Vec3 v = velocity + t * gravity;
        for (const auto& p : pushes) v += timeOn(p, t) * p.acceleration;
        for (const auto& k : kicks)
            if (t > k.time) v += k.velocity;
        return v;
    }
};

class FreeFlight : public Reference {
  public:
    FreeFlight(const Scenario& scenario, const std::vector<int>& bodies) : scenario_(scenario) {
        for (const int index : bodies) add(index);
        validUntil_ = firstFloorContact();
        for (const auto& flight : flights_) validUntil_ = std::min(validUntil_, flight.rotation.validUntil());
    }

    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const auto& flight : flights_) result.push_back(flight.index);
        return result;
    }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int body, double t) const override {
        const Flight& flight = find(body);
        const Attitude attitude = flight.rotation.at(t);
        return stateOf(*flight.body, flight.comAt(t), attitude.orientation, flight.velocityAt(t),
                       attitude.angularVelocity);
    }

    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        const Flight& flight = find(body);
        if (scheme == adapter::Scheme::Unknown || !flight.kicks.empty()) return std::nullopt;
        Vec3 a = flight.gravity;
        for (const auto& push : flight.pushes) {
            if (push.start > 0.0 || push.end < runEnd(scenario_)) return std::nullopt;
            a += push.acceleration;
        }
        const double t = step * dt;
        const double shift = scheme == adapter::Scheme::SymplecticEuler ? dt
                             : adapter::isEuler(scheme)                 ? -dt
                                                                        : 0.0;
        const Vec3 com = flight.com + t * flight.velocity + (0.5 * t * (t + shift)) * a;
        PartialState state = stateOf(*flight.body, com, flight.velocity + t * a);
        if (flight.body->angularVelocity == Vec3{}) {
            const Quat q = flight.body->pose.orientation;
            state = stateOf(*flight.body, com, q, *state.velocity, {});
        }
        return state;
    }

  private:
    void add(int index) {
        requireUndisturbed(scenario_, index, {.constantForces = true, .events = true});
        const Body& body = scenario_.bodies[index];
        Flight flight{index,
                      &body,
                      centerOfMass(body),
                      body.velocity,
                      gravityOn(scenario_, index),
                      {},
                      {},
                      TorqueFreeMotion(body, scenario_.dimension, runEnd(scenario_))};
        for (const auto& force : scenario_.forces) {
            const auto* push = std::get_if<scenario::ConstantForce>(&force);
            if (!push || push->body != index) continue;
            require(push->torque == Vec3{}, "a torque acts on " + bodyTitle(scenario_, index));
            flight.pushes.push_back({push->force / body.massProperties.mass, push->start, push->end});
        }
        for (const auto& event : scenario_.events) {
            if (event.body != index) continue;
            require(event.angularImpulse == Vec3{}, "an event turns " + bodyTitle(scenario_, index));
            flight.kicks.push_back({event.impulse / body.massProperties.mass, event.time});
        }
        flights_.push_back(std::move(flight));
    }

    const Flight& find(int body) const {
        for (const auto& flight : flights_)
            if (flight.index == body) return flight;
        throw std::invalid_argument("free_flight: unknown body");
    }

    /// Height over a fixed half-space of the sphere about the centre of mass that holds the body, or of the
    /// body itself where it does not turn.
    double clearance(const Flight& flight, const Plane& plane, double t) const {
        Body moved = *flight.body;
        const Attitude attitude = flight.rotation.at(t);
        moved.pose.orientation = attitude.orientation;
        moved.pose.position =
            flight.comAt(t) - rotate(attitude.orientation, moved.massProperties.centerOfMass);
        Scenario one;
        one.dimension = scenario_.dimension;
        one.materials = scenario_.materials;
        one.bodies.push_back(moved);
        for (auto& shape : one.bodies[0].shapes) shape.material = 0;
        Plane floor = plane;
        floor.material = 0;
        return supportOf(one, 0, floor).gap;
    }

    double firstFloorContact() const {
        double first = 1e300;
        for (const auto& flight : flights_)
            for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i) {
                const Body& other = scenario_.bodies[i];
                if (other.type != scenario::BodyType::Static || other.shapes.size() != 1 ||
                    !std::holds_alternative<scenario::HalfSpace>(other.shapes[0].geometry) ||
                    !scenario::mayCollide(scenario_, i, flight.index) || flight.body->shapes.empty())
                    continue;
                const Plane plane = planeOf(scenario_, i, flight.com);
                first = std::min(first, contactTime(flight, plane));
            }
        return first;
    }

    double contactTime(const Flight& flight, const Plane& plane) const {
        const double reach = sizeOf(*flight.body);
        const int samples = 2000;
        double before = 0.0;
        for (int k = 0; k <= samples; ++k) {
            const double t = scenario_.duration * k / samples;
            const bool touches = plane.height(flight.comAt(t)) < reach && clearance(flight, plane, t) < 0.0;
            if (touches) {
                require(k > 0, bodyTitle(scenario_, flight.index) + " starts inside a fixed half-space");
                double low = before, high = t;
                for (int i = 0; i < 60; ++i) {
                    const double middle = 0.5 * (low + high);
                    (clearance(flight, plane, middle) < 0.0 ? high : low) = middle;
                }
                return low;
            }
            before = t;
        }
        return 1e300;
    }

    const Scenario& scenario_;
    std::vector<Flight> flights_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeFreeFlight(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies", "body"});
    const char* key = spec.parameters.count("body") ? "body" : "bodies";
    return std::make_unique<FreeFlight>(scenario, parts.dynamicBodies(key));
}

}  // namespace rigor::validation
