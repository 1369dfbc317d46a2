// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Free swings of a real pendulum of one, two or three arms: DIR/single_NN.csv, double_NN.csv, triple_NN.csv
// (columns t, theta1.., omega1..), each a segment that can be started from its first row;
// DIR/KIND_segments.csv, how far the source's own model is from each; DIR/parameters.json, that model.
//
// Angles are absolute, measured from straight up, and so are those of the bodies here: arm i has its centre
// of mass at a_i from its upper joint and the next joint at L_i along itself,
//     p_(i+1) = p_i + L_i (-sin theta_i, cos theta_i),  x_i = p_i + a_i (-sin theta_i, cos theta_i).
// Each joint brakes by k_i times the relative rate. Masses, lengths, inertias, k and g are the source's fits,
// of which only the combinations that enter the equations mean something. Angular velocities are filtered
// and serve as start values alone.
//
// A scenario is a whole recording or any span of one (a list with columns file, start, end, in seconds of the
// file's column t). Its start, unless the caller selects the first row as it is, is fitted: the angles and
// rates from which the source's model is nearest to the first 0.1 s (arm_model.hpp).
// Source: Kaheman, Fasel, Bramburger, Strom, Kutz, Brunton, arXiv 2205.06231 (2022).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "scenarios/json/json_text.hpp"
#include "scenarios/loader/overrides.hpp"
#include "validation/import/arm_model.hpp"
#include "validation/import/csv.hpp"
#include "validation/import/dataset.hpp"
#include "validation/import/importer.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using nlohmann::ordered_json;

constexpr std::array kArmEngines{results::kInHouseEngine, "ode:preset=matched", "bullet:preset=matched"};
constexpr double kRate = 1000.0;               // samples per second
constexpr double kSampleTimeTolerance = 1e-6;  // [s]
constexpr std::size_t kFitSamples = 100;       // 0.1 s: rates to 4 mrad/s with encoders of 1 mrad
constexpr std::size_t kLeastSamples = 20;      // least number of samples of a span whose start is fitted
constexpr double kHalfThickness = 0.01;        // half thickness of the picture of an arm [m]
constexpr double kFineStep = 1.0 / 16000;  // [s] of the judged study: well below the noise of the encoders
// Two codes that integrate one model differ by rounding of the record (1e-5 rad), of its first velocity and
// by the first order of a time step: half a milliradian of an RMS of 2 to 220.
constexpr double kSameModel = 5e-4, kSameModelShare = 0.02;

struct Swing {
    std::vector<double> times, angles;  ///< [s], [rad] by sample, then by arm
    ArmState start;
    double modelError = 0.0;  ///< RMS of the worst angle of the source's model from this start [rad]
};

/// A recording or a part of it.
struct Span {
    fs::path file;
    std::string name;  ///< name of the scenario
    bool whole = true;
    double start = 0.0, end = 0.0;  ///< [s] of the column t
};

std::size_t armsOf(const std::string& kind) {
    return kind == "single" ? 1 : kind == "double" ? 2 : 3;
}

ArmModel readModel(const fs::path& from, const std::string& kind) {
    const fs::path file = from / "parameters.json";
    const auto root = nlohmann::json::parse(readTextFile(file), nullptr, false);
    ArmModel model;
    const auto refuse = [&](const std::string& pointer, const std::string& found,
                            const std::string& expected) {
        throw LoadError({{"import.parameters", file.string(), pointer, 0, found, expected}});
    };
    if (root.is_discarded() || !root.is_object()) refuse("", "no JSON object", "the source's parameters");
    if (!root.contains(kind) || !root[kind].is_object()) refuse("/" + kind, "nothing", "an object");
    const auto& values = root[kind];
    const auto list = [&](const char* key) {
        std::vector<double> numbers;
        const std::string pointer = "/" + kind + "/" + key;
        const std::size_t count = armsOf(kind);
        if (!values.contains(key) || !values[key].is_array() || values[key].size() != count)
            refuse(pointer, values.contains(key) ? values[key].dump() : "nothing",
                   std::to_string(count) + " numbers, one for each arm");
        for (const auto& value : values[key]) {
            if (!value.is_number()) refuse(pointer, value.dump(), "a number");
            numbers.push_back(value.get<double>());
        }
        return numbers;
    };
    model.mass = list("m");
    model.com = list("a");
    model.length = list("L");
    model.inertia = list("I");
    model.braking = list("k");
    if (!values.contains("g") || !values["g"].is_number()) refuse("/" + kind + "/g", "nothing", "a number");
    model.gravity = values["g"].get<double>();
    return model;
}

/// Rows of the table that a span takes; refuses spans that are not in it.
std::pair<std::size_t, std::size_t> rowsOf(const CsvTable& table, const Span& span) {
    if (span.whole) return {0, table.size()};
    const double first = table.number(0, "t"), last = table.number(table.size() - 1, "t");
    const auto begin = static_cast<std::ptrdiff_t>(std::lround((span.start - first) * kRate)),
               end = static_cast<std::ptrdiff_t>(std::lround((span.end - first) * kRate));
    if (begin < 0 || end >= static_cast<std::ptrdiff_t>(table.size()) || end <= begin)
        throw LoadError({table.problem(
            "import.span", 0,
            "the span " + ordered_json(span.start).dump() + " .. " + ordered_json(span.end).dump(),
            "one within the times " + ordered_json(first).dump() + " .. " + ordered_json(last).dump() +
                " of the file")});
    return {static_cast<std::size_t>(begin), static_cast<std::size_t>(end) + 1};
}

Swing readSwing(const Span& span, const ArmModel& model, bool fitted) {
    const std::size_t arms = model.arms();
    std::vector<std::string> columns{"t"};
    for (const char* name : {"theta", "omega"})
        for (std::size_t i = 1; i <= arms; ++i) columns.push_back(name + std::to_string(i));
    const CsvTable table(span.file, columns);
    if (table.size() < 2) throw LoadError({table.problem("import.short", 0, "one sample", "at least two")});
    const auto [begin, end] = rowsOf(table, span);
    Swing swing;
    const double start = table.number(begin, "t");
    for (std::size_t row = begin; row < end; ++row) {
        const double t = (row - begin) / kRate;
        if (!(std::abs(table.number(row, "t") - start - t) <= kSampleTimeTolerance))
            throw LoadError({table.problem("import.time", table.line(row), "t = " + table.text(row, "t"),
                                           "times that rise by 0.001 s from line to line")});
        swing.times.push_back(t);
        for (std::size_t i = 1; i <= arms; ++i)
            swing.angles.push_back(table.number(row, "theta" + std::to_string(i)));
    }
    for (std::size_t i = 1; i <= arms; ++i) {
        swing.start.angles.push_back(swing.angles[i - 1]);
        swing.start.rates.push_back(table.number(begin, "omega" + std::to_string(i)));
    }
    const std::size_t samples = swing.times.size();
    if (fitted) {
        if (samples < kLeastSamples)
            throw LoadError({table.problem(
                "import.short", 0, std::to_string(samples) + " samples",
                "at least " + std::to_string(kLeastSamples) + ", from which a start can be fitted")});
        swing.start = fitStart(model, swing.start, swing.angles, 1.0 / kRate, std::min(samples, kFitSamples));
    }
    swing.modelError = worstRms(predictAngles(model, swing.start, 1.0 / kRate, samples), swing.angles, arms);
    return swing;
}

/// Error of the source's model for a segment of its list: the largest RMS of an angle [rad].
std::optional<double> publishedError(const fs::path& from, const std::string& kind, const std::string& file,
                                     std::size_t arms) {
    const fs::path list = from / (kind + "_segments.csv");
    if (!fs::exists(list)) return std::nullopt;
    std::vector<std::string> columns{"file"};
    for (std::size_t i = 1; i <= arms; ++i)
        columns.push_back("rms_theta" + std::to_string(i) + "_published_parameters");
    const CsvTable segments(list, columns);
    for (std::size_t row = 0; row < segments.size(); ++row) {
        if (segments.text(row, "file") != file) continue;
        double worst = 0.0;
        for (std::size_t i = 1; i <= arms; ++i) worst = std::max(worst, segments.number(row, columns[i]));
        return worst;
    }
    return std::nullopt;
}

/// The recordings that a list names, by file and span; its lines are numbered from 1.
std::vector<Span> spansOf(const CsvTable& list, const std::map<int, fs::path>& files) {
    std::vector<Span> spans;
    for (std::size_t row = 0; row < list.size(); ++row) {
        std::string name = list.text(row, "file");
        if (fs::path(name).extension() != ".csv") name += ".csv";
        const auto it = std::find_if(files.begin(), files.end(),
                                     [&](const auto& f) { return f.second.filename() == name; });
        if (it == files.end())
            throw LoadError(
                {list.problem("import.unknown", list.line(row), name,
                              "one of the " + std::to_string(files.size()) + " recordings that are there")});
        Span span{it->second, fs::path(name).stem().string(), false, list.number(row, "start"),
                  list.number(row, "end")};
        for (const double t : {span.start, span.end})
            span.name += "_" + std::to_string(std::lround(t * kRate));
        if (std::any_of(spans.begin(), spans.end(), [&](const Span& s) { return s.name == span.name; }))
            throw LoadError(
                {list.problem("import.duplicate", list.line(row), "a span a second time", "each once")});
        spans.push_back(std::move(span));
    }
    return spans;
}

/// Value with four digits.
std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}
std::string armName(std::size_t i) {
    return "arm_" + std::to_string(i + 1);
}
std::string jointName(std::size_t i) {
    return "joint_" + std::to_string(i + 1);
}

/// Adds bodies and joints of the model in the start of the swing.
void addArms(const ArmModel& model, const Swing& swing, ordered_json& bodies, ordered_json& joints) {
    Vec3 pivot, pivotVelocity;
    for (std::size_t i = 0; i < model.arms(); ++i) {
        const double angle = swing.start.angles[i], rate = swing.start.rates[i];
        const Vec3 along{-std::sin(angle), std::cos(angle), 0};
        const Vec3 turning{-rate * std::cos(angle), -rate * std::sin(angle), 0};  // d(along)/dt
        const Vec3 place = pivot + model.com[i] * along;
        const Vec3 velocity = pivotVelocity + model.com[i] * turning;
        const double reach = std::max(model.length[i], 2.0 * model.com[i]);
        bodies.push_back({{"name", armName(i)},
                          {"mass", model.mass[i]},
                          {"inertia", model.inertia[i]},
                          {"position", {place.x, place.y}},
                          {"angle", angle},
                          {"velocity", {velocity.x, velocity.y}},
                          {"angular_velocity", rate},
                          {"collides", false},
                          {"shapes",
                           {{{"box", {{"half_extents", {kHalfThickness, 0.5 * reach}}}},
                             {"position", {0, 0.5 * reach - model.com[i]}}}}}});
        joints.push_back({{"name", jointName(i)},
                          {"type", "hinge"},
                          {"a", i == 0 ? "world" : armName(i - 1)},
                          {"b", armName(i)},
                          {"anchor", {pivot.x, pivot.y}},
                          {"spring", {{"stiffness", 0}, {"damping", model.braking[i]}}}});
        pivot += model.length[i] * along;
        pivotVelocity += model.length[i] * turning;
    }
}

std::string scenarioOf(const std::string& name, const std::string& kind, bool train, const ArmModel& model,
                       const Swing& swing, bool fitted) {
    ordered_json bodies = ordered_json::array(), joints = ordered_json::array(), names = joints;
    addArms(model, swing, bodies, joints);
    for (std::size_t i = 0; i < model.arms(); ++i) names.push_back(armName(i));
    return scenarioText(
        {{"rigor", 1},
         {"name", name},
         {"title", "A measured free swing of a " + kind + " pendulum"},
         {"description",
          "Angles by encoders at 1 kHz. Masses, lengths, inertias, friction of the joints and g are the "
          "source's fits; its own model of them is off by " +
              shown(swing.modelError) +
              " rad (RMS of the worst angle) when it starts as this scenario does: " +
              (fitted ? "angles and rates fitted to the first 0.1 s."
                      : "from the first row, rates filtered by the source.")},
         {"source",
          "MultiArm-Pendulum, (c) 2022 dynamicslab, MIT; Kaheman, Fasel, Bramburger, Strom, Kutz, Brunton, "
          "arXiv 2205.06231"},
         {"isolates", {"joints", "energy"}},
         {"tags", {"measured", train ? "train" : "test"}},
         {"dimension", 2},
         {"gravity", {0, -model.gravity}},
         {"duration", swing.times.back()},
         {"dt", {1.0 / kRate}},
         {"materials", {{"arm", ordered_json::object()}}},
         {"bodies", bodies},
         {"joints", joints},
         {"observe", names},
         {"reference",
          {{"measured_motion", {{"bodies", names}, {"times", swing.times}, {"angles", swing.angles}}}}},
         {"metrics", {"measured_orientation_rms", "measured_orientation_mean", "measured_orientation_max"}}});
}

/// Findings: with the published parameters every engine must have the error of the published model.
ordered_json findingsOf(const std::string& name, double published) {
    const double slack = std::max(kSameModel, kSameModelShare * published);
    ordered_json findings = ordered_json::array();
    for (const char* engine : kArmEngines)
        findings.push_back({{"statement", std::string("As far from the record as the published model: ") +
                                              name + ", " + engine},
                            {"source", "Kaheman et al., arXiv 2205.06231"},
                            {"variant", engine},
                            {"metric", "measured_orientation_rms"},
                            {"at_least", published - slack},
                            {"at_most", published + slack}});
    return findings;
}

ordered_json partOf(const std::string& name, double published) {
    return {{"name", name},
            {"scenarios", {name + ".json"}},
            {"dt", {kFineStep}},
            {"variants", kArmEngines},
            {"metrics", {"measured_orientation_rms"}},
            {"findings", findingsOf(name, published)}};
}

}  // namespace

const std::vector<ImportChoice>& multiArmPendulumChoices() {
    static const std::vector<ImportChoice> choices{
        {"arms",
         {{"triple", "three arms, segments of 1.5 s"},
          {"double", "two arms, segments of 2.7 s"},
          {"single", "one arm, segments of 9.2 s"}}},
        {"start",
         {{"fit", "angles and rates from which the source's model is nearest to the first 0.1 s"},
          {"row", "the first row: angles as measured, rates as the source filtered them"}}}};
    return choices;
}

Imported importMultiArmPendulum(const ImportRequest& request) {
    const std::string& kind = request.choices.at("arms");
    const bool fitted = request.choices.at("start") == "fit";
    const auto files = numberedRecordings(request.from, kind, "", "segments");
    const ArmModel model = readModel(request.from, kind);
    std::vector<std::pair<Span, bool>> chosen;  // each span, and true if it is for the fit
    const bool isList = request.select != "all" && CsvTable(request.select, {}).has("file");
    if (isList) {
        const std::vector<Span> spans = spansOf(CsvTable(request.select, {"file", "start", "end"}), files);
        std::vector<int> ids;
        for (std::size_t i = 0; i < spans.size(); ++i) ids.push_back(static_cast<int>(i) + 1);
        ImportRequest all = request;
        all.select = "all";
        for (const Chosen& c : chooseRecordings(ids, all)) chosen.emplace_back(spans[c.id - 1], c.train);
    } else {
        std::vector<int> ids;
        for (const auto& [id, file] : files) ids.push_back(id);
        for (const Chosen& c : chooseRecordings(ids, request))
            chosen.emplace_back(Span{files.at(c.id), numberedName(kind, c.id, 2), true, 0, 0}, c.train);
    }

    Imported imported;
    imported.title = "Measured free swings of a " + kind + " pendulum";
    ordered_json parts = ordered_json::array();
    for (const auto& [span, train] : chosen) {
        const Swing swing = readSwing(span, model, fitted);
        imported.scenarios.push_back(
            {span.name, scenarioOf(span.name, kind, train, model, swing, fitted), train});
        std::optional<double> published;
        if (span.whole && !fitted)
            published = publishedError(request.from, kind, span.file.filename().string(), model.arms());
        parts.push_back(partOf(span.name, published.value_or(swing.modelError)));
    }
    for (std::size_t i = 0; i < model.arms(); ++i) {
        const double k = model.braking[i];
        imported.parameters.push_back({"friction_" + std::to_string(i + 1),
                                       "joints." + jointName(i) + ".spring.damping", 0.2 * k,
                                       std::max(5.0 * k, 1e-4), k});
    }
    imported.metric = "measured_orientation_rms";
    imported.report = {"measured_orientation_mean", "measured_orientation_max"};
    const ordered_json study = {{"rigor_study", 1},
                                {"name", "published_model"},
                                {"title", "The published model comes out again: " + kind + " pendulum"},
                                {"description",
                                 "Engines that solve the published equations are exactly as far from the "
                                 "recording as the published model is, no nearer and no farther."},
                                {"parts", parts}};
    imported.studies.push_back({"published_model", study.dump(1) + "\n"});
    if (fs::exists(request.from / "LICENSE")) imported.licence = request.from / "LICENSE";
    return imported;
}

}  // namespace rigor::validation
