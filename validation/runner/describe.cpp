// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/describe.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "adapters/interface/capability_fields.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
constexpr ProcessLimits kDescribeLimits{20.0, 4096};

json optionToJson(const adapter::Option& o) {
    return {{"key", o.key},
            {"values", o.values},
            {"min", numberToJson(o.min)},
            {"max", numberToJson(o.max)},
            {"integer", o.integer},
            {"default", o.defaultValue},
            {"matched", o.matchedValue},
            {"help", o.help}};
}

adapter::Option optionFromJson(const json& j) {
    adapter::Option o;
    o.key = j.at("key");
    o.values = j.at("values").get<std::vector<std::string>>();
    o.min = numberFromJson(j.at("min"));
    o.max = numberFromJson(j.at("max"));
    o.integer = j.at("integer");
    o.defaultValue = j.at("default");
    o.matchedValue = j.at("matched");
    o.help = j.at("help");
    return o;
}

json presetsToJson(const std::vector<adapter::Preset>& presets) {
    json list = json::array();
    for (const auto& p : presets) list.push_back({{"name", p.name}, {"values", p.values}});
    return list;
}

void readDescription(const json& j, EngineDescription& d) {
    // The name is the one its module goes by: specs and reports use that.
    d.info = {d.info.name,         j.at("version"), j.at("precision"), j.at("title"),
              j.at("build_notes"), j.at("package"), j.at("clock")};
    d.capabilities = adapter::capabilitiesFromJson(j.at("capabilities"));
    for (const json& o : j.at("options")) d.options.push_back(optionFromJson(o));
    for (const json& p : j.at("presets"))
        d.presets.push_back({p.at("name"), p.at("values").get<std::map<std::string, std::string>>()});
}

/// The engine that resolveSettings reads, made from its description: the library stays out of this process.
class DescribedEngine final : public adapter::EngineWithPresets {
  public:
    explicit DescribedEngine(const EngineDescription& d) : d_(d) {}
    adapter::EngineInfo info() const override { return d_.info; }
    adapter::Capabilities capabilities() const override { return d_.capabilities; }
    std::vector<adapter::Option> options() const override { return d_.options; }
    std::vector<adapter::Preset> presets() const override { return d_.presets; }

  private:
    const EngineDescription& d_;
};

/// Descriptions that this process has had made: a run needs the same ones several times. A module that has been replaced
/// since is described anew, and so is one that could not be described.
class KnownDescriptions {
  public:
    /// The program that describes, the engine as it is named, its module, and the time at which that was written.
    using Key = std::tuple<std::string, std::string, std::filesystem::path, std::filesystem::file_time_type>;

    std::optional<EngineDescription> find(const std::optional<Key>& key) {
        const std::lock_guard lock(mutex_);
        const auto it = key ? known_.find(*key) : known_.end();
        return it == known_.end() ? std::nullopt : std::optional(it->second);
    }
    void keep(const std::optional<Key>& key, const EngineDescription& description) {
        const std::lock_guard lock(mutex_);
        if (key && description.problem.empty()) known_.insert_or_assign(*key, description);
    }

  private:
    std::mutex mutex_;
    std::map<Key, EngineDescription> known_;
};

KnownDescriptions& knownDescriptions() {
    static KnownDescriptions known;
    return known;
}

/// Empty for an engine that is not installed.
std::optional<KnownDescriptions::Key> keyOf(const std::string& engine, const std::filesystem::path& binary) {
    try {
        const auto module = adapter::moduleFor(adapter::parseSpec(engine));
        std::error_code error;
        const auto written = std::filesystem::last_write_time(module, error);
        if (!error) return KnownDescriptions::Key{binary.string(), engine, module, written};
    } catch (const adapter::BadInput&) {  // the child says what is wrong
    }
    return std::nullopt;
}

void addPrecisions(const std::string& engine, EngineDescription& d) {
    const std::string& own = d.info.precision;
    if (!own.empty()) d.precisions.push_back(own);
    for (const auto& variant : adapter::availablePrecisions(adapter::parseSpec(engine).engine))
        if (variant != own) d.precisions.push_back(variant);
    for (const auto& option : d.options)
        if (option.key == "precision") d.precisions = option.values;
}

/// The child that describes an engine.
ProcessTask describeTask(const std::string& engine, const std::filesystem::path& binary,
                         const std::filesystem::path& answer, EngineDescription& d) {
    return {{binary.string(), "__describe", engine, answer.string()},
            kDescribeLimits,
            engine,
            [&d, answer](const ProcessResult& result) {
                const auto reply = readJsonFile(answer);
                if (result.exitedWith(0) && reply) {
                    readDescription(*reply, d);
                    return;
                }
                d.problem = result.timedOut ? "no result within the time limit" : result.ending();
                if (const std::string line = lastLine(result.outputTail); !line.empty())
                    d.problem += ": " + line;
            }};
}

}  // namespace

int describeChild(const std::string& engine, const std::filesystem::path& answer) {
    const adapter::LoadedEngine loaded = adapter::loadEngine(adapter::parseSpec(engine));
    const adapter::EngineInfo info = loaded->info();
    json options = json::array();
    for (const auto& o : loaded->options()) options.push_back(optionToJson(o));
    writeJsonFile(answer, {{"version", info.version},
                           {"precision", info.precision},
                           {"title", info.title},
                           {"build_notes", info.buildNotes},
                           {"package", info.package},
                           {"clock", info.clock},
                           {"capabilities", adapter::capabilitiesToJson<json>(loaded->capabilities())},
                           {"options", std::move(options)},
                           {"presets", presetsToJson(adapter::ownPresets(*loaded))}});
    return 0;
}

std::string capabilitiesText(const EngineDescription& description) {
    if (!description.problem.empty()) return "";
    const auto names = adapter::presetNames(description.presets);
    const auto limit = [](double value) { return std::isfinite(value) ? json(value) : json(nullptr); };
    json options = json::array();
    for (const auto& o : description.options) {
        json values = json::object();
        for (const auto& name : names) values[name] = adapter::presetValue(o, name, description.presets);
        options.push_back({{"key", o.key},
                           {"values", o.values},
                           {"min", limit(o.min)},
                           {"max", limit(o.max)},
                           {"integer", o.integer},
                           {"presets", std::move(values)},
                           {"help", o.help}});
    }
    return json{{"capabilities", adapter::capabilitiesToJson<json>(description.capabilities)},
                {"options", std::move(options)},
                {"presets", names},
                {"clock", description.info.clock}}
        .dump();
}

std::vector<EngineDescription> describeEngines(const std::vector<std::string>& engines,
                                               const std::filesystem::path& binary, int jobs) {
    const ScratchFolder scratch;
    ProcessPool pool(jobs);
    std::vector<EngineDescription> descriptions(engines.size());
    std::map<std::size_t, std::optional<KnownDescriptions::Key>> requested;
    for (std::size_t i = 0; i < engines.size(); ++i) {
        const auto key = keyOf(engines[i], binary);
        if (auto known = knownDescriptions().find(key)) {
            descriptions[i] = *std::move(known);
            continue;
        }
        requested[i] = key;
        descriptions[i].info.name = adapter::parseSpec(engines[i]).engine;
        const auto answer = scratch.path() / (std::to_string(i) + ".json");
        pool.add(describeTask(engines[i], binary, answer, descriptions[i]));
    }
    const std::atomic<bool> never{false};
    pool.run(never, [](const std::string&) {});
    for (const auto& [i, key] : requested) {
        addPrecisions(engines[i], descriptions[i]);
        knownDescriptions().keep(key, descriptions[i]);
    }
    return descriptions;
}

EngineDescription describeEngine(const std::string& engine, const std::filesystem::path& binary) {
    return describeEngines({engine}, binary, 1).front();
}

std::vector<adapter::EngineSpec> withAllPresets(const std::vector<adapter::EngineSpec>& specs,
                                                const std::filesystem::path& binary) {
    std::set<std::string> names;
    for (const auto& spec : specs)
        if (!spec.options.contains("preset")) names.insert(spec.engine);
    std::map<std::string, std::vector<adapter::Preset>> own;
    for (auto& d : describeEngines({names.begin(), names.end()}, binary, 1)) own[d.info.name] = d.presets;
    std::vector<adapter::EngineSpec> expanded;
    for (const auto& spec : specs) {
        if (spec.options.contains("preset")) {
            expanded.push_back(spec);
            continue;
        }
        for (const auto& preset : adapter::presetNames(own[spec.engine])) {
            expanded.push_back(spec);
            expanded.back().options["preset"] = preset;
        }
    }
    return expanded;
}

void checkSettings(const adapter::EngineSpec& spec, const EngineDescription& description) {
    const auto given = spec.options.find("precision");
    const auto& built = description.precisions;
    if (given != spec.options.end() && !built.empty() &&
        std::find(built.begin(), built.end(), given->second) == built.end()) {
        std::string names;
        for (const auto& name : built) names += (names.empty() ? "" : ", ") + name;
        throw adapter::BadInput("engine '" + spec.engine + "', key 'precision': found '" + given->second +
                                "', expected one of " + names);
    }
    (void)adapter::resolveSettings(spec, DescribedEngine(description));
}

void checkSpecs(const std::vector<adapter::EngineSpec>& specs, const std::filesystem::path& binary) {
    std::vector<std::string> engines;
    for (const auto& spec : specs) {
        (void)adapter::moduleFor(spec);
        if (std::find(engines.begin(), engines.end(), spec.engine) == engines.end())
            engines.push_back(spec.engine);
    }
    const auto descriptions = describeEngines(engines, binary, 1);
    for (const auto& spec : specs)
        for (const auto& d : descriptions)
            if (d.info.name == spec.engine && d.problem.empty()) checkSettings(spec, d);
}

void checkPlan(const std::vector<CasePlan>& plan, const std::filesystem::path& binary) {
    std::map<std::string, adapter::EngineSpec> specs;
    for (const CasePlan& c : plan) specs.emplace(c.spec.text(), c.spec);
    std::vector<adapter::EngineSpec> each;
    for (const auto& [text, spec] : specs) each.push_back(spec);
    checkSpecs(each, binary);
}

}  // namespace rigor::validation
