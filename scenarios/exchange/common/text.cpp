// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/text.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

namespace rigor::models {
namespace {

using Json = nlohmann::ordered_json;

/// Removes a key whose value is the format's default.
void drop(Json& object, const char* key, const Json& usual) {
    if (object.contains(key) && object.at(key) == usual) object.erase(key);
}

void tidyPose(Json& object) {
    drop(object, "position", {0.0, 0.0, 0.0});
    drop(object, "orientation", {1.0, 0.0, 0.0, 0.0});
}

void tidyBody(Json& body) {
    tidyPose(body);
    drop(body, "type", "dynamic");
    drop(body, "velocity", {0.0, 0.0, 0.0});
    drop(body, "angular_velocity", {0.0, 0.0, 0.0});
    drop(body, "center_of_mass", {0.0, 0.0, 0.0});
    drop(body, "collides", true);
    drop(body, "gravity_scale", 1.0);
    drop(body, "damping", {{"linear_kept_per_second", 1.0}, {"angular_kept_per_second", 1.0}});
    for (Json& shape : body["shapes"]) tidyPose(shape);
}

bool isShort(const Json& value) {
    return std::none_of(value.begin(), value.end(), [](const Json& v) { return v.is_structured(); }) ||
           value.dump().size() < 100;
}

void print(std::string& out, const Json& value, int depth) {
    if (!value.is_structured() || value.empty() || (depth > 1 && isShort(value)) ||
        (value.is_array() && isShort(value))) {
        out += value.dump();
        return;
    }
    const std::string indent(static_cast<std::size_t>(2 * depth + 2), ' ');
    out += value.is_object() ? '{' : '[';
    bool isFirst = true;
    for (const auto& [key, inner] : value.items()) {
        out += (isFirst ? "\n" : ",\n") + indent;
        if (value.is_object()) out += Json(key).dump() + ": ";
        print(out, inner, depth + 1);
        isFirst = false;
    }
    out += "\n" + std::string(static_cast<std::size_t>(2 * depth), ' ');
    out += value.is_object() ? '}' : ']';
}

}  // namespace

std::string digits(std::initializer_list<double> values) {
    std::string out;
    char text[32];
    for (const double value : values) {
        const auto end = std::to_chars(text, text + sizeof text, value + 0.0).ptr;
        out += (out.empty() ? "" : " ") + std::string(text, end);
    }
    return out;
}

std::string tidied(const std::string& scenario) {
    Json root = Json::parse(scenario);
    for (const char* key : {"isolates", "pairs", "joints", "forces", "events"})
        drop(root, key, Json::array());
    drop(root, "time_limit", 60.0);
    drop(root, "materials", Json::object());
    Json moving = Json::array();
    for (Json& body : root["bodies"]) {
        tidyBody(body);
        if (!body.contains("type")) moving.push_back(body["name"]);
    }
    drop(root, "observe", moving);
    if (root.contains("joints"))
        for (Json& joint : root["joints"]) drop(joint, "collide_connected", false);
    std::string out;
    print(out, root, 0);
    return out + "\n";
}

}  // namespace rigor::models
