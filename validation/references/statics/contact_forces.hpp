// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Looks for contact forces that balance given loads, or for the motion that shows that none do: a linear
// program (numerics/linear_program.hpp) over rays of the friction cones. A cone has two rays in 2D. In 3D it
// starts with eight, and each solution adds, at every contact, the ray of the round cone that it violates
// most, until forces or motion satisfy the round cones (cutting planes: Kelley, J. SIAM 8 (1960) 703). A
// result counts only with the certificate of force_balance.hpp.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "validation/references/numerics/linear_program.hpp"
#include "validation/references/statics/force_balance.hpp"

namespace rigor::validation {

class ContactForces {
  public:
    explicit ContactForces(const LoadedBodies& problem);

    enum class Verdict { Balance, Move, Undecided };
    Verdict verdict() const { return verdict_; }

    /// The sum of the normal forces [N] over the contacts of a pair, by the pair's number, where all forces
    /// that balance the loads agree on it. It may be called only if they balance.
    std::map<int, double> determinate();

  private:
    using Real = numerics::Real;
    using Real3 = numerics::Real3;
    struct Ray {
        std::size_t contact = 0;
        Real3 direction;  ///< force on b; normal part 1
        Real scale = 1;   ///< force of a unit of the unknown [N]
    };
    void addRay(std::size_t contact, Real3 direction);
    /// Adds the rays of the round cones that the motion violates; `cost` as in leastSum. False: none.
    bool addViolated(const VirtualMotion& motion, const std::vector<int>& cost);
    VirtualMotion motion() const;
    std::vector<Real3> forces() const;
    void decide();
    /// A certified lower bound of the sum of cost times normal force that lies within rounding of the least
    /// value found; empty where there is none.
    std::optional<double> least(const std::vector<int>& cost);
    void noteForces();
    bool agreed(int pair) const;

    const LoadedBodies& problem_;
    numerics::LinearProgram program_;
    std::vector<Ray> rays_;
    Verdict verdict_ = Verdict::Undecided;
    double loads_ = 0.0;
    std::map<int, std::pair<double, double>> range_;  ///< range of the forces of the points visited, by pair
};

}  // namespace rigor::validation
