// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Planar sliding of a body with a flat base. Friction mu N acts against the velocity at height h below the
// centre of mass, so the pressure is centred at com + mu h v/|v| on the plane; it must lie in the contact
// area.
#include "validation/references/sliding/sliding.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {

SlidingBody::SlidingBody(const Scenario& scenario, int index, int floor)
    : scenario_(&scenario),
      body_(&scenario.bodies[index]),
      index_(index),
      plane_(planeOf(scenario, floor, centerOfMass(*body_))),
      com_(centerOfMass(*body_)),
      slide_({}, 0.0, {}, 0.0) {
    const std::string subject = bodyTitle(scenario, index);
    requireUndisturbed(scenario, index);
    requireContact(scenario, index, floor);
    requireStill(scenario, floor);
    const Support support = supportOf(scenario, index, plane_);
    require(std::abs(support.gap) <= 1e-4 * sizeOf(*body_),
            subject + " does not start in contact with " + bodyTitle(scenario, floor));
    const Vec3 g = gravityOn(scenario, index);
    load_ = -dot(g, plane_.normal);
    require(load_ > 0.0, "gravity does not press " + subject + " against " + bodyTitle(scenario, floor));
    pull_ = g + load_ * plane_.normal;
    if (negligible(norm(pull_), norm(g))) pull_ = {};
    require(norm(body_->angularVelocity) == 0.0, subject + " starts with a spin");
    require(negligible(dot(body_->velocity, plane_.normal), norm(body_->velocity)),
            "the velocity of " + subject + " is not along " + bodyTitle(scenario, floor));
    const auto pair = pairCoefficients(scenario, support.material, plane_.material);
    mu_ = pair.friction;
    isOneCoefficient_ = holdingFriction(pair) == mu_;
    slide_ = PlanarSlide(pull_, mu_ * load_, body_->velocity, holdingFriction(pair) * load_);
    requireNoTipping(support);
    for (const double t : {0.25, 0.5, 0.75, 1.0})
        require(plane_.holds(com_ + slide_.at(t * scenario.duration).displacement),
                subject + " slides over the edge of " + bodyTitle(scenario, floor));
}

void SlidingBody::requireNoTipping(const Support& support) const {
    const double height = plane_.height(com_);
    const Vec3 foot = com_ - height * plane_.normal;
    const double slack = 1e-9 * sizeOf(*body_);
    const auto check = [&](Vec3 offset) {
        require(supportMargin(support.points, foot + offset, plane_.normal, scenario_->dimension) >= -slack,
                bodyTitle(*scenario_, index_) + " tips: friction at its base outweighs its stance");
    };
    // Directions the motion passes through, then rest.
    for (int k = 0; k <= 16; ++k) {
        const Vec3 v = slide_.at(scenario_->duration * k / 16.0).velocity;
        if (norm(v) > 0.0) check((mu_ * height) * unit(v));
    }
    if (slide_.sticks()) check((height / load_) * pull_);
}

PartialState SlidingBody::exact(double t) const {
    const auto s = slide_.at(t);
    return stateOf(*body_, com_ + s.displacement, body_->pose.orientation, s.velocity, {});
}

std::optional<PartialState> SlidingBody::schemeExact(std::size_t step, double dt,
                                                     adapter::Scheme scheme) const {
    // Two coefficients: no one knows which of them a scheme takes in the step that stops.
    if (!adapter::isEuler(scheme) || !isOneCoefficient_) return std::nullopt;
    const auto s = steps_.at(pull_, mu_ * load_, body_->velocity, step, dt, scheme);
    return stateOf(*body_, com_ + s.displacement, body_->pose.orientation, s.velocity, {});
}

double SlidingBody::distance(const Trajectory& run, std::size_t k) const {
    const Vec3 moved =
        centerOfMass(*body_, run.state(k, index_)) - centerOfMass(*body_, run.state(0, index_));
    return norm(moved - dot(moved, plane_.normal) * plane_.normal);
}

void SlidingBody::addStopQuantities(std::vector<Quantity>& result, const std::string& suffix, double dt,
                                    adapter::Scheme scheme) const {
    const double start = speed();
    if (!slide_.stopTime() || start == 0.0 || *slide_.stopTime() > scenario_->duration) return;
    Quantity distanceQ{
        "stop_distance" + suffix, "m", norm(slide_.at(*slide_.stopTime()).displacement), {}, 0.0, {}};
    const auto last = static_cast<std::size_t>(std::llround(scenario_->duration / dt));
    if (const auto state = schemeExact(last, dt, scheme); state && norm(*state->velocity) == 0.0)
        distanceQ.schemeExact = norm(*state->position - body_->pose.position);
    // Distance in the last frame; empty while it still moves faster than 5 % of the start.
    distanceQ.measure = [this, start](const Trajectory& run) -> std::optional<double> {
        const std::size_t end = run.frames() - 1;
        if (!(norm(run.state(end, index_).velocity) < 0.05 * start)) return std::nullopt;
        return distance(run, end);
    };
    result.push_back(std::move(distanceQ));
    Quantity timeQ{"stop_time" + suffix, "s", *slide_.stopTime(), {}, 0.0, {}};
    timeQ.measure = [this, start](const Trajectory& run) {
        return extrapolatedStop(run, start,
                                [&](std::size_t k) { return norm(run.state(k, index_).velocity); });
    };
    result.push_back(std::move(timeQ));
}

}  // namespace rigor::validation
