// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// pile {name, bodies, count, seed, columns, origin, spacing, jitter, turn, vary}: `count` bodies, the
// templates in turn, layer upon layer on a grid of `columns` places, each moved by up to `jitter` [m] along
// every horizontal axis, with "turn" turned uniformly (3D: Shoemake, Graphics Gems III, 1992), and with
// "vary" of other extents: a ball's radius and each half extent of a box times a number from 1 - vary to 1 +
// vary. Names name_i. `origin` is the centre of the lowest layer.
#include <cmath>

#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;

Quat randomRotation(PortableRandom& random) {
    const double u = random.unit(), a = kTwoPi * random.unit(), b = kTwoPi * random.unit();
    const double s = std::sqrt(1.0 - u), t = std::sqrt(u);
    return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
}

/// Changes what is a number where extents stand; the rest is for the reader to refuse.
void varyExtents(Json& body, double vary, PortableRandom& random) {
    const auto change = [&](Json& value) {
        if (value.is_number()) value = value.get<double>() * random.between(1.0 - vary, 1.0 + vary);
    };
    if (!body.contains("shapes") || !body["shapes"].is_array()) return;
    for (Json& shape : body["shapes"]) {
        if (!shape.is_object()) continue;
        for (const char* kind : {"sphere", "circle"})
            if (shape.contains(kind) && shape[kind].is_object() && shape[kind].contains("radius"))
                change(shape[kind]["radius"]);
        if (shape.contains("box") && shape["box"].is_object() && shape["box"].contains("half_extents") &&
            shape["box"]["half_extents"].is_array())
            for (Json& extent : shape["box"]["half_extents"]) change(extent);
    }
}

}  // namespace

void turnAtRandom(Json& body, PortableRandom& random, int dimension) {
    if (dimension == 2) {
        body["angle"] = kTwoPi * random.unit();
        return;
    }
    const Quat q = randomRotation(random);
    body["orientation"] = {q.w, q.x, q.y, q.z};
}

Generated pileUp(const Node& node, const std::vector<Json>& templates, PortableRandom& random) {
    const auto name = node.require("name"), countNode = node.require("count"),
               columns = node.require("columns"), spacing = node.require("spacing");
    Generated made;
    if (!name || !countNode || !columns || !spacing) return made;
    const int count = countNode->scaledInteger(1, kMaxBodies);
    const int across = columns->scaledInteger(1, 1000), deep = node.dimension() == 3 ? across : 1;
    const Vec3 step = spacing->scaledVector(),
               origin = node.has("origin") ? node["origin"].scaledVector() : Vec3{};
    const double jitter = node.has("jitter") ? node["jitter"].number(0.0, 1e6) : 0.0,
                 vary = node.has("vary") ? node["vary"].number(0.0, 0.9) : 0.0;
    const bool turned = node.has("turn") && node["turn"].boolean();
    if (!node.context().problems.empty()) return made;
    const double half = 0.5 * (across - 1);
    for (int n = 0; n < count; ++n) {
        const int layer = n / (across * deep), place = n % (across * deep), i = place % across,
                  k = place / across;
        Vec3 p = origin + Vec3{(i - half) * step.x, layer * step.y, 0.0};
        p.x += random.between(-jitter, jitter);
        if (node.dimension() == 3) p.z += (k - half) * step.z + random.between(-jitter, jitter);
        Json body = placed(templates[static_cast<std::size_t>(n) % templates.size()],
                           name->name() + "_" + std::to_string(n), p, node.dimension());
        if (turned) turnAtRandom(body, random, node.dimension());
        if (vary > 0.0) varyExtents(body, vary, random);
        made.bodies.push_back(std::move(body));
    }
    return made;
}

Generated generatePile(const Node& node) {
    node.isObject(
        {"name", "bodies", "count", "seed", "columns", "origin", "spacing", "jitter", "turn", "vary"});
    const auto bodies = node.require("bodies"), seed = node.require("seed");
    if (!bodies || !seed) return {};
    std::vector<Json> templates;
    for (const Node& body : bodies->items()) templates.push_back(body.json());
    if (bodies->json().is_array() && templates.empty())
        bodies->problem("generator.empty", "at least one body");
    PortableRandom random(static_cast<std::uint64_t>(seed->integer(0, 2000000000)));
    if (!node.context().problems.empty()) return {};
    return pileUp(node, templates, random);
}

}  // namespace rigor::scenario
