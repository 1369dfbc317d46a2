// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Steps from midpoint to midpoint (integrators/moreau_midpoint.cpp): the way to the midpoints before everything
// else, and the way back to the end of the step after it. step_shown.cpp has what the world shows of its contacts.
#include <algorithm>

#include "engine/pipeline/small_turn.hpp"
#include "engine/pipeline/step.hpp"

namespace rigor::engine {
template <class S>
void Step<S>::beginFlights() {
    std::vector<std::uint8_t>& bound = state_.bound;
    bound.assign(bodies_.size(), 0);
    for (const auto& record : joints_.records()) bound[record.joint.a] = bound[record.joint.b] = 1;
    for (const auto& record : world_.forces.records()) bound[record.place.a] = bound[record.place.b] = 1;
    // A contact that has pressed a body in the last step goes on to do so. Its normal may have turned since.
    for (const Contact<S>& contact : contacts_.list())
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i)
            if (contact.impulses[i].normal > 0 && !contact.points[i].impact)
                bound[contact.bodyA] = bound[contact.bodyB] = 1;
    const std::vector<std::uint8_t>& valid = bodies_.midpoints.valid;
    for (std::size_t i = 0; i < valid.size(); ++i)
        if (valid[i] == Midpoints<S>::kBounces) bound[i] = 1;
    state_.flights.begin(bodies_, bound, Real(0.5) * state_.substepSize);
}

/// Bodies that have collided in flight go to where that takes them.
template <class S>
void Step<S>::endFlights() {
    result_.unlocatedImpacts = state_.flights.resolve(movedWorld(state_.size, Real(0)),
                                                      algorithms_.restitution->bounces(), state_.impacts);
    if (!state_.flights.anyHasCollided()) return;
    for (Contact<S>& contact : contacts_.list()) {
        if (!state_.flights.hasCollided(contact.bodyA) && !state_.flights.hasCollided(contact.bodyB))
            continue;
        contact.impulses.fill({});
        contact.totals.fill({});
        showGap(contact);
    }
}

/// Time from the end of a step to the midpoint of an island's first sub-step.
template <class S>
typename S::Real Step<S>::halfOf(IslandKind islands) const {
    return Real(0.5) * state_.size / Real(algorithms_.method(islands).substeps);
}

/// Integrators that step from midpoint to midpoint begin there.
template <class S>
void Step<S>::toMidpoints() {
    const Real h = state_.substepSize;
    if (algorithms_.locatesImpacts) beginFlights();
    contacts_.beginWays(bodies_, tasks_);
    state_.leads.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) state_.leads[i].start = bodies_.pose[i];
    const bool same = world_.clock.lastSubstepSize == h;
    leaveMidpointsOfJoints();
    findRenewed(same);
    const bool drifts = !joints_.records().empty() && hasRenewed() && beginDrift(true);
    if (moveToMidpoints(same)) {
        contacts_.keepSides(bodies_, tasks_);
        endDrift(drifts, true);
    }
    tasks_.forEach(bodies_.size(), kBodyGrain, [this](std::size_t i) { measureLead(i); });
}

/// True: midpoints were found anew. With continuous collision bodies collide on the way there.
template <class S>
bool Step<S>::moveToMidpoints(bool same) {
    const Real half = halfOf(IslandKind::Usual);
    const Real ofLarge = algorithms_.large ? halfOf(IslandKind::Large) : Real(0);
    const Real ofViolent = algorithms_.violent ? halfOf(IslandKind::Violent) : Real(0);
    if (!algorithms_.ccdToMidpoints)
        return motion_.toMidpoint(bodies_, {half, ofLarge, ofViolent}, same, tasks_);
    if (!motion_.toMidpoint(bodies_, {}, same, tasks_)) return false;
    ContinuousCollision<S>& ccd = *algorithms_.ccdToMidpoints;
    ccd.remember(bodies_);
    motion_.flyToMidpoint(bodies_, state_.renewed, half);
    ccd.rememberKick(bodies_);
    const bool inTime = ccd.resolve(movedWorld(half, Real(0)), state_.impacts);
    result_.impactsCut = result_.impactsCut || !inTime;
    motion_.finish(bodies_, half, tasks_);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (state_.renewed[i] && bodies_.islands[i] != IslandKind::Usual)
            motion_.coast(bodies_, i, halfOf(bodies_.islands[i]) - half);
    return true;
}

template <class S>
void Step<S>::measureLead(std::size_t i) {
    Lead<S>& lead = state_.leads[i];
    lead.motion = {};
    lead.middle = bodies_.pose[i];
    if (bodies_.constants[i].type == BodyType::Static || bodies_.asleep[i]) return;
    lead.motion.v = bodies_.pose[i].p - lead.start.p;
    lead.motion.w = smallTurn(lead.start.q, bodies_.pose[i].q);
}

/// Islands whose kind has changed go to the midpoints of their new sub-steps, and their contacts with them.
/// They meet kinematic bodies there, too.
template <class S>
void Step<S>::changeHalves(std::span<const IslandKind> before) {
    if (!motion_.isAtMidpoint()) return;
    std::vector<Velocity<S>>& moved = state_.way;
    moved.assign(bodies_.size(), Velocity<S>{});
    bool any = false;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        any = any || bodies_.constants[i].type == BodyType::Kinematic;
        if (bodies_.islands[i] == before[i] || bodies_.invMass[i] == 0) continue;
        any = true;
        const Pose<S> from = bodies_.pose[i];
        motion_.coast(bodies_, i, halfOf(bodies_.islands[i]) - halfOf(before[i]));
        moved[i] = {typename S::Vec(bodies_.pose[i].p - from.p), smallTurn(from.q, bodies_.pose[i].q)};
        measureLead(i);
    }
    if (!any) return;
    const auto isStill = [](const Velocity<S>& motion) {
        return motion.v.isZero(0) && dotAng(motion.w, motion.w) == Real(0);
    };
    for (Contact<S>& contact : contacts_.list()) {
        const auto motionOf = [&](std::uint32_t i) {
            if (bodies_.constants[i].type != BodyType::Kinematic) return moved[i];
            const Real later = halfOf(contact.islands) - halfOf(IslandKind::Usual);
            const Velocity<S>& velocity = bodies_.velocity[i];
            return Velocity<S>{typename S::Vec(later * velocity.v), Ang(later * velocity.w)};
        };
        const Velocity<S> a = motionOf(contact.bodyA), b = motionOf(contact.bodyB);
        if (isStill(a) && isStill(b)) continue;
        const auto at = [&](std::uint32_t i, const Velocity<S>& motion) {
            const bool kinematic = bodies_.constants[i].type == BodyType::Kinematic;
            return typename S::Vec(kinematic ? bodies_.pose[i].p : bodies_.pose[i].p - motion.v);
        };
        moveContact(contact, at(contact.bodyA, a), a, at(contact.bodyB, b), b);
    }
}

/// Moves the points of a contact with its bodies, which are at pA, pB before. Both points move without
/// rotation, so that the arms of round bodies that roll stay as they are, and then along the normal: to the
/// separation of the points that have turned with the bodies.
template <class S>
void Step<S>::moveContact(Contact<S>& contact, const typename S::Vec& pA, const Velocity<S>& a,
                          const typename S::Vec& pB, const Velocity<S>& b) const {
    const typename S::Vec& n = contact.manifold.normal;
    const bool movesA = bodies_.invMass[contact.bodyA] > 0, movesB = bodies_.invMass[contact.bodyB] > 0;
    const Real shareB = movesA && movesB ? Real(0.5) : movesA ? Real(0) : Real(1);
    for (int i = 0; i < contact.manifold.count; ++i) {
        ManifoldPoint<S>& point = contact.manifold.points[i];
        const Real apart = n.dot(b.v - a.v);
        const Real turned = n.dot(cross(b.w, typename S::Vec(point.pointB - pB)) -
                                  cross(a.w, typename S::Vec(point.pointA - pA)));
        point.separation += apart + turned;
        point.pointA += a.v - ((Real(1) - shareB) * turned) * n;
        point.pointB += b.v + (shareB * turned) * n;
    }
    contact.placed = false;
}

/// They show the state between two midpoints.
template <class S>
void Step<S>::toEnd() {
    if (state_.any.usual) releaseBroken();
    shortenLandings();
    const Real h = state_.substepSize;
    std::span<const Velocity<S>> way = motion_.used();
    if (method_.style.positions) {
        state_.way.resize(bodies_.size());
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const Velocity<S>& moved = state_.positions.motion[i];
            state_.way[i] = {typename S::Vec(moved.v / h), Ang(moved.w / h)};
        }
        way = state_.way;
    }
    const bool drifts = !joints_.records().empty() && state_.broken.empty() && beginDrift(false);
    motion_.toEnd(bodies_, IslandKind::Usual, way, halfOf(IslandKind::Usual), tasks_);
    for (const IslandKind islands : {IslandKind::Large, IslandKind::Violent}) {
        if (!state_.any[islands]) continue;
        Motion<S>& motion = algorithms_.method(islands).motion;
        motion.toEnd(bodies_, islands, motion.used(), halfOf(islands), tasks_);
    }
    endDrift(drifts, false);
    contacts_.keepSidesOfMidpoints(bodies_, tasks_);
    showContacts();
    if (algorithms_.locatesImpacts) endFlights();
    showBounces();
}

/// A joint that breaks does so when the step begins: its last impulses are taken back.
template <class S>
void Step<S>::releaseBroken() {
    if (method_.style.positions) return;
    const Real h = state_.substepSize;
    world_.joints.findOverloaded(h * Real(method_.substeps), state_.broken);
    for (const JointId id : state_.broken) {
        const typename JointSet<S>::Record& record = world_.joints.record(id);
        if (record.islands != IslandKind::Usual || record.rows == 0) continue;
        const std::uint32_t a = record.joint.a, b = record.joint.b;
        const Velocity<S> beforeA = bodies_.velocity[a], beforeB = bodies_.velocity[b];
        Block<S> block;
        block.invMassA = bodies_.invMass[a];
        block.invMassB = bodies_.invMass[b];
        for (std::uint32_t i = record.firstRow; i < record.firstRow + record.rows; ++i)
            applyRowImpulse<S>(rows_.rows[i], block, -rows_.rows[i].impulse, bodies_.velocity[a],
                               bodies_.velocity[b]);
        for (const auto& [body, before] : {std::pair{a, beforeA}, std::pair{b, beforeB}}) {
            if (bodies_.invMass[body] == 0) continue;
            const Velocity<S>& now = bodies_.velocity[body];
            const Velocity<S> change{typename S::Vec(now.v - before.v), Ang(now.w - before.w)};
            const Velocity<S>& used = motion_.used()[body];
            motion_.carry(bodies_.pose[body], change, h);
            motion_.replaceUsed(body, {typename S::Vec(used.v + change.v), Ang(used.w + change.w)});
        }
    }
}

/// Bodies that joints connect begin at midpoints together: one of them alone would not be where its joints hold it.
template <class S>
void Step<S>::leaveMidpointsOfJoints() {
    if (!algorithms_.correction->drifts()) return;
    const auto moves = [&](std::uint32_t i) { return bodies_.invMass[i] > 0; };
    DisjointSets& jointed = state_.jointed;
    jointed.begin(static_cast<std::uint32_t>(bodies_.size()));
    for (const auto& record : joints_.records())
        if (moves(record.joint.a) && moves(record.joint.b)) jointed.join(record.joint.a, record.joint.b);
    state_.leaving.assign(bodies_.size(), 0);
    const std::vector<std::uint8_t>& valid = bodies_.midpoints.valid;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
        if (moves(i) && !(i < valid.size() && valid[i])) state_.leaving[jointed.rootOf(i)] = 1;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i)
        if (state_.leaving[jointed.rootOf(i)]) bodies_.leaveMidpoint(i);
}

/// Joints alone, where the bodies are. Motors that reach their speed keep the coordinates that it has led to.
template <class S>
StepPositions<S> Step<S>::jointPositions() {
    state_.still.assign(bodies_.size(), Velocity<S>{});
    StepPositions<S> positions(bodies_, joints_, state_.noContacts, state_.still, state_.substepSize, Real(0),
                               state_.positions);
    positions.holdMotors();
    return positions;
}

template <class S>
bool Step<S>::hasRenewed() const {
    return std::find(state_.renewed.begin(), state_.renewed.end(), 1) != state_.renewed.end();
}

/// Joints on the half of a step to the midpoints (`there`) or back from them follow the arcs that they hold bodies on
/// (PositionCorrection::beginDrift). On the way there those of bodies whose midpoints were not known. With continuous
/// collision the way there may be another, and joints are put right alone.
template <class S>
bool Step<S>::beginDrift(bool there) {
    if (method_.style.ownsCorrection || !algorithms_.correction->drifts() || algorithms_.ccdToMidpoints)
        return false;
    StepPositions<S> positions = jointPositions();
    if (there) positions.takeOnly(state_.renewed);
    return algorithms_.correction->beginDrift(positions);
}

/// Errors are of the order h^2: two iterations of Newton's method leave h^8.
template <class S>
void Step<S>::endDrift(bool drifts, bool there) {
    if (joints_.records().empty() || method_.style.ownsCorrection) return;
    const PositionIterations iterations{def_.positionIterations, std::min(def_.positionIterations, 2)};
    StepPositions<S> positions = jointPositions();
    if (!drifts) return algorithms_.correction->correct(positions, iterations, def_.slop);
    if (there) positions.takeOnly(state_.renewed);
    const Real half = halfOf(IslandKind::Usual);
    algorithms_.correction->endDrift(positions, there ? half : -half, !there, iterations);
}

#define RIGOR_INSTANTIATE(S)                                          \
    template void Step<S>::toMidpoints();                             \
    template typename S::Real Step<S>::halfOf(IslandKind) const;      \
    template void Step<S>::changeHalves(std::span<const IslandKind>); \
    template void Step<S>::toEnd();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
