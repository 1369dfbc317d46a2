// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rigid bodies that joints hold together, in open chains and closed loops, planar or in 3D: Newton's and
// Euler's laws for every body with the forces of the joints as Lagrange multipliers,
//   m v' = f + sum j_v^T lambda,  I w' + w x I w = t + sum j_w^T lambda,
// and every joint's equations g = 0 differentiated twice, g'' = -2 c g' - c^2 g. The exact motion has
// g = g' = 0 throughout, so the right side vanishes on it; it only keeps rounding from adding up.
// Equations that follow from others (loops in a plane, Bricard's) are left out: a set of independent ones is
// chosen at the start by elimination with pivoting.
// Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, chapter 11; Baumgarte,
// Comp. Meth. Appl. Mech. Eng. 1 (1972) 1.
#pragma once

#include <vector>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation {

class MechanismMotion {
  public:
    using Real = numerics::Real;
    using Real3 = numerics::Real3;
    using Real33 = numerics::Real33;
    static constexpr std::size_t kStride = 13;  ///< position, quaternion, velocity, body rates of each body

    struct Member {
        Real mass = 1;
        Real33 inertia{};     ///< inertia about the centre of mass, body axes
        Real3 gravity;        ///< [m/s^2]
        bool driven = false;  ///< keeps its velocity and its world angular velocity, whatever acts on it
    };
    /// A point or a direction fixed in a body (index) or in the world (-1).
    struct Fixed {
        int body = -1;
        Real3 local;  ///< arm from the centre of mass, body axes
    };
    /// One scalar equation between two bodies.
    struct Equation {
        enum class Kind {
            Point,      ///< e . (p_b - p_a) = 0 with e fixed in the world
            Offset,     ///< t_a . (p_b - p_a) = 0 with t_a fixed in a
            Direction,  ///< t_a . n_b = 0
            Distance,   ///< |p_b - p_a| = l
        };
        Kind kind = Kind::Point;
        Fixed a, b;  ///< points; directions for Direction
        Real3 axis;  ///< e, or t_a in body axes of a
        Real length = 0;
        int joint = 0;  ///< joint that the equation belongs to
    };
    struct Spring {
        Fixed a, b;
        Real stiffness = 0, damping = 0, restLength = 0;
    };
    /// Constant force at the centre of mass and torque, world axes, during [start, end).
    struct Load {
        int body = 0;
        Real3 force, torque;
        Real start = 0, end = 1e300L;
    };

    std::vector<Member> members;
    std::vector<Equation> equations;
    std::vector<Spring> springs;
    std::vector<Load> loads;
    bool planar = false;  ///< the equations leave out what planar motion keeps by itself

    /// Chooses independent equations at `y`; `rate` is the c of the top [1/s].
    void prepare(const numerics::OdeState& y, Real rate);
    /// dy/dt for integrateOde.
    void derivative(Real t, const numerics::OdeState& y, numerics::OdeState& d) const;
    /// Largest |g| and |g'| over all equations, those left out too; sines of angles count as lengths at the
    /// distance `size`.
    Real gap(const numerics::OdeState& y, Real size) const;
    Real gapRate(const numerics::OdeState& y, Real size) const;
    /// Number of free motions: 6 (planar: 3) per body less the independent equations.
    std::size_t freedom() const;
    /// Cost of one call of derivative(), in units of about one multiplication.
    std::size_t operations() const;

  private:
    struct Spot {  ///< a point: where, how fast, the part of its acceleration that velocities give
        Real3 arm, place, velocity, bend;
    };
    /// g, its rate, what g'' is without accelerations, and the coefficients of (v', w') of both bodies.
    struct Row {
        Real value = 0, rate = 0, bend = 0;
        int a = -1, b = -1;
        Real3 va, wa, vb, wb;
    };
    struct Pose {
        Real33 turn, inverse{};       ///< body to world; of the inertia, world axes
        Real3 place, velocity, spin;  ///< world
    };
    std::vector<Pose> posesOf(const numerics::OdeState& y) const;
    static Spot spotOf(const std::vector<Pose>& poses, const Fixed& point);
    static Real3 turned(const std::vector<Pose>& poses, int body, Real3 local);
    Row rowOf(const std::vector<Pose>& poses, const Equation& equation) const;
    void push(Real t, const std::vector<Pose>& poses, std::vector<Real3>& force,
              std::vector<Real3>& torque) const;
    /// J M^-1 J^T over `rows`, with M^-1 J^T for each row.
    std::vector<std::vector<Real>> gram(const std::vector<Pose>& poses, const std::vector<Row>& rows,
                                        std::vector<Row>& inverse) const;

    std::vector<Real33> inverses_;  ///< inverse inertias, body axes
    std::vector<std::size_t> chosen_;
    Real rate_ = 0;
};

}  // namespace rigor::validation
