// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/frame_lines.hpp"

#include <algorithm>
#include <cmath>

#include "cli/view/scene_lines.hpp"

namespace rigor::view {
namespace {

using scenario::Vec3;
using validation::Packet;

/// The arrays of one frame.
class FrameArrays {
  public:
    FrameArrays(const Packet& packet, int instance)
        : arrays_(packet.arrays), prefix_(std::to_string(instance) + "/") {}
    std::vector<double> numbers(const char* name) const { return arrays_.doubles(prefix_ + name); }
    std::vector<std::int32_t> indices(const char* name) const { return arrays_.integers(prefix_ + name); }
    std::vector<Vec3> vectors(const char* name) const {
        const std::vector<double> list = numbers(name);
        std::vector<Vec3> out;
        for (std::size_t i = 0; i + 2 < list.size(); i += 3)
            out.push_back({list[i], list[i + 1], list[i + 2]});
        return out;
    }

  private:
    const results::ArrayBundle& arrays_;
    std::string prefix_;
};

void readStates(const FrameArrays& frame, cli::Scene& scene) {
    const auto position = frame.vectors("position"), velocity = frame.vectors("velocity"),
               angular = frame.vectors("angular_velocity");
    const std::vector<double> turn = frame.numbers("orientation");
    scene.states.resize(position.size());
    for (std::size_t i = 0; i < position.size(); ++i)
        scene.states[i] = {position[i],
                           {turn[4 * i], turn[4 * i + 1], turn[4 * i + 2], turn[4 * i + 3]},
                           velocity[i],
                           angular[i]};
}

/// The contacts of the last step, at the places where their bodies have carried them.
void readContacts(const FrameArrays& frame, cli::Scene& scene) {
    const auto a = frame.indices("contacts/body_a"), b = frame.indices("contacts/body_b");
    const auto pointA = frame.vectors("contacts/carried_a"), pointB = frame.vectors("contacts/carried_b"),
               normal = frame.vectors("contacts/normal"),
               friction = frame.vectors("contacts/friction_impulse");
    const std::vector<double> impulse = frame.numbers("contacts/normal_impulse");
    for (std::size_t i = 0; i < a.size(); ++i) {
        adapter::ContactPoint c;
        c.bodyA = a[i];
        c.bodyB = b[i];
        c.pointA = pointA[i];
        c.pointB = pointB[i];
        c.normal = normal[i];
        c.hasImpulse = std::isfinite(impulse[i]);
        if (c.hasImpulse) {
            c.normalImpulse = impulse[i];
            c.frictionImpulse = friction[i];
        }
        scene.contacts.push_back(c);
    }
}

/// The contacts that the stages of the present step have made so far.
void readManifolds(const FrameArrays& frame, cli::Scene& scene) {
    const auto between = frame.indices("manifolds/between");
    const auto normal = frame.vectors("manifolds/normal"), pointA = frame.vectors("manifolds/point_a"),
               pointB = frame.vectors("manifolds/point_b");
    const std::vector<double> impulse = frame.numbers("manifolds/impulse");
    std::size_t point = 0;
    for (std::size_t m = 0; 5 * m < between.size(); ++m)
        for (int i = 0; i < between[5 * m + 4]; ++i, ++point) {
            adapter::ContactPoint c;
            c.bodyA = between[5 * m];
            c.bodyB = between[5 * m + 2];
            c.pointA = pointA[point];
            c.pointB = pointB[point];
            c.normal = normal[m];
            c.hasImpulse = true;
            c.normalImpulse = impulse[point];
            scene.contacts.push_back(c);
        }
}

void readStages(const FrameArrays& frame, cli::Scene& scene) {
    const auto of = frame.indices("boxes/of"), islands = frame.indices("islands");
    const auto corners = frame.vectors("boxes/sides");
    for (std::size_t i = 0; 2 * i < of.size(); ++i)
        scene.boxes.push_back({{of[2 * i], of[2 * i + 1]}, {corners[2 * i], corners[2 * i + 1]}});
    for (std::size_t at = 0; at < islands.size();) {
        const auto begin = islands.begin() + static_cast<std::ptrdiff_t>(at) + 1;
        scene.islands.emplace_back(begin, begin + islands[at]);
        at += 1 + static_cast<std::size_t>(islands[at]);
    }
}

cli::Scene sceneOf(const Packet& packet, const nlohmann::json& head, const scenario::Scenario& scenario) {
    const FrameArrays frame(packet, head.at("instance").get<int>());
    cli::Scene scene;
    scene.scenario = &scenario;
    scene.time = head.at("time").get<double>();
    readStates(frame, scene);
    const nlohmann::json& stage = head.at("stage");
    const bool staged = head.at("has_stages").get<bool>() && stage.at("done") != "";
    if (staged && stage.at("in_step").get<bool>())
        readManifolds(frame, scene);
    else
        readContacts(frame, scene);
    if (staged) readStages(frame, scene);
    scene.jointHolds.assign(scenario.joints.size(), true);
    for (const nlohmann::json& broken : head.at("broken_joints"))
        scene.jointHolds[broken.get<std::size_t>()] = false;
    return scene;
}

/// Lines and points as arrays; z is 0 in 2D.
template <class S>
class LineArrays final : public engine::LineSink<S> {
  public:
    using Vec = typename S::Vec;
    void line(const Vec& from, const Vec& to, engine::DebugKind kind, engine::BodyId body) override {
        if (!from.allFinite() || !to.allFinite()) return;
        add(ends_, from);
        add(ends_, to);
        name(lineNames_, kind, body);
    }
    void point(const Vec& at, engine::DebugKind kind, engine::BodyId body) override {
        if (!at.allFinite()) return;
        add(points_, at);
        name(pointNames_, kind, body);
    }
    void into(Packet& packet, const std::string& prefix) const {
        packet.arrays.add(prefix + "lines/ends", std::span(ends_));
        packet.arrays.add(prefix + "lines/names", std::span(lineNames_));
        packet.arrays.add(prefix + "points/at", std::span(points_));
        packet.arrays.add(prefix + "points/names", std::span(pointNames_));
    }

  private:
    static void add(std::vector<double>& to, const Vec& v) {
        for (int i = 0; i < 3; ++i) to.push_back(i < S::dim ? v[i] : 0.0);
    }
    static void name(std::vector<std::int32_t>& to, engine::DebugKind kind, engine::BodyId body) {
        to.push_back(static_cast<std::int32_t>(kind));
        to.push_back(static_cast<std::int32_t>(body.index) - 1);
    }
    std::vector<double> ends_, points_;
    std::vector<std::int32_t> lineNames_, pointNames_;
};

template <class S>
void addLinesOf(Packet& packet, const std::string& prefix, const cli::Scene& scene,
                const std::set<engine::DebugKind>& kinds) {
    engine::DebugOptions<S> options = cli::optionsFor<S>(kinds);
    options.normalLength = options.impulseScale = options.velocityScale = 1.0;
    LineArrays<S> lines;
    cli::drawScene<S>(scene, options, lines);
    lines.into(packet, prefix);
}

}  // namespace

void addLines(Packet& packet, const nlohmann::json& head, const scenario::Scenario& scenario,
              const std::set<engine::DebugKind>& kinds) {
    const cli::Scene scene = sceneOf(packet, head, scenario);
    const std::string prefix = std::to_string(head.at("instance").get<int>()) + "/";
    if (scenario.dimension == 2)
        addLinesOf<engine::Space2d>(packet, prefix, scene, kinds);
    else
        addLinesOf<engine::Space3d>(packet, prefix, scene, kinds);
}

nlohmann::json lineKinds() {
    nlohmann::json names = nlohmann::json::array();
    for (int i = 0; i < engine::kDebugKinds; ++i)
        names.push_back(engine::debugKindName(static_cast<engine::DebugKind>(i)));
    return names;
}

}  // namespace rigor::view
