// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/options.hpp"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

namespace rigor::models {

using nlohmann::json;

json toJson(const ReadOptions& o) {
    json assets = json::array();
    for (const auto& folder : o.assets) assets.push_back(folder.string());
    return {{"file", o.file.string()},
            {"name", o.name},
            {"without", o.without},
            {"assets", assets},
            {"licence", o.licence},
            {"duration", o.duration},
            {"dt", o.timeStep},
            {"friction", o.friction},
            {"density", o.density},
            {"scale", o.scale},
            {"keyframe", o.keyframe},
            {"fixed_base", o.fixedBase},
            {"self_collision", o.selfCollision},
            {"hull", o.hull},
            {"hull_corners", o.hullCorners},
            {"static", o.isStatic},
            {"has_floor", o.hasFloor},
            {"floor", o.floor}};
}

ReadOptions optionsFromJson(const json& j) {
    ReadOptions o;
    o.file = j.at("file").get<std::string>();
    o.name = j.at("name").get<std::string>();
    o.without = j.at("without").get<std::set<std::string>>();
    for (const auto& folder : j.at("assets")) o.assets.emplace_back(folder.get<std::string>());
    o.licence = j.at("licence").get<std::string>();
    o.duration = j.at("duration").get<double>();
    o.timeStep = j.at("dt").get<double>();
    o.friction = j.at("friction").get<double>();
    o.density = j.at("density").get<double>();
    o.scale = j.at("scale").get<double>();
    o.keyframe = j.at("keyframe").get<std::string>();
    o.fixedBase = j.at("fixed_base").get<bool>();
    o.selfCollision = j.at("self_collision").get<bool>();
    o.hull = j.at("hull").get<bool>();
    o.hullCorners = j.at("hull_corners").get<int>();
    o.isStatic = j.at("static").get<bool>();
    o.hasFloor = j.at("has_floor").get<bool>();
    o.floor = j.at("floor").get<double>();
    return o;
}

int runReader(int argc, char** argv, Answer (*read)(const ReadOptions&)) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s OPTIONS_JSON ANSWER_FILE; meant to be started by 'rigor import'\n",
                     argv[0]);
        return 2;
    }
    const ReadOptions options = optionsFromJson(json::parse(argv[1]));
    Answer answer;
    try {
        answer = read(options);
    } catch (const Refusal& refusal) {
        answer.report = Report(options.without);
        answer.report.refuse("file", refusal.place(), refusal.what());
    }
    std::ofstream out(argv[2], std::ios::binary);
    out << json{{"scenario", answer.scenario}, {"report", answer.report.json()}}.dump(
        -1, ' ', false, json::error_handler_t::replace);
    return out.flush() ? 0 : 3;
}

}  // namespace rigor::models
