// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A cart that rolls down one slope twice: with its two heavy discs at rest, and with them turning on the
// axles of its small wheels. DIR/experimental-data-1.csv: the times of 20 pairs of runs (t1 at rest, t2
// turning [s]); DIR/experimental-data-2.csv: masses and diameters.
//
// Rolling without slipping, the small wheels of radius r light, the discs of mass M together and radius R:
//     a_rest = g sin(slope),   a_turning = g sin(slope) m / (m + M R^2 / (2 r^2)),
// so the ratio of the times is that of the square roots and knows neither slope nor way. Both are not
// recorded: the way is taken as 1 m and the slope such that the cart at rest needs the mean time t1; what is
// scored is where the other cart is at the mean time t2.
// Source: D. Angemi, F. Ingrassia, G. Di Silvestre, G. De Luca, lab1-dfa, Physics Laboratory 1, University of
// Catania, CC-BY 4.0.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenarios/loader/loader.hpp"
#include "validation/import/csv.hpp"
#include "validation/import/dataset.hpp"
#include "validation/import/importer.hpp"
#include "validation/import/lab_catania.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using nlohmann::ordered_json;

constexpr double kCartGravity = 9.81;  // [m/s^2]; only its product with the slope's sine matters
constexpr double kWay = 1.0;           // [m]
// steps of a run: the first-order error of a time step is 5e-4 of the way
constexpr double kCartSteps = 2000;
constexpr double kRollingFriction = 0.5;  // enough to roll: a tenth would do
constexpr double kFrameHalfLength = 0.15, kFrameHalfHeight = 0.05,
                 kAxle = 0.1;  // dimensions in the picture of the frame [m]

struct Cart {
    double frame = 0.0, discs = 0.0;               ///< masses [kg]; the two discs together
    double wheelRadius = 0.0, discRadius = 0.0;    ///< [m]
    double mass() const { return frame + discs; }  ///< [kg]
};

struct CartTimes {
    double atRest = 0.0, turning = 0.0;  ///< means [s]
    double standardError = 0.0;          ///< standard error of the mean ratio turning/at rest
};

double valueOf(const CsvTable& table, const std::string& description) {
    for (std::size_t row = 0; row < table.size(); ++row)
        if (table.text(row, "description") == description) return table.number(row, "value");
    throw LoadError(
        {table.problem("import.value", 0, "no line '" + description + "'", "one of each quantity")});
}

Cart readCart(const fs::path& file) {
    const CsvTable table(file, {"description", "value"});
    Cart cart;
    cart.frame = valueOf(table, "Massa carrello (privo di ruote grandi)");
    cart.discs = valueOf(table, "Massa ruota grande 1 (dx)") + valueOf(table, "Massa ruota grande 2 (sx)");
    cart.wheelRadius = 0.5 * valueOf(table, "Diametro ruote piccole");
    cart.discRadius = 0.5 * valueOf(table, "Diametro ruote grandi");
    if (!(cart.frame > 0.0 && cart.discs > 0.0 && cart.wheelRadius > 0.0 && cart.discRadius > 0.0))
        throw LoadError({table.problem("import.value", 0, "a mass or diameter of 0 or less", "above 0")});
    return cart;
}

CartTimes readCartTimes(const fs::path& file) {
    const CsvTable table(file, {"t1", "t2"});
    const auto count = static_cast<double>(table.size());
    CartTimes times;
    double ratio = 0.0, squares = 0.0;
    for (std::size_t row = 0; row < table.size(); ++row) {
        const double t1 = table.number(row, "t1"), t2 = table.number(row, "t2");
        if (!(t1 > 0.0 && t2 > t1))
            throw LoadError(
                {table.problem("import.time", table.line(row),
                               "t1 = " + table.text(row, "t1") + ", t2 = " + table.text(row, "t2"),
                               "0 < t1 < t2: with turning discs the cart is slower")});
        times.atRest += t1 / count;
        times.turning += t2 / count;
        ratio += t2 / t1 / count;
        squares += t2 / t1 * (t2 / t1) / count;
    }
    if (table.size() < 2) throw LoadError({table.problem("import.short", 0, "one pair", "at least two")});
    times.standardError = std::sqrt(std::max(0.0, squares - ratio * ratio) / (count - 1.0));
    return times;
}

/// The slope is the x axis; gravity is tilted instead.
std::string scenarioOf(const Cart& cart, const CartTimes& times, bool turning) {
    const double pull = 2.0 * kWay / (times.atRest * times.atRest);  // g sin(slope)
    const double duration = turning ? times.turning : times.atRest;
    const double height = cart.wheelRadius + kFrameHalfHeight;
    ordered_json bodies = {
        {{"name", "slope"}, {"type", "static"}, {"shapes", {{{"half_plane", {{"normal", {0, 1}}}}}}}},
        {{"name", "frame"},
         {"mass", cart.frame},
         {"position", {0, height}},
         {"shapes", {{{"box", {{"half_extents", {kFrameHalfLength, kFrameHalfHeight}}}}}}}}};
    ordered_json joints = ordered_json::array();
    for (const auto& [name, x] : {std::pair{"rear", -kAxle}, std::pair{"front", kAxle}}) {
        // Each axle has one disc; what turns is the disc, what touches the slope is the small wheel.
        bodies.push_back({{"name", name},
                          {"mass", 0.5 * cart.discs},
                          {"inertia", 0.25 * cart.discs * cart.discRadius * cart.discRadius},
                          {"position", {x, cart.wheelRadius}},
                          {"material", "wheel"},
                          {"shapes", {{{"circle", {{"radius", cart.wheelRadius}}}}}}});
        joints.push_back({{"name", std::string(name) + "_axle"},
                          {"type", "hinge"},
                          {"a", "frame"},
                          {"b", name},
                          {"anchor", {x, cart.wheelRadius}}});
    }
    for (auto& body : bodies)
        if (!body.contains("material")) body["material"] = "wood";
    return scenarioText(
        {{"rigor", 1},
         {"name", turning ? "cart_discs_turning" : "cart_discs_at_rest"},
         {"title", turning ? "A cart rolls down a slope and turns two heavy discs"
                           : "A cart rolls down a slope, its heavy discs at rest"},
         {"description",
          "Mean of 20 timed runs of a real cart. The way is taken as 1 m and the slope such that the cart "
          "with "
          "discs at rest needs its measured time; the ratio of the two times depends on neither. Discs at "
          "rest "
          "are wheels without friction: the small wheels themselves weigh next to nothing."},
         {"source", lab::sourceText("means taken, units unchanged")},
         {"isolates", {"rolling", "joints"}},
         {"tags", {"measured"}},
         {"dimension", 2},
         {"gravity", {pull, -std::sqrt(kCartGravity * kCartGravity - pull * pull)}},
         {"duration", duration},
         {"dt", {duration / kCartSteps}},
         {"materials", {{"wood", ordered_json::object()}, {"wheel", ordered_json::object()}}},
         {"pairs",
          {{{"a", "wheel"},
            {"b", "wood"},
            {"friction", turning ? kRollingFriction : 0.0},
            {"restitution", 0}}}},
         {"bodies", bodies},
         {"joints", joints},
         {"observe", {"frame"}},
         {"reference",
          {{"measured_motion",
            {{"body", "frame"}, {"times", {0.0, duration}}, {"positions", {0.0, height, kWay, height}}}}}},
         {"metrics", {"measured_position_final"}}});
}

/// The metric is in widths of the frame, its height.
ordered_json studyOf(const CartTimes& times) {
    const double width = 2.0 * kFrameHalfHeight, ratio = times.turning / times.atRest;
    const double allowed = kWay * 2.0 * 2.0 * times.standardError / ratio / width;
    const ordered_json within = lab::findings(
        "At the measured time the cart is at the photocell, within two standard errors of the measured ratio",
        "at_most", allowed);
    const ordered_json without =
        lab::findings("Discs that do not turn would be half a metre too far", "at_least", 0.5 / width);
    ordered_json still = lab::part("discs_without_inertia", "cart_discs_turning.json", without);
    still["set"] = {"pairs.0.friction=0"};
    return {{"rigor_study", 1},
            {"name", "rolling_cart"},
            {"title", "A cart with turning discs needs 1.31 times as long"},
            {"description", "Measured ratio of the times " + ordered_json(ratio).dump() +
                                ", standard error " + ordered_json(times.standardError).dump() + "."},
            {"parts",
             {lab::part("discs_at_rest", "cart_discs_at_rest.json", within),
              lab::part("discs_turning", "cart_discs_turning.json", within), still}}};
}

}  // namespace

const std::vector<ImportChoice>& rollingCartChoices() {
    static const std::vector<ImportChoice> none;
    return none;
}

Imported importRollingCart(const ImportRequest& request) {
    lab::requireWhole(request, "rolling-cart");
    const Cart cart = readCart(request.from / "experimental-data-2.csv");
    const CartTimes times = readCartTimes(request.from / "experimental-data-1.csv");
    Imported imported;
    imported.title = "A timed cart with turning discs";
    imported.scenarios.push_back({"cart_discs_at_rest", scenarioOf(cart, times, false), false});
    imported.scenarios.push_back({"cart_discs_turning", scenarioOf(cart, times, true), false});
    imported.studies.push_back({"rolling_cart", studyOf(times).dump(1) + "\n"});
    imported.licence = lab::licenceOf(request.from);
    return imported;
}

}  // namespace rigor::validation
