// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// JSON Schema by valijson; the only file that includes it.
#include "scenarios/loader/schema_check.hpp"

#include <stdexcept>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "scenarios/loader/loader.hpp"
#include "scenarios/schema/scenario_schema.hpp"  // generated from the JSON files beside it

namespace rigor::scenario {
namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

class CompiledSchema {
  public:
    explicit CompiledSchema(const char* text) : json_(Json::parse(text)) {
        valijson::SchemaParser parser;
        Adapter adapter(json_);
        parser.populateSchema(adapter, schema_);
    }
    bool accepts(const Json& value, valijson::ValidationResults& results) const {
        valijson::Validator validator;
        Adapter target(value);
        return validator.validate(schema_, target, &results);
    }

  private:
    Json json_;
    valijson::Schema schema_;
};

/// {"<root>", "[bodies]", "[0]"} -> "/bodies/0"
std::string pointerOf(const std::vector<std::string>& context) {
    std::string pointer;
    for (const std::string& step : context)
        if (step.size() > 2 && step.front() == '[')
            pointer += "/" + escapeToken(step.substr(1, step.size() - 2));
    return pointer;
}

void check(const CompiledSchema& schema, const JsonDocument& document, const std::string& fileName) {
    valijson::ValidationResults results;
    if (schema.accepts(document.value, results)) return;
    std::vector<Problem> problems;
    valijson::ValidationResults::Error error;
    while (results.popError(error)) {
        const std::string pointer = pointerOf(error.context);
        std::string found = "a value the schema refuses";
        try {
            found = describe(document.value.at(Json::json_pointer(pointer)));
        } catch (const Json::exception&) {
            // the context names a place that does not exist (a missing key): the description says so
        }
        problems.push_back(
            {"schema.violation", fileName, pointer, document.lineOf(pointer), found, error.description});
    }
    throw LoadError(std::move(problems));
}

}  // namespace

void checkScenarioSchema(const JsonDocument& document, const std::string& fileName) {
    static const CompiledSchema schema(kScenarioSchema);
    check(schema, document, fileName);
}

void checkSuiteSchema(const JsonDocument& document, const std::string& fileName) {
    static const CompiledSchema schema(kSuiteSchema);
    check(schema, document, fileName);
}

void checkCollisionSchema(const JsonDocument& document, const std::string& fileName) {
    static const CompiledSchema schema(kCollisionSchema);
    check(schema, document, fileName);
}

void checkStudySchema(const JsonDocument& document, const std::string& fileName) {
    static const CompiledSchema schema(kStudySchema);
    check(schema, document, fileName);
}

}  // namespace rigor::scenario
