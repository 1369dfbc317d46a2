// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/generators/generator.hpp"

namespace rigor::scenario {

const std::vector<Generator>& generatorTable() {
    static const std::vector<Generator> table{
        {"grid", "copies of a body on a regular grid; counts [1, n, 1] is a stack", generateGrid},
        {"pyramid", "rows that shrink by one body (3D: square layers)", generatePyramid},
        {"pile", "bodies of several kinds above each other, jittered and turned from a seed", generatePile},
        {"chain", "links in a line, joined end to end and to the world", generateChain},
        {"container", "a floor and walls around it", generateContainer},
        {"group", "bodies and joints that are written out, as one thing to repeat", generateGroup},
        {"hull_pile", "a pile of convex hulls that are made from a seed", generateHullPile},
        {"net", "a rectangle of bodies, each joined to its neighbours", generateNet},
        {"rain", "bodies that arrive one after the other, evenly in time", generateRain},
        {"repeat", "what another generator makes, many times side by side", generateRepeat},
        {"tumbler", "a hollow box that turns about its middle at a fixed rate", generateTumbler}};
    return table;
}

Generated generate(const Node& entry) {
    std::string known;
    for (const Generator& generator : generatorTable()) {
        known += (known.empty() ? "" : ", ") + std::string(generator.name);
        if (entry.json().is_object() && entry.json().size() == 1 && entry.has(generator.name))
            return generator.make(entry[generator.name]);
    }
    entry.problem("generator.unknown", "an object with one key among " + known);
    return {};
}

Json vectorJson(const Vec3& v, int dimension) {
    return dimension == 2 ? Json{v.x, v.y} : Json{v.x, v.y, v.z};
}

Json boxShape(const Node& node, const Vec3& halfExtents, const Vec3& position) {
    Json shape{{"box", {{"half_extents", vectorJson(halfExtents, node.dimension())}}},
               {"position", vectorJson(position, node.dimension())}};
    if (node.has("material")) shape["material"] = node["material"].json();
    return shape;
}

Json placed(const Json& body, const std::string& name, const Vec3& position, int dimension) {
    Json copy = body;
    if (!copy.is_object()) copy = Json::object();
    copy["name"] = name;
    copy["position"] = vectorJson(position, dimension);
    return copy;
}

}  // namespace rigor::scenario
