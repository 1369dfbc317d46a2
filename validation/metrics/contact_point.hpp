// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One point of contact in mechanics: where the impulse acts, how the two surfaces move against each other
// there, and how an impulse changes that. One implementation for the residuals of the contact law and for
// contact problems.
//     u = vB + wB x rB - vA - wA x rA,    du = K dp,    K = sum over the moving bodies of 1/m - [r] I^-1 [r]
// with the impulse p on B, the arms r from the centres of mass to the middle between the two surface points
// (one point for both, or equal and opposite impulses would make a couple), or to the moving body's own
// surface where the other takes no momentum: its arm then does not depend on gap or overlap.
// Source: Jean, The non-smooth contact dynamics method, 1999, section 2 (K is a diagonal block of the
// Delassus operator).
#pragma once

#include <optional>
#include <span>

#include "scenarios/model/scenario.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// Inverse mass [1/kg] and inverse inertia about the centre of mass, world axes [1/(kg m^2)]; zero for bodies
/// that no impulse moves. In 2D the inverse inertia is about z alone.
struct Mobility {
    double inverseMass = 0.0;
    scenario::Mat3 inverseInertia;
};
Mobility mobilityOf(const scenario::Scenario& scenario, int body, const BodyState& state);

class PointOfContact {
  public:
    /// `states` are those at which the engine found the contact. The contact names two bodies of the
    /// scenario.
    PointOfContact(const scenario::Scenario& scenario, const ContactPoint& contact,
                   std::span<const BodyState> states);

    const scenario::Vec3& normal() const { return normal_; }  ///< unit, A to B
    const scenario::Vec3& armA() const { return armA_; }      ///< arm from A's centre of mass, world axes [m]
    const scenario::Vec3& armB() const { return armB_; }
    /// Velocity of B's surface relative to A's [m/s], with the arms kept and the velocities of `states`.
    scenario::Vec3 velocity(std::span<const BodyState> states) const;
    /// Change of that velocity for an impulse on B [N s].
    scenario::Vec3 response(const scenario::Vec3& impulse) const;
    /// Largest dot(t, K t) over unit tangents t [1/kg].
    double tangentialMobility() const;
    double normalMobility() const { return dot(normal_, response(normal_)); }

  private:
    std::size_t a_, b_;
    int dimension_;
    scenario::Vec3 normal_, armA_, armB_;
    Mobility ofA_, ofB_;
};

/// Velocity of B's surface relative to A's over their bodies at the contact (Shape::surfaceVelocity), in the poses of
/// `states`; zero where neither moves. What friction opposes is this and PointOfContact::velocity().
scenario::Vec3 surfaceSlip(const scenario::Scenario& scenario, const ContactPoint& contact,
                           std::span<const BodyState> states);

/// Two unit vectors that make a right-handed frame with the unit normal. In 2D the first has z = 0.
std::array<scenario::Vec3, 2> tangentsOf(const scenario::Vec3& normal, int dimension);

/// True if the contact names two different bodies of the scenario, one of them dynamic, and its shapes.
bool isKnownContact(const scenario::Scenario& scenario, const ContactPoint& contact);
/// Coefficients of the two shapes' materials; those of the first shapes if the engine does not report which
/// touched.
scenario::PairCoefficients coefficientsOf(const scenario::Scenario& scenario, const ContactPoint& contact);

}  // namespace rigor::validation
