// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The order of an integrator by fits over many step sizes: against closed forms, or between runs where there is none.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/pipeline/tests/scene.hpp"

namespace rigor::engine::test {

/// Slope of ln error against ln h by least squares.
inline double fittedOrder(const std::vector<double>& h, const std::vector<double>& error) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < h.size(); ++i) {
        const double lx = std::log(h[i]), ly = std::log(error[i]);
        n += 1;
        x += lx;
        y += ly;
        xx += lx * lx;
        xy += lx * ly;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/// State of a scene at `time` after `steps` equal steps.
using RunOf = std::function<Eigen::VectorXd(const std::string& integrator, int steps)>;

inline double orderAgainst(const RunOf& stateOf, const char* integrator, double time,
                           const Eigen::VectorXd& exact, const std::vector<int>& steps) {
    std::vector<double> h, error;
    for (const int n : steps) {
        h.push_back(time / n);
        error.push_back((stateOf(integrator, n) - exact).norm());
    }
    return fittedOrder(h, error);
}
/// The order that the differences of runs with n and 2 n steps have.
inline double orderBetweenRuns(const RunOf& stateOf, const char* integrator, double time,
                               const std::vector<int>& steps) {
    std::vector<double> h, error;
    for (const int n : steps) {
        h.push_back(time / n);
        error.push_back((stateOf(integrator, n) - stateOf(integrator, 2 * n)).norm());
    }
    return fittedOrder(h, error);
}

template <class S>
WorldDef<S> earthWith(const std::string& integrator) {
    WorldDef<S> def = earth<S>();
    def.integrator = integrator;
    return def;
}
template <class S>
void runSteps(World<S>& world, double time, int steps) {
    for (int i = 0; i < steps; ++i) world.step(time / steps);
}

/// Positions and velocities of bodies, one after the other.
template <class S>
Eigen::VectorXd placesAndVelocities(const World<S>& world, const std::vector<BodyId>& bodies) {
    std::vector<double> all;
    for (const BodyId id : bodies) {
        for (int k = 0; k < S::dim; ++k) all.push_back(world.pose(id).p[k]);
        for (int k = 0; k < S::dim; ++k) all.push_back(world.velocity(id)[k]);
    }
    return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace rigor::engine::test
