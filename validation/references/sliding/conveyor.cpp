// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body on a conveyor belt, whose surface moves at the velocity b: for one who rides along it is the same body with
// the velocity v0 - b on a floor at rest (Galilei), x = x'(t) + b t. A block slides with mu g towards the belt's
// velocity and then rides; down a slope likewise; a ball slips until it rolls on the belt; a body that lands gets
// the impulse of friction at the impact. Which law it is at rest is another reference's: incline_slide,
// slip_to_roll, rolling_incline, rolling_resistance, or planar_contact for bodies that fall onto the belt.
// Source: Galilei 1632; Coulomb 1785. Assumes what that reference does; a belt with one velocity along its face,
// on a fixed body. Quantities: those of that reference, seen from the belt (stop_time: when it begins to ride).
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {

std::unique_ptr<Reference> makeInclineSlide(const Scenario&, const scenario::ReferenceSpec&);
std::unique_ptr<Reference> makePlanarContact(const Scenario&, const scenario::ReferenceSpec&);
std::unique_ptr<Reference> makeRollingIncline(const Scenario&, const scenario::ReferenceSpec&);
std::unique_ptr<Reference> makeRollingResistance(const Scenario&, const scenario::ReferenceSpec&);
std::unique_ptr<Reference> makeSlipToRoll(const Scenario&, const scenario::ReferenceSpec&);

namespace {

using scenario::ParameterValue;
using scenario::ReferenceSpec;

/// Velocity of the belt's surface [m/s], world frame.
Vec3 beltVelocity(const Scenario& scenario, int on) {
    const Body& support = scenario.bodies[on];
    require(support.shapes.size() == 1, bodyTitle(scenario, on) + " has more than one shape");
    require(support.velocity == Vec3{} && support.angularVelocity == Vec3{},
            bodyTitle(scenario, on) + " moves itself");
    const scenario::SurfaceVelocity& surface = support.shapes.front().surfaceVelocity;
    require(surface.angular == Vec3{}, "the belt turns: use turntable");
    return rotate(support.pose.orientation, surface.linear);
}

class Conveyor : public Reference {
  public:
    Conveyor(const Scenario& scenario, int body, int on)
        : body_(scenario.bodies[body]), belt_(beltVelocity(scenario, on)), still_(scenario) {
        const Plane plane = planeOf(scenario, on, centerOfMass(body_));
        require(std::abs(dot(belt_, plane.normal)) <= 1e-9 * norm(belt_), "the belt moves across its face");
        for (const auto& shape : body_.shapes)
            require(!shape.surfaceVelocity.moves(), "the surface of " + bodyTitle(scenario, body) + " moves");
        // Seen from the belt it has no end; where the real one ends is checked below.
        Body& floor = still_.bodies[on];
        const scenario::HalfSpace endless{rotateInverse(floor.pose.orientation, plane.normal),
                                          plane.offset - dot(plane.normal, floor.pose.position)};
        floor.shapes.front() = {endless, {}, floor.shapes.front().material, {}};
        still_.bodies[body].velocity = body_.velocity - belt_;
        inner_ = makeInner(body, on, plane);
        for (int k = 0; k <= 64; ++k) {
            const double t = scenario.duration * k / 64.0;
            if (t > inner_->validUntil()) break;
            const auto position = exact(body, t).position;
            require(!position || plane.holds(*position), bodyTitle(scenario, body) + " leaves the belt");
        }
    }
    std::vector<int> bodies() const override { return inner_->bodies(); }
    double validUntil() const override { return inner_->validUntil(); }
    PartialState exact(int body, double t) const override { return carried(inner_->exact(body, t), t); }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        const auto state = inner_->schemeExact(body, step, dt, scheme);
        if (!state) return std::nullopt;
        return carried(*state, static_cast<double>(step) * dt);
    }
    std::vector<Quantity> quantities(double dt, adapter::Scheme scheme) const override {
        std::vector<Quantity> result = inner_->quantities(dt, scheme);
        for (Quantity& quantity : result)
            quantity.measure = [this, measure = std::move(quantity.measure)](const Trajectory& run) {
                return measure(fromTheBelt(run));
            };
        return result;
    }

  private:
    std::unique_ptr<Reference> makeInner(int body, int on, const Plane& plane) {
        const auto named = [&](const char* name, const char* part, const char* floor) {
            ReferenceSpec spec;
            spec.name = name;
            const bool list = std::string(part) == "bodies";
            spec.parameters[part] =
                list ? ParameterValue(std::vector<std::string>{body_.name}) : ParameterValue(body_.name);
            spec.parameters[floor] = still_.bodies[on].name;
            return spec;
        };
        const auto pair = pairCoefficients(still_, body_.shapes.front().material,
                                           still_.bodies[on].shapes.front().material);
        const bool moments = pair.rollingFriction > 0.0 || pair.torsionalFriction > 0.0;
        const bool ball = body_.shapes.size() == 1 &&
                          std::holds_alternative<scenario::Sphere>(body_.shapes.front().geometry);
        const double size = sizeOf(body_);
        if (supportOf(still_, body, plane).gap > 1e-4 * size) {
            require(!moments, "no closed form of a landing with rolling friction");
            return makePlanarContact(still_, named("planar_contact", "bodies", "floor"));
        }
        if (ball && moments) return makeRollingResistance(still_, named("rolling_resistance", "ball", "on"));
        require(!moments, "no closed form of rolling friction but for a ball");
        if (!ball) return makeInclineSlide(still_, named("incline_slide", "body", "on"));
        const Vec3 g = gravityOn(still_, body);
        const Vec3 along = g - dot(g, plane.normal) * plane.normal;
        if (negligible(norm(along), norm(g)))
            return makeSlipToRoll(still_, named("slip_to_roll", "ball", "floor"));
        return makeRollingIncline(still_, named("rolling_incline", "ball", "on"));
    }
    PartialState carried(PartialState state, double t) const {
        if (state.position) *state.position += t * belt_;
        if (state.velocity) *state.velocity += belt_;
        return state;
    }
    Trajectory fromTheBelt(const Trajectory& run) const {
        Trajectory seen = run;
        const std::vector<int> moved = bodies();
        for (std::size_t k = 0; k < run.frames(); ++k)
            for (const int body : moved) {
                auto& state = seen.states[k * run.bodyCount + static_cast<std::size_t>(body)];
                state.position -= run.times[k] * belt_;
                state.velocity -= belt_;
            }
        return seen;
    }

    const Body& body_;
    Vec3 belt_;
    Scenario still_;  ///< the scene as seen from the belt
    std::unique_ptr<Reference> inner_;
};

}  // namespace

std::unique_ptr<Reference> makeConveyor(const Scenario& scenario, const ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "on"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<Conveyor>(scenario, body, parts.support("on", body));
}

}  // namespace rigor::validation
