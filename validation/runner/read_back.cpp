// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/read_back.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace rigor::validation {
namespace {

using adapter::BodyReadBack;
using adapter::Quat;
using adapter::Vec3;
using results::ReadBackRow;
using scenario::Body;
using scenario::BodyType;
using scenario::Scenario;

constexpr std::size_t kFewBodies = 12;       ///< number of bodies up to which every body has its rows
constexpr std::size_t kMostMismatches = 50;  ///< rows of mismatches in larger scenes

/// `scale` turns the relative tolerance into an absolute one; not below 1e-3 of an SI unit, so that values
/// near zero are not held to bits.
ReadBackRow row(const char* quantity, const std::string& subject, double expected, double found, double error,
                double scale, double tolerance) {
    const bool ok = std::isfinite(error) && error <= tolerance * std::max(scale, 1e-3);
    return {quantity, subject, expected, found, error, ok};
}

ReadBackRow scalar(const char* quantity, const std::string& subject, double expected, double found,
                   double tolerance) {
    return row(quantity, subject, expected, found, std::abs(found - expected), std::abs(expected), tolerance);
}

ReadBackRow vector(const char* quantity, const std::string& subject, Vec3 expected, Vec3 found,
                   double tolerance) {
    return row(quantity, subject, norm(expected), norm(found), norm(found - expected), norm(expected),
               tolerance);
}

ReadBackRow orientation(const std::string& subject, Quat e, Quat f, double tolerance) {
    const auto distance = [&](double sign) {
        return norm(Quat{f.w - sign * e.w, f.x - sign * e.x, f.y - sign * e.y, f.z - sign * e.z});
    };
    // q and -q are the same orientation
    return row("orientation", subject, norm(e), norm(f), std::min(distance(1.0), distance(-1.0)), 1.0,
               tolerance);
}

ReadBackRow inertia(const Body& body, const BodyReadBack& found, int dimension, double tolerance) {
    const auto& e = body.massProperties.inertia;
    double worst = 0.0, scale = 0.0, expectedAt = 0.0, foundAt = 0.0;
    for (int i = dimension == 2 ? 2 : 0; i < 3; ++i)
        for (int j = dimension == 2 ? 2 : 0; j < 3; ++j) {
            scale = std::max(scale, std::abs(e(i, j)));
            const double error = std::abs(found.inertia(i, j) - e(i, j));
            if (error >= worst || std::isnan(error)) {
                worst = error;
                expectedAt = e(i, j);
                foundAt = found.inertia(i, j);
            }
        }
    // Relative to the largest component alone: small bodies have small inertias.
    const bool ok = std::isfinite(worst) && worst <= tolerance * scale;
    return {"inertia", body.name, expectedAt, foundAt, worst, ok};
}

std::vector<ReadBackRow> bodyRows(const Scenario& s, const Body& body, const BodyReadBack& found,
                                  double tolerance) {
    const std::string& name = body.name;
    std::vector<ReadBackRow> rows{
        scalar("mass", name, body.massProperties.mass, found.mass, tolerance),
        vector("position", name, body.pose.position, found.state.position, tolerance),
        orientation(name, body.pose.orientation, found.state.orientation, tolerance)};
    if (body.type != BodyType::Static) {
        rows.push_back(vector("velocity", name, body.velocity, found.state.velocity, tolerance));
        rows.push_back(
            vector("angular_velocity", name, body.angularVelocity, found.state.angularVelocity, tolerance));
    }
    if (body.type == BodyType::Dynamic) {
        rows.push_back(vector("com", name, body.massProperties.centerOfMass, found.centerOfMass, tolerance));
        rows.push_back(inertia(body, found, s.dimension, tolerance));
        rows.push_back(vector("gravity", name, body.gravityScale * s.gravity, found.gravity, tolerance));
    }
    return rows;
}

/// Rows for a scene of many bodies: the worst row of each quantity, and the mismatches.
std::vector<ReadBackRow> condensed(const std::vector<ReadBackRow>& all) {
    std::map<std::string, ReadBackRow> worst;
    std::vector<ReadBackRow> rows;
    for (const ReadBackRow& r : all) {
        if (!r.ok && rows.size() < kMostMismatches) rows.push_back(r);
        const auto [it, isNew] = worst.emplace(r.quantity, r);
        if (!isNew && (!(r.error <= it->second.error))) it->second = r;
    }
    for (const auto& [quantity, r] : worst)
        if (r.ok) rows.push_back(r);
    return rows;
}

}  // namespace

double readBackTolerance(const std::string& precision) {
    return precision == "f32" ? 1e-5 : 1e-9;
}

std::vector<ReadBackRow> compareReadBack(const Scenario& scenario, const adapter::ReadBack& readBack,
                                         double tolerance) {
    const std::size_t count = scenario.bodies.size();
    if (readBack.bodies.size() != count) return {scalar("bodies", "", count, readBack.bodies.size(), 0.0)};
    std::vector<ReadBackRow> rows;
    for (std::size_t i = 0; i < count; ++i) {
        auto some = bodyRows(scenario, scenario.bodies[i], readBack.bodies[i], tolerance);
        rows.insert(rows.end(), some.begin(), some.end());
    }
    if (count > kFewBodies) rows = condensed(rows);
    for (const adapter::PairReadBack& pair : readBack.pairs) {
        const auto expected = pairCoefficients(scenario, pair.materialA, pair.materialB);
        const std::string subject =
            scenario.materials[pair.materialA].name + "|" + scenario.materials[pair.materialB].name;
        rows.push_back(scalar("friction", subject, expected.friction, pair.friction, tolerance));
        rows.push_back(scalar("restitution", subject, expected.restitution, pair.restitution, tolerance));
    }
    return rows;
}

std::string readBackProblem(const std::vector<ReadBackRow>& rows,
                            const std::vector<results::LedgerRow>& ledger) {
    for (const ReadBackRow& r : rows) {
        const bool announced = std::any_of(ledger.begin(), ledger.end(), [&](const results::LedgerRow& l) {
            return l.topic == r.quantity && l.realisation != "exact";
        });
        if (r.ok || announced) continue;
        char text[160];
        std::snprintf(text, sizeof text, ": found %.10g, expected %.10g", r.found, r.expected);
        return "read-back, " + r.quantity + (r.subject.empty() ? "" : " of " + r.subject) + text;
    }
    return "";
}

}  // namespace rigor::validation
