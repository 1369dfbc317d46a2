// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tosses of a real cube onto a fixed board: DIR/toss_NNN.csv (or DIR/tosses/), columns t, p, q, v (world), w
// (body frame), one frame per line.
//
// Lengths in the recordings are about 2 % short: bodies in flight fall at 9.614 m/s^2 and the cube rests at
// 0.0512 m over the board instead of its 0.0524. So a choice of units:
//   data       as recorded, with g = 9.614 and half width 0.0512: consistent, nothing is changed
//   rescaled   lengths times 0.0524/0.0512, with g = 9.81 and half width 0.0524: consistent to 0.3 %
//   published  lengths as recorded, with g = 9.81 and half width 0.0524: what the published fits did
// The moment of inertia keeps its ratio to m (half width)^2. The cube is sharp here; the real one has edges
// rounded by about 2 mm.
// Source: Pfrommer, Halm, Posa, ContactNets, CoRL 2020; Acosta, Yang, Posa, IEEE RA-L 7 (2022) 6471.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "scenarios/json/json_text.hpp"
#include "validation/import/csv.hpp"
#include "validation/import/dataset.hpp"
#include "validation/import/importer.hpp"
#include "validation/import/recording.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using nlohmann::ordered_json;

constexpr double kTossedMass = 0.37;                          // [kg]
constexpr double kNominalHalf = 0.0524;                       // [m]
constexpr double kNominalInertia = 0.00081;                   // [kg m^2] at the nominal half width
constexpr double kTossFriction = 0.18, kRestitution = 0.125;  // contact-nets' parameters
constexpr int kTossStepsPerFrame = 10;                        // 1/1480 s, the step of the published fits
constexpr std::size_t kLeastFrames = 10;

struct Units {
    double scale, gravity, half;
    const char* sentence;
};
Units unitsOf(const std::string& name) {
    if (name == "rescaled")
        return {kNominalHalf / 0.0512, 9.81, kNominalHalf,
                "Lengths of the recording times 0.0524/0.0512, so that g = 9.81 and half width 0.0524 hold."};
    if (name == "published")
        return {
            1.0, 9.81, kNominalHalf,
            "Lengths as recorded (2 % short) with g = 9.81 and half width 0.0524, as in the published fits."};
    return {1.0, 9.614, 0.0512,
            "In the recording's own units, whose lengths are 2 % short: g = 9.614, half width 0.0512."};
}

const std::vector<std::string>& columns() {
    static const std::vector<std::string> names{"t",  "px", "py", "pz", "qw", "qx", "qy",
                                                "qz", "vx", "vy", "vz", "wx", "wy", "wz"};
    return names;
}

Recording readToss(const fs::path& file) {
    const CsvTable table(file, columns());
    if (table.size() < kLeastFrames)
        throw LoadError({table.problem("import.short", 0, std::to_string(table.size()) + " frames",
                                       "at least " + std::to_string(kLeastFrames))});
    Recording recording{steadyRate(table), {}};
    for (std::size_t row = 0; row < table.size(); ++row) {
        recording.frames.push_back({vectorAt(table, row, "p"), unitQuaternionAt(table, row, "q"),
                                    vectorAt(table, row, "v"), vectorAt(table, row, "w")});
    }
    return recording;
}

void scaleLengths(Recording& recording, double factor) {
    for (RecordedFrame& f : recording.frames) {
        f.position = factor * f.position;
        f.velocity = factor * f.velocity;
    }
}

ordered_json recordedMotion(const Recording& recording, std::size_t first) {
    ordered_json times = ordered_json::array(), positions = times, orientations = times;
    for (std::size_t k = first; k < recording.frames.size(); ++k) {
        const RecordedFrame& f = recording.frames[k];
        times.push_back((k - first) / recording.rate);
        for (const auto& x : toJson(f.position)) positions.push_back(x);
        for (const auto& x : toJson(f.orientation)) orientations.push_back(x);
    }
    return {{"body", "cube"}, {"times", times}, {"positions", positions}, {"orientations", orientations}};
}

std::string tossName(int id) {
    return numberedName("toss", id, 3);
}

std::string scenarioOf(int id, bool train, const Recording& recording, const StartState& start,
                       const Units& units) {
    const auto frames = static_cast<double>(recording.frames.size() - 1 - start.frame);
    const double ratio = units.half / kNominalHalf, inertia = kNominalInertia * ratio * ratio;
    return scenarioText(
        {{"rigor", 1},
         {"name", tossName(id)},
         {"title", "Measured toss " + std::to_string(id) + " of a cube"},
         {"description", std::string("A recorded cube flies, hits a board, tumbles and comes to rest. ") +
                             units.sentence + " Starts at frame " + std::to_string(start.frame) +
                             " of the recording. " + start.how +
                             " Friction and restitution of the pair: contact-nets' parameters."},
         {"source",
          "ContactNets data, (c) 2020 Dynamic Autonomy and Intelligent Robotics Lab, BSD-3-Clause; "
          "Pfrommer, Halm, Posa, CoRL 2020"},
         {"isolates", {"impact", "friction"}},
         {"tags", {"measured", train ? "train" : "test"}},
         {"dimension", 3},
         {"gravity", {0, 0, -units.gravity}},
         {"duration", frames / recording.rate},
         {"dt", {1.0 / (kTossStepsPerFrame * recording.rate)}},
         {"materials", {{"cube", ordered_json::object()}, {"board", ordered_json::object()}}},
         {"pairs",
          {{{"a", "cube"}, {"b", "board"}, {"friction", kTossFriction}, {"restitution", kRestitution}}}},
         {"bodies",
          {{{"name", "board"},
            {"type", "static"},
            {"shapes", {{{"half_space", {{"normal", {0, 0, 1}}}}, {"material", "board"}}}}},
           {{"name", "cube"},
            {"mass", kTossedMass},
            {"inertia", {inertia, inertia, inertia}},
            {"position", toJson(start.position)},
            {"orientation", toJson(start.orientation)},
            {"velocity", toJson(start.velocity)},
            {"angular_velocity", toJson(start.spin)},
            {"shapes",
             {{{"box", {{"half_extents", {units.half, units.half, units.half}}}}, {"material", "cube"}}}}}}},
         {"observe", {"cube"}},
         {"reference", {{"measured_motion", recordedMotion(recording, start.frame)}}},
         {"metrics", {"measured_position_mean", "measured_orientation_mean", "measured_loss"}}});
}

/// The heights of a recording distinguish it from all others; a copy of it turned about z has the same.
class CopyFinder {
  public:
    void check(const Recording& recording, const fs::path& file) {
        std::vector<double> heights;
        for (const RecordedFrame& f : recording.frames) heights.push_back(f.position.z);
        const auto [it, isNew] = seen_.emplace(std::move(heights), file);
        if (!isNew)
            throw LoadError(
                {{"import.copy", file.string(), "", 0,
                  "the same recording as " + it->second.filename().string() + " (maybe turned about z)",
                  "each once: a copy would be fitted on and scored (leave it out with --select)"}});
    }

  private:
    std::map<std::vector<double>, fs::path> seen_;
};

}  // namespace

const std::vector<ImportChoice>& cubeTossChoices() {
    static const std::vector<ImportChoice> choices{
        {"units",
         {{"data", "as recorded, g = 9.614, half width 0.0512"},
          {"rescaled", "lengths times 0.0524/0.0512, g = 9.81, half width 0.0524"},
          {"published", "as recorded, g = 9.81, half width 0.0524, as the published fits"}}},
        {"start",
         {{"rule", "the simulator study's rule for the first frame and its velocities"},
          {"flight", "the same frame, least squares over the free flight"}}}};
    return choices;
}

Imported importCubeToss(const ImportRequest& request) {
    const auto files = numberedRecordings(request.from, "toss", "tosses");
    std::vector<int> ids;
    for (const auto& [id, file] : files) ids.push_back(id);
    const Units units = unitsOf(request.choices.at("units"));
    Imported imported;
    imported.title = "Measured tosses of a cube";
    CopyFinder copies;
    std::vector<Problem> problems;
    for (const Chosen& chosen : chooseRecordings(ids, request)) {
        const fs::path& file = files.at(chosen.id);
        try {
            Recording recording = readToss(file);
            copies.check(recording, file);
            scaleLengths(recording, units.scale);
            if (firstFrameBelow(recording, units.half * std::sqrt(3.0)) == recording.frames.size())
                throw LoadError(
                    {{"import.no_fall", file.string(), "", 0, "a cube that stays above the board",
                      "a centre that comes down to " + std::to_string(units.half * std::sqrt(3.0)) + " m"}});
            const StartState start = request.choices.at("start") == "flight"
                                         ? startByFlight(recording, units.half, units.gravity)
                                         : startByRule(recording, units.half, units.gravity);
            imported.scenarios.push_back({tossName(chosen.id),
                                          scenarioOf(chosen.id, chosen.train, recording, start, units),
                                          chosen.train});
        } catch (const LoadError& error) {
            problems.insert(problems.end(), error.problems().begin(), error.problems().end());
        }
    }
    if (!problems.empty()) throw LoadError(std::move(problems));
    imported.parameters = {{"friction", "pairs.0.friction", 0.02, 0.6, kTossFriction},
                           {"restitution", "pairs.0.restitution", 0.0, 0.7, kRestitution}};
    imported.metric = "measured_loss";
    imported.report = {"measured_position_mean", "measured_orientation_mean"};
    if (fs::exists(request.from / "LICENSE")) imported.licence = request.from / "LICENSE";
    return imported;
}

}  // namespace rigor::validation
