// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// rain {name, bodies, count, seed, columns, spacing, origin, interval, speed, turn}: `count` bodies, the
// templates in turn, that fall onto a grid of `columns` places (3D: squared) around `origin`, so many that
// one arrives at the height of `origin` every `interval` [s] if nothing is in its way: body n starts at the
// height v t + g t^2 / 2 above it, t = (n + 1) interval, with the velocity v = `speed` [m/s] downwards. The
// places take turns in an order that the seed decides, so that two bodies of one place are always a whole
// round apart. Gravity must point along -y. Names name_n.
#include <algorithm>
#include <numeric>

#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {
namespace {

/// 0 .. n-1 in an order of the seed's (Fisher and Yates).
std::vector<int> shuffled(int n, PortableRandom& random) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.unit() * static_cast<double>(i))]);
    return order;
}

}  // namespace

Generated generateRain(const Node& node) {
    node.isObject(
        {"name", "bodies", "count", "seed", "columns", "spacing", "origin", "interval", "speed", "turn"});
    const auto name = node.require("name"), bodies = node.require("bodies"),
               countNode = node.require("count"), seed = node.require("seed"),
               columns = node.require("columns"), spacing = node.require("spacing"),
               interval = node.require("interval"), speed = node.require("speed");
    Generated made;
    if (!name || !bodies || !countNode || !seed || !columns || !spacing || !interval || !speed) return made;
    const auto templates = bodies->items();
    if (bodies->json().is_array() && templates.empty())
        bodies->problem("generator.empty", "at least one body");
    const bool solid = node.dimension() == 3, turned = node.has("turn") && node["turn"].boolean();
    const int count = countNode->scaledInteger(1, kMaxBodies), across = columns->scaledInteger(1, 1000);
    const double pitch = spacing->positive(), pause = interval->scaled(1e-6, 1e3),
                 v = speed->number(0.0, 1e3);
    const Vec3 gravity = node.context().gravity,
               origin = node.has("origin") ? node["origin"].scaledVector() : Vec3{};
    if (gravity.x != 0.0 || gravity.z != 0.0 || gravity.y > 0.0)
        node.problem("generator.gravity", "gravity along another axis", "gravity along -y");
    PortableRandom random(static_cast<std::uint64_t>(seed->integer(0, 2000000000)));
    if (!node.context().problems.empty()) return made;
    const std::vector<int> order = shuffled(solid ? across * across : across, random);
    const double half = 0.5 * (across - 1);
    for (int n = 0; n < count; ++n) {
        const int place = order[static_cast<std::size_t>(n) % order.size()];
        const double t = (n + 1) * pause;
        const Vec3 p = origin + Vec3{(place % across - half) * pitch, v * t - 0.5 * gravity.y * t * t,
                                     solid ? (place / across - half) * pitch : 0.0};
        Json body = placed(templates[static_cast<std::size_t>(n) % templates.size()].json(),
                           name->name() + "_" + std::to_string(n), p, node.dimension());
        body["velocity"] = vectorJson({0.0, -v, 0.0}, node.dimension());
        if (turned) turnAtRandom(body, random, node.dimension());
        made.bodies.push_back(std::move(body));
    }
    return made;
}

}  // namespace rigor::scenario
