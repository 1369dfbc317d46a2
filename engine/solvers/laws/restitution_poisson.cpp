// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Poisson's law of impact, in two phases for all contacts at once [GlockerPfeiffer1995], [AnitescuPotra1997]:
//     compression   0 <= c_n _|_ n . u >= 0: every contact that is hit comes to rest or separates by itself
//     expansion     c_n gives back e c_n: that impulse is applied, and
//                   0 <= x_n _|_ n . u >= 0 for what more is needed where bodies would still approach
// Friction obeys Coulomb's law in each phase, with limits mu c_n and mu (e c_n + x_n) and the velocities at
// the end of the phase; so a contact may slide in one and stick, or slide back, in the other, which Newton's
// law (one phase) cannot express. Joints hold in both; what a bounded row has used of its bounds in
// compression is not there in expansion.
//
// Impacts take place before the forces of the step, from the velocities that the bodies hit with; afterwards
// the contacts keep the separation speed that they got, as with Newton's law: the forces of one step do not
// change the rebound. Without friction and with one contact both laws agree.
// Cost: two more solves in steps with impacts. Known limits: contacts that rest take part in the impact as
// inelastic ones; the two phases share one configuration, arms and normals.
#include <algorithm>
#include <vector>

#include "engine/solvers/restitution.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Poisson final : public Restitution<S> {
  public:
    using Real = typename S::Real;

    std::unique_ptr<Restitution<S>> clone() const override { return std::make_unique<Poisson>(*this); }
    bool solvesImpacts() const override { return true; }

    void impact(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities,
                const std::function<void()>& solve) override {
        saved_.resize(rows.rows.size());
        for (std::size_t i = 0; i < saved_.size(); ++i) {
            Row<S>& row = rows.rows[i];
            saved_[i] = {row.bias, row.lower, row.upper, Real(0)};
            row.impulse = 0;
        }
        forEachBounce(rows, [](Block<S>&, Row<S>& normal) { normal.bias = 0; });
        solve();
        beginExpansion(rows, velocities);
        solve();
        finish(rows, velocities);
    }

  private:
    struct Saved {
        Real bias, lower, upper;
        Real compression;
    };

    template <class Action>
    static void forEachBounce(ConstraintRows<S>& rows, Action action) {
        for (Block<S>& block : rows.blocks)
            if (block.kind == BlockKind::Contact && block.restitution > 0)
                action(block, rows.rows[block.first]);
    }

    void beginExpansion(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities) {
        for (std::size_t i = 0; i < saved_.size(); ++i) {
            Row<S>& row = rows.rows[i];
            saved_[i].compression = row.impulse;
            row.bias += row.softness * row.impulse;
            row.lower -= row.impulse;
            row.upper -= row.impulse;
            row.impulse = 0;
        }
        forEachBounce(rows, [&](Block<S>& block, Row<S>& normal) {
            block.appliedNormal = block.restitution * saved_[block.first].compression;
            applyRowImpulse<S>(normal, block, block.appliedNormal, velocities[block.a], velocities[block.b]);
        });
        shareWithMoments(rows);
    }

    /// Rolling and torsional friction have the normal impulse of the point whose block they follow.
    static void shareWithMoments(ConstraintRows<S>& rows) {
        Real applied = 0;
        for (Block<S>& block : rows.blocks) {
            if (block.kind == BlockKind::Contact) applied = block.appliedNormal;
            if (block.kind == BlockKind::Moment) block.appliedNormal = applied;
        }
    }

    void finish(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities) {
        for (std::size_t i = 0; i < saved_.size(); ++i) {
            Row<S>& row = rows.rows[i];
            row.impulse += saved_[i].compression;
            row.bias = saved_[i].bias;
            row.lower = saved_[i].lower;
            row.upper = saved_[i].upper;
        }
        forEachBounce(rows, [&](Block<S>& block, Row<S>& normal) {
            normal.impulse += block.appliedNormal;
            block.appliedNormal = 0;
            normal.bias = normal.relaxedBias =
                std::min(Real(0), -rowVelocity<S>(normal, velocities[block.a], velocities[block.b]));
        });
        shareWithMoments(rows);
    }

    std::vector<Saved> saved_;
};

}  // namespace

template <class S>
std::unique_ptr<Restitution<S>> makePoissonRestitution() {
    return std::make_unique<Poisson<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makePoissonRestitution, Restitution);

}  // namespace rigor::engine
