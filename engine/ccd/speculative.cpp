// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Speculative contacts: a fast body gets a contact before it touches, and the solver takes just so much of
// its velocity that the gap closes at the end of the step.
//
// At the start of a step of h each body is expected to move with v + h (g + F/m), w, and its boxes are swept
// along that way. Two shapes that may pass each other unseen (their relative motion is more than half of
// their thickness) have their time of impact t computed on it (time_of_impact.cpp). If there is one, their
// manifold there, with normal n, arms rA, rB and closing speed u_n = -n . (vB + wB x rB - vA - wA x rA), is
// the contact of this step, with the separation
//     s = t u_n     so that the row     n . u + s / h >= 0
// requires only that the shapes have not passed t's pose at the end of the step. [Catto2005] gives the
// row; the usual separation is the distance at the start, with the plane between the closest points there.
// Deviation: plane, arms and distance are those of the impact. The usual plane stops bodies that would have
// passed beside the other ("ghost collisions"), and a plane and arms from 8 m away are those of the wrong
// corner.
//
// Restitution: the body stops at the surface with the step's end, and then gets its rebound
// e times the approach of before (RowContacts::applySpeculativeRestitution, in the relaxation after the move).
//
// An impact off the centre of mass makes the body spin, and the rest of its way in the step carries it round
// the point that the row holds. So the way of a speculative contact is checked again after the move: where it
// ends deeper in the other body than a quarter of their thickness, both go back to where they touch, with the
// velocities they have.
//
// Chains, meshes and height fields have no speculative contacts. The ways of fast shapes are checked against
// them after the move, too (surface_impact.cpp): a shape that would pass goes back to where it has just
// touched, and the contacts of the next step see to the impact.
//
// Cost: two times of impact per fast pair that collides. Limits: the rest of the step after the impact is
// lost (the body is up to |v| h behind); a body that another contact deflects is not looked at again in the
// same step and may then pass a second thin wall; a body that an impact of this step makes fast is not seen;
// friction acts with the step's begin; explicit_euler moves bodies before the row acts on them, so there it
// stops nothing.
#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/surface_impact.hpp"
#include "engine/ccd/traits.hpp"
#include "engine/contacts/time_of_impact.hpp"

namespace rigor::engine {
namespace {

template <class S>
class Speculative final : public ContinuousCollision<S> {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    std::unique_ptr<ContinuousCollision<S>> clone() const override {
        return std::make_unique<Speculative>(*this);
    }
    bool looksAhead() const override { return true; }

    void predict(const BodyArrays<S>& bodies, std::span<const ShapeRecord<S>> shapes, const Vec& gravity,
                 Real h) override {
        h_ = h;
        moving_.resize(shapes.size());
        continuous_.resize(shapes.size());
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const std::uint32_t body = shapes[i].body;
            continuous_[i] = bodies.constants[body].continuous;
            MovingShape<S>& m = moving_[i];
            m = movingShape<S>(shapes[i], bodies.pose[body], bodies.velocity[body]);
            if (bodies.invMass[body] > 0)
                m.velocity.v += h * (bodies.constants[body].gravityScale * gravity +
                                     bodies.invMass[body] * bodies.wrench[body].force);
        }
    }

    void growBox(std::uint32_t shape, Aabb<S>& box) const override {
        if (!continuous_[shape]) return;
        const Aabb<S> swept = sweptBox<S>(moving_[shape], h_);
        box = {box.min.cwiseMin(swept.min), box.max.cwiseMax(swept.max)};
    }

    void findAhead(Contact<S>& contact, std::span<const ShapeRecord<S>> shapes,
                   const NarrowPhase<S>& narrowPhase) const override {
        MovingShape<S> a = moving_[contact.shapeA], b = moving_[contact.shapeB];
        // The world may have been copied since predict().
        a.shape = &shapes[contact.shapeA].shape;
        b.shape = &shapes[contact.shapeB].shape;
        contact.speculative =
            (continuous_[contact.shapeA] || continuous_[contact.shapeB]) && mayPassUnseen<S>(a, b, h_);
        if (!contact.speculative || contact.manifold.count > 0) return;
        const TimeOfImpact<S> impact = timeOfImpact<S>(a, b, h_);
        if (!impact.hit) return;
        collideAt<S>(a, b, impact, narrowPhase, contact.manifold);
        const Vec pA = a.body.p + impact.time * a.velocity.v, pB = b.body.p + impact.time * b.velocity.v;
        const Vec& n = contact.manifold.normal;
        for (int i = 0; i < contact.manifold.count; ++i) {
            ManifoldPoint<S>& where = contact.manifold.points[i];
            auto& point = contact.points[i];
            const Vec at = Real(0.5) * (where.pointA + where.pointB);
            point.rA = at - pA;
            point.rB = at - pB;
            const Vec u =
                b.velocity.v + cross(b.velocity.w, point.rB) - a.velocity.v - cross(a.velocity.w, point.rA);
            point.separation = std::max(Real(0), where.separation - impact.time * n.dot(u));
            where.separation = point.separation;
        }
    }

    void remember(const BodyArrays<S>& bodies) override {
        starts_.assign(bodies.pose.begin(), bodies.pose.end());
    }

    bool resolve(const MovedWorld<S>& world, std::vector<ImpactEvent<S>>&) override {
        const ShapeSet<S>& shapes = world.contacts.shapes();
        const auto moved = [&](std::uint32_t shape) {
            const ShapeRecord<S>& record = shapes[shape];
            const std::uint32_t i = record.body;
            const Velocity<S> v =
                straightVelocity<S>(starts_[i], world.bodies.pose[i], world.motion.used()[i], world.h);
            return movingShape<S>(record, starts_[i], v);
        };
        for (const Contact<S>& contact : world.contacts.list()) {
            if (!contact.speculative || contact.vetoed) continue;
            const MovingShape<S> a = moved(contact.shapeA), b = moved(contact.shapeB);
            const TimeOfImpact<S> impact = timeOfImpact<S>(a, b, world.h, true);
            if (!impact.hit) continue;
            for (const std::uint32_t i : {contact.bodyA, contact.bodyB}) {
                if (world.bodies.invMass[i] == 0) continue;
                const Velocity<S> v = (i == contact.bodyA ? a : b).velocity;
                const Real share = impact.time / world.h;
                world.bodies.pose[i] = movedPose<S>(starts_[i], v, impact.time);
                world.motion.replaceUsed(i, {Vec(share * v.v), typename S::Ang(share * v.w)});
            }
        }
        for (const std::uint32_t surface : shapes.surfaces())
            for (std::uint32_t i = 0; i < shapes.size(); ++i)
                if (shapes.movable()[i]) stopAtSurface(world, surface, i, moved(surface), moved(i));
        return true;
    }

  private:
    /// Takes a shape that has passed a surface back along its way.
    void stopAtSurface(const MovedWorld<S>& world, std::uint32_t surface, std::uint32_t shape,
                       const MovingShape<S>& still, const MovingShape<S>& moving) {
        const ShapeSet<S>& shapes = world.contacts.shapes();
        const std::uint32_t body = shapes[shape].body;
        if (!world.bodies.constants[body].continuous) return;
        if (!mayPassUnseen<S>(still, moving, world.h)) return;
        if (!world.contacts.filter().mayCollide(world.bodies, shapes[surface], shapes[shape])) return;
        if (!sweptBox<S>(moving, world.h).overlaps(shapes.box(surface))) return;
        const bool known = hasRows<S>(world.contacts.list(), surface, shape);
        const TimeOfImpact<S> impact = surfaceImpact_.find(still, moving, world.h, known, world.narrowPhase);
        if (!impact.hit) return;
        // A little overlap: contacts that bounce do so once they touch.
        const Real deep = Real(1e-3) * moving.inscribedRadius / impact.approach;
        const Real time = std::min(world.h, impact.exact + deep), share = time / world.h;
        world.bodies.pose[body] = movedPose<S>(starts_[body], moving.velocity, time);
        world.motion.replaceUsed(
            body, {Vec(share * moving.velocity.v), typename S::Ang(share * moving.velocity.w)});
    }

    SurfaceImpact<S> surfaceImpact_;
    Real h_ = 0;
    std::vector<Pose<S>> starts_;           ///< start poses of the (sub-)step
    std::vector<std::uint8_t> continuous_;  ///< flag of each shape: 1 if its body takes part
    std::vector<MovingShape<S>> moving_;    ///< motion of each shape by dense shape index
};

}  // namespace

ContinuousCollisionTraits makeSpeculativeTraits() {
    return {.givesContacts = true, .losesRest = true};
}

template <class S>
std::unique_ptr<ContinuousCollision<S>> makeSpeculative() {
    return std::make_unique<Speculative<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeSpeculative, ContinuousCollision);

}  // namespace rigor::engine
