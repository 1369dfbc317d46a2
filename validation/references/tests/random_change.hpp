// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random parameters for a scenario: friction of both kinds, restitution, masses, moments of inertia,
// velocities, spins, strength and direction of gravity, duration, steps and size over wide ranges, zero
// included.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "validation/references/parts.hpp"
#include "validation/references/tests/other_units.hpp"

namespace rigor::validation::testing {

class Change {
  public:
    explicit Change(unsigned seed) : random_(seed) {}
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    bool chance(double share) { return uniform(0, 1) < share; }
    double decades(double reach) { return std::pow(10.0, uniform(-reach, reach)); }

    void apply(Scenario& s) {
        const bool many = chance(0.5);  // false: one property at a time
        const int one = static_cast<int>(uniform(0, 9));
        const auto picks = [&](int which) { return many ? chance(0.3) : one == which; };
        if (picks(0)) changeFriction(s);
        if (picks(1)) {
            for (auto& m : s.materials) m.restitution = coefficient(1.0);
            for (auto& p : s.pairs) p.restitution = coefficient(1.0);
        }
        if (picks(2)) forEachMass(s, 3, true);
        if (picks(3)) {
            const double factor = chance(0.3) ? 0.0 : decades(2), turn = chance(0.7) ? factor : decades(2);
            for (auto& b : s.bodies) {
                b.velocity = factor * b.velocity;
                b.angularVelocity = turn * b.angularVelocity;
            }
        }
        if (picks(4)) s.gravity = (chance(0.2) ? 0.0 : decades(2)) * s.gravity;
        if (picks(5)) s.duration *= decades(1.5);
        if (picks(6)) {
            const double factor = decades(1.5);
            for (double& dt : s.timeSteps) dt = std::min(factor * dt, s.duration);
        }
        if (picks(7)) {
            // Larger or smaller under the same gravity: in its own time, or in the time that it had.
            const double length = decades(3), time = chance(0.5) ? std::sqrt(length) : 1.0;
            const Vec3 gravity = s.gravity;
            Scenario other = s;
            if (inUnits(other, {length, time, chance(0.5) ? length * length * length : 1.0})) {
                s = other;
                s.gravity = gravity;
            }
        }
        if (picks(8)) {
            const Quat tilt =
                scenario::fromAxisAngle({0, 0, 1}, uniform(-1, 1) * std::pow(10.0, uniform(-3, 0)));
            if (chance(0.5))
                s.gravity = rotate(tilt, s.gravity);
            else
                forEachMass(s, 1, false);
        }
    }

  private:
    void changeFriction(Scenario& s) {
        const bool isOne = chance(0.6);
        const auto change = [&](auto& m) {
            m.friction = coefficient(2.0);
            m.staticFriction = isOne ? 0.0 : m.friction + coefficient(1.0);
        };
        for (auto& m : s.materials) change(m);
        for (auto& p : s.pairs) change(p);
    }
    void forEachMass(Scenario& s, double reach, bool withMass) {
        for (auto& b : s.bodies) {
            if (b.type != scenario::BodyType::Dynamic) continue;
            const double factor = decades(reach);
            if (withMass) b.massProperties.mass *= factor;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) b.massProperties.inertia(i, j) *= factor;
        }
    }
    double coefficient(double most) {
        const double kind = uniform(0, 1);
        if (kind < 0.2) return 0.0;
        if (kind < 0.3) return most;
        if (kind < 0.6) return most * std::pow(10.0, uniform(-4, 0));
        return uniform(0, most);
    }
    std::mt19937 random_;
};

}  // namespace rigor::validation::testing
