// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/collision_cases.hpp"

#include <algorithm>

#include "scenarios/loader/collision_lines.hpp"
#include "scenarios/loader/overrides.hpp"
#include "scenarios/loader/read_parts.hpp"
#include "scenarios/loader/schema_check.hpp"

namespace rigor::scenario {
namespace {

namespace fs = std::filesystem;

ExpectedContact readExpected(const Node& node) {
    ExpectedContact expected;
    if (!node.isObject({"signed_distance", "overlap", "normals", "accuracy"})) return expected;
    if (const auto n = node.find("signed_distance")) expected.signedDistance = n->number(-1e9, 1e9);
    if (const auto n = node.find("overlap")) expected.overlap = n->boolean();
    if (const auto n = node.find("normals"))
        for (const Node& normal : n->items()) expected.normals.push_back(normal.unitVector());
    if (const auto n = node.find("accuracy")) expected.accuracy = n->number(0.0, 1.0);
    if (!expected.overlap && expected.signedDistance && std::abs(*expected.signedDistance) > 0.0)
        expected.overlap = *expected.signedDistance < 0.0;
    if (expected.overlap && expected.signedDistance &&
        *expected.overlap != (*expected.signedDistance < 0.0) && *expected.signedDistance != 0.0)
        node.problem("collision.contradiction", "overlap that the signed distance denies",
                     "overlap = (signed_distance < 0)");
    return expected;
}

CollisionCase readCase(const Node& node, int dimension) {
    CollisionCase c;
    if (!node.isObject({"name", "dimension", "a", "b", "expected", "tags", "source"})) return c;
    if (const auto n = node.require("name")) c.name = n->name();
    if (const auto n = node.find("dimension")) dimension = n->integer(2, 3);
    c.dimension = node.context().dimension = dimension;
    if (const auto n = node.require("a")) c.a = readPosedShape(*n);
    if (const auto n = node.require("b")) c.b = readPosedShape(*n);
    if (const auto n = node.find("expected")) c.expected = readExpected(*n);
    if (const auto n = node.find("tags")) c.tags = n->texts();
    if (const auto n = node.find("source")) (void)n->text();
    Json text = node.json();
    text["dimension"] = dimension;
    c.text = text.dump(-1, ' ', false, Json::error_handler_t::replace);
    return c;
}

CollisionFile readOwnFormat(const std::string& text, const fs::path& file) {
    const JsonDocument document = parseDocument(text, file.string());
    ReadContext context{file.string(), &document, {}, 3};
    const Node root(document.value, "", context);
    CollisionFile result;
    result.file = file;
    root.isObject({"rigor_collision", "name", "title", "source", "dimension", "cases"});
    if (document.value.is_object()) {
        int dimension = 3;
        if (const auto n = root.require("rigor_collision")) n->integer(1, 1);
        if (const auto n = root.require("name")) result.name = n->name();
        if (const auto n = root.find("title")) result.title = n->text();
        if (const auto n = root.find("source")) (void)n->text();
        if (const auto n = root.find("dimension")) dimension = n->integer(2, 3);
        if (const auto list = root.require("cases"))
            for (const Node& item : list->items()) {
                CollisionCase c = readCase(item, dimension);
                c.line = document.lineOf(item.pointer());
                const bool known =
                    std::any_of(result.cases.begin(), result.cases.end(),
                                [&](const CollisionCase& other) { return other.name == c.name; });
                if (known && !c.name.empty())
                    item.problem("collision.duplicate", "the name '" + c.name + "' a second time",
                                 "each name once");
                result.cases.push_back(std::move(c));
            }
    }
    if (!context.problems.empty()) throw LoadError(std::move(context.problems));
    checkCollisionSchema(document, file.string());
    return result;
}

/// The first line that is not empty.
std::string firstLine(const std::string& text) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find('\n', begin) - begin);
}

bool isOneQueryPerLine(const std::string& text, const fs::path& file) {
    const Json line = Json::parse(firstLine(text), nullptr, false);
    if (!line.is_discarded()) return line.is_object() && !line.contains("rigor_collision");
    return file.extension() == ".jsonl" || file.extension() == ".ndjson";
}

}  // namespace

CollisionCase readCollisionCase(const std::string& text) {
    const Json json = Json::parse(text);
    ReadContext context{"case", nullptr, {}, 3};
    const Node node(json, "", context);
    CollisionCase c = json.contains("pose_a") ? readCollisionLine(node) : readCase(node, 3);
    if (!context.problems.empty()) throw LoadError(std::move(context.problems));
    return c;
}

CollisionFile loadCollisionFile(const fs::path& file) {
    const std::string text = readTextFile(file);
    CollisionFile result =
        isOneQueryPerLine(text, file) ? readCollisionLines(text, file) : readOwnFormat(text, file);
    if (result.cases.empty())
        throw LoadError({{"collision.empty", file.string(), "", 0, "no case", "at least one case"}});
    return result;
}

}  // namespace rigor::scenario
