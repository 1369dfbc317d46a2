// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Loads on bodies that touch, and checks of what is claimed about them: contact forces that balance the
// loads, virtual motions in which the loads gain energy. The checks take the numbers of the problem and of
// the claim as they are, in exact rational arithmetic, and know nothing of how the claim was found.
//   Forces f_c on b at the points of contact balance the loads:
//     sum f_c + F = 0, sum (p_c - x) x f_c + T = 0 on every body, f_c in its friction cone.
//   A motion (v, w) of the bodies, with u_c the velocity of b beside that of a at the point p_c, gives for
//   forces that balance: sum f_c.u_c + P = 0 with the power P = sum F.v + T.w of the loads. So where
//   f_c.u_c >= 0 for every force of every cone and P > 0, no forces balance: the bodies move.
//   Source: Farkas, J. reine angew. Math. 124 (1902) 1; Livesley, Int. J. Numer. Meth. Eng. 12 (1978) 1853.
// The numbers of a scene are rounded, so both statements have a margin: forces balance up to 1e-11 of each
// body's own load; they do not where every choice, with all normal forces together up to 1e6 times all loads,
// leaves more than 1e-9 of some body's load. Anything between is undecided.
#pragma once

#include <optional>
#include <vector>

#include "validation/references/numerics/vector.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {

/// Bodies that may move, numbered from 0, their loads and the points where they touch.
struct LoadedBodies {
    struct LoadedBody {
        Vec3 center;         ///< centre of mass, world frame [m]
        Vec3 force, torque;  ///< load, torque about the centre of mass [N], [N m]
        double size = 1.0;   ///< length that torques are divided by for comparison with forces [m]
        double load = 1.0;   ///< magnitude of the load [N]
    };
    struct Contact {
        int a = -1, b = -1;  ///< bodies; -1: fixed
        int pair = 0;        ///< a number that is the same for all contacts of two bodies
        Vec3 point, normal;  ///< world [m]; from a to b, of length 1 up to rounding
        double friction = 0.0;
    };
    int dimension = 3;
    std::vector<LoadedBody> bodies;
    std::vector<Contact> contacts;
};

/// Velocities of the centres of mass and angular velocities, one for each body.
struct VirtualMotion {
    std::vector<numerics::Real3> velocity, spin;
};

/// The forces, one for each contact, on its body b, lie in their cones and balance the loads.
bool balance(const LoadedBodies& problem, const std::vector<numerics::Real3>& forces);

/// True if the loads gain more energy in this motion than any contact forces can take: nothing balances the
/// loads.
bool gainsEnergy(const LoadedBodies& problem, const VirtualMotion& motion);

/// A number that the sum of cost_c times the normal force of contact c is not below, for all forces that
/// balance the loads and that together are at most 1e6 times all loads [N]. The motion is the certificate.
double leastSum(const LoadedBodies& problem, const std::vector<int>& cost, const VirtualMotion& motion);

}  // namespace rigor::validation
