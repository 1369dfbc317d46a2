// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Five bodies that slide down a steel rail, timed between two photocells, 40 times each.
// DIR/experimental-data-1.csv: heights h1, h2 and places s1, s2 of the photocells; -2.csv: times;
// DIR/output-data-1.csv: accelerations, -2.csv: coefficients of friction, each with its uncertainty.
//     a = 2 (s1 - s2)/t^2,   mu = tan(slope) - a/(g cos(slope))
// as the report has it. The published coefficients are not these: the script that made them computes
// tan(slope) - (a/g) cos(slope), which gives all five as published (0.60, 0.39, 0.49, 0.26, 0.33) where the
// report's own formula gives 0.56, 0.27, 0.41, 0.08, 0.18. So an engine with the formula's coefficient has to
// be at the photocell at the measured time, and with the published one it must not. Two of the bodies are
// balls; they slide as well, since the formula's coefficients are below 2/7 tan(slope), the least with which
// a ball would roll. All are boxes here: a body that slides does not show its shape. Source: D. Angemi, F.
// Ingrassia, G. Di Silvestre, G. De Luca, lab1-dfa, experiment 2, 2022, CC-BY 4.0.
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/import/dataset.hpp"
#include "validation/import/lab_catania.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

// steps of a run: the first-order error is 5e-4 of the way
constexpr double kSlideSteps = 2000;
constexpr double kBoxHalfLength = 0.02, kBoxHalfHeight = 0.01;  // half extents of the box [m]
constexpr double kSliderMass = 0.1;                             // [kg]; the motion does not know it
constexpr double kSlideCoverage = 2.0;                          // published uncertainties

struct Slope {
    double way = 0.0, angle = 0.0;  ///< [m], [rad]
};

double valueOf(const CsvTable& table, const std::string& key, const std::string& name,
               const std::string& column) {
    for (std::size_t row = 0; row < table.size(); ++row)
        if (table.text(row, key) == name) return lab::positive(table, row, column);
    throw scenario::LoadError({table.problem("import.value", 0, "no line '" + name + "'", "one of each")});
}

Slope readSlope(const fs::path& file) {
    const CsvTable table(file, {"dimension", "value"});
    const auto value = [&](const char* name) { return valueOf(table, "dimension", name, "value"); };
    const double way = value("s1") - value("s2"), height = value("h1") - value("h2");
    if (!(height > 0.0 && way > height))
        throw scenario::LoadError(
            {table.problem("import.value", 0, "photocells that no slope joins", "0 < h1 - h2 < s1 - s2")});
    return {way, std::asin(height / way)};
}

/// Mean times of the bodies, in the order in which they first stand in the file.
std::vector<std::pair<std::string, double>> readSlideTimes(const fs::path& file) {
    const CsvTable table(file, {"mass", "t"});
    std::vector<std::pair<std::string, double>> sums;
    std::vector<double> counts;
    for (std::size_t row = 0; row < table.size(); ++row) {
        const std::string& body = table.text(row, "mass");
        std::size_t i = 0;
        while (i < sums.size() && sums[i].first != body) ++i;
        if (i == sums.size()) {
            sums.emplace_back(body, 0.0);
            counts.push_back(0.0);
        }
        sums[i].second += lab::positive(table, row, "t");
        counts[i] += 1.0;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i].second /= counts[i];
    return sums;
}

/// The slope is the x axis; gravity is tilted instead.
std::string scenarioOf(const std::string& name, const std::string& body, const Slope& slope, double time,
                       double friction) {
    return scenarioText(
        {{"rigor", 1},
         {"name", name},
         {"title", "Body " + body + " slides from one photocell to the next"},
         {"description", "From rest it needs " + ordered_json(time).dump() +
                             " s for the way, a mean of timed runs. Friction: the coefficient that the "
                             "report's formula gives "
                             "for this time."},
         {"source", lab::sourceText("means taken, units unchanged, coefficients computed anew")},
         {"isolates", {"friction"}},
         {"tags", {"measured"}},
         {"dimension", 2},
         {"gravity", {lab::kGravity * std::sin(slope.angle), -lab::kGravity * std::cos(slope.angle)}},
         {"duration", time},
         {"dt", {time / kSlideSteps}},
         {"materials", {{"body", ordered_json::object()}, {"rail", ordered_json::object()}}},
         {"pairs", {{{"a", "body"}, {"b", "rail"}, {"friction", friction}, {"restitution", 0}}}},
         {"bodies",
          {{{"name", "rail"},
            {"type", "static"},
            {"shapes", {{{"half_plane", {{"normal", {0, 1}}}}, {"material", "rail"}}}}},
           {{"name", "body"},
            {"mass", kSliderMass},
            {"position", {0, kBoxHalfHeight}},
            {"shapes",
             {{{"box", {{"half_extents", {kBoxHalfLength, kBoxHalfHeight}}}}, {"material", "body"}}}}}}},
         {"observe", {"body"}},
         {"reference",
          {{"measured_motion",
            {{"body", "body"},
             {"times", {0.0, time}},
             {"positions", {0.0, kBoxHalfHeight, slope.way, kBoxHalfHeight}}}}}},
         {"metrics", {"measured_position_final"}}});
}

}  // namespace

const std::vector<ImportChoice>& inclineSlidingChoices() {
    static const std::vector<ImportChoice> none;
    return none;
}

Imported importInclineSliding(const ImportRequest& request) {
    lab::requireWhole(request, "incline-sliding");
    const Slope slope = readSlope(request.from / "experimental-data-1.csv");
    const CsvTable accelerations(request.from / "output-data-1.csv",
                                 {"configuration", "acceleration", "uncertainty"});
    const CsvTable coefficients(request.from / "output-data-2.csv",
                                {"configuration", "coefficient_friction", "uncertainty"});
    const double width = 2.0 * kBoxHalfHeight;
    Imported imported;
    imported.title = "Bodies that slide down a rail";
    ordered_json parts = ordered_json::array();
    for (const auto& [body, time] : readSlideTimes(request.from / "experimental-data-2.csv")) {
        const double acceleration = 2.0 * slope.way / (time * time);
        const double friction =
            std::tan(slope.angle) - acceleration / (lab::kGravity * std::cos(slope.angle));
        if (!(friction >= 0.0))
            throw scenario::LoadError({accelerations.problem(
                "import.value", 0, "a body " + body + " that is faster than without friction",
                "times above those of a smooth rail")});
        const std::string name = "incline_sliding_" + body, file = name + ".json";
        imported.scenarios.push_back({name, scenarioOf(name, body, slope, time, friction), false});
        const double perAcceleration = 0.5 * time * time / width;
        const double byAcceleration = valueOf(accelerations, "configuration", body, "uncertainty");
        parts.push_back(lab::part(
            body, file,
            lab::findings(
                "At the measured time the body is at the photocell, within two uncertainties of the "
                "published acceleration",
                "at_most", kSlideCoverage * byAcceleration * perAcceleration)));
        const double byFriction = valueOf(coefficients, "configuration", body, "uncertainty") *
                                  lab::kGravity * std::cos(slope.angle);
        ordered_json published =
            lab::part(body + "_published_coefficient", file,
                      lab::findings("With the published coefficient it is not, by more than two of its "
                                    "uncertainties: a cosine multiplies there that has to divide",
                                    "at_least", kSlideCoverage * byFriction * perAcceleration));
        published["set"] = {
            "pairs.0.friction=" +
            ordered_json(valueOf(coefficients, "configuration", body, "coefficient_friction")).dump()};
        parts.push_back(published);
    }
    const ordered_json study = {{"rigor_study", 1},
                                {"name", "incline_sliding"},
                                {"title", "Bodies on a rail: times agree, published coefficients do not"},
                                {"description", "Mean times, published accelerations and coefficients."},
                                {"parts", parts}};
    imported.studies.push_back({"incline_sliding", study.dump(1) + "\n"});
    imported.licence = lab::licenceOf(request.from);
    return imported;
}

}  // namespace rigor::validation
