// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A bob on a thread of six lengths. DIR/output-data-1.csv: length, the time of ten periods (a column named
// period_s), and g from the two with its uncertainty.
//     T = 2 pi sqrt(l/g), so dT/T = dg/(2 g)
// The periods are 0.5 to 1.3 % longer than those of small swings at 9.80 m/s^2; how wide the real ones were
// is not recorded (20 degrees would make 0.8 %). An engine is held to two of the published uncertainties.
// Source: D. Angemi, F. Ingrassia, G. Di Silvestre, G. De Luca, lab1-dfa, 2022, CC-BY 4.0.
#include <nlohmann/json.hpp>

#include "validation/import/lab_catania.hpp"

namespace rigor::validation {
namespace {

using nlohmann::ordered_json;

constexpr double kPeriods = 10;        // periods in the recorded time
constexpr double kRadius = 0.005;      // radius of the bob [m]; its rotation adds 0.01 % to the period
constexpr double kBobMass = 0.1;       // [kg]; the period does not know it
constexpr double kBobCoverage = 2.0;   // published uncertainties
constexpr double kOtherGravity = 8.8;  // [m/s^2], a tenth less

lab::Pendulum pendulumOf(const CsvTable& table, std::size_t row) {
    lab::Pendulum swing;
    swing.name = "simple_pendulum_" + table.text(row, "l");
    swing.distance = lab::positive(table, row, "length");
    swing.period = lab::positive(table, row, "period_s") / kPeriods;
    swing.title = "A bob on a thread of " + table.text(row, "length") + " m";
    swing.description = "Ten periods took " + table.text(row, "period_s") +
                        " s; published: g = " + table.text(row, "g") + " +- " +
                        table.text(row, "uncertainty_g") + " m/s^2.";
    swing.source = lab::sourceText("one of ten periods from the lowest place on, units unchanged");
    swing.mass = kBobMass;
    swing.inertia = 0.4 * kBobMass * kRadius * kRadius;
    swing.shape = {{"circle", {{"radius", kRadius}}}};
    return swing;
}

}  // namespace

const std::vector<ImportChoice>& simplePendulumChoices() {
    static const std::vector<ImportChoice> none;
    return none;
}

Imported importSimplePendulum(const ImportRequest& request) {
    lab::requireWhole(request, "simple-pendulum");
    const CsvTable table(request.from / "output-data-1.csv",
                         {"l", "length", "period_s", "g", "uncertainty_g"});
    Imported imported;
    imported.title = "A bob on threads of six lengths";
    ordered_json parts = ordered_json::array();
    for (std::size_t row = 0; row < table.size(); ++row) {
        const lab::Pendulum swing = pendulumOf(table, row);
        const double share =
            0.5 * lab::positive(table, row, "uncertainty_g") / lab::positive(table, row, "g");
        const double bound = lab::lateness(swing, kBobCoverage * share * swing.period, 2.0 * kRadius);
        const std::string name = table.text(row, "l"), file = swing.name + ".json";
        imported.scenarios.push_back({swing.name, lab::swingText(swing), false});
        parts.push_back(lab::part(name, file,
                                  lab::findings("After the measured period the bob is at its lowest place "
                                                "again, within two published uncertainties",
                                                "at_most", bound)));
        ordered_json other =
            lab::part(name + "_less_gravity", file,
                      lab::findings("With a tenth less gravity it is not", "at_least", bound));
        other["set"] = {"gravity=[0," + ordered_json(-kOtherGravity).dump() + "]"};
        parts.push_back(other);
    }
    const ordered_json study = {{"rigor_study", 1},
                                {"name", "simple_pendulum"},
                                {"title", "Measured periods of a bob on six threads"},
                                {"description", "Published lengths, times and uncertainties of g."},
                                {"parts", parts}};
    imported.studies.push_back({"simple_pendulum", study.dump(1) + "\n"});
    imported.licence = lab::licenceOf(request.from);
    return imported;
}

}  // namespace rigor::validation
