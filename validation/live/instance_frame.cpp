// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_frame.hpp"

#include <cmath>
#include <limits>

namespace rigor::validation {
namespace {

using adapter::BodyState;
using adapter::ContactPoint;
using nlohmann::json;
using scenario::Vec3;

/// An array in the making.
class Numbers {
  public:
    Numbers& operator<<(const Vec3& v) {
        values_.insert(values_.end(), {v.x, v.y, v.z});
        return *this;
    }
    Numbers& operator<<(double v) {
        values_.push_back(v);
        return *this;
    }
    void into(Packet& packet, const char* name) const { packet.arrays.add(name, std::span(values_)); }

  private:
    std::vector<double> values_;
};
class Indices {
  public:
    Indices& operator<<(int v) {
        values_.push_back(v);
        return *this;
    }
    Indices& operator<<(std::size_t v) { return *this << static_cast<int>(v); }
    Indices& operator<<(const adapter::ShapeName& s) { return *this << s.body << s.shape; }
    void into(Packet& packet, const char* name) const { packet.arrays.add(name, std::span(values_)); }

  private:
    std::vector<std::int32_t> values_;
};

void addStates(Packet& packet, std::span<const BodyState> states) {
    Numbers position, orientation, velocity, angularVelocity;
    for (const BodyState& s : states) {
        position << s.position;
        orientation << s.orientation.w << s.orientation.x << s.orientation.y << s.orientation.z;
        velocity << s.velocity;
        angularVelocity << s.angularVelocity;
    }
    position.into(packet, "position");
    orientation.into(packet, "orientation");
    velocity.into(packet, "velocity");
    angularVelocity.into(packet, "angular_velocity");
}

/// A point of a body's surface, carried along from one state of the body to another.
Vec3 carried(const Vec3& point, const BodyState& from, const BodyState& to) {
    const scenario::Pose before{from.position, from.orientation};
    return scenario::Pose{to.position, to.orientation} * (inverse(before) * point);
}

/// Contacts with the points where they were found, at the states `found`, and where their bodies have carried those since.
void addContacts(Packet& packet, const std::vector<ContactPoint>& contacts, std::span<const BodyState> found,
                 std::span<const BodyState> now) {
    Indices bodyA, bodyB, shapeA, shapeB;
    Numbers pointA, pointB, normal, depth, normalImpulse, frictionImpulse, carriedA, carriedB;
    for (const ContactPoint& c : contacts) {
        const auto a = static_cast<std::size_t>(c.bodyA), b = static_cast<std::size_t>(c.bodyB);
        carriedA << carried(c.pointA, found[a], now[a]);
        carriedB << carried(c.pointB, found[b], now[b]);
        bodyA << c.bodyA;
        bodyB << c.bodyB;
        shapeA << c.shapeA;
        shapeB << c.shapeB;
        pointA << c.pointA;
        pointB << c.pointB;
        normal << c.normal;
        depth << c.depth;
        normalImpulse << (c.hasImpulse ? c.normalImpulse : std::numeric_limits<double>::quiet_NaN());
        frictionImpulse << c.frictionImpulse;
    }
    bodyA.into(packet, "contacts/body_a");
    bodyB.into(packet, "contacts/body_b");
    shapeA.into(packet, "contacts/shape_a");
    shapeB.into(packet, "contacts/shape_b");
    pointA.into(packet, "contacts/point_a");
    pointB.into(packet, "contacts/point_b");
    carriedA.into(packet, "contacts/carried_a");
    carriedB.into(packet, "contacts/carried_b");
    normal.into(packet, "contacts/normal");
    depth.into(packet, "contacts/depth");
    normalImpulse.into(packet, "contacts/normal_impulse");
    frictionImpulse.into(packet, "contacts/friction_impulse");
}

json counters(const adapter::StepCounters& c) {
    json out = json::object();
    const auto put = [&](const char* key, std::int64_t value) {
        if (value >= 0) out[key] = value;
    };
    put("pair_tests", c.pairTests);
    put("pairs", c.pairs);
    put("narrow_phase_queries", c.narrowPhaseQueries);
    put("contacts", c.contacts);
    put("islands", c.islands);
    put("iterations", c.solverIterations);
    if (c.residual >= 0.0 && std::isfinite(c.residual)) out["residual"] = c.residual;
    if (!c.phaseSeconds.empty()) out["phase_seconds"] = c.phaseSeconds;
    return out;
}

void addManifolds(Packet& packet, const std::vector<adapter::StagedManifold>& manifolds) {
    Indices between, features, rows;
    Numbers normals, pointA, pointB, depth, impulse;
    for (const auto& m : manifolds) {
        between << m.a << m.b << m.points.size();
        normals << m.normal;
        for (const auto& p : m.points) {
            features << static_cast<int>(p.feature);
            rows << p.row;
            pointA << p.pointA;
            pointB << p.pointB;
            depth << p.depth;
            impulse << p.normalImpulse;
        }
    }
    between.into(packet, "manifolds/between");
    normals.into(packet, "manifolds/normal");
    features.into(packet, "manifolds/feature");
    rows.into(packet, "manifolds/row");
    pointA.into(packet, "manifolds/point_a");
    pointB.into(packet, "manifolds/point_b");
    depth.into(packet, "manifolds/depth");
    impulse.into(packet, "manifolds/impulse");
}

void addRows(Packet& packet, const std::vector<adapter::StagedRow>& rows) {
    Indices names;
    Numbers impulse, bias, softness, error, effectiveMass;
    for (const auto& r : rows) {
        names << static_cast<int>(r.kind) << r.bodyA << r.bodyB << r.joint;
        impulse << r.impulse;
        bias << r.bias;
        softness << r.softness;
        error << r.error;
        effectiveMass << r.effectiveMass;
    }
    names.into(packet, "rows/names");
    impulse.into(packet, "rows/impulse");
    bias.into(packet, "rows/bias");
    softness.into(packet, "rows/softness");
    error.into(packet, "rows/error");
    effectiveMass.into(packet, "rows/effective_mass");
}

void addIterations(Packet& packet, const std::vector<adapter::StagedIteration>& iterations) {
    Indices sizes;
    Numbers residuals, impulses;
    for (const auto& i : iterations) {
        sizes << i.substep << i.impulses.size();
        residuals << i.residual;
        for (const double v : i.impulses) impulses << v;
    }
    sizes.into(packet, "iterations/sizes");
    residuals.into(packet, "iterations/residual");
    impulses.into(packet, "iterations/impulses");
}

void addStages(Packet& packet, const adapter::StagedWorld& staged) {
    Indices boxesOf, pairs, islands;
    Numbers boxes;
    for (const auto& box : staged.boxes()) {
        boxesOf << box.of;
        boxes << box.box.min << box.box.max;
    }
    for (const auto& pair : staged.pairs()) pairs << pair.a << pair.b;
    for (const auto& island : staged.islands()) {
        islands << island.size();
        for (const int body : island) islands << body;
    }
    boxesOf.into(packet, "boxes/of");
    boxes.into(packet, "boxes/sides");
    pairs.into(packet, "pairs");
    islands.into(packet, "islands");
    addManifolds(packet, staged.manifolds());
    addRows(packet, staged.rows());
    addIterations(packet, staged.iterations());
}

json vector(const Vec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

Packet instanceFrame(InstanceWorld& instance, bool stages) {
    Packet packet;
    json& header = packet.header;
    header["step"] = instance.steps();
    header["time"] = instance.steps() * instance.dt();
    header["state"] = instance.nonFinite().empty() ? "ready" : "non_finite";
    header["message"] = instance.nonFinite();
    addStates(packet, instance.states());
    std::vector<ContactPoint> contacts;
    const std::span<const BodyState> before = instance.statesBefore();
    if (!before.empty()) instance.world().readContacts(contacts);
    const bool atEnd = instance.world().contactInstant() == adapter::ContactInstant::StepEnd;
    header["contacts_at_step_end"] = atEnd;
    addContacts(packet, contacts, atEnd ? instance.states() : before, instance.states());
    header["counters"] = counters(instance.world().counters());
    if (const auto history = instance.history())
        header["history"] = {
            {"bytes", history->bytes}, {"most", InstanceWorld::kMostKeptBytes}, {"every", history->every}};
    if (const auto pull = instance.pull())
        header["drag"] = {{"body", instance.drag()->body},
                          {"point", vector(pull->point)},
                          {"target", vector(instance.drag()->target)},
                          {"force", vector(pull->force)}};
    json broken = json::array();
    for (std::size_t j = 0; j < instance.scenario().joints.size(); ++j)
        if (!instance.world().jointHolds(j)) broken.push_back(j);
    header["broken_joints"] = broken;
    const adapter::StagedWorld* staged = instance.world().staged();
    header["stage"] = {{"in_step", instance.inStep()},
                       {"done", instance.lastStage()},
                       {"next", staged != nullptr ? staged->nextStage() : ""},
                       {"substep", staged != nullptr ? staged->substep() : 0}};
    header["has_stages"] = stages && staged != nullptr;
    if (stages && staged != nullptr) {
        addStages(packet, *staged);
        packet.arrays.add("iterations/start", std::span(instance.startImpulses()));
    }
    return packet;
}

json instanceDescription(InstanceWorld& instance) {
    json ledger = json::array();
    for (const auto& e : instance.world().ledger())
        ledger.push_back({{"topic", e.topic},
                          {"requested", e.requested},
                          {"resolved", e.resolved},
                          {"realisation", adapter::realisationName(e.realisation)},
                          {"reason", e.reason}});
    return {{"settings", instance.settings()},
            {"ledger", std::move(ledger)},
            {"dt", instance.dt()},
            {"has_stages", instance.world().staged() != nullptr},
            {"has_snapshots", instance.world().snapshots() != nullptr}};
}

}  // namespace rigor::validation
