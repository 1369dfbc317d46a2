// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario's exact pair coefficients and collision filter inside Box2D, which would take sqrt(mu_a mu_b)
// and max(e_a, e_b).
#pragma once

#include <box2d/box2d.h>

#include "adapters/interface/pair_table.hpp"

namespace rigor::box2d {

/// Data behind b2FixtureUserData::pointer.
struct FixtureTag {
    int body = 0, shape = 0, material = 0;
    const scenario::Shape* source = nullptr;  ///< null where its surface does not move
    adapter::Pose frame = {};                 ///< the scenario's body frame in that of the Box2D body [m]
};

/// Data behind b2BodyUserData::pointer: the force and torque of the coming step [Box2D units].
struct BodyTag {
    b2Vec2 force{0.0f, 0.0f};
    float torque = 0.0f;
};

class ContactRules final : public b2ContactListener, public b2ContactFilter {
  public:
    struct Settings {
        float dt = 0.0f;
        bool correctRestitution = false;
        float restitutionThreshold = 1.0f;  ///< [Box2D lengths / s]
        double scale = 1.0;                 ///< Box2D lengths per metre
    };
    ContactRules(const adapter::PairTable& pairs, const Settings& settings)
        : pairs_(pairs), settings_(settings) {}

    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;
    void PreSolve(b2Contact* contact, const b2Manifold* old) override;

    /// Friction and restitution that a contact of these two materials ends up with in Box2D: two overlapping
    /// discs approach each other in a world of their own, which takes one step under these rules.
    scenario::PairCoefficients probe(int materialA, int materialB) const;

  private:
    float restitutionFor(b2Contact& contact, float restitution) const;
    float tangentSpeed(const b2Contact& contact) const;

    const adapter::PairTable& pairs_;
    Settings settings_;
};

}  // namespace rigor::box2d
