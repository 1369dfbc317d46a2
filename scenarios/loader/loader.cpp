// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of the checks: JSON syntax, overrides, meaning (the reader, whose messages are the most precise),
// then the published schema. A scenario leaves this file only when all of them found nothing.
#include "scenarios/loader/loader.hpp"

#include <cmath>
#include <deque>
#include <fstream>
#include <iterator>
#include <set>

#include "scenarios/generators/generator.hpp"
#include "scenarios/loader/engine_settings.hpp"
#include "scenarios/loader/overrides.hpp"
#include "scenarios/loader/read_parts.hpp"
#include "scenarios/loader/schema_check.hpp"

namespace rigor::scenario {
namespace {

constexpr int kFormatVersion = 1;
constexpr int kMaxSize = 1000000;

/// Reports read it from the text of the file: it plays no part in a run.
void readNegligibleError(const Node& node) {
    node.isObject({"value", "reason"});
    if (const auto value = node.require("value")) (void)value->number(1e-6, 1e-2);
    if (const auto reason = node.require("reason")) (void)reason->text();
}

void readHeader(const Node& root, Scenario& s) {
    if (const auto n = root.require("rigor"); n && n->json() != kFormatVersion)
        n->problem("schema.version", "1, the version of this format");
    if (const auto n = root.require("name")) s.name = n->name();
    if (const auto n = root.require("title")) s.title = n->text();
    if (const auto n = root.find("description")) s.description = n->text();
    if (const auto n = root.find("source")) s.source = n->text();
    if (const auto n = root.find("isolates")) s.isolates = n->texts();
    if (const auto n = root.find("tags")) s.tags = n->texts();
    if (const auto n = root.require("gravity")) s.gravity = root.context().gravity = n->vector();
    if (const auto n = root.require("duration")) s.duration = n->number(1e-6, 3600.0);
    if (const auto n = root.find("size")) s.size = root.context().size = n->integer(1, kMaxSize);
    if (const auto n = root.find("time_limit")) s.timeLimit = n->number(0.1, 86400.0);
    if (const auto n = root.find("negligible_error")) readNegligibleError(*n);
    if (const auto n = root.require("dt"))
        for (const Node& step : n->items()) s.timeSteps.push_back(step.timeStep());
    if (root.has("dt") && s.timeSteps.empty()) root["dt"].problem("value.range", "at least one time step");
    if (!root.context().problems.empty()) return;
    for (const double dt : s.timeSteps)
        if (dt > s.duration || s.duration / dt > 1e8)
            root["dt"].problem("value.range", "time steps not longer than the duration, at most 1e8 of them");
}

void readMaterials(const Node& root, Scenario& s) {
    const auto coefficients = [](const Node& n, auto& target) {
        if (const auto f = n.find("friction")) target.friction = f->number(0.0, 1e6);
        if (const auto e = n.find("restitution")) target.restitution = e->number(0.0, 1.0);
        if (const auto k = n.find("static_friction")) target.staticFriction = k->number(target.friction, 1e6);
        if (const auto r = n.find("rolling_friction")) target.rollingFriction = r->number(0.0, 1e6);
        if (const auto t = n.find("torsional_friction")) {
            target.torsionalFriction = t->number(0.0, 1e6);
            if (t->dimension() == 2)
                t->problem("material.dimension", "torsional friction", "rolling_friction, or 3 dimensions");
        }
    };
    if (const auto list = root.find("materials"))
        for (const auto& [name, node] : list->members()) {
            node.isObject({"friction", "static_friction", "restitution", "density", "rolling_friction",
                           "torsional_friction"});
            Material material;
            material.name = name;
            coefficients(node, material);
            if (const auto n = node.find("density")) material.density = n->positive();
            s.materials.push_back(material);
        }
    if (const auto list = root.find("pairs"))
        for (const Node& node : list->items()) {
            node.isObject({"a", "b", "friction", "static_friction", "restitution", "rolling_friction",
                           "torsional_friction"});
            MaterialPair pair;
            if (const auto n = node.require("a")) pair.a = readMaterialName(*n, s);
            if (const auto n = node.require("b")) pair.b = readMaterialName(*n, s);
            node.require("friction");
            node.require("restitution");
            coefficients(node, pair);
            for (const MaterialPair& p : s.pairs)
                if ((p.a == pair.a && p.b == pair.b) || (p.a == pair.b && p.b == pair.a))
                    node.problem("pair.duplicate", "a pair of materials a second time", "each pair once");
            s.pairs.push_back(pair);
        }
}

/// Bodies of the file, then those of the generators, in order. Generated nodes share the generator's pointer.
void readBodies(const Node& root, Scenario& s, std::deque<Json>& made) {
    std::set<std::string> names;
    const auto add = [&](const Node& node) {
        Body body = readBody(node, s);
        if (!body.name.empty() && !names.insert(body.name).second)
            node.problem("body.duplicate", "the name '" + body.name + "' a second time", "each name once");
        s.bodies.push_back(std::move(body));
    };
    if (const auto list = root.find("bodies")) {
        if (list->json().is_array() && list->json().size() > static_cast<std::size_t>(kMaxBodies))
            list->problem("generator.size", "at most " + std::to_string(kMaxBodies) + " bodies");
        else
            for (const Node& node : list->items()) add(node);
    }
    std::vector<Node> joints;
    if (const auto list = root.find("generators"))
        for (const Node& entry : list->items()) {
            if (!root.context().problems.empty()) return;
            Generated generated = generate(entry);
            if (s.bodies.size() + generated.bodies.size() > static_cast<std::size_t>(kMaxBodies)) {
                entry.problem("generator.size", "at most " + std::to_string(kMaxBodies) + " bodies in all");
                return;
            }
            for (const Json& json : generated.bodies) {
                add(Node(json, entry.pointer(), root.context()));
                if (!root.context().problems.empty()) return;  // the other copies would say the same
            }
            made.push_back(std::move(generated.joints));
            joints.emplace_back(made.back(), entry.pointer(), root.context());
        }
    if (s.bodies.empty() && root.context().problems.empty())
        root.problem("body.missing", "no body", "at least one body");
    if (!root.context().problems.empty()) return;
    if (const auto list = root.find("joints")) readJoints(*list, s);
    for (const Node& list : joints) readJoints(list, s);
}

void readObserved(const Node& root, Scenario& s) {
    if (const auto n = root.find("observe")) {
        for (const Node& item : n->items()) s.observed.push_back(readBodyName(item, s, false));
    }
    if (s.observed.empty())
        for (std::size_t i = 0; i < s.bodies.size(); ++i)
            if (s.bodies[i].type == BodyType::Dynamic) s.observed.push_back(static_cast<int>(i));
    if (s.observed.empty()) root.problem("body.observed", "no dynamic body", "a body to observe");
    if (const auto n = root.find("reference")) s.reference = readReference(*n);
    if (const auto n = root.find("metrics")) s.metrics = n->texts();
    if (s.metrics.empty()) s.metrics = {s.reference ? "position_final" : "energy_drift"};
    readAcceptance(root, s);
}

Scenario readScenario(const JsonDocument& document, const std::string& file) {
    ReadContext context{file, &document, {}, 3};
    Scenario s;
    const Node root(document.value, "", context);
    root.isObject({"rigor",      "name",      "title",      "description",      "isolates",
                   "source",     "tags",      "dimension",  "gravity",          "duration",
                   "dt",         "materials", "pairs",      "layers",           "bodies",
                   "generators", "joints",    "forces",     "events",           "observe",
                   "reference",  "metrics",   "accept",     "known_deviations", "engines",
                   "size",       "bench",     "time_limit", "negligible_error"});
    std::deque<Json> made;  // generated nodes refer to it
    if (document.value.is_object()) {
        // Nothing else can be read if the dimension is missing.
        if (const auto n = root.require("dimension")) s.dimension = context.dimension = n->integer(2, 3);
        if (!context.problems.empty()) throw LoadError(std::move(context.problems));
        readHeader(root, s);
        readMaterials(root, s);
        if (const auto n = root.find("layers")) readLayers(*n, s);
        if (context.problems.empty()) readBodies(root, s, made);
        if (context.problems.empty()) {
            if (const auto n = root.find("forces")) readForces(*n, s);
            if (const auto n = root.find("events")) readEvents(*n, s);
            readObserved(root, s);
            if (const auto n = root.find("bench")) s.bench = readBench(*n);
            if (const auto n = root.find("engines")) checkEngineSettings(*n);
        }
    }
    if (!context.problems.empty()) throw LoadError(std::move(context.problems));
    return s;
}

}  // namespace

std::string readTextFile(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file))
        throw LoadError({{"file.unreadable", file.string(), "", 0, "no readable file", "a file"}});
    return {std::istreambuf_iterator<char>(in), {}};
}

LoadedScenario loadScenarioText(const std::string& json, const std::string& fileName,
                                const std::vector<std::string>& overrides) {
    JsonDocument document = parseDocument(json, fileName);
    for (const std::string& override : overrides) applyOverride(document, override, fileName);
    LoadedScenario loaded{readScenario(document, fileName),
                          overrides.empty() ? json : document.value.dump(2) + "\n",
                          document.value.contains("reference") ? document.lineOf("/reference") : 0};
    checkScenarioSchema(document, fileName);
    return loaded;
}

LoadedScenario loadScenario(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return loadScenarioText(readTextFile(file), file.string(), overrides);
}

}  // namespace rigor::scenario
