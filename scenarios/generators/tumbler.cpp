// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// tumbler {name, inside, thickness, speed, origin, material}: one kinematic body, a closed hollow box of
// width, height (and depth) `inside` [m] with walls `thickness` thick (default 0.5) around `origin`, that
// turns about +z at `speed` [rad/s] whatever happens in it. A compound of 4 boxes, in 3D 6.
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

Generated generateTumbler(const Node& node) {
    node.isObject({"name", "inside", "thickness", "speed", "origin", "material"});
    const auto name = node.require("name"), inside = node.require("inside"), speed = node.require("speed");
    Generated made;
    if (!name || !inside || !speed) return made;
    const Vec3 space = inside->scaledVector(),
               origin = node.has("origin") ? node["origin"].scaledVector() : Vec3{};
    const double t = 0.5 * (node.has("thickness") ? node["thickness"].positive() : 0.5),
                 rate = speed->number(-1e3, 1e3);
    const bool solid = node.dimension() == 3;
    if (space.x <= 0.0 || space.y <= 0.0 || (solid && space.z <= 0.0))
        inside->problem("value.range", "numbers > 0");
    if (!node.context().problems.empty()) return made;
    const double x = 0.5 * space.x, y = 0.5 * space.y, z = 0.5 * space.z;
    Json shapes = Json::array();
    for (const double side : {-1.0, 1.0}) {
        shapes.push_back(boxShape(node, {x + 2.0 * t, t, z}, {0.0, side * (y + t), 0.0}));
        shapes.push_back(boxShape(node, {t, y, z}, {side * (x + t), 0.0, 0.0}));
        if (solid)
            shapes.push_back(boxShape(node, {x + 2.0 * t, y + 2.0 * t, t}, {0.0, 0.0, side * (z + t)}));
    }
    Json body = placed(Json::object(), name->name(), origin, node.dimension());
    body["type"] = "kinematic";
    body["shapes"] = std::move(shapes);
    body["angular_velocity"] = solid ? Json{0.0, 0.0, rate} : Json(rate);
    made.bodies.push_back(std::move(body));
    return made;
}

}  // namespace rigor::scenario
