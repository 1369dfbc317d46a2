// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/import/lab_catania.hpp"

#include <cmath>
#include <stdexcept>

#include "validation/import/dataset.hpp"

namespace rigor::validation::lab {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {
constexpr double kPi = 3.14159265358979323846;
constexpr double kAmplitude =
    5.0 * kPi / 180.0;           // [rad]; the compound pendulum's report says below 7 degrees
constexpr double kSteps = 2000;  // steps of a period
}  // namespace

std::string sourceText(const std::string& changed) {
    return "D. Angemi, F. Ingrassia, G. Di Silvestre, G. De Luca, lab1-dfa, University of Catania, CC-BY 4.0 "
           "(https://creativecommons.org/licenses/by/4.0/); " +
           changed;
}

ordered_json engines() {
    return {results::kInHouseEngine, "bullet:preset=matched", "ode:preset=matched", "box2d:preset=matched"};
}

ordered_json findings(const std::string& statement, const char* bound, double value) {
    ordered_json all = ordered_json::array();
    for (const auto& engine : engines())
        all.push_back({{"statement", statement},
                       {"source", "Angemi and others, lab1-dfa, University of Catania"},
                       {"variant", engine},
                       {"metric", "measured_position_final"},
                       {bound, value}});
    return all;
}

ordered_json part(const std::string& name, const std::string& scenarioFile, const ordered_json& findings) {
    return {{"name", name},
            {"scenarios", {scenarioFile}},
            {"variants", engines()},
            {"metrics", {"measured_position_final"}},
            {"findings", findings}};
}

void requireWhole(const ImportRequest& request, const std::string& dataSet) {
    if (request.select != "all" || !request.train.empty())
        throw std::invalid_argument(dataSet +
                                    ": the runs are taken as a mean; nothing to select or to fit on");
}

fs::path licenceOf(const fs::path& from) {
    for (const fs::path& file : {from / "LICENSE", fs::absolute(from / "..").lexically_normal() / "LICENSE"})
        if (fs::exists(file)) return file;
    return {};
}

double positive(const CsvTable& table, std::size_t row, const std::string& column) {
    const double value = table.number(row, column);
    if (!(value > 0.0))
        throw scenario::LoadError({table.problem("import.value", table.line(row),
                                                 column + " = " + table.text(row, column), "above 0")});
    return value;
}

std::string swingText(const Pendulum& p) {
    const double rate = kAmplitude * 2.0 * kPi / p.period;
    const ordered_json lowest = {0, -p.distance};
    return scenarioText(
        {{"rigor", 1},
         {"name", p.name},
         {"title", p.title},
         {"description", p.description},
         {"source", p.source},
         {"isolates", {"joints"}},
         {"tags", {"measured"}},
         {"dimension", 2},
         {"gravity", {0, -kGravity}},
         {"duration", p.period},
         {"dt", {p.period / kSteps}},
         {"materials", {{"metal", ordered_json::object()}}},
         {"bodies",
          {{{"name", "pendulum"},
            {"mass", p.mass},
            {"inertia", p.inertia},
            {"position", lowest},
            {"velocity", {rate * p.distance, 0}},
            {"angular_velocity", rate},
            {"collides", false},
            {"shapes", {p.shape}}}}},
         {"joints",
          {{{"name", "axis"}, {"type", "hinge"}, {"a", "world"}, {"b", "pendulum"}, {"anchor", {0, 0}}}}},
         {"observe", {"pendulum"}},
         {"reference",
          {{"measured_motion",
            {{"body", "pendulum"},
             {"times", {0.0, p.period}},
             {"positions", {0.0, -p.distance, 0.0, -p.distance}}}}}},
         {"metrics", {"measured_position_final"}}});
}

double lateness(const Pendulum& p, double late, double width) {
    const double angle = kAmplitude * std::sin(2.0 * kPi * late / p.period);
    return 2.0 * p.distance * std::sin(0.5 * angle) / width;
}

}  // namespace rigor::validation::lab
