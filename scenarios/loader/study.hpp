// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Study files: named ways of running side by side. A part of a study is a grid of scenarios, parameters, time
// steps and variants; a part may state a symptom: what one variant must show and another must not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {

/// Runs of a study are planned before the first begins, and each plan holds its scenario: more would not fit in memory.
inline constexpr int kMaxStudyRuns = 200000;

/// A way of running: an engine spec under a name of its own.
struct StudyVariant {
    std::string name, engine;
};

/// A fault that one variant shows and another cures, judged by a measured value.
struct StudySymptom {
    std::string fault, cure;  ///< names of variants
    std::string metric;
    bool growth = false;  ///< judge the exponent p of metric ~ (number of bodies)^p over the part's scenarios
    double faultAtLeast = 0.0, cureAtMost = 0.0;
};

/// A statement about the numbers of a part, judged when it has run.
struct StudyFinding {
    std::string statement, source;
    std::string variant, metric;
    /// Rows it is about: "scenario" (as the part names it), "dt" [s], or a parameter's or option's key, with
    /// its value; all of the variant's when empty.
    std::vector<std::pair<std::string, std::string>> where;
    std::optional<double> atLeast, atMost;  ///< every such row is within
};

/// Starts a little beside the scenario's, by which chaotic scenes are compared: each joined group of bodies
/// is moved as a whole. Uniform within plus and minus these, for each component.
struct StudyEnsemble {
    int members = 0;
    int seed = 0;
    double position = 0.0;  ///< [m]
    double angle = 0.0;     ///< [rad]
    double velocity = 0.0;  ///< [m/s]
    double spin = 0.0;      ///< [rad/s]
};

struct StudyPart {
    std::string name, title, description;
    std::vector<std::string> scenarios;  ///< names or files; relative to the study's own file
    std::vector<std::string> overrides;  ///< KEY=VALUE for every scenario
    /// Scenario keys and their values: every combination is run.
    std::vector<std::pair<std::string, std::vector<std::string>>> parameters;
    /// Spec keys and their values: every combination is run with every variant.
    std::vector<std::pair<std::string, std::vector<std::string>>> options;
    std::vector<StudyVariant> variants;
    std::vector<double> timeSteps;        ///< empty: the first of each scenario
    std::vector<std::string> metrics;     ///< columns; "name" or "name:subject"
    std::vector<std::string> symmetries;  ///< names of validation's table, or "*"; each row is also run so
    std::optional<StudyEnsemble> ensemble;
    double divergenceThreshold = 0.01;  ///< fraction of the scene's length: runs with a larger distance have
                                        ///< diverged
    std::optional<StudySymptom> symptom;
    std::vector<StudyFinding> findings;
};

struct Study {
    std::filesystem::path file;
    std::string name, title, description;
    bool leaveOutAbsent = false;  ///< variants of engines that are not installed are left out, not an error
    std::vector<StudyPart> parts;
};

/// Throws LoadError.
Study loadStudy(const std::filesystem::path& file);

/// The files of <library>/studies, sorted by name.
std::vector<LibraryEntry> listStudies();
/// A name of the library or a path to a file. Throws LoadError ("study.not_found").
std::filesystem::path findStudy(const std::string& nameOrPath);

}  // namespace rigor::scenario
