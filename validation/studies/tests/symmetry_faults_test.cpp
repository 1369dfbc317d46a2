// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engines of one broken symmetry each (runner/tests/doubles/asymmetric.cpp), run as a study: the column meant
// for it shows the fault, with those alone that cannot but show it too; the honest engine shows nothing.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "validation/studies/tests/run_study.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

/// Two balls that spin about no principal axis fly apart; symplectic Euler comes back g h T = 2/128 x 1/2 m
/// beside the start.
constexpr double kReturn = 2.0 / 128.0 * 0.5;
const char* const kScene = R"({"rigor": 1, "name": "apart", "title": "Two balls fly apart", "dimension": 3,
  "gravity": [0, -2, 0], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0, "restitution": 1}},
  "bodies": [
    {"name": "block", "type": "static", "position": [0, -50, 0], "shapes": [{"box": {"half_extents": [1, 1, 1]}}]},
    {"name": "left", "mass": 2, "inertia": [0.008, 0.01, 0.014], "position": [-1, 2, 3], "velocity": [-4.1, 5.3, 3.7],
     "angular_velocity": [1, -2, 3], "shapes": [{"sphere": {"radius": 0.1}}]},
    {"name": "right", "mass": 1, "inertia": [0.004, 0.006, 0.005], "position": [1, 2, 3], "velocity": [4.3, 2.1, -6.1],
     "angular_velocity": [2, 1, -1], "shapes": [{"sphere": {"radius": 0.2}}]}]})";

/// Deviations of the engine without a fault: rounding, except for its own order, which follows the pull on
/// the bodies.
const std::map<std::string, double> kKept{{"galilean", 1e-12},
                                          {"translation", 1e-11},
                                          {"rotation", 1e-12},
                                          {"rotation_90", 1e-12},
                                          {"rotation_vertical", 1e-12},
                                          {"mirror", 1e-14},
                                          {"permutation", 0.0},
                                          {"insertion_order", 0.0},
                                          {"froude", 1e-14},
                                          {"repeat", 0.0},
                                          {"threads", 0.0},
                                          {"time_reversal", kReturn * 1.15}};

struct Fault {
    const char* name;
    Names broken;  ///< the first meant for it, others cannot but show it
};
const Fault kFaults[] = {
    {"none", {}},
    // A drag against the air at rest; it removes energy at a rate per second of its own.
    {"absolute_drag", {"galilean", "time_reversal", "froude"}},
    // A turn about x itself does not show it.
    {"preferred_axis", {"rotation", "rotation_vertical"}},
    {"order_dependent", {"permutation"}},
    {"insertion_dependent", {"insertion_order"}},
    {"thread_dependent", {"threads"}},
    // An axial vector that drives a polar one; both also turn round differently in time.
    {"screw", {"mirror", "time_reversal", "froude"}},
    {"own_length", {"froude"}},
    {"ageing", {"time_reversal", "froude"}},
};

class SymmetryFaults : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const auto folder = std::filesystem::path(testing::TempDir());
        std::ofstream(folder / "apart.json") << kScene;
        json variants = json::array();
        for (const Fault& f : kFaults)
            variants.push_back(
                {{"name", f.name}, {"engine", std::string("double_asymmetric:fault=") + f.name}});
        for (const char* f : {"hidden_random", "float_positions"})
            variants.push_back({{"name", f}, {"engine", std::string("double_asymmetric:fault=") + f}});
        const json study{{"rigor_study", 1},
                         {"name", "broken"},
                         {"parts",
                          {{{"name", "p"},
                            {"scenarios", {"apart.json"}},
                            {"symmetries", {"*"}},
                            {"variants", variants},
                            {"metrics",
                             {"symmetry.repeat.frames", "symmetry.threads.from", "symmetry.rotation.angle",
                              "symmetry.time_reversal.angle"}}}}}};
        std::ofstream(folder / "broken.json") << study.dump();
        setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/tests/doubles").c_str(), 1);
        int code = -1;
        result_ = runStudy((folder / "broken.json").string(), code);
        unsetenv("RIGOR_ADAPTER_PATH");
    }
    /// Value of a column; NaN where it has none.
    static double value(const std::string& variant, const std::string& column) {
        for (const json& row : result_.at("parts").at(0).at("rows"))
            if (row.at("variant") == variant) {
                const json& v = row.at("metrics").at(column).at("value");
                return v.is_number() ? v.get<double>() : std::nan("");
            }
        throw std::runtime_error("no row of " + variant);
    }
    static json result_;
};
json SymmetryFaults::result_;

TEST_F(SymmetryFaults, EachIsFoundByTheColumnMeantForIt) {
    for (const Fault& f : kFaults) {
        Names broken;
        for (const auto& [symmetry, kept] : kKept)
            if (!(value(f.name, "symmetry." + symmetry) <= kept)) broken.insert(symmetry);
        EXPECT_EQ(broken, f.broken) << f.name;
    }
    // Closed forms of the deviations: a T (T - h)/2 of the pull, turned by 22.5 degrees against itself.
    const double pulled = 0.5 * 0.1 * 0.5 * (0.5 - 1.0 / 128.0);
    EXPECT_NEAR(value("preferred_axis", "symmetry.rotation_vertical"),
                pulled * 2.0 * std::sin(std::acos(-1.0) / 16.0), 1e-9);
    EXPECT_NEAR(value("none", "symmetry.time_reversal"), kReturn, 1e-12);
    EXPECT_LT(value("none", "symmetry.rotation.angle"), 1e-12);
}

TEST_F(SymmetryFaults, BitsTellWhatDistancesHide) {
    EXPECT_EQ(value("none", "symmetry.repeat.frames"), 0.0);
    EXPECT_GT(value("hidden_random", "symmetry.repeat.frames"), 60.0) << "of 65 frames";
    EXPECT_LT(value("hidden_random", "symmetry.repeat"), 1e-5);
    EXPECT_TRUE(std::isnan(value("none", "symmetry.threads.from"))) << "never";
    EXPECT_LT(value("thread_dependent", "symmetry.threads.from"), 0.02);
    EXPECT_LT(value("thread_dependent", "symmetry.threads"), 1e-8);
}

TEST_F(SymmetryFaults, FloatsShowFarFromTheOrigin) {
    EXPECT_GT(value("float_positions", "symmetry.translation"), 1e-5);
    EXPECT_LT(value("float_positions", "symmetry.rotation_90"), 2e-5);
    EXPECT_GT(value("float_positions", "symmetry.translation"),
              20.0 * value("float_positions", "symmetry.rotation_90"));
}

}  // namespace
}  // namespace rigor::validation
