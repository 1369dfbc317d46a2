// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The joints that a step has not solved. Biases of joints are re-linearised in every iteration, at the poses that the
// velocities lead to (joint_set.hpp). That diverges where light links rotate far in a step, or where the joints hardly allow the
// motion, as in a flat net: the biases still change at the end, or the impulses do work. Independent parts of the
// problem with such joints are to be solved again with the linearisation at the start of the step.
// Cost: that of reading the joints and their rows; where some joint has diverged, O(blocks + bodies).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/pipeline/joint_set.hpp"
#include "engine/solvers/independent_parts.hpp"

namespace rigor::engine {

template <class S>
class JointConvergence {
  public:
    using Real = typename S::Real;

    /// Stores impulses and velocities before a solve. Allocates only when there are more rows or bodies than ever before.
    void remember(const JointSet<S>& joints, const ConstraintRows<S>& rows,
                  std::span<const Velocity<S>> velocities);
    /// Finds the parts that have diverged since remember(). Changes of a bias below `still` [m/s or rad/s] count as none.
    /// `ideal`: impulses of the joints do no work, and remember() has stored where they began.
    void find(const JointSet<S>& joints, const ConstraintRows<S>& rows,
              std::span<const Velocity<S>> velocities, Real still, bool ideal);

    /// Blocks of the parts whose joints do work, and of the others whose biases still change; in ascending order.
    std::span<const std::uint32_t> working() const { return working_; }
    std::span<const std::uint32_t> changing() const { return changing_; }

    /// Restores velocities and impulses of working() as they were stored; the impulses of equality rows become zero.
    void restart(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities) const;

  private:
    using Record = typename JointSet<S>::Record;
    /// Sums over the joints of a part.
    struct Sum {
        Real work = 0;  ///< twice the work of the equality rows since remember() [J]
        Real energy =
            0;  ///< twice the kinetic energy before and after, of a body once for each of its joints [J]
        BiasChange<Real> change;
    };
    void add(const Record& record, const ConstraintRows<S>& rows, std::span<const Velocity<S>> velocities,
             bool ideal, Sum& sum) const;
    static bool works(const Sum& sum) { return sum.work > Real(kMostWork) * sum.energy; }

    /// Largest work relative to the kinetic energy. A pendulum of length L has up to g h^2 / (2 L); a chain of 20
    /// links 6e-5.
    static constexpr double kMostWork = 0.01;
    static constexpr Real kSettled = Real(1e-3);  ///< change of a bias relative to the largest one

    std::vector<Real> impulses_;
    std::vector<Velocity<S>> velocities_;
    std::vector<std::uint32_t> units_;  ///< each block is a unit of its own
    IndependentParts parts_;
    std::vector<Sum> sums_;  ///< one for each part
    std::vector<std::uint32_t> working_, changing_;
};

}  // namespace rigor::engine
