// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A rod of 1 m that swings about pivots at ten distances h from its middle. DIR/output-data-2.csv: h and the
// period, each with its uncertainty (mean of 100 timed swings); DIR/output-data-1.csv: g from each.
//     T = 2 pi sqrt((l^2/12 + h^2)/(g h))
// The pivots are 0.5 cm uncertain, which is 4.7 % of the period at h = 5 cm and nothing at 29 cm: an engine
// is held to two standard uncertainties of period and place together. The authors drop h = 5 cm, whose period
// is 19 % longer than any rod's; here every engine has to disagree with it. Source: D. Angemi, F. Ingrassia,
// G. Di Silvestre, G. De Luca, lab1-dfa, experiment 4, 2022, CC-BY 4.0.
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/import/lab_catania.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kRodLength = 1.0;    // length of the rod [m]
constexpr double kHalfWidth = 0.01;   // half width of its picture [m]
constexpr double kRodMass = 1.0;      // [kg]; the period does not know it
constexpr double kRodCoverage = 2.0;  // standard uncertainties

struct Pivot {
    std::string name;
    double distance = 0.0, distanceUncertainty = 0.0;  ///< distance from the middle [m]
    double period = 0.0, periodUncertainty = 0.0;      ///< [s]
    bool dropped = false;                              ///< left out by the authors
};

/// Uncertainty of the period, including that of the pivot's place: dT/T = (2 h/(l^2/12 + h^2) - 1/h) dh/2.
double uncertaintyOf(const Pivot& p) {
    const double gyration = kRodLength * kRodLength / 12.0 + p.distance * p.distance;
    const double byPlace =
        0.5 * p.period * (2.0 * p.distance / gyration - 1.0 / p.distance) * p.distanceUncertainty;
    return std::hypot(p.periodUncertainty, byPlace);
}

std::vector<Pivot> readPivots(const fs::path& file) {
    const CsvTable table(
        file, {"configuration", "distance_CM", "uncertainty_distance", "time", "uncertainty_time"});
    std::vector<Pivot> pivots;
    for (std::size_t row = 0; row < table.size(); ++row) {
        Pivot p;
        p.name = table.text(row, "configuration");
        p.distance = lab::positive(table, row, "distance_CM");
        p.distanceUncertainty = lab::positive(table, row, "uncertainty_distance");
        p.period = lab::positive(table, row, "time");
        p.periodUncertainty = lab::positive(table, row, "uncertainty_time");
        p.dropped = p.name == "d1";
        if (!(p.distance < 0.5 * kRodLength))
            throw scenario::LoadError(
                {table.problem("import.value", table.line(row),
                               "distance_CM = " + table.text(row, "distance_CM"), "a pivot on the rod")});
        pivots.push_back(p);
    }
    return pivots;
}

/// A point mass swings faster. If it is ahead by more than a third of a swing, its place is ambiguous.
bool tellsPointMass(const Pivot& p) {
    constexpr double kPi = 3.14159265358979323846;
    return 2.0 * kPi * std::sqrt(p.distance / lab::kGravity) > 0.75 * p.period;
}

lab::Pendulum pendulumOf(const Pivot& p) {
    lab::Pendulum swing;
    swing.name = "compound_pendulum_" + p.name;
    swing.title = "A rod of 1 m swings about a pivot " + ordered_json(100.0 * p.distance).dump() +
                  " cm from its middle";
    swing.description = "A timed period of " + ordered_json(p.period).dump() +
                        " s, mean of 100, uncertainty " + ordered_json(p.periodUncertainty).dump() +
                        " s; the pivot's place is uncertain by " +
                        ordered_json(p.distanceUncertainty).dump() + " m." +
                        (p.dropped ? " The authors leave this one out." : "");
    swing.source = lab::sourceText("one period from the lowest place on, units unchanged");
    swing.mass = kRodMass;
    swing.distance = p.distance;
    swing.inertia = kRodMass * kRodLength * kRodLength / 12.0;
    swing.period = p.period;
    swing.shape = {{"box", {{"half_extents", {kHalfWidth, 0.5 * kRodLength}}}}};
    return swing;
}

}  // namespace

const std::vector<ImportChoice>& compoundPendulumChoices() {
    static const std::vector<ImportChoice> none;
    return none;
}

Imported importCompoundPendulum(const ImportRequest& request) {
    lab::requireWhole(request, "compound-pendulum");
    Imported imported;
    imported.title = "A rod that swings about ten pivots";
    ordered_json parts = ordered_json::array();
    for (const Pivot& pivot : readPivots(request.from / "output-data-2.csv")) {
        const lab::Pendulum swing = pendulumOf(pivot);
        const double bound = lab::lateness(swing, kRodCoverage * uncertaintyOf(pivot), 2.0 * kHalfWidth);
        imported.scenarios.push_back({swing.name, lab::swingText(swing), false});
        if (pivot.dropped) {
            parts.push_back(lab::part(
                pivot.name, swing.name + ".json",
                lab::findings("No rod has the period that the authors leave out", "at_least", bound)));
            continue;
        }
        parts.push_back(lab::part(pivot.name, swing.name + ".json",
                                  lab::findings("After the measured period the rod is at its lowest place "
                                                "again, within two uncertainties",
                                                "at_most", bound)));
        if (!tellsPointMass(pivot)) continue;
        ordered_json point =
            lab::part(pivot.name + "_point_mass", swing.name + ".json",
                      lab::findings("A point mass at this distance is not", "at_least", bound));
        point["set"] = {"bodies.pendulum.inertia=1e-6"};
        parts.push_back(point);
    }
    const ordered_json study = {{"rigor_study", 1},
                                {"name", "compound_pendulum"},
                                {"title", "Measured periods of a rod about ten pivots"},
                                {"description", "Published periods and pivots with their uncertainties."},
                                {"parts", parts}};
    imported.studies.push_back({"compound_pendulum", study.dump(1) + "\n"});
    imported.licence = lab::licenceOf(request.from);
    return imported;
}

}  // namespace rigor::validation
