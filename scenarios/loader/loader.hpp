// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenario and suite files to the model: JSON Schema first, then the checks a schema cannot make. Nothing
// half-loads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/json/problem.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::scenario {

struct LoadedScenario {
    Scenario scenario;
    std::string text;  ///< JSON as loaded, overrides applied, generators kept; loading it again gives the
                       ///< same scenario
    int referenceLine = 0;  ///< line of the reference in the file, 0: it has none
};

/// `overrides` are KEY=VALUE with a dotted path and a JSON value: "bodies.block.velocity=[3.1,0,0.2]",
/// "gravity=[0,-1.6,0]", "bodies.0.mass=2". Elements of arrays of named objects are found by name or index.
/// Throws LoadError.
LoadedScenario loadScenario(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides = {});
LoadedScenario loadScenarioText(const std::string& json, const std::string& fileName,
                                const std::vector<std::string>& overrides = {});

/// A named list of scenarios, engine specs and options.
struct Suite {
    std::string name, title;
    std::vector<std::string> scenarios;  ///< names or paths relative to the suite's file
    std::vector<std::string> engines;    ///< specs; empty: all installed
    std::vector<double> timeSteps;       ///< empty: each scenario's own
    int maxTimeSteps = 0;                ///< take only the first n of each scenario; 0: all
    int orders = 1;                      ///< number of insertion orders in which each case is run
};
Suite loadSuite(const std::filesystem::path& file);
/// True if the file exists and declares that it is a suite.
bool isSuiteFile(const std::filesystem::path& file);

struct LibraryEntry {
    std::string name, title;
    std::filesystem::path file;
};
/// The scenario library: RIGOR_SCENARIOS, else the scenarios of dataFolder() (data_folder.hpp).
std::filesystem::path libraryFolder();
std::vector<LibraryEntry> listScenarios();  ///< sorted by name; unreadable files are left out
/// The scenes of the bench, which the suites' "*" and listScenarios() leave out: large, timed, without a
/// reference.
std::vector<LibraryEntry> listBenchScenarios();
std::vector<LibraryEntry> listSuites();
/// A name of the library or a path to a file. Throws LoadError (id "scenario.not_found") listing close names.
std::filesystem::path findScenario(const std::string& nameOrPath);
std::filesystem::path findSuite(const std::string& nameOrPath);

}  // namespace rigor::scenario
