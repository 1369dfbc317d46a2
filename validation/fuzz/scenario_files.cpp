// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files in JSON: scenarios, suites, studies, collision queries.
#include "scenarios/loader/collision_cases.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/study.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/fuzz/scratch_file.hpp"
#include "validation/fuzz/targets.hpp"

namespace rigor::fuzz {
namespace {

using scenario::LoadError;

/// A message must be there for people to act upon, and can not steer a terminal.
void checkProblems(const LoadError& error) {
    if (error.problems().empty()) throw std::logic_error("a refusal without a problem");
    for (const scenario::Problem& problem : error.problems())
        for (const char c : problem.text())
            if (static_cast<unsigned char>(c) < 0x20 && c != '\t')
                throw std::logic_error("a control character in a message");
}

}  // namespace

void readScenarioFile(const std::string& bytes) {
    try {
        const auto loaded = scenario::loadScenarioText(bytes, "input");
        // A scenario that has been read can be written, and is one again.
        (void)scenario::loadScenarioText(scenario::scenarioText(loaded.scenario), "written");
    } catch (const LoadError& error) {
        checkProblems(error);
        if (error.problems().front().file == "written")
            throw std::logic_error("a scenario that is written is refused: " +
                                   error.problems().front().text());
    }
}

void readSuiteFile(const std::string& bytes) {
    try {
        (void)scenario::loadSuite(scratchFile(bytes));
    } catch (const LoadError& error) {
        checkProblems(error);
    }
}

void readStudyFile(const std::string& bytes) {
    try {
        (void)scenario::loadStudy(scratchFile(bytes));
    } catch (const LoadError& error) {
        checkProblems(error);
    }
}

void readCaseFile(const std::string& bytes) {
    try {
        const auto file = scenario::loadCollisionFile(scratchFile(bytes));
        for (const auto& one : file.cases) (void)scenario::readCollisionCase(one.text);
    } catch (const LoadError& error) {
        checkProblems(error);
    }
}

}  // namespace rigor::fuzz
