// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pushes of a real cube by a robot hand: DIR/push_NNNN.csv, motion capture of hand and cube at a steady rate.
//
// The hand drives the scenario: a finger follows the point of the hand that pushes, as it was recorded; the
// cube is simulated from rest. The hand's shape is not given, and its tracked frame is not at the fingers.
// The pushing point of the hand is found by least squares over the recordings to fit on (push_recording.hpp):
// one point, fixed in the hand, for all of them. How high above the table it is can not be seen from the
// push: the finger's lowest point comes within 5 mm of the table, so that the finger passes over the cube
// where the real one does.
//
// The finger is a body of 100 t, free of gravity, whose velocity is changed by an impulse at each frame: the
// friction of a cube of 88 g changes its speed by 3e-6 m/s in a second.
//
// What is recorded besides: after its largest speed the cube runs ahead of the hand and slides to rest, which
// gives its friction on the table independently of any engine: deceleration/g.
// Source: Collins, Howard, Leitner, Quantifying the reality gap in robotic manipulation tasks, ICRA 2019.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <tuple>

#include "scenarios/loader/loader.hpp"
#include "validation/import/dataset.hpp"
#include "validation/import/importer.hpp"
#include "validation/import/push_recording.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using nlohmann::ordered_json;

constexpr double kTableGravity = 9.81;  // [m/s^2]
// half width and mass of the cube, as the source simulates it
constexpr double kHalf = 0.0375, kPushedMass = 0.0884;
constexpr double kFingerMass = 1e5;                                // [kg]
constexpr double kFingerRadius = 0.005, kFingerHalfLength = 0.02;  // a capsule across the push [m]
// clearance of the finger above the table, at its lowest [m]
constexpr double kFingerClearance = 0.005;
constexpr double kFingerFriction = 0.3;  // not given: initial value for a fit
constexpr double kStartGap = 0.002;      // least gap between finger and cube [m]
constexpr double kCalm = 0.3;            // [s] of rest at the end
constexpr int kPushStepsPerFrame = 10;
// MuJoCo's published displacement, 0.1137 m, against the mean of the measured ones, 0.0962 m: the farther of
// the two of seven published configurations that push the cube at all.
constexpr double kPublishedMiss = 0.0175;
constexpr double kSmooth = 0.02;  // friction of a table on which the cube has to slide too far
constexpr std::array kPushEngines{results::kInHouseEngine, "bullet:preset=matched", "ode:preset=matched"};

/// Data common to all recordings of a folder.
struct Common {
    PushPoint point;
    double friction = 0.0, frictionScatter = 0.0;          ///< friction of the cube on the table: mean and
                                                           ///< deviation
    double displacement = 0.0, displacementScatter = 0.0;  ///< [m]
};

/// Mean and standard deviation of a sample.
template <class Value>
std::pair<double, double> spread(const std::vector<Push>& pushes, Value value) {
    const auto count = static_cast<double>(pushes.size());
    double mean = 0.0, squares = 0.0;
    for (const Push& push : pushes) mean += value(push) / count;
    for (const Push& push : pushes) squares += (value(push) - mean) * (value(push) - mean);
    return {mean, pushes.size() < 2 ? 0.0 : std::sqrt(squares / (count - 1.0))};
}

Common commonOf(const std::vector<Push>& pushes) {
    Common common;
    common.point = fitPushPoint(pushes, kHalf);
    std::tie(common.friction, common.frictionScatter) =
        spread(pushes, [](const Push& push) { return slideDeceleration(push) / kTableGravity; });
    std::tie(common.displacement, common.displacementScatter) =
        spread(pushes, [](const Push& push) { return push.displacement; });
    return common;
}

/// The frames that a scenario covers, and the finger's path in them.
struct Piece {
    std::size_t first = 0, last = 0;
    std::vector<Vec3> finger;  ///< centres, one for each frame
};

Piece pieceOf(const Push& push, const Common& common, const fs::path& file) {
    const std::vector<Vec3> path = pathOf(push, common.point.inHand);
    Piece piece;
    piece.first = push.moved;
    const auto gap = [&](std::size_t k) { return push.cube[k].position.x - kHalf - path[k].x; };
    while (piece.first > 0 && gap(piece.first) < kStartGap) --piece.first;
    if (piece.first == 0)
        throw LoadError({{"import.gap", file.string(), "", 0, "a hand that is never clear of the cube",
                          "2 mm between the two before the push"}});
    piece.last = std::min(push.cube.size() - 1, push.stopped + std::lround(kCalm * push.rate));
    double lowest = path[piece.first].z;
    for (std::size_t k = piece.first; k <= push.stopped; ++k) lowest = std::min(lowest, path[k].z);
    for (std::size_t k = piece.first; k <= piece.last; ++k)
        piece.finger.push_back(
            {path[k].x - kFingerRadius, path[k].y, path[k].z - lowest + kFingerClearance + kFingerRadius});
    return piece;
}

/// Impulses that take the finger from each frame to the next.
ordered_json drive(const Piece& piece, double rate) {
    ordered_json events = ordered_json::array();
    Vec3 before = rate * (piece.finger[1] - piece.finger[0]);
    for (std::size_t k = 1; k + 1 < piece.finger.size(); ++k) {
        const Vec3 velocity = rate * (piece.finger[k + 1] - piece.finger[k]);
        events.push_back(
            {{"time", k / rate}, {"body", "finger"}, {"impulse", toJson(kFingerMass * (velocity - before))}});
        before = velocity;
    }
    return events;
}

/// The tracked frame is neither the cube's nor quite at its centre: attitudes are turns since the start,
/// heights are differences from it.
ordered_json recordedMotion(const Push& push, const Piece& piece) {
    ordered_json times = ordered_json::array(), positions = times, orientations = times;
    const RecordedPose& start = push.cube[piece.first];
    for (std::size_t k = piece.first; k <= piece.last; ++k) {
        const RecordedPose& pose = push.cube[k];
        times.push_back((k - piece.first) / push.rate);
        for (const double x : {pose.position.x, pose.position.y, pose.position.z - start.position.z + kHalf})
            positions.push_back(x);
        for (const auto& x : toJson(pose.orientation * conjugate(start.orientation)))
            orientations.push_back(x);
    }
    return {{"body", "cube"}, {"times", times}, {"positions", positions}, {"orientations", orientations}};
}

ordered_json bodiesOf(const Push& push, const Piece& piece) {
    const Vec3 cube = push.cube[piece.first].position;
    return {{{"name", "table"},
             {"type", "static"},
             {"shapes", {{{"half_space", {{"normal", {0, 0, 1}}}}, {"material", "table"}}}}},
            {{"name", "finger"},
             {"mass", kFingerMass},
             {"gravity_scale", 0},
             {"position", toJson(piece.finger[0])},
             {"velocity", toJson(push.rate * (piece.finger[1] - piece.finger[0]))},
             {"shapes",
              {{{"capsule", {{"radius", kFingerRadius}, {"half_length", kFingerHalfLength}}},
                {"material", "finger"}}}}},
            {{"name", "cube"},
             {"mass", kPushedMass},
             {"position", {cube.x, cube.y, kHalf}},
             {"shapes", {{{"box", {{"half_extents", {kHalf, kHalf, kHalf}}}}, {"material", "cube"}}}}}};
}

std::string rounded(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string scenarioOf(const std::string& name, bool train, const Push& push, const Piece& piece,
                       const Common& common) {
    const double duration = (piece.last - piece.first) / push.rate;
    return scenarioText(
        {{"rigor", 1},
         {"name", name},
         {"title", "A measured push of a cube by a robot hand"},
         {"description",
          "A finger follows the recorded hand; the cube is pushed by " +
              rounded(1000.0 * push.displacement, 1) +
              " mm, slides and rests. One point fixed in the hand pushes in all recordings (least squares, " +
              rounded(1000.0 * common.point.rms, 2) +
              " mm left). Friction on the table: from the slides' deceleration, " +
              rounded(common.friction, 3) + ", deviation between recordings " +
              rounded(common.frictionScatter, 3) + "; that of the finger is not known."},
         {"source",
          "Quantifying the reality gap in robotic manipulation tasks, (c) 2018 Jack Collins, CSIRO, "
          "BSD-3-Clause; Collins, Howard, Leitner, ICRA 2019"},
         {"isolates", {"friction", "contact"}},
         {"tags", {"measured", train ? "train" : "test"}},
         {"dimension", 3},
         {"gravity", {0, 0, -kTableGravity}},
         {"duration", duration},
         {"dt", {1.0 / (kPushStepsPerFrame * push.rate)}},
         {"materials",
          {{"table", ordered_json::object()},
           {"cube", ordered_json::object()},
           {"finger", ordered_json::object()}}},
         {"pairs",
          {{{"a", "cube"}, {"b", "table"}, {"friction", common.friction}, {"restitution", 0}},
           {{"a", "cube"}, {"b", "finger"}, {"friction", kFingerFriction}, {"restitution", 0}}}},
         {"bodies", bodiesOf(push, piece)},
         {"events", drive(piece, push.rate)},
         {"observe", {"cube"}},
         {"reference", {{"measured_motion", recordedMotion(push, piece)}}},
         {"metrics", {"measured_position_final", "measured_position_mean", "measured_orientation_mean"}}});
}

ordered_json partOf(const char* name, const std::string& statement, const char* bound,
                    const ordered_json& files) {
    ordered_json findings = ordered_json::array();
    for (const char* engine : kPushEngines)
        findings.push_back({{"statement", statement},
                            {"source", "Collins, Howard, Leitner, ICRA 2019"},
                            {"variant", engine},
                            {"metric", "measured_position_final"},
                            {bound, kPublishedMiss / (2.0 * kHalf)}});
    return {{"name", name},
            {"scenarios", files},
            {"variants", kPushEngines},
            {"metrics", {"measured_position_final", "measured_position_mean", "measured_orientation_mean"}},
            {"findings", findings}};
}

/// Study of the recordings that no parameter was taken from.
ordered_json studyOf(const Imported& imported, const Common& common) {
    ordered_json files = ordered_json::array();
    const bool any = std::any_of(imported.scenarios.begin(), imported.scenarios.end(),
                                 [](const ImportedScenario& s) { return !s.train; });
    for (const ImportedScenario& s : imported.scenarios)
        if (!s.train || !any) files.push_back(s.name + ".json");
    ordered_json smooth = partOf(
        "smooth_table", "On a table of friction 0.02 it stops farther away than that", "at_least", files);
    smooth["set"] = {"pairs.0.friction=" + ordered_json(kSmooth).dump()};
    return {{"rigor_study", 1},
            {"name", "pushed_cube"},
            {"title", "Given the hand's motion, the cube stops near where it did"},
            {"description",
             "Recordings that neither the friction nor the point of the hand that pushes was taken from. "
             "Displacement " +
                 rounded(1000.0 * common.displacement, 1) + " mm, deviation between recordings " +
                 rounded(1000.0 * common.displacementScatter, 1) +
                 " mm. The published simulations move the arm by its joints; here the hand is given."},
            {"parts",
             {partOf("as_measured", "Nearer to where the cube stopped than the published 17.5 mm of MuJoCo",
                     "at_most", files),
              smooth}}};
}

std::string pushName(int id) {
    return numberedName("push", id, 4);
}

}  // namespace

const std::vector<ImportChoice>& cubePushChoices() {
    static const std::vector<ImportChoice> none;
    return none;
}

Imported importCubePush(const ImportRequest& request) {
    const auto files = numberedRecordings(request.from, "push");
    std::vector<int> ids;
    for (const auto& [id, file] : files) ids.push_back(id);
    const std::vector<Chosen> chosen = chooseRecordings(ids, request);
    std::vector<Push> pushes, toFit;
    for (const Chosen& one : chosen) {
        pushes.push_back(readPush(files.at(one.id)));
        if (one.train) toFit.push_back(pushes.back());
    }
    const Common common = commonOf(toFit.empty() ? pushes : toFit);

    Imported imported;
    imported.title = "Measured pushes of a cube";
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Piece piece = pieceOf(pushes[i], common, files.at(chosen[i].id));
        const std::string name = pushName(chosen[i].id);
        imported.scenarios.push_back(
            {name, scenarioOf(name, chosen[i].train, pushes[i], piece, common), chosen[i].train});
    }
    imported.parameters = {{"table_friction", "pairs.0.friction", 0.1, 0.6, common.friction},
                           {"finger_friction", "pairs.1.friction", 0.0, 1.0, kFingerFriction}};
    imported.metric = "measured_position_final";
    imported.report = {"measured_position_mean", "measured_orientation_mean"};
    imported.studies.push_back({"pushed_cube", studyOf(imported, common).dump(1) + "\n"});
    if (fs::exists(request.from / "LICENSE")) imported.licence = request.from / "LICENSE";
    return imported;
}

}  // namespace rigor::validation
