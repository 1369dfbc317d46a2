// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Common part of the experiments of lab1-dfa: a body that is timed from one place to another, 2D scenarios
// that every engine can run, and findings that hold each engine to the measured time. Source: D. Angemi, F.
// Ingrassia, G. Di Silvestre, G. De Luca, lab1-dfa, Physics Laboratory 1, University of Catania, CC-BY 4.0.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "validation/import/csv.hpp"
#include "validation/import/importer.hpp"

namespace rigor::validation::lab {

/// Normal gravity at 37.5 degrees north [m/s^2]. Source: WGS 84, Somigliana's formula.
constexpr double kGravity = 9.7996;

/// A scenario's source: the authors, the licence, and what was changed.
std::string sourceText(const std::string& changed);

/// The engines that are held to a measured time.
nlohmann::ordered_json engines();

/// One finding for each engine; `bound` is "at_most" or "at_least" of `measured_position_final` [widths].
nlohmann::ordered_json findings(const std::string& statement, const char* bound, double value);

/// A part of a study: one scenario, all engines, `measured_position_final`.
nlohmann::ordered_json part(const std::string& name, const std::string& scenarioFile,
                            const nlohmann::ordered_json& findings);

/// Refuses what a data set of means can not do: throws std::invalid_argument where a selection or a part to
/// fit on is requested.
void requireWhole(const ImportRequest& request, const std::string& dataSet);

/// LICENSE of the folder or of the one that it lies in; "" without one.
std::filesystem::path licenceOf(const std::filesystem::path& from);

/// A number that has to be above zero. Throws LoadError: "import.value".
double positive(const CsvTable& table, std::size_t row, const std::string& column);

/// A pendulum in 2D that swings about the origin, seen from its lowest place to its lowest place.
struct Pendulum {
    std::string name, title, description, source;
    double mass = 1.0;             ///< [kg]
    double distance = 0.0;         ///< distance of the centre of mass from the axis [m]
    double inertia = 0.0;          ///< inertia about the centre of mass [kg m^2]
    double period = 0.0;           ///< measured [s]
    nlohmann::ordered_json shape;  ///< shape of the body, around its centre of mass
};
/// Starts at the lowest place with the speed of a swing of 5 degrees; after the measured period it is to be
/// there again, moving the same way. Five degrees make a period 0.05 % longer than small ones.
std::string swingText(const Pendulum& pendulum);
/// Distance from the lowest place of a pendulum that is `late` by a time [s], in widths of the body.
double lateness(const Pendulum& pendulum, double late, double width);

}  // namespace rigor::validation::lab
