// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The program as a user calls it, and comparisons of scenarios by meaning.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"

namespace rigor::models::testing {

/// Relative: rounding of frames and of text.
inline constexpr double kTolerance = 1e-12;

struct Outcome {
    int code = -1;
    std::string out;  ///< standard output
    std::string err;
};
/// bin/rigor with these arguments.
Outcome rigor(const std::string& arguments);

/// An empty folder of its own for a test.
std::filesystem::path freshFolder(const std::string& name);
std::filesystem::path writeText(const std::filesystem::path& file, const std::string& text);

/// Imports a file that must be read; `options` go to the command line.
scenario::Scenario imported(const std::string& format, const std::filesystem::path& file,
                            const std::string& options = "");
/// The refusal of a file that must not be read: what is said on standard error.
std::string refusal(const std::string& format, const std::filesystem::path& file,
                    const std::string& options = "");

/// Simulates a scenario of one body whose duration is 10 s; its last line of numbers: t, pose, velocities.
std::vector<double> lastState(const std::filesystem::path& scenario);

/// RIGOR_DATA/models, or "" where it is not given.
std::filesystem::path modelsFolder();

/// Inertia of a body about its centre, in the axes of the world.
scenario::Mat3 inertiaInWorld(const scenario::Body& body);

void expectNear(const scenario::Vec3& a, const scenario::Vec3& b, double tolerance, const std::string& what);
void expectNear(const scenario::Mat3& a, const scenario::Mat3& b, double tolerance, const std::string& what);
/// Same bodies, masses, inertia in the world, motion, joints, laws of pairs and filters; frames of bodies may differ.
void expectSameMeaning(const scenario::Scenario& a, const scenario::Scenario& b, double tolerance);

}  // namespace rigor::models::testing
