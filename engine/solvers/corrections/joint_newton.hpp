// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Newton's method for the positions of joints. Where their bodies are now C is found, and the bodies move along
// M^-1 J^T lambda with
//     K lambda = -C,   K = J M^-1 J^T                   all joints that are connected at once (joints/joint_system.hpp)
// Connected joints are a part. What becomes of a part does not depend on the others. Where Newton's method has been too
// far off to bring anything, or there are no factors, a part is corrected joint by joint, which is slow and sure. Where
// further iterations come no nearer, as in nets, which have more rows than motions, K is made larger on its diagonal, as
// by Levenberg and Marquardt.
//
// An impulse along a row r at a body of a part moves all of the part while the joints hold:
//     u = M^-1 (r^T - J^T K^-1 J M^-1 r^T)
// Cost: an iteration is linear in the joints of chains and trees, and so is a motion u; see joint_system.cpp for loops.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/core/disjoint_sets.hpp"
#include "engine/core/ids.hpp"
#include "engine/solvers/joints/joint_system.hpp"
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {

/// Moves the bodies of a joint by impulses times a second, one for each row that holds.
template <class S>
void moveJoint(PositionProblem<S>& problem, const JointPositions<S>& joint, const typename S::Real* lambda) {
    for (std::size_t r = 0; r < joint.block.rows; ++r) problem.move(joint.block, joint.row[r], lambda[r]);
}

template <class S>
class JointNewton {
  public:
    using Real = typename S::Real;

    /// Joint error that Newton's method squares [m] or [rad].
    static constexpr Real kNear = Real(1e-5);
    /// Error that rounding leaves [m] or [rad].
    static constexpr Real kRounding = Real(1000) * std::numeric_limits<Real>::epsilon();

    /// Connected joints.
    struct Part {
        std::uint32_t first = 0, last = 0;  ///< range of the members, the last one excluded
        /// Largest error of a row that holds, where the joints were evaluated last, and before that.
        Real error = 0, before = std::numeric_limits<Real>::infinity();
        Real damping = 0;      ///< fraction of K's diagonal that is added to it, where there are loops
        bool settled = false;  ///< rounding is reached
        bool looped = false;   ///< some joint closes a loop
        bool hangs = false;    ///< some joint connects it to a body that no impulse moves
        bool slow = false;     ///< its joints are corrected one by one
        bool holds = false;    ///< its joints hold while contacts and limits are pushed
        bool pushed = false;   ///< a contact or a limit at one of its bodies was
        std::size_t size() const { return last - first; }
    };
    /// Motion of a body by a unit impulse.
    struct Reach {
        std::uint32_t body;
        Velocity<S> motion;
    };

    /// Finds the joints as they are now; held() are those that have equality rows.
    void evaluateAll(const PositionProblem<S>& problem);
    std::vector<JointPositions<S>>& joints() { return joints_; }
    std::vector<std::size_t>& held() { return held_; }
    /// Some joint has limits.
    bool limited() const { return limited_; }
    /// Factors K of all joints that are held, as `joints` were evaluated. False: there are no factors.
    bool factor(const std::vector<JointPositions<S>>& joints);
    /// Numbers of the k-th of held() are at(k).
    JointSystem<S>& system() { return system_; }

    /// Finds the parts of the joints that are held, and their errors as they were evaluated.
    void findParts();
    std::span<Part> parts() { return parts_; }
    /// The part of a body that impulses move; null: no equality rows act on it.
    Part* partOf(std::uint32_t body) {
        const std::uint32_t part = body < partOfBody_.size() ? partOfBody_[body] : kNullIndex;
        return part == kNullIndex ? nullptr : &parts_[part];
    }
    /// Whether there are factors.
    bool fits() const { return fits_; }

    /// The caller has evaluated the joints for the first iteration, if `evaluated`; each of the others evaluates them itself.
    /// Iterations end where rounding is reached.
    void approach(PositionProblem<S>& problem, Part& part, int iterations, bool evaluated);
    /// Further iterations with damping, where the joints were further apart than `near` before the last one.
    void approachFurther(PositionProblem<S>& problem, Part& part, int iterations, Real near);

    /// Appends to `out` the motions by a unit impulse along `row` while joints hold, as far as their parts have factors;
    /// returns how far the row goes by them [1/kg] or [1/(kg m^2)].
    Real reach(const Block<S>& block, const Row<S>& row, std::vector<Reach>& out);

  private:
    static constexpr Real kLeastDamping = Real(1e-3), kMostDamping = Real(0.3);

    static Real errorOf(const JointPositions<S>& joint);
    static void renewDamping(Part& part);
    std::size_t jointOf(std::uint32_t member) const { return held_[members_[member]]; }
    void evaluate(const PositionProblem<S>& problem, Part& part);
    void move(PositionProblem<S>& problem, Part& part);
    void moveTogether(PositionProblem<S>& problem, const Part& part);
    void moveOneByOne(PositionProblem<S>& problem, const Part& part);
    static void damp(JointPositions<S>& joint, Real damping);
    void hold(const Part& part, const Block<S>& block, const Row<S>& row);
    void takeMotions(const Block<S>& block, std::vector<Reach>& out);
    void takeMotions(const Part& part, std::vector<Reach>& out);

    std::vector<JointPositions<S>> joints_;
    std::vector<std::size_t> held_;
    bool limited_ = false;
    bool fits_ = false;  ///< the system can have factors
    std::vector<typename JointSystem<S>::Item> items_;
    JointSystem<S> system_;
    DisjointSets sets_;                 ///< bodies that joints connect
    std::vector<std::size_t> closing_;  ///< joints that close loops
    std::vector<Part> parts_;
    std::vector<std::uint32_t> members_;     ///< indices of held_, part by part
    std::vector<std::uint32_t> partOfBody_;  ///< kNullIndex: none
    std::vector<Velocity<S>> motion_;        ///< motions of bodies that reach() finds; else zero
};

}  // namespace rigor::engine
