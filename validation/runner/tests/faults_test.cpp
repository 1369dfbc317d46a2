// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The harness checks itself: engines of one known fault each (doubles/rigid.cpp) go through the whole
// pipeline, and each has to miss the bound of the metric meant for it, by the amount that the fault makes;
// the engine without a fault keeps every bound and shows its order.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <sstream>

#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Verdict;

constexpr double kFaultStep = 0.0078125;  // 1/128: sums of it are exact

std::string scene(const std::string& name, const std::string& rest) {
    return R"({"rigor": 1, "name": ")" + name + R"(", "title": ")" + name +
           R"(", "dimension": 3, "isolates": ["the harness"], "source": "none", )" + rest + "}";
}

/// Two balls fly and spin, their frames off their centres; nothing touches them. Symplectic Euler is off by
/// g T h/2.
const std::string kFlight = scene("flight", R"("gravity": [0.5, -3.75, 0.25], "duration": 0.5,
  "dt": [0.0078125, 0.00390625, 0.001953125, 0.0009765625],
  "materials": {"steel": {"friction": 0, "restitution": 1}},
  "bodies": [
    {"name": "left", "mass": 2, "position": [1, 2, 3], "velocity": [4, 5, -6], "angular_velocity": [1, -2, 3],
     "axis_angle_deg": {"axis": [0, 0.6, 0.8], "angle_deg": 50},
     "shapes": [{"sphere": {"radius": 0.1}, "position": [0.25, 0, 0]}]},
    {"name": "right", "mass": 1, "position": [9, 2, 3], "velocity": [4, 5, 6], "angular_velocity": [2, 1, 0],
     "axis_angle_deg": {"axis": [0.6, 0, 0.8], "angle_deg": 70},
     "shapes": [{"sphere": {"radius": 0.1}, "position": [0, 0.25, 0]}]}],
  "reference": {"free_flight": {}}, "metrics": ["position_max"],
  "accept": {"*": {"position_max": {"max": 0.0075, "order": 1}, "velocity_max": 1e-11, "orientation_max": 1e-10,
    "spin_final": 1e-10, "quaternion_norm_error": 1e-12, "linear_momentum_drift": 1e-12}})");

/// A ball flies without a spin, so that its scheme's own solution is known.
const std::string kThrow =
    scene("throw", R"("gravity": [0.5, -3.75, 0.25], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0, "restitution": 1}},
  "bodies": [{"name": "ball", "mass": 2, "position": [1, 2, 3], "velocity": [4, 5, -6],
    "shapes": [{"sphere": {"radius": 0.1}}]}],
  "reference": {"free_flight": {}}, "metrics": ["scheme_position_max"],
  "accept": {"*": {"position_max": 0.0075, "scheme_position_max": 1e-11, "velocity_max": 1e-11}})");

/// An L of two blocks spins about no principal axis.
const std::string kTop = scene("top", R"("gravity": [0, 0, 0], "duration": 1,
  "dt": [0.0078125, 0.00390625, 0.001953125], "materials": {"steel": {"friction": 0, "restitution": 1}},
  "bodies": [{"name": "top", "mass": 3, "position": [0, 0, 0], "angular_velocity": [0.5, 4, 1],
    "axis_angle_deg": {"axis": [0.6, 0, 0.8], "angle_deg": 40},
    "shapes": [{"box": {"half_extents": [0.3, 0.1, 0.05]}, "position": [0.3, 0, 0]},
               {"box": {"half_extents": [0.1, 0.2, 0.05]}, "position": [0, 0.3, 0]}]}],
  "reference": {"torque_free_top": {}}, "metrics": ["orientation_max"],
  "accept": {"*": {"orientation_max": {"max": 0.0005, "order": 2}, "spin_final": {"max": 0.0012, "order": 2},
    "angular_momentum_drift": 1e-11, "energy_drift": {"max": 2e-4, "order": 2}}})");

/// A ball hits another one that spins; they touch at the end of a step.
const std::string kImpact = scene("impact", R"("gravity": [0, 0, 0], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0.1, "restitution": 0.5}},
  "bodies": [
    {"name": "a", "mass": 1, "position": [-0.75, 0, 0], "velocity": [2, 0, 0],
     "shapes": [{"sphere": {"radius": 0.125}}]},
    {"name": "b", "mass": 2, "position": [0, 0, 0], "angular_velocity": [0, 0, 10],
     "shapes": [{"sphere": {"radius": 0.125}}]}],
  "reference": {"two_sphere_impact": {"a": "a", "b": "b"}}, "metrics": ["velocity_final"],
  "accept": {"*": {"velocity_final": 1e-9, "spin_final": 1e-9, "normal_error": 1e-7, "overlap_max": 1e-12,
    "linear_momentum_drift": 1e-12, "energy_gain": 1e-12}})");

/// A ball hits a wall; it touches at the end of a step.
const std::string kBounce = scene("bounce", R"("gravity": [0, 0, 0], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0.25, "restitution": 0.5}},
  "bodies": [
    {"name": "wall", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
    {"name": "ball", "mass": 1, "position": [0, 0.625, 0], "velocity": [2, -2, 0],
     "shapes": [{"sphere": {"radius": 0.125}}]}],
  "reference": {"sphere_plane_impact": {"ball": "ball", "floor": "wall"}}, "metrics": ["quantity_error"],
  "accept": {"*": {"quantity_error": 1e-9, "position_max": 1e-9, "normal_error": 1e-7, "overlap_max": 1e-12,
    "penetration_max": 1e-9, "energy_gain": 1e-12, "signorini_residual": 1e-9}})");

/// Blocks slide in two directions until they stop: v^2/(2 mu g) = 0.25 m, in 0.25 s.
const std::string kSlides = scene("slides", R"("gravity": [0, -10, 0], "duration": 0.5, "dt": [0.0078125],
  "materials": {"wood": {"friction": 0.8, "restitution": 0}},
  "bodies": [
    {"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
    {"name": "along", "mass": 1, "position": [0, 0.03125, -3], "velocity": [2, 0, 0],
     "shapes": [{"box": {"half_extents": [0.25, 0.03125, 0.25]}}]},
    {"name": "across", "mass": 1, "position": [0, 0.03125, 3],
     "velocity": [1.4142135623730951, 0, 1.4142135623730951],
     "shapes": [{"box": {"half_extents": [0.25, 0.03125, 0.25]}}]}],
  "reference": {"friction_sweep": {"bodies": ["along", "across"], "on": "floor"}}, "metrics": ["quantity_error"],
  "accept": {"*": {"quantity_error": 0.04, "velocity_final": 1e-6, "position_final": 0.01, "normal_error": 1e-6,
    "signorini_residual": 1e-4, "coulomb_residual": 1e-9, "dissipation_error": 1e-4}})");

/// A ball between two walls: for ever.
const std::string kRally = scene("rally", R"("gravity": [0, 0, 0], "duration": 4, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0, "restitution": 1}},
  "bodies": [
    {"name": "left", "type": "static", "shapes": [{"half_space": {"normal": [1, 0, 0]}}]},
    {"name": "right", "type": "static", "position": [1, 0, 0], "shapes": [{"half_space": {"normal": [-1, 0, 0]}}]},
    {"name": "ball", "mass": 1, "position": [0.5, 0, 0], "velocity": [2, 0, 0],
     "shapes": [{"sphere": {"radius": 0.125}}]}],
  "metrics": ["energy_drift"],
  "accept": {"*": {"energy_drift": 1e-12, "energy_gain": 1e-12, "normal_error": 1e-7}})");

/// A block stands on the floor.
const std::string kRest = scene("rest", R"("gravity": [0, -10, 0], "duration": 1, "dt": [0.0078125],
  "materials": {"wood": {"friction": 0.5, "restitution": 0}},
  "bodies": [
    {"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
    {"name": "block", "mass": 1, "position": [0, 0.125, 0],
     "shapes": [{"box": {"half_extents": [0.25, 0.125, 0.25]}}]}],
  "reference": {"at_rest": {}}, "metrics": ["rest_motion"],
  "accept": {"*": {"rest_sink": 1e-6, "rest_creep": 1e-6, "rest_turn": 1e-6, "rest_jitter": 1e-6,
    "penetration_max": 1e-6, "overlap_max": 1e-6, "normal_flicker": 1e-6, "contact_flicker": 1e-3}})");

/// A rod rests on a hinge about `axis`, at both its stops.
std::string hinged(const std::string& name, const std::string& axis) {
    return scene(name, R"("gravity": [0, 0, 0], "duration": 1, "dt": [0.0078125],
  "materials": {"wood": {"friction": 0.5, "restitution": 0}}, "bodies": [{"name": "rod", "mass": 1, "position": [0, 0, 0], "collides": false,
    "shapes": [{"box": {"half_extents": [0.5, 0.1, 0.1]}}]}],
  "joints": [{"name": "pivot", "type": "hinge", "a": "world", "b": "rod", "anchor": [0, 0, 0],
    "axis": )" + axis + R"(, "limits": [0, 0]}],
  "metrics": ["joint_drift"],
  "accept": {"*": {"joint_drift": 1e-9, "joint_axis_drift": 1e-9, "joint_limit_violation": 1e-9}})");
}
const std::string kHinge = hinged("hinge", "[1, 0, 0]"), kStop = hinged("stop", "[0, 1, 0]");

using Names = std::set<std::string>;

struct Fault {
    const char* name;
    const std::string* scene;
    const char* metric;   ///< the one meant for it, or the start of the reason
    const char* subject;  ///< subject whose row is from `least` to `most`
    double least, most;
    const char* also = "";         ///< other metrics that cannot but miss their bounds
    const char* spared = nullptr;  ///< subject of the metric that the fault does not touch
};

const char* const kAllOfTheTop = "angular_momentum_drift orientation_max spin_final energy_drift";
const Fault kFaults[] = {
    // g T = 1.89572 m/s
    {"gravity_twice", &kFlight, "velocity_max", "", 1.8957, 1.8958, "position_max linear_momentum_drift"},
    {"gravity_double", &kFlight, "read-back, gravity of left: found 7.58", "", 0, 0,
     "velocity_max position_max linear_momentum_drift"},
    {"ids_swapped", &kFlight, "position_max", "left", 8.0, 10.0, "velocity_max orientation_max spin_final"},
    {"quaternion_order", &kFlight, "orientation_max", "right", 0.1, 3.1416},
    // 64 steps of 1e-6
    {"quaternion_drifts", &kFlight, "quaternion_norm_error", "", 6.39e-5, 6.41e-5},
    {"origin_is_center", &kFlight, "position_max", "left", 0.25, 0.26},
    {"own_step", &kFlight, "position_max", "", 0.03, 0.08,
     "velocity_max orientation_max linear_momentum_drift"},
    // g T h: on the other side of the exact solution, as far from it as it should be
    {"wrong_scheme", &kThrow, "scheme_position_max", "", 0.01480, 0.01482},
    // v h
    {"state_delayed", &kThrow, "scheme_position_max", "", 0.0625, 0.0726, "position_max velocity_max"},
    {"body_frame_spin", &kTop, "spin_final", "", 1.0, 20.0, "energy_drift angular_momentum_drift"},
    {"inertia_not_rotated", &kTop, "angular_momentum_drift", "", 0.01, 1.0, "orientation_max spin_final"},
    {"compound_inertia", &kTop, "read-back, inertia of top: found 0.08, expected 0.2096", "", 0, 0,
     kAllOfTheTop},
    {"compound_inertia_announced", &kTop, "angular_momentum_drift", "", 0.1, 1.0, kAllOfTheTop},
    {"compound_inertia_hidden", &kTop, "angular_momentum_drift", "", 0.1, 1.0, kAllOfTheTop},
    {"momentum_leak", &kImpact, "linear_momentum_drift", "", 0.99e-6, 1.02e-6, "velocity_final spin_final"},
    {"normal_flipped", &kImpact, "normal_error", "", 3.13, 3.1416, "normal_error_median"},
    {"normal_flipped", &kImpact, "normal_error_median", "", 3.13, 3.1416, "normal_error"},
    {"normal_flipped", &kBounce, "normal_error", "", 3.1415, 3.1416,
     "signorini_residual normal_error_median"},
    {"points_swapped", &kBounce, "contact_inconsistency", "", 1.9999, 2.0001, "penetration_max"},
    // (e - 0.99 e) |vn| / |v| = 0.005 / sqrt 2
    {"restitution_low", &kBounce, "quantity_error", "normal_velocity", 0.00353, 0.00354,
     "position_max signorini_residual", "tangential_velocity"},
    // (e - 0.99 e) |vn|
    {"restitution_low", &kBounce, "signorini_residual", "", 0.00999, 0.01001, "position_max quantity_error"},
    // 1/mu - 1 less a step's worth
    {"friction_squared", &kSlides, "quantity_error", "stop_distance_along", 0.21, 0.26,
     "position_final dissipation_error"},
    {"friction_squared", &kSlides, "quantity_error", "stop_distance_across", 0.21, 0.26,
     "position_final dissipation_error"},
    // 1 - 1/sqrt 2 at 45 degrees and a step's worth; nothing along an axis
    {"friction_pyramid", &kSlides, "quantity_error", "stop_distance_across", 0.29, 0.33,
     "position_final coulomb_residual dissipation_error", "stop_distance_along"},
    // (sqrt 2 - 1) mu p_n K: K is 1.05/m .. 4.05/m at a corner, and each carries a fourth of m g h, unevenly
    {"friction_pyramid", &kSlides, "coulomb_residual", "across", 0.0067, 0.04,
     "position_final quantity_error dissipation_error", "along"},
    // 0.1 rad of what friction may take at a corner in a step: mu p_n K = 0.016 .. 0.063 m/s, and up to all
    // of the
    // load stands on one corner when it stops
    {"friction_sideways", &kSlides, "dissipation_error", "", 0.0016, 0.0252,
     "position_final quantity_error velocity_final signorini_residual"},
    // 2 x 1e-4/s x 4 s
    {"hidden_damping", &kRally, "energy_drift", "", 7.9e-4, 8.1e-4},
    // 1.01^2 at each of 10 or 11 bounces, of the energy at the end
    {"restitution_high", &kRally, "energy_gain", "", 0.17, 0.21, "energy_drift"},
    {"sinking", &kRest, "rest_sink", "block", 0.99e-4, 1.01e-4, "penetration_max overlap_max"},
    {"creeping", &kRest, "rest_creep", "block", 0.99e-4, 1.01e-4},
    {"turning", &kRest, "rest_turn", "block", 0.99e-3, 1.01e-3},
    {"jitter", &kRest, "rest_jitter", "block", 0.99e-3, 1.01e-3},
    {"shapes_shrunk", &kRest, "overlap_max", "", 1e-3, 3e-3,
     "rest_sink penetration_max contact_inconsistency"},
    // the normal turns out and back again; one step of four
    {"normal_flickers", &kRest, "normal_flicker", "block", 0.0199, 0.0201},
    {"contacts_blink", &kRest, "contact_flicker", "block", 0.24, 0.26},
    {"creeping", &kHinge, "joint_drift", "pivot", 0.99e-4, 1.01e-4},
    {"turning", &kHinge, "joint_axis_drift", "pivot", 0.99e-3, 1.01e-3},
    {"turning", &kStop, "joint_limit_violation", "pivot.angle", 0.99e-3, 1.01e-3},
};

class Faults : public fixtures::RunnerTest, public testing::WithParamInterface<const std::string*> {
  protected:
    results::Run runWith(const std::string& text, const Names& faults, const std::vector<double>& steps) {
        std::string specs;
        for (const std::string& f : faults)
            specs += (specs.empty() ? "" : ",") + ("double_rigid:fault=" + f + ",preset=default");
        const auto loaded = fixtures::load(text);
        return run(planCases({loaded}, adapter::parseSpecList(specs), steps), options(loaded.first.name));
    }
    static const CaseRow& rowOf(const results::Run& run, const std::string& fault) {
        for (const auto& row : run.cases)
            if (row.spec.find("fault=" + fault + ",") != std::string::npos) return row;
        throw std::runtime_error("no row of " + fault);
    }
    static Names missed(const CaseRow& row) {
        Names names;
        for (const auto& m : row.metrics)
            if (m.verdict == Verdict::Fail) names.insert(m.name);
        return names;
    }
    static const results::MetricRow& metricOf(const CaseRow& row, const std::string& name,
                                              const std::string& subject) {
        for (const auto& m : row.metrics)
            if (m.name == name && m.subject == subject) return m;
        throw std::runtime_error(row.spec + " has no " + name + " of '" + subject + "'");
    }
};

void expectCaught(const Fault& f, const CaseRow& row, const Names& missed,
                  const std::function<double(const char* subject)>& value) {
    EXPECT_EQ(row.outcome, results::Outcome::Completed) << row.reason;
    EXPECT_EQ(row.verdict, Verdict::Fail);
    std::istringstream also(f.also);
    Names expected{std::istream_iterator<std::string>(also), {}};
    if (std::string(f.metric).starts_with("read-back")) {
        EXPECT_THAT(row.reason, testing::StartsWith(f.metric));
    } else {
        expected.insert(f.metric);
        EXPECT_GE(value(f.subject), f.least);
        EXPECT_LE(value(f.subject), f.most);
        if (f.spared != nullptr) {
            EXPECT_LT(value(f.spared), 0.04) << f.spared;
        }
    }
    EXPECT_EQ(missed, expected);
}

TEST_P(Faults, EachIsFoundByTheMetricMeantForIt) {
    Names names{"none"};
    for (const Fault& f : kFaults)
        if (f.scene == GetParam()) names.insert(f.name);
    const auto run = runWith(*GetParam(), names, {kFaultStep});
    ASSERT_EQ(run.scenarios[0].referenceProblem, "");
    const CaseRow& honest = rowOf(run, "none");
    EXPECT_EQ(honest.verdict, Verdict::Pass) << honest.reason;
    for (const Fault& f : kFaults) {
        if (f.scene != GetParam()) continue;
        SCOPED_TRACE(f.name);
        const CaseRow& row = rowOf(run, f.name);
        expectCaught(f, row, missed(row),
                     [&](const char* subject) { return metricOf(row, f.metric, subject).value; });
    }
    EXPECT_FALSE(runIsGreen(run));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Faults,
                         testing::Values(&kFlight, &kThrow, &kTop, &kImpact, &kBounce, &kSlides, &kRally,
                                         &kRest, &kHinge, &kStop));

using FaultList = Faults;

TEST_F(FaultList, HasEveryFaultOfTheDouble) {
    Names tested{"none"};
    for (const Fault& f : kFaults) tested.insert(f.name);
    const auto options = describeEngine("double_rigid", this->options().binary).options;
    ASSERT_EQ(options.size(), 1u);
    EXPECT_EQ(Names(options[0].values.begin(), options[0].values.end()), tested);
}

/// log2 of the ratio of errors at successive halvings of the step, and what was wrong at each step.
struct Refinement {
    std::vector<double> orders;
    std::vector<std::string> reasons;
};

class Order : public Faults {
  protected:
    Refinement climb(const std::string& text, const std::string& fault, const std::string& metric) {
        const auto run = runWith(text, {fault}, {});
        Refinement refinement;
        double last = 0.0;
        for (const CaseRow& row : run.cases) {
            const double error = metricOf(row, metric, "").value;
            if (last > 0.0) refinement.orders.push_back(std::log2(last / error));
            last = error;
            refinement.reasons.push_back(row.reason);
        }
        return refinement;
    }
};

TEST_F(Order, OfTheHonestDoubleIsKnown) {
    const Refinement flight = climb(kFlight, "none", "position_max");
    EXPECT_THAT(flight.orders,
                testing::ElementsAre(testing::DoubleNear(1.0, 1e-9), testing::DoubleNear(1.0, 1e-9),
                                     testing::DoubleNear(1.0, 1e-9)));
    EXPECT_THAT(flight.reasons, testing::Each(""));
    const Refinement top = climb(kTop, "none", "orientation_max");
    EXPECT_THAT(top.orders,
                testing::ElementsAre(testing::DoubleNear(2.0, 0.03), testing::DoubleNear(2.0, 0.03)));
    EXPECT_THAT(top.reasons, testing::Each(""));
}

/// An engine that steps as it likes is as wrong at a small step as at a large one.
TEST_F(Order, OfAnEngineWithAStepOfItsOwnIsNought) {
    const Refinement flight = climb(kFlight, "own_step", "position_max");
    ASSERT_EQ(flight.orders.size(), 3u);
    for (const double order : flight.orders) EXPECT_LT(order, 0.5);
    EXPECT_THAT(flight.reasons, testing::Each("position_max misses its bound"));
}

}  // namespace
}  // namespace rigor::validation
