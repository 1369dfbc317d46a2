// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The laws of Signorini and Coulomb, point by point, for engines that report their impulses: by how much, as
// a velocity [m/s], what the engine did at a contact misses each law. With the frame, arms and K of
// contact_point.hpp at the states that the contacts belong to, u the relative velocity at the step's end (u- at its start),
// p_n and p_t the impulses of the step, s the separation (minus the depth), h the step, e and mu those of the
// pair:
//
//   Signorini    0 <= p_n  _|_  u_n - u_low >= 0, where
//                    u_low  = -s/h apart, e (approach) touching or overlapping; where contacts belong to the end of
//                             the step -s/(h/2): until they are found again there may be half a step
//                the residual is the largest of     u_low - u_n            (it comes too near)
//                                                   -K_nn p_n              (it pulls)
//                                                   min(K_nn p_n, u_n - u_high)   (it pushes what leaves)
//                What position stabilisation may do to gap and overlap is not counted: a pressing contact may
//                take any velocity up to u_high = max(0, -s)/h + e (approach), which removes the overlap
//                within the step, and a gap may be closed within the step or held. The rate at which overlap
//                is removed is not an error of this law; overlap itself is measured by overlap_max. The
//                approach is (-u_n-)+ or that with the gravity of the step in it, u_low taking the smaller and
//                u_high the larger: both are in use.
//   Coulomb      |p_t| <= mu p_n: the residual is k (|p_t| - mu p_n)+, k = K along p_t. The largest of both
//                coefficients counts where the pair has a static one.
//   dissipation  with u_t now that of the surfaces, which may move over their bodies (belts):
//                p_t maximises the power it takes, -p_t . u_t, over the disc |p_t| <= mu p_n: with P the
//                projection onto the disc, rho = 1/max K_tt and p' = P(p_t) (so that Coulomb's residual is
//                not counted twice), the residual is |p' - P(p' - rho u_t)|/rho: zero where it sticks, or
//                slides against friction at its limit; at most the slip.
//
// Only contacts with reported impulses and, if apart, with an impulse count. Only records of every step do
// for the first and the last; frames further apart lack the states that the step ended with. These are the
// parts of the natural map of the contact problem (De Saxce and Feng, Math. Comput. Modelling 28, 1998;
// Facchinei and Pang, 2003, section 1.5), each by itself. Newton's law of impact as in Moreau, 1988.
#include <algorithm>
#include <cmath>
#include <map>

#include "validation/metrics/contact_point.hpp"
#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// Data of one contact in one step.
struct ContactStep {
    const Scenario& scenario;
    const ContactPoint& contact;
    PairCoefficients pair;
    PointOfContact point;
    std::span<const BodyState> before, after;
    double h;      ///< [s]
    double until;  ///< time in which a gap may be closed [s]

    double normalImpulse() const { return contact.normalImpulse; }
    Vec3 tangential(const Vec3& v) const { return v - dot(v, contact.normal) * contact.normal; }
};

double gravityAlong(const ContactStep& d) {
    const auto pull = [&](int body) {
        const Body& b = d.scenario.bodies[body];
        return b.type == BodyType::Dynamic ? b.gravityScale * dot(d.contact.normal, d.scenario.gravity) : 0.0;
    };
    return pull(d.contact.bodyB) - pull(d.contact.bodyA);
}

double signorini(const ContactStep& d) {
    const double now = dot(d.contact.normal, d.point.velocity(d.after));
    const double then = dot(d.contact.normal, d.point.velocity(d.before));
    const double late = then + d.h * gravityAlong(d);
    const double slow = std::max(0.0, -std::max(then, late)), fast = std::max(0.0, -std::min(then, late));
    const double apart = -d.contact.depth, e = d.pair.restitution;
    const double low = apart > 0.0 ? -apart / d.until : e * slow;
    const double high = std::max(0.0, -apart) / d.h + e * fast;
    const double push = d.point.normalMobility() * d.normalImpulse();
    return std::max({0.0, low - now, -push, std::min(push, now - high)});
}

double frictionLimit(const ContactStep& d, double coefficient) {
    return coefficient * std::max(0.0, d.normalImpulse());
}

double coulomb(const ContactStep& d) {
    const Vec3 pull = d.tangential(d.contact.frictionImpulse);
    const double size = norm(pull);
    const double excess = size - frictionLimit(d, std::max(d.pair.friction, d.pair.staticFriction));
    if (!(excess > 0.0)) return std::isfinite(size) ? 0.0 : size;
    return excess * dot(pull, d.point.response(pull)) / (size * size);
}

Vec3 onDisc(const Vec3& v, double radius) {
    const double size = norm(v);
    return size > radius ? (radius / size) * v : v;
}

double dissipation(const ContactStep& d) {
    const Vec3 slip = d.tangential(d.point.velocity(d.after) + surfaceSlip(d.scenario, d.contact, d.before));
    const double mobility = d.point.tangentialMobility();
    const auto defect = [&](double radius) {
        const Vec3 pull = onDisc(d.tangential(d.contact.frictionImpulse), radius);
        return mobility * norm(pull - onDisc(pull - slip / mobility, radius));
    };
    const double sliding = defect(frictionLimit(d, d.pair.friction));
    if (!(d.pair.staticFriction > d.pair.friction)) return sliding;
    return std::min(sliding, norm(slip));  // it may stick within the larger limit
}

std::vector<MetricValue> largest(const MetricInput& input, double (*defect)(const ContactStep&),
                                 bool needsStates) {
    const Trajectory& t = input.trajectory;
    if (needsStates && t.stride != 1) return {};
    std::map<int, Worst> worst;
    const std::size_t frames = std::min(t.frames(), t.contacts.size());
    const bool atEnd = t.contactInstant == adapter::ContactInstant::StepEnd;
    for (std::size_t k = atEnd; k + !atEnd < frames; ++k)
        for (const ContactPoint& contact : t.contacts[k]) {
            if (!contact.hasImpulse || !isKnownContact(input.scenario, contact)) continue;
            if (contact.depth < 0.0 && contact.normalImpulse == 0.0) continue;
            const ContactStep step{input.scenario,
                                   contact,
                                   coefficientsOf(input.scenario, contact),
                                   {input.scenario, contact, t.frame(k)},
                                   t.frame(k - atEnd),
                                   t.frame(k + !atEnd),
                                   t.dt,
                                   atEnd ? 0.5 * t.dt : t.dt};
            const double value = defect(step);
            for (const int body : {contact.bodyA, contact.bodyB})
                if (isDynamic(input.scenario, body)) worst[body].add(value, t.times[k]);
        }
    std::vector<MetricValue> rows;
    for (const auto& [body, value] : worst) rows.push_back(value.row(bodyName(input, body)));
    return withWorst(std::move(rows));
}

}  // namespace

std::vector<MetricValue> signoriniResidual(const MetricInput& input) {
    return largest(input, signorini, true);
}
std::vector<MetricValue> coulombResidual(const MetricInput& input) {
    return largest(input, coulomb, false);
}
std::vector<MetricValue> dissipationError(const MetricInput& input) {
    return largest(input, dissipation, true);
}

}  // namespace rigor::validation
