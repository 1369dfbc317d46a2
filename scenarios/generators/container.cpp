// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// container {name, inside, thickness, material}: static boxes around a space of width, height (and depth)
// `inside` [m] that is open above, its floor's surface at height 0, centred on x = 0 (and z = 0). Walls and
// floor are `thickness` thick (default 0.5). Bodies name_floor, name_left, name_right, in 3D also name_back,
// name_front.
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

Generated generateContainer(const Node& node) {
    node.isObject({"name", "inside", "thickness", "material"});
    const auto name = node.require("name"), inside = node.require("inside");
    Generated made;
    if (!name || !inside) return made;
    const Vec3 space = inside->scaledVector();
    const double t = 0.5 * (node.has("thickness") ? node["thickness"].positive() : 0.5);
    const bool solid = node.dimension() == 3;
    if (space.x <= 0.0 || space.y <= 0.0 || (solid && space.z <= 0.0))
        inside->problem("value.range", "numbers > 0");
    if (!node.context().problems.empty()) return made;
    const auto add = [&](const char* part, const Vec3& halfExtents, const Vec3& position) {
        Json body = placed(Json::object(), name->name() + "_" + part, position, node.dimension());
        body["type"] = "static";
        body["shapes"] = Json::array({boxShape(node, halfExtents, {})});
        made.bodies.push_back(std::move(body));
    };
    // The floor and the walls on x are long enough to close the corners.
    const double x = 0.5 * space.x, y = 0.5 * space.y, z = 0.5 * space.z;
    add("floor", {x + 2.0 * t, t, z + 2.0 * t}, {0.0, -t, 0.0});
    add("left", {t, y, z + 2.0 * t}, {-x - t, y, 0.0});
    add("right", {t, y, z + 2.0 * t}, {x + t, y, 0.0});
    if (solid) {
        add("back", {x, y, t}, {0.0, y, -z - t});
        add("front", {x, y, t}, {0.0, y, z + t});
    }
    return made;
}

}  // namespace rigor::scenario
