// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Impacts within a step of bodies that others hold, where steps lead from midpoint to midpoint: a block that rocks lands on
// one edge while it turns about another. A row that closes the gap s by the end of the step, J v_1 >= -s / h, would slow the
// body in one step and stop it in the next: two blows of which neither is the impact. Instead
//     tau = s / (-h J v_0)                          fraction of the way between the midpoints until the gap is closed
//     v = v_0 + h M^-1 f + M^-1 J^T (1/2 + tau) p   p the last impulses of what holds the body until it lands
//     J v_1 >= 0                                    the law of impact for all its contacts, from v on
//     q_M1 = q_M + h (tau v_0 + (1 - tau) v_1)
// v_0 is that of the beginning of the step, half a step before q_M.
// For bodies that touch none but bodies that take no impulses: what else hangs on them would have to move as well. Bodies
// that nothing holds have flight_impacts.hpp.
#include <algorithm>

#include "engine/pipeline/step.hpp"

namespace rigor::engine {
namespace {

template <class S>
Landing<S>* findLanding(std::vector<Landing<S>>& landings, std::uint32_t body) {
    const auto found = std::find_if(landings.begin(), landings.end(),
                                    [&](const Landing<S>& landing) { return landing.body == body; });
    return found == landings.end() ? nullptr : &*found;
}

/// The body of a block that impulses move: the other one does not move with those that may land.
template <class S>
std::uint32_t movedBody(const BodyArrays<S>& bodies, const Block<S>& block) {
    return bodies.invMass[block.a] > 0 ? block.a : block.b;
}

}  // namespace

template <class S>
void Step<S>::findLandingBodies() {
    std::vector<std::uint8_t>& may = state_.mayLand;
    may.assign(bodies_.size(), 0);
    state_.landings.clear();
    if (!locatesLandings()) return;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        may[i] = bodies_.invMass[i] > 0 ? (state_.bound[i] ? kMayLand | kMayBounce : kMayBounce) : 0;
    for (const auto& record : joints_.records()) may[record.joint.a] = may[record.joint.b] = 0;
    const auto mayNotLand = [&](std::uint32_t body) { may[body] &= kMayBounce; };
    for (const auto& record : world_.forces.records()) {
        mayNotLand(record.place.a);
        mayNotLand(record.place.b);
    }
    for (const Contact<S>& contact : contacts_.list())
        if (contact.manifold.count > 0 && bodies_.invMass[contact.bodyA] > 0 &&
            bodies_.invMass[contact.bodyB] > 0) {
            mayNotLand(contact.bodyA);
            mayNotLand(contact.bodyB);
        }
    state_.before.assign(bodies_.velocity.begin(), bodies_.velocity.end());
}

/// The contacts that hold a body until it lands act for that part of the step, before the impact, with their last impulses.
template <class S>
void Step<S>::beginLandings() {
    std::vector<Landing<S>>& landings = state_.landings;
    landings.clear();
    state_.held.clear();
    state_.bounces.clear();
    for (const LandingPoint<Real>& point : contactModel_.landings()) {
        const Block<S>& block = rows_.blocks[point.block];
        if (point.bounces) {
            state_.bounces.push_back(point);
            for (const std::uint32_t body : {block.a, block.b})
                if (bodies_.invMass[body] > 0) state_.mayLand[body] |= kBounces;
            continue;
        }
        const std::uint32_t body = movedBody<S>(bodies_, block);
        Landing<S>* found = findLanding<S>(landings, body);
        if (found == nullptr) found = &landings.emplace_back(Landing<S>{body, Real(0), Real(0), {}});
        found->time += point.time;
        found->points += 1;
    }
    if (!state_.bounces.empty()) {
        state_.startImpulses.resize(rows_.rows.size());
        for (std::size_t i = 0; i < rows_.rows.size(); ++i) state_.startImpulses[i] = rows_.rows[i].impulse;
    }
    const auto bounces = [&](const Landing<S>& landing) {
        return (state_.mayLand[landing.body] & kBounces) != 0;
    };
    landings.erase(std::remove_if(landings.begin(), landings.end(), bounces), landings.end());
    for (Landing<S>& landing : landings) {
        landing.time /= landing.points;
        state_.mayLand[landing.body] |= kLands;
    }
    if (landings.empty()) return;
    for (const Block<S>& block : rows_.blocks) {
        const std::uint32_t body = movedBody<S>(bodies_, block);
        if (block.kind != BlockKind::Contact || (state_.mayLand[body] & kLands) == 0) continue;
        const Real time = findLanding<S>(landings, body)->time;
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Real held = (Real(0.5) + time) * rows_.rows[i].impulse;
            if (held == 0) continue;
            applyRowImpulse<S>(rows_.rows[i], block, held, bodies_.velocity[block.a],
                               bodies_.velocity[block.b]);
            state_.held.push_back({i, held});
        }
    }
}

/// Bodies that have landed in this step go where they would be if they had kept their velocity until they did.
template <class S>
void Step<S>::placeLandings() {
    delayBounces();
    for (const auto& [row, impulse] : state_.held) rows_.rows[row].impulse += impulse;
    for (Landing<S>& landing : state_.landings) {
        const Velocity<S>&before = state_.before[landing.body], &after = motion_.used()[landing.body];
        landing.change = {typename S::Vec(before.v - after.v), Ang(before.w - after.w)};
        const Velocity<S> more{typename S::Vec(landing.time * landing.change.v),
                               Ang(landing.time * landing.change.w)};
        motion_.carry(bodies_.pose[landing.body], more, state_.substepSize);
        motion_.replaceUsed(landing.body, {typename S::Vec(after.v + more.v), Ang(after.w + more.w)});
    }
}

/// The way from the next midpoint back to the end of the step is that of the velocity after the landing, as far as there was
/// one before the end.
template <class S>
void Step<S>::shortenLandings() {
    shortenBounces();
    for (const Landing<S>& landing : state_.landings) {
        const Velocity<S> used = motion_.used()[landing.body];
        const Real share = std::max(Real(0), Real(2) * landing.time - Real(1)) - landing.time;
        motion_.replaceUsed(landing.body, {typename S::Vec(used.v + share * landing.change.v),
                                           Ang(used.w + share * landing.change.w)});
    }
    state_.landings.clear();
}

#define RIGOR_INSTANTIATE(S)                    \
    template void Step<S>::findLandingBodies(); \
    template void Step<S>::beginLandings();     \
    template void Step<S>::placeLandings();     \
    template void Step<S>::shortenLandings();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
