// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The collision of two bodies at one instant.
#pragma once

#include "engine/contacts/pre_solve.hpp"
#include "engine/contacts/shape_record.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/narrowphase/manifold.hpp"
#include "engine/solvers/solver.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Impulses at the points of one manifold by sequential impulses, whatever the world's solver: Newton's
/// restitution e on the normal velocities u_0 from before, n . u >= -e n . u_0 (impulse > 0 only with
/// equality), the world's friction law on the velocities of the surfaces, rolling and torsional friction. Other contacts and joints of the bodies are not considered.
template <class S>
class ImpactSolver {
  public:
    using Real = typename S::Real;
    ImpactSolver();

    /// The points of `manifold` become rows with the coefficients of `law`. bodies.invInertia is that of the instant.
    void begin(const BodyArrays<S>& bodies, const ShapeRecord<S>& a, const ShapeRecord<S>& b,
               const Manifold<S>& manifold, const PreSolveAnswer<S>& law);
    /// Changes the velocities of both bodies. Approaches slower than `threshold` do not bounce; `bounce`
    /// false: none does. Returns the sum of the normal impulses [N s].
    Real solve(BodyArrays<S>& bodies, FrictionLaw<S> friction, Real threshold, bool bounce);
    /// Sum of the friction impulses of the last solve on B [N s].
    typename S::Vec frictionImpulse() const;

  private:
    ClonePtr<Solver<S>> solver_;
    ConstraintRows<S> rows_;
    Real restitution_ = 0;
};

}  // namespace rigor::engine
