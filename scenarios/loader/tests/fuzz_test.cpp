// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Seeded mutations of good files. Whatever comes in, the loader either refuses it with a place, or gives a
// scenario that is sound all through; it never crashes and never gives half of one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

using Json = nlohmann::json;

class Mutator {
  public:
    explicit Mutator(std::uint64_t seed) : random_(seed) {}

    std::string mutate(const std::string& text) {
        std::string result = text;
        const int times = 1 + below(3);
        for (int i = 0; i < times; ++i) result = once(result);
        return result;
    }

  private:
    int below(std::size_t n) { return static_cast<int>(random_() % n); }

    std::string once(std::string text) {
        if (text.empty()) return "{";
        const auto at = static_cast<std::size_t>(below(text.size()));
        switch (below(9)) {
            case 0:
                text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
                return text;
            case 1:
                return text.erase(at, 1 + static_cast<std::size_t>(below(20)));
            case 2:
                return text.substr(0, at);
            case 3:
                return text.insert(at, text.substr(static_cast<std::size_t>(below(text.size())), 30));
            case 4:
                return replaceNumber(std::move(text));
            default:
                return structural(text);
        }
    }

    std::string replaceNumber(std::string text) {
        static const char* const kNumbers[] = {"1e999",
                                               "-1e999",
                                               "1e308",
                                               "-1e308",
                                               "1e-320",
                                               "0",
                                               "-0.0",
                                               "-1",
                                               "NaN",
                                               "Infinity",
                                               "99999999999999999999",
                                               "1e15",
                                               "0x10",
                                               "1."};
        const auto at = text.find_first_of("0123456789", static_cast<std::size_t>(below(text.size())));
        if (at == std::string::npos) return text;
        const auto end = text.find_first_not_of("0123456789.eE+-", at);
        return text.replace(at, (end == std::string::npos ? text.size() : end) - at,
                            kNumbers[below(std::size(kNumbers))]);
    }

    /// Changes the tree rather than the text, so that the result is JSON and reaches the deeper checks.
    std::string structural(const std::string& text) {
        Json document = Json::parse(text, nullptr, false);
        if (document.is_discarded()) return text;
        std::vector<std::string> pointers;
        const Json flat = document.flatten();
        for (const auto& [pointer, value] : flat.items()) pointers.push_back(pointer);
        if (pointers.empty() || !document.is_structured()) return text;
        std::string pointer = pointers[below(pointers.size())];
        for (int up = below(3); up > 0 && pointer.find('/', 1) != std::string::npos; --up)
            pointer.resize(pointer.rfind('/'));
        const Json::json_pointer place(pointer);
        if (place.empty()) return text;
        Json& parent = document[place.parent_pointer()];
        const std::string key = place.back();
        switch (below(4)) {
            case 0:  // drop
                if (parent.is_object())
                    parent.erase(key);
                else
                    parent.erase(static_cast<std::size_t>(std::stoul(key)));
                break;
            case 1:  // rename
                if (parent.is_object()) {
                    Json value = document[place];
                    parent.erase(key);
                    parent[key + "x"] = std::move(value);
                }
                break;
            case 2:
                document[place] = oddValue();
                break;
            default:  // a value from elsewhere
                document[place] = Json(document[Json::json_pointer(pointers[below(pointers.size())])]);
        }
        return document.dump(2, ' ', false, Json::error_handler_t::replace);
    }

    Json oddValue() {
        static const std::vector<Json> values{nullptr,
                                              true,
                                              -1,
                                              0,
                                              1e-300,
                                              1e300,
                                              "",
                                              "world",
                                              "x",
                                              Json::array(),
                                              Json::object(),
                                              Json{0, 0, 0},
                                              Json{1, 2},
                                              Json{{"sphere", 3}},
                                              std::string(500, 'a'),
                                              4294967296.0};
        return values[below(values.size())];
    }

    std::mt19937_64 random_;
};

void expectSoundShape(const Shape& shape, const Scenario& s) {
    ASSERT_GE(shape.material, 0);
    ASSERT_LT(static_cast<std::size_t>(shape.material), s.materials.size());
    ASSERT_TRUE(isFinite(shape.pose.position));
    ASSERT_NEAR(norm(shape.pose.orientation), 1.0, 1e-9);
    const auto* sphere = std::get_if<Sphere>(&shape.geometry);
    const auto* box = std::get_if<Box>(&shape.geometry);
    const auto* hull = std::get_if<ConvexHull>(&shape.geometry);
    ASSERT_TRUE(sphere == nullptr || sphere->radius > 0.0);
    ASSERT_TRUE(box == nullptr || (box->halfExtents.x > 0.0 && box->halfExtents.y > 0.0));
    ASSERT_TRUE(hull == nullptr || hull->vertices.size() >= (s.dimension == 2 ? 3u : 4u));
}

void expectSoundBody(const Body& body, const Scenario& s) {
    ASSERT_TRUE(isFinite(body.pose.position) && isFinite(body.velocity) && isFinite(body.angularVelocity));
    ASSERT_NEAR(norm(body.pose.orientation), 1.0, 1e-9);
    for (const Shape& shape : body.shapes) expectSoundShape(shape, s);
    if (body.type != BodyType::Dynamic) return;
    const Mat3& inertia = body.massProperties.inertia;
    ASSERT_GT(body.massProperties.mass, 0.0);
    ASSERT_TRUE(std::isfinite(body.massProperties.mass) && isFinite(body.massProperties.centerOfMass));
    ASSERT_TRUE(inertia(2, 2) > 0.0 && std::isfinite(inertia(2, 2)));
    ASSERT_TRUE(s.dimension == 2 || (inertia(0, 0) > 0.0 && inertia(1, 1) > 0.0));
}

/// Everything that code relies on that uses a loaded scenario.
void expectSound(const Scenario& s) {
    ASSERT_TRUE(s.dimension == 2 || s.dimension == 3);
    ASSERT_TRUE(s.duration > 0.0 && std::isfinite(s.duration) && isFinite(s.gravity));
    ASSERT_FALSE(s.timeSteps.empty() || s.bodies.empty() || s.observed.empty() || s.metrics.empty());
    for (const double dt : s.timeSteps) ASSERT_TRUE(dt > 0.0 && dt <= s.duration);
    std::set<std::string> names;
    const int count = static_cast<int>(s.bodies.size());
    for (const Body& body : s.bodies) {
        ASSERT_FALSE(body.name.empty() || body.name == "world");
        ASSERT_TRUE(names.insert(body.name).second);
        expectSoundBody(body, s);
    }
    for (const Material& m : s.materials)
        ASSERT_TRUE(m.friction >= 0.0 && m.restitution >= 0.0 && m.restitution <= 1.0 && m.density > 0.0);
    for (const int body : s.observed) ASSERT_TRUE(body >= 0 && body < count);
    for (const Joint& joint : s.joints) {
        ASSERT_TRUE(joint.bodyA >= kNone && joint.bodyA < count && joint.bodyB >= 0 && joint.bodyB < count);
        ASSERT_NE(joint.bodyA, joint.bodyB);
        ASSERT_NEAR(norm(joint.axisA), 1.0, 1e-9);
    }
    for (const Event& event : s.events) ASSERT_TRUE(event.body >= 0 && event.body < count);
}

std::string readAll(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Fuzz, MutationsAreRefusedWithAPlaceOrLoadWhole) {
    const auto entries = listScenarios();
    ASSERT_FALSE(entries.empty());
    constexpr int kRounds = 3000;
    int refused = 0, loaded = 0;
    for (int round = 0; round < kRounds; ++round) {
        const auto& entry = entries[static_cast<std::size_t>(round) % entries.size()];
        SCOPED_TRACE(entry.name + ", seed " + std::to_string(round));
        const std::string text = Mutator(static_cast<std::uint64_t>(round)).mutate(readAll(entry.file));
        try {
            const LoadedScenario result = loadScenarioText(text, "mutant.json");
            ++loaded;
            ASSERT_NO_FATAL_FAILURE(expectSound(result.scenario)) << text;
        } catch (const LoadError& error) {
            ++refused;
            ASSERT_FALSE(error.problems().empty());
            for (const Problem& problem : error.problems()) {
                ASSERT_FALSE(problem.id.empty() || problem.found.empty() || problem.expected.empty());
                ASSERT_GT(problem.line, 0) << problem.text();
                ASSERT_EQ(problem.file, "mutant.json");
            }
        }  // anything else thrown fails the test
    }
    // Both outcomes really occur.
    EXPECT_GT(refused, kRounds / 3);
    EXPECT_GT(loaded, kRounds / 50);
}

}  // namespace
}  // namespace rigor::scenario
