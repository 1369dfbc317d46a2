// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See line_collisions.hpp.
#include "validation/references/impacts/line_collisions.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr std::size_t kMaxImpacts = 20000;

/// Reach of a sphere or box along d from its own centre; the box needs a side across d.
double reach(const Shape& shape, Quat bodyOrientation, Vec3 d, int dimension, const std::string& subject) {
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) return sphere->radius;
    const auto* box = std::get_if<Box>(&shape.geometry);
    require(box != nullptr, subject + " is neither a sphere nor a box");
    const Vec3 local = rotateInverse(bodyOrientation * shape.pose.orientation, d);
    const double h[3] = {box->halfExtents.x, box->halfExtents.y, box->halfExtents.z};
    const double c[3] = {std::abs(local.x), std::abs(local.y), std::abs(local.z)};
    for (int i = 0; i < dimension; ++i)
        if (c[i] > 1.0 - 1e-12) return h[i];
    violated("no side of " + subject + " is across the line of the collision");
}

}  // namespace

LineCollisions::LineCollisions(const Scenario& scenario, std::vector<int> bodies, bool gapsNeeded)
    : scenario_(scenario), bodies_(std::move(bodies)) {
    require(bodies_.size() >= 2, "a collision needs two bodies");
    const auto body = [&](int i) -> const Body& { return scenario.bodies[i]; };
    // The line: through the two outermost moving centres, or along the velocity where a wall is hit.
    int first = kNone;
    for (const int i : bodies_)
        if (body(i).type == BodyType::Dynamic && first == kNone) first = i;
    require(first != kNone, "nothing moves");
    origin_ = centerOfMass(body(first));
    gravity_ = gravityOn(scenario, first);
    for (const int i : bodies_) {
        const bool wall = body(i).type != BodyType::Dynamic;
        if (i == first || (wall && std::holds_alternative<HalfSpace>(body(i).shapes.at(0).geometry)))
            continue;
        direction_ = unit(centerOfMass(body(i)) - origin_);
    }
    for (const int i : bodies_) {
        if (direction_ != Vec3{} || i == first) continue;
        direction_ = -planeOf(scenario, i, origin_).normal;
    }
    require(direction_ != Vec3{}, "the centres of mass coincide");
    double fastest = 0.0;
    for (const int i : bodies_) fastest = std::max(fastest, norm(body(i).velocity));
    for (const int i : bodies_) {
        const std::string subject = bodyTitle(scenario, i);
        const Body& b = body(i);
        require(b.angularVelocity == Vec3{}, subject + " spins");
        require(negligible(norm(cross(b.velocity, direction_)), fastest),
                "the velocity of " + subject + " is not along the line of the centres");
        if (b.type != BodyType::Dynamic) {
            require(norm(gravity_) == 0.0, "gravity acts beside the fixed " + subject);
            continue;
        }
        requireUndisturbed(scenario, i);
        require(negligible(norm(gravityOn(scenario, i) - gravity_), norm(gravity_)),
                "gravity acts differently on " + subject);
    }
    Phase start;
    std::vector<std::pair<Member, int>> order;
    for (const int i : bodies_) order.emplace_back(memberOf(i), i);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first.position < b.first.position; });
    bodies_.clear();
    for (const auto& [member, index] : order) {
        start.members.push_back(member);
        bodies_.push_back(index);
    }
    for (std::size_t k = 0; k + 1 < bodies_.size(); ++k) {
        const auto &a = start.members[k], &b = start.members[k + 1];
        const double gap = b.position - b.low - a.position - a.high,
                     size = std::max(sizeOf(body(bodies_[k])), sizeOf(body(bodies_[k + 1])));
        const std::string subject =
            bodyTitle(scenario, bodies_[k]) + " and " + bodyTitle(scenario, bodies_[k + 1]);
        require(gap >= -1e-9 * size, subject + " overlap");
        require(!gapsNeeded || gap > 1e-9 * size,
                subject + " touch: which of them moves first is not defined without a gap");
        if (a.mass > 0.0 || b.mass > 0.0) requireContact(scenario, bodies_[k], bodies_[k + 1]);
    }
    phases_.push_back(std::move(start));
    run(runEnd(scenario));
}

LineCollisions::Member LineCollisions::memberOf(int index) const {
    const Body& body = scenario_.bodies[index];
    const std::string subject = bodyTitle(scenario_, index);
    Member member;
    member.velocity = dot(body.velocity, direction_);
    require(body.shapes.size() == 1, subject + " has not exactly one shape");
    const Shape& shape = body.shapes[0];
    member.lowMaterial = member.highMaterial = shape.material;
    if (std::holds_alternative<HalfSpace>(shape.geometry)) {
        const Plane plane = planeOf(scenario_, index, origin_);
        require(norm(cross(plane.normal, direction_)) < 1e-9,
                subject + " is not across the line of the collision");
        member.position = (plane.offset - dot(plane.normal, origin_)) / dot(plane.normal, direction_);
        return member;
    }
    member.mass = body.type == BodyType::Dynamic ? body.massProperties.mass : 0.0;
    const Vec3 center = body.pose * shape.pose.position;
    const Vec3 com = body.type == BodyType::Dynamic ? centerOfMass(body) : center;
    member.position = dot(com - origin_, direction_);
    const double size = reach(shape, body.pose.orientation, direction_, scenario_.dimension, subject);
    const double tolerance = 1e-9 * size;
    require(norm(com - origin_ - member.position * direction_) <= tolerance ||
                (member.mass == 0.0 && std::holds_alternative<Box>(shape.geometry)),
            "the centre of mass of " + subject + " is off the line");
    if (std::holds_alternative<Sphere>(shape.geometry))
        require(norm(cross(center - origin_, direction_)) <= tolerance,
                "the sphere of " + subject + " is off the line");
    const double offset = dot(center - com, direction_);
    member.low = size - offset;
    member.high = size + offset;
    return member;
}

bool LineCollisions::nextImpact(const Phase& phase, double& time, std::size_t& left, bool& clash) const {
    time = 1e300;
    clash = false;
    for (std::size_t k = 0; k + 1 < phase.members.size(); ++k) {
        const Member &a = phase.members[k], &b = phase.members[k + 1];
        const double closing = a.velocity - b.velocity;
        if (!(closing > 0.0)) continue;
        const double gap = std::max(0.0, b.position - b.low - a.position - a.high);
        const double t = phase.start + gap / closing;
        const bool same = std::abs(t - time) <= 1e-12 * t;
        if (same && k == left + 1) clash = true;
        if (t < time && !same) {
            time = t;
            left = k;
            clash = false;
        }
    }
    return time < 1e300;
}

void LineCollisions::run(double end) {
    for (;;) {
        const Phase& now = phases_.back();
        double time = 0.0;
        std::size_t left = 0;
        bool clash = false;
        if (!nextImpact(now, time, left, clash) || time > end) return;
        if (clash && time > scenario_.duration) {
            validUntil_ = time;
            return;
        }
        require(!clash, "two impacts on one body at the same instant: the outcome is not defined");
        if (impacts_.size() >= kMaxImpacts) {
            validUntil_ = now.start;  // impacts accumulate
            return;
        }
        Phase next{time, now.members};
        for (auto& member : next.members) member.position += (time - now.start) * member.velocity;
        Member &a = next.members[left], &b = next.members[left + 1];
        const double e = pairCoefficients(scenario_, a.highMaterial, b.lowMaterial).restitution;
        const double u = a.velocity - b.velocity;
        // Fixed bodies are infinitely heavy: fractions of the velocity change.
        const double shareA = a.mass == 0.0 ? 0.0 : (b.mass == 0.0 ? 1.0 : b.mass / (a.mass + b.mass));
        a.velocity -= (1.0 + e) * shareA * u;
        b.velocity += (1.0 + e) * (1.0 - shareA) * u;
        if (e == 0.0) b.velocity = a.velocity;
        impacts_.push_back({time, bodies_[left], bodies_[left + 1]});
        phases_.push_back(std::move(next));
    }
}

std::size_t LineCollisions::slot(int body) const {
    return std::find(bodies_.begin(), bodies_.end(), body) - bodies_.begin();
}

PartialState LineCollisions::exact(int index, double t) const {
    const Body& body = scenario_.bodies[index];
    const auto after = std::upper_bound(phases_.begin(), phases_.end(), t,
                                        [](double v, const Phase& p) { return v < p.start; });
    const Phase& phase = after == phases_.begin() ? phases_.front() : *(after - 1);
    const Member& m = phase.members.at(slot(index));
    const Vec3 com =
        origin_ + (m.position + (t - phase.start) * m.velocity) * direction_ + (0.5 * t * t) * gravity_;
    return stateOf(body, com, body.pose.orientation, m.velocity * direction_ + t * gravity_, {});
}

bool LineCollisions::isOver() const {
    const std::vector<Member>& last = phases_.back().members;
    double fastest = 0.0;
    for (const Member& m : phases_.front().members) fastest = std::max(fastest, std::abs(m.velocity));
    for (std::size_t k = 0; k + 1 < last.size(); ++k)
        if (last[k].velocity - last[k + 1].velocity > 1e-12 * fastest) return false;
    return validUntil_ > 1e299 && (impacts_.empty() || impacts_.back().time <= scenario_.duration);
}

double LineCollisions::velocityAfter(int body) const {
    return phases_.back().members.at(slot(body)).velocity;
}

double LineCollisions::velocityBefore(int body) const {
    return phases_.front().members.at(slot(body)).velocity;
}

double LineCollisions::energyLoss() const {
    double loss = 0.0;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const Member &a = phases_.front().members[k], &b = phases_.back().members[k];
        loss += 0.5 * a.mass * (a.velocity * a.velocity - b.velocity * b.velocity);
    }
    return loss;
}

}  // namespace rigor::validation
