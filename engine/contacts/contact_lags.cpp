// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of a step's middle that turn, and landings within the step: for steps that lead from midpoint to midpoint.
#include "engine/contacts/contact_rows.hpp"

namespace rigor::engine {
namespace {

template <class S>
PointFrame<S> frameOf(const typename Contact<S>::Point& point, const typename S::Vec& normal) {
    return {point.rA, point.rB, normal};
}

/// Fraction of the step in which the gap of a point closes that lands in it at its own time; 0: none.
template <class S>
typename S::Real landingTime(const BodyArrays<S>& bodies, const ContactStep<S>& step,
                             const Contact<S>& contact, const typename Contact<S>::Point& point,
                             const RowLag<S>& lag) {
    using Real = typename S::Real;
    if (step.mayLand.empty() || point.separation <= kTouching<Real> || contact.speculative) return 0;
    if (step.bounces && contact.coefficients.restitution > 0) return 0;
    const std::uint32_t body = bodies.invMass[contact.bodyA] > 0 ? contact.bodyA : contact.bodyB;
    const Real closes = -step.h * (point.approach + lag.normal);
    if ((step.mayLand[body] & kMayLand) == 0 || closes < Real(0.25) * step.restingGap ||
        point.separation >= closes)
        return 0;
    return point.separation / closes;
}

}  // namespace

template <class S>
bool bouncesAhead(const BodyArrays<S>& bodies, const ContactStep<S>& step, const Contact<S>& contact,
                  const typename Contact<S>::Point& point) {
    if (!(contact.bounceTime > 0) || point.approach >= -step.restitutionThreshold) return false;
    if (point.separation <= kTouching<typename S::Real>) return false;
    if (contact.piece != kNullIndex && point.separation >= -step.h * point.approach) return false;
    const auto may = [&](std::uint32_t body) {
        return bodies.invMass[body] == 0 || (step.mayLand[body] & kMayBounce) != 0;
    };
    return may(contact.bodyA) && may(contact.bodyB);
}

template <class S>
void placeWithLags(const BodyArrays<S>& bodies, Contact<S>& contact, RowLags<S>& lags) {
    const auto last = contact.points;
    placePoints(bodies, contact);
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
        lags[i] = rowLag<S>(frameOf<S>(last[i], contact.lastNormal),
                            frameOf<S>(contact.points[i], contact.manifold.normal), bodies, contact);
}

template <class S>
void addLag(const BodyArrays<S>& bodies, const ContactStep<S>& step, const Contact<S>& contact,
            std::size_t index, RowLag<S>& lag, const Block<S>& block, Row<S>* rows) {
    if (bouncesAhead<S>(bodies, step, contact, contact.points[index])) {
        const typename Contact<S>::Point& point = contact.points[index];
        lag.landing = contact.piece != kNullIndex ? point.separation / (-step.h * point.approach)
                                                  : contact.bounceTime / step.h;
        lag.bounces = true;
        return;
    }
    rows[0].error += step.h * lag.normal;
    lag.landing = landingTime<S>(bodies, step, contact, contact.points[index], lag);
    if (lag.landing > 0) rows[0].bias = rows[0].relaxedBias = 0;
    const auto add = [](Row<S>& row, typename S::Real bias) {
        row.bias += bias;
        row.relaxedBias += bias;
    };
    if (block.restitution == 0) add(rows[0], lag.normal);
    for (int i = 1; i < block.rows; ++i) add(rows[i], lag.slip.dot(rows[i].lin));
}

template <class S>
void findLandings(const ContactList<S>& contacts, std::span<const std::uint32_t> own,
                  std::span<const RowLags<S>> lags, std::vector<LandingPoint<typename S::Real>>& landings) {
    landings.clear();
    if (lags.empty()) return;
    for (const std::uint32_t k : own)
        for (std::size_t i = 0; i < lags[k].size(); ++i)
            if (lags[k][i].landing > 0)
                landings.push_back({contacts[k].block[i], lags[k][i].landing, lags[k][i].bounces});
}

#define RIGOR_INSTANTIATE(S)                                                                             \
    template bool bouncesAhead<S>(const BodyArrays<S>&, const ContactStep<S>&, const Contact<S>&,        \
                                  const Contact<S>::Point&);                                             \
    template void placeWithLags<S>(const BodyArrays<S>&, Contact<S>&, RowLags<S>&);                      \
    template void addLag<S>(const BodyArrays<S>&, const ContactStep<S>&, const Contact<S>&, std::size_t, \
                            RowLag<S>&, const Block<S>&, Row<S>*);                                       \
    template void findLandings<S>(const ContactList<S>&, std::span<const std::uint32_t>,                 \
                                  std::span<const RowLags<S>>, std::vector<LandingPoint<S::Real>>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
