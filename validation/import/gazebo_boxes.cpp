// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A free box of 0.1 x 0.4 x 0.9 m and 10 kg in Gazebo classic, for 10 s: DIR/BENCHMARK_boxes_dt.csv, the
// errors that its engines were published with at ten time steps. Two motions: `simple`, without gravity,
// turning about its longest principal moment; `complex`, under gravity, tumbling about the middle one. The
// scenarios are the same boxes with an exact solution; the study tests whether today's engines reproduce the
// published errors.
//
// Published, each the largest in 10 s: linPositionErr [m] and angPositionErr [rad] are position_max and
// orientation_max; angMomentumErr = |H - H0|/|H0| is angular_momentum_drift; energyError = |E - E0|/E0 is
// over the energy at the start, energy_drift over the largest kinetic energy of the exact motion, so it is
// multiplied by E0/T(10 s).
// Source: S. Peters, J. Hsu, Comparison of rigid body dynamic simulators for robotic simulation in Gazebo,
// 2014; github.com/scpeters/benchmark, Apache-2.0.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "scenarios/loader/loader.hpp"
#include "validation/import/csv.hpp"
#include "validation/import/dataset.hpp"
#include "validation/import/importer.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using nlohmann::ordered_json;

constexpr double kBoxMass = 10.0, kDuration = 10.0;           // [kg], [s]
constexpr Vec3 kInertia{0.80833333, 0.68333333, 0.14166667};  // [kg m^2], as in the benchmark's world
// The published errors have six digits, and are of first or second order in the time step: other roundings of
// dt and of the inertia change them by far less than this.
constexpr double kSame = 0.02;
// Error below which it is the round-off of ten thousand steps and no constant of a scheme [m, rad, 1].
constexpr double kRoundOff = 1e-8;

struct Motion {
    const char* name;
    bool isComplex;
    Vec3 gravity, velocity, spin;
};
const Motion kMotions[] = {{"simple", false, {}, {-0.9, 0.4, 0.1}, {0.5, 0, 0}},
                           {"complex", true, {0, 0, -9.8}, {-2, 2, 8}, {0.1, 5, 0.1}}};

double kineticAt(const Motion& m, double t) {
    const Vec3 v = m.velocity + t * m.gravity;
    return 0.5 * (kBoxMass * dot(v, v) + kInertia.x * m.spin.x * m.spin.x + kInertia.y * m.spin.y * m.spin.y +
                  kInertia.z * m.spin.z * m.spin.z);
}

std::string scenarioName(const Motion& motion) {
    return std::string("gazebo_box_") + motion.name;
}

std::string scenarioOf(const Motion& motion, const std::vector<double>& steps) {
    return ordered_json(
               {{"rigor", 1},
                {"name", scenarioName(motion)},
                {"title", motion.isComplex ? "A box thrown and tumbling about its middle axis"
                                           : "A box that drifts and turns about a principal axis"},
                {"description", "The free box of Gazebo's benchmark of its physics engines."},
                {"source", "Peters, Hsu, 2014; github.com/scpeters/benchmark, Apache-2.0"},
                {"isolates", {"integration", "rotation"}},
                {"tags", {"published"}},
                {"dimension", 3},
                {"gravity", toJson(motion.gravity)},
                {"duration", kDuration},
                {"dt", steps},
                {"materials", {{"box", ordered_json::object()}}},
                {"bodies",
                 {{{"name", "box"},
                   {"mass", kBoxMass},
                   {"inertia", toJson(kInertia)},
                   {"velocity", toJson(motion.velocity)},
                   {"angular_velocity", toJson(motion.spin)},
                   {"shapes", {{{"box", {{"half_extents", {0.05, 0.2, 0.45}}}}}}}}}},
                {"reference", {{"free_flight", {{"body", "box"}}}}},
                {"metrics", {"position_max", "orientation_max", "angular_momentum_drift", "energy_drift"}}})
               .dump(1) +
           "\n";
}

/// A column of the published table beside the metric that it is.
struct Column {
    const char *published, *metric;
    double factor;  ///< factor from the published number to the metric
};

std::vector<Column> columnsOf(const Motion& motion) {
    if (!motion.isComplex) return {{"angPositionErr_mag_maxAbs", "orientation_max", 1.0}};
    const double largest = std::max(kineticAt(motion, 0.0), kineticAt(motion, kDuration));
    return {{"linPositionErr_maxAbs", "position_max", 1.0},
            {"angMomentumErr_maxAbs", "angular_momentum_drift", 1.0},
            {"energyError_maxAbs", "energy_drift", kineticAt(motion, 0.0) / largest}};
}

/// One line of the published table: an engine at a time step, one box with a collision shape.
struct Published {
    std::size_t row;
    double dt;
};

std::vector<Published> rowsOf(const CsvTable& table, const std::string& engine, const Motion& motion) {
    std::vector<Published> rows;
    for (std::size_t row = 0; row < table.size(); ++row)
        if (table.text(row, "engine") == engine && table.integer(row, "modelCount") == 1 &&
            table.integer(row, "collision") == 1 &&
            (table.integer(row, "isComplex") == 1) == motion.isComplex)
            rows.push_back({row, table.number(row, "dt")});
    if (rows.empty())
        throw LoadError({table.problem("import.engine", 0, "no line of " + engine, "at least one")});
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.dt > b.dt; });
    return rows;
}

/// Ratios of today's errors of an engine to the published ones.
struct Factors {
    double least, most;
};
constexpr Factors kAsPublished{1.0 - kSame, 1.0 + kSame};

/// An engine of the benchmark, and today's that is held to it. Gazebo brings its own branch of ODE: position
/// and orientation errors are those of its steps, but the torque-free tumbling of ODE 0.16.2 is less accurate
/// by a factor that hardly depends on the step, so both are of first order.
struct Variant {
    const char *engine, *spec;
    Factors momentum, energy;
};
const Variant kVariants[] = {{"ode", "ode:preset=default", {1.6, 2.0}, {1.1, 1.2}},
                             {"bullet", "bullet:preset=default", kAsPublished, kAsPublished}};

Factors timesOf(const Variant& variant, const std::string& metric) {
    if (metric == "angular_momentum_drift") return variant.momentum;
    return metric == "energy_drift" ? variant.energy : kAsPublished;
}

std::string statementOf(const Variant& variant, double dt, const std::string& metric, const Factors& times) {
    const bool same = times.least == kAsPublished.least;
    return std::string(variant.engine) + " at " + ordered_json(dt).dump() + " s: " + metric +
           (same ? " as published"
                 : " " + ordered_json(times.least).dump() + " to " + ordered_json(times.most).dump() +
                       " times the published");
}

ordered_json partOf(const CsvTable& table, const Variant& variant, const Motion& motion) {
    ordered_json steps = ordered_json::array(), findings = steps, metrics = steps;
    for (const Column& column : columnsOf(motion)) metrics.push_back(column.metric);
    for (const Published& one : rowsOf(table, variant.engine, motion)) {
        steps.push_back(one.dt);
        for (const Column& column : columnsOf(motion)) {
            const double value = column.factor * table.number(one.row, column.published);
            const Factors times = timesOf(variant, column.metric);
            findings.push_back({{"statement", statementOf(variant, one.dt, column.metric, times)},
                                {"source", "Peters, Hsu, 2014"},
                                {"variant", variant.spec},
                                {"metric", column.metric},
                                {"where", {{"dt", one.dt}}},
                                {"at_least", std::max(0.0, value * times.least - kRoundOff)},
                                {"at_most", value * times.most + kRoundOff}});
        }
    }
    return {{"name", std::string(motion.name) + "_" + variant.engine},
            {"scenarios", {scenarioName(motion) + ".json"}},
            {"dt", steps},
            {"variants", {variant.spec}},
            {"metrics", metrics},
            {"findings", findings}};
}

}  // namespace

const std::vector<ImportChoice>& gazeboBoxesChoices() {
    static const std::vector<ImportChoice> none;
    return none;
}

Imported importGazeboBoxes(const ImportRequest& request) {
    if (request.select != "all" || !request.train.empty())
        throw std::invalid_argument(
            "gazebo-boxes: these are published errors; nothing to select or to fit on");
    const CsvTable table(request.from / "BENCHMARK_boxes_dt.csv",
                         {"engine", "dt", "isComplex", "collision", "modelCount", "linPositionErr_maxAbs",
                          "angMomentumErr_maxAbs", "energyError_maxAbs", "angPositionErr_mag_maxAbs"});
    Imported imported;
    imported.title = "Gazebo's benchmark of a free box";
    ordered_json parts = ordered_json::array();
    for (const Motion& motion : kMotions) {
        std::vector<double> steps;
        for (const Published& one : rowsOf(table, kVariants[0].engine, motion)) steps.push_back(one.dt);
        imported.scenarios.push_back({scenarioName(motion), scenarioOf(motion, steps), false});
        for (const Variant& variant : kVariants) parts.push_back(partOf(table, variant, motion));
    }
    const ordered_json study = {{"rigor_study", 1},
                                {"name", "published_errors"},
                                {"title", "Gazebo's published errors of a free box come out again"},
                                {"description",
                                 "Errors of ODE and Bullet as published in 2014 and since, against the same "
                                 "engines as they are today."},
                                {"parts", parts}};
    imported.studies.push_back({"published_errors", study.dump(1) + "\n"});
    if (fs::exists(request.from / "LICENSE")) imported.licence = request.from / "LICENSE";
    return imported;
}

}  // namespace rigor::validation
