// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plain programs: scenes written against an engine's library alone, the way its manual does it, whose
// trajectories the adapter has to reproduce for the scenario file of the same scene. A program and the
// adapter have only the library in common, and the numbers in the two files; nothing here converts or builds
// anything.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::plain {

using adapter::BodyState;
using scenario::Quat;
using scenario::Scenario;
using scenario::Vec3;

/// States of all bodies of the scenario, by its index, before the first step and after each one.
using Trajectory = std::vector<std::vector<BodyState>>;

/// A scenario file by its path from the source tree's root, "scenarios/library/3d/box_stack.json". Throws
/// std::runtime_error where the harness would push bodies: a plain program has no harness.
inline Scenario load(const std::string& path, const std::vector<std::string>& overrides = {}) {
    const auto file = std::filesystem::path(RIGOR_SOURCE_DIR) / path;
    Scenario loaded = scenario::loadScenario(file, overrides).scenario;
    if (!loaded.forces.empty() || !loaded.events.empty())
        throw std::runtime_error(path + ": found forces or events, expected none: the harness applies them");
    return loaded;
}

/// The adapter's trajectory of a scenario: engine and settings by a spec ("bullet:preset=matched"), the
/// module by the registry as the harness finds it (RIGOR_ADAPTER_PATH). `holds` receives World::jointHolds
/// of joint 0 after each step where it is not null.
inline Trajectory adapterRun(const std::string& specText, const Scenario& scene, double dt, int steps,
                             std::vector<bool>* holds = nullptr) {
    const adapter::EngineSpec spec = adapter::parseSpec(specText);
    const adapter::LoadedEngine engine = adapter::loadEngine(spec);
    const auto world = engine->dynamics()->build(scene, dt, adapter::resolveSettings(spec, *engine));
    Trajectory trajectory(static_cast<std::size_t>(steps) + 1, std::vector<BodyState>(scene.bodies.size()));
    world->readStates(trajectory[0]);
    for (int i = 1; i <= steps; ++i) {
        world->step();
        world->readStates(trajectory[i]);
        if (holds != nullptr) holds->push_back(world->jointHolds(0));
    }
    return trajectory;
}

/// Largest differences that are allowed; zero requires equal bits. Orientations are compared by components,
/// up to the quaternion's sign: libraries that keep matrices give them with a rounding of their own.
struct Bounds {
    double position = 0.0;         ///< [m]
    double orientation = 0.0;      ///< bound of a quaternion's component [1]
    double velocity = 0.0;         ///< [m/s]
    double angularVelocity = 0.0;  ///< [rad/s]
};

inline double largest(const Vec3& d) {
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
}
inline double largest(const Quat& a, const Quat& b) {
    const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0.0 ? -1.0 : 1.0;
    return std::max({std::abs(a.w - sign * b.w), std::abs(a.x - sign * b.x), std::abs(a.y - sign * b.y),
                     std::abs(a.z - sign * b.z)});
}

/// Success where every state of every step agrees; otherwise reports the first difference (step, body,
/// quantity) and the largest of the run. A NaN agrees with nothing.
inline ::testing::AssertionResult same(const Trajectory& plain, const Trajectory& adapter,
                                       const Bounds& bounds = {}) {
    if (plain.size() != adapter.size() || plain.empty())
        return ::testing::AssertionFailure()
               << plain.size() << " states of the plain program, " << adapter.size() << " of the adapter";
    const char* const names[] = {"position", "orientation", "velocity", "angular velocity"};
    const double allowed[] = {bounds.position, bounds.orientation, bounds.velocity, bounds.angularVelocity};
    double worst[4] = {};
    std::string first;
    for (std::size_t step = 0; step < plain.size(); ++step) {
        if (plain[step].size() != adapter[step].size())
            return ::testing::AssertionFailure() << plain[step].size() << " bodies of the plain program, "
                                                 << adapter[step].size() << " of the adapter";
        for (std::size_t body = 0; body < plain[step].size(); ++body) {
            const BodyState &p = plain[step][body], &a = adapter[step][body];
            const double found[] = {largest(p.position - a.position), largest(p.orientation, a.orientation),
                                    largest(p.velocity - a.velocity),
                                    largest(p.angularVelocity - a.angularVelocity)};
            for (int k = 0; k < 4; ++k) {
                if (!(found[k] <= worst[k])) worst[k] = found[k];
                if (found[k] <= allowed[k] || !first.empty()) continue;
                char text[160];
                std::snprintf(text, sizeof text, "step %zu, body %zu: %s differs by %.17g, allowed %.3g",
                              step, body, names[k], found[k], allowed[k]);
                first = text;
            }
        }
    }
    char text[200];
    std::snprintf(text, sizeof text, "largest differences: %.3g m, %.3g, %.3g m/s, %.3g rad/s", worst[0],
                  worst[1], worst[2], worst[3]);
    if (first.empty()) return ::testing::AssertionSuccess() << text;
    return ::testing::AssertionFailure() << first << "; " << text;
}

/// Distance that a body moves over a run [m]: a comparison of scenes in which nothing happens proves nothing.
inline double travel(const Trajectory& trajectory, std::size_t body) {
    double most = 0.0;
    for (const auto& states : trajectory)
        most = std::max(most, norm(states[body].position - trajectory.front()[body].position));
    return most;
}

}  // namespace rigor::plain
