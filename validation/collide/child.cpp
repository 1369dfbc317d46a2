// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries of one engine, case by case. Every result is written before the next query, so that a library that
// ends the process costs one result; an alarm ends a query that hangs.
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "adapters/interface/checked_world.hpp"
#include "adapters/interface/input_check.hpp"
#include "validation/collide/exchange.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/line_file.hpp"

namespace rigor::validation {
namespace {

using adapter::CollisionAnswer;
using adapter::ContactPoint;
using nlohmann::json;
using scenario::Vec3;

/// The direction between the closest points of shapes that are apart.
std::optional<Vec3> directionBetween(const CollisionAnswer& found) {
    if (found.overlap || !found.witnessA || !found.witnessB) return std::nullopt;
    const Vec3 gap = *found.witnessB - *found.witnessA;
    if (!(norm(gap) > 0.0)) return std::nullopt;
    return gap / norm(gap);
}

CollideAnswer fromEngine(const CollisionAnswer& found) {
    CollideAnswer answer;
    answer.answered = true;
    answer.overlap = found.overlap;
    answer.signedDistance = found.signedDistance;
    answer.witnessA = found.witnessA;
    answer.witnessB = found.witnessB;
    answer.contacts = found.contacts.size();
    answer.normal = directionBetween(found);
    if (found.contacts.empty()) return answer;
    const ContactPoint* deepest = &found.contacts.front();
    for (const ContactPoint& c : found.contacts)
        if (c.depth > deepest->depth) deepest = &c;
    answer.normal = deepest->normal;
    answer.witnessA = deepest->pointA;
    answer.witnessB = deepest->pointB;
    if (!answer.signedDistance) answer.signedDistance = -deepest->depth;
    return answer;
}

/// Result of a query with the settings of the spec, and by the algorithm that its narrow_phase names if there
/// is a choice.
CollisionAnswer answerBy(const adapter::CollisionEngine& engine, const adapter::Settings& settings,
                         const adapter::CollisionQuery& query) {
    const std::vector<std::string> known = engine.algorithms();
    const auto chosen = settings.find("narrow_phase");
    adapter::CollisionQuery by = query;
    by.settings = &settings;
    if (chosen != settings.end() && std::find(known.begin(), known.end(), chosen->second) != known.end())
        by.algorithm = chosen->second;
    return adapter::collideChecked(engine, by);
}

CollideAnswer runQuery(const adapter::CollisionEngine& engine, const adapter::Settings& settings,
                       const scenario::CollisionCase& c) {
    adapter::CollisionQuery query;
    query.a = {&c.a.geometry, c.a.pose};
    query.b = {&c.b.geometry, c.b.pose};
    query.dimension = c.dimension;
    CollideAnswer answer;
    if (!c.unsupported.empty()) {
        answer.verdict = CollideVerdict::Unsupported;
        answer.message = c.unsupported;
        return answer;
    }
    try {
        adapter::checkQueryInput(query);
        const auto start = std::chrono::steady_clock::now();
        const CollisionAnswer found = answerBy(engine, settings, query);
        const auto end = std::chrono::steady_clock::now();
        answer = fromEngine(found);
        answer.seconds = std::chrono::duration<double>(end - start).count();
    } catch (const adapter::Unsupported& error) {
        answer.verdict = CollideVerdict::Unsupported;
        answer.message = error.what();
    } catch (const std::exception& error) {
        answer.verdict = CollideVerdict::Error;
        answer.message = error.what();
    }
    return answer;
}

json optional(const std::optional<double>& value) {
    return value ? numberToJson(*value) : json(nullptr);
}
json optional(const std::optional<Vec3>& value) {
    return value ? json{numberToJson(value->x), numberToJson(value->y), numberToJson(value->z)}
                 : json(nullptr);
}
std::optional<double> optionalNumber(const json& j) {
    return j.is_null() ? std::nullopt : std::optional(numberFromJson(j));
}
std::optional<Vec3> optionalVector(const json& j) {
    if (j.is_null()) return std::nullopt;
    return Vec3{numberFromJson(j.at(0)), numberFromJson(j.at(1)), numberFromJson(j.at(2))};
}

}  // namespace

json answerToJson(const CollideAnswer& a) {
    return {a.answered,
            a.overlap,
            optional(a.signedDistance),
            optional(a.normal),
            optional(a.witnessA),
            optional(a.witnessB),
            a.contacts,
            numberToJson(a.seconds),
            a.message,
            static_cast<int>(a.verdict)};
}

CollideAnswer answerFromJson(const json& j) {
    CollideAnswer a;
    a.answered = j.at(0);
    a.overlap = j.at(1);
    a.signedDistance = optionalNumber(j.at(2));
    a.normal = optionalVector(j.at(3));
    a.witnessA = optionalVector(j.at(4));
    a.witnessB = optionalVector(j.at(5));
    a.contacts = j.at(6);
    a.seconds = numberFromJson(j.at(7));
    a.message = j.at(8);
    a.verdict = static_cast<CollideVerdict>(j.at(9).get<int>());
    return a;
}

int collideChild(const std::filesystem::path& requestFile) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    const auto questions = readJsonFile(request->at("questions").get<std::string>());
    if (!questions) throw std::runtime_error("the questions can not be read");
    const adapter::EngineSpec spec = adapter::parseSpec(request->at("spec").get<std::string>());
    const adapter::LoadedEngine engine = adapter::loadEngine(spec);
    if (engine->collision() == nullptr)
        throw adapter::BadInput("engine '" + spec.engine + "' has no collision queries");
    const adapter::Settings settings = adapter::resolveSettings(spec, *engine);
    const double limit = numberFromJson(request->at("seconds"));
    const auto first = request->at("first").get<std::size_t>(), last = request->at("last").get<std::size_t>();
    LineWriter out(request->at("answer").get<std::string>());
    for (std::size_t i = first; i < last; ++i) {
        const scenario::CollisionCase c = scenario::readCollisionCase(questions->at(i).get<std::string>());
        setAlarm(limit);
        const CollideAnswer answer = runQuery(*engine->collision(), settings, c);
        setAlarm(0.0);
        out.add(answerToJson(answer));
    }
    return 0;
}

}  // namespace rigor::validation
