// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// This program's own tables in place of the engine's: all of its algorithms, and false entries. One of these is an
// algorithm of the engine that declares one trait otherwise; its name is "false_" and its summary that trait.
#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/traits.hpp"
#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/traits.hpp"
#include "engine/solvers/restitution.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<Solver<S>> factory(); \
    SolverTraits factory##Traits();
#include "engine/solvers/solvers.def"
template <class R>
using Vec2 = Eigen::Matrix<R, 2, 1>;
#define ALGORITHM(name, function, summary)                        \
    template <class R>                                            \
    Vec2<R> function(R, R, R, const Vec2<R>&, const Vec2<R>&, R); \
    FrictionTraits function##Traits();
#include "engine/solvers/frictions.def"
#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    Integrator<S> factory();              \
    IntegratorTraits factory##Traits();
#include "engine/integrators/integrators.def"
#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    RotationScheme<S> factory();          \
    RotationTraits factory##Traits();
#include "engine/integrators/rotations.def"
#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    TurnRotation<S> factory();            \
    OrientationTraits factory##Traits();
#include "engine/integrators/orientation_updates.def"
#define ALGORITHM(name, factory, summary)              \
    template <class S>                                 \
    std::unique_ptr<ContinuousCollision<S>> factory(); \
    ContinuousCollisionTraits factory##Traits();
#include "engine/ccd/continuous_collisions.def"
#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<Restitution<S>> factory();
#include "engine/solvers/restitutions.def"
#define ALGORITHM(name, function, summary) ManifoldTraits function##Traits();
#include "engine/narrowphase/manifolds.def"

namespace {

template <class T, class Change>
T with(T traits, Change change) {
    change(traits);
    return traits;
}

/// Projected Gauss-Seidel whose springs of contacts are softer than the setting.
template <class S>
class Softer final : public Solver<S> {
  public:
    explicit Softer(std::unique_ptr<Solver<S>> inner) : inner_(std::move(inner)) {}
    std::unique_ptr<Solver<S>> clone() const override { return std::make_unique<Softer>(inner_->clone()); }
    SolverStyle<S> style() const override { return inner_->style(); }
    void solve(const SolverInput<S>& input) override {
        using Real = typename S::Real;
        for (const Block<S>& block : input.constraints.blocks) {
            if (block.kind != BlockKind::Contact) continue;
            Row<S>& row = input.constraints.rows[block.first];
            const Real K = Real(1) / row.invK - row.softness;
            row.softness *= Real(1.5);
            row.invK = Real(1) / (K + row.softness);
        }
        inner_->solve(input);
    }

  private:
    std::unique_ptr<Solver<S>> inner_;
};
template <class S>
std::unique_ptr<Solver<S>> makeSofter() {
    return std::make_unique<Softer<S>>(makePgsSoft<S>());
}

/// No contact bounces, though it says that they do.
template <class S>
class Dead final : public Restitution<S> {
  public:
    std::unique_ptr<Restitution<S>> clone() const override { return std::make_unique<Dead>(*this); }
    bool bounces() const override { return true; }
    bool solvesImpacts() const override { return true; }
    void impact(ConstraintRows<S>& rows, std::span<Velocity<S>>, const std::function<void()>&) override {
        for (const Block<S>& block : rows.blocks)
            if (block.kind == BlockKind::Contact) rows.rows[block.first].bias = 0;
    }
};
template <class S>
std::unique_ptr<Restitution<S>> makeDead() {
    return std::make_unique<Dead<S>>();
}
/// Newton's law, which says that it solves impacts by a law of its own.
template <class S>
class Idle final : public Restitution<S> {
  public:
    std::unique_ptr<Restitution<S>> clone() const override { return std::make_unique<Idle>(*this); }
    bool solvesImpacts() const override { return true; }
};
template <class S>
std::unique_ptr<Restitution<S>> makeIdle() {
    return std::make_unique<Idle<S>>();
}

}  // namespace

// name, honest factory, what is changed
#define SOLVER_LIARS                                                                    \
    FALSE_ENTRY(contact_frequency, makeSofter, makePgsSoft, (void)t)                    \
    FALSE_ENTRY(direct, makePgs, makePgs, t.direct = true)                              \
    FALSE_ENTRY(friction, makePgs, makePgs, t.friction = FrictionShape::Cone)           \
    FALSE_ENTRY(friction_of_patches, makeWide, makeWide, t.frictionOfPatches = false)   \
    FALSE_ENTRY(iterations, makePgs, makePgs, t.iterations = 20)                        \
    FALSE_ENTRY(linear_joint_share, makeWide, makeWide, t.linearJointBaumgarte.reset()) \
    FALSE_ENTRY(friction_obeys, makeDantzig, makeDantzig, t.friction.reset())           \
    FALSE_ENTRY(contacts_in_single, makeWide, makeWide, t.contactsInSingle = false)     \
    FALSE_ENTRY(relax_iterations, makePgsSoft, makePgsSoft, t.relaxIterations = 1)      \
    FALSE_ENTRY(errors, makeTgsSoft, makeTgsSoft, t.errors = ErrorHandling::Correction) \
    FALSE_ENTRY(errors_springs, makePgs, makePgs, t.errors = ErrorHandling::Springs)    \
    FALSE_ENTRY(correction, makeXpbd, makeXpbd, t.errors = ErrorHandling::Correction)   \
    FALSE_ENTRY(stops, makePgs, makePgs, t.stops = StopRule::Residual)                  \
    FALSE_ENTRY(substeps, makeTgsSoft, makeTgsSoft, t.substeps = 4)                     \
    FALSE_ENTRY(warm_starts, makeSinglePass, makeSinglePass, t.warmStarts = true)
#define FRICTION_LIARS FALSE_ENTRY(shape, frictionPyramid, frictionPyramid, t.shape = FrictionShape::Cone)
#define INTEGRATOR_LIARS                                                                                  \
    FALSE_ENTRY(order, integratorVelocityVerlet, integratorVelocityVerlet, t.order = 4)                   \
    FALSE_ENTRY(scheme, integratorExplicitEuler, integratorExplicitEuler,                                 \
                t.scheme = FlightScheme::SymplecticEuler)                                                 \
    FALSE_ENTRY(forces, integratorRk4, integratorRk4, t.forces = ForceTimes::Start)                       \
    FALSE_ENTRY(owns_rotation, integratorVelocityVerlet, integratorVelocityVerlet, t.ownsRotation = true) \
    FALSE_ENTRY(in_blocks, integratorExplicitEuler, integratorExplicitEuler, t.inBlocks = true)
#define ROTATION_LIARS                                                                  \
    FALSE_ENTRY(order, rotationExplicit, rotationExplicit, t.order = 2)                 \
    FALSE_ENTRY(keeps_momentum, rotationNone, rotationNone, t.keepsMomentum = true)     \
    FALSE_ENTRY(keeps_energy, rotationImplicit, rotationImplicit, t.keepsEnergy = true) \
    FALSE_ENTRY(in_blocks, rotationImplicit, rotationImplicit, t.inBlocks = true)
#define ORIENTATION_LIARS                                                            \
    FALSE_ENTRY(exact, orientationFirstOrder, orientationFirstOrder, t.exact = true) \
    FALSE_ENTRY(in_blocks, orientationFirstOrder, orientationFirstOrder, t.inBlocks = true)
#define COLLISION_LIARS                                                                    \
    FALSE_ENTRY(acts, makeNoContinuousCollision, makeNoContinuousCollision, t.acts = true) \
    FALSE_ENTRY(gives_contacts, makeSpeculative, makeSpeculative, t.givesContacts = false) \
    FALSE_ENTRY(loses_rest, makeSpeculative, makeSpeculative, t.losesRest = false)
#define RESTITUTION_LIARS                  \
    FALSE_ENTRY(bounces, makeDead, (), ()) \
    FALSE_ENTRY(solves_impacts, makeIdle, (), ())
#define MANIFOLD_LIARS FALSE_ENTRY(remembers, manifoldDeepest, manifoldDeepest, t.remembers = true)

// --- algorithms
#define FALSE_ENTRY(lie, factory, honest, change) {"false_" #lie, &factory<S>, #lie},
template <class S>
std::span<const AlgorithmEntry<SolverFactory<S>>> solverTable() {
    static constexpr AlgorithmEntry<SolverFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/solvers/solvers.def"
        SOLVER_LIARS};
    return table;
}
template <class S>
std::span<const AlgorithmEntry<IntegratorFactory<S>>> integratorTable() {
    static constexpr AlgorithmEntry<IntegratorFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/integrators/integrators.def"
        INTEGRATOR_LIARS};
    return table;
}
template <class S>
std::span<const AlgorithmEntry<RotationFactory<S>>> rotationTable() {
    static constexpr AlgorithmEntry<RotationFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/integrators/rotations.def"
        ROTATION_LIARS};
    return table;
}
template <class S>
std::span<const AlgorithmEntry<OrientationFactory<S>>> orientationUpdateTable() {
    static constexpr AlgorithmEntry<OrientationFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/integrators/orientation_updates.def"
        ORIENTATION_LIARS};
    return table;
}
template <class S>
std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable() {
    static constexpr AlgorithmEntry<ContinuousCollisionFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/ccd/continuous_collisions.def"
        COLLISION_LIARS};
    return table;
}
template <class S>
std::span<const AlgorithmEntry<RestitutionFactory<S>>> restitutionTable() {
    static constexpr AlgorithmEntry<RestitutionFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/solvers/restitutions.def"
        RESTITUTION_LIARS};
    return table;
}
template <class S>
std::span<const AlgorithmEntry<ManifoldFunction<S>>> manifoldTable() {
    static constexpr AlgorithmEntry<ManifoldFunction<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/narrowphase/manifolds.def"
        MANIFOLD_LIARS};
    return table;
}
#undef FALSE_ENTRY
#define FALSE_ENTRY(lie, function, honest, change) {"false_" #lie, &function<typename S::Real>, #lie},
template <class S>
std::span<const AlgorithmEntry<FrictionLaw<S>>> frictionTable() {
    static constexpr AlgorithmEntry<FrictionLaw<S>> table[] = {
#define ALGORITHM(name, function, summary) {#name, &function<typename S::Real>, summary},
#include "engine/solvers/frictions.def"
        FRICTION_LIARS};
    return table;
}
#undef FALSE_ENTRY

#define RIGOR_INSTANTIATE(S)                                                                     \
    template std::span<const AlgorithmEntry<SolverFactory<S>>> solverTable<S>();                 \
    template std::span<const AlgorithmEntry<FrictionLaw<S>>> frictionTable<S>();                 \
    template std::span<const AlgorithmEntry<IntegratorFactory<S>>> integratorTable<S>();         \
    template std::span<const AlgorithmEntry<RotationFactory<S>>> rotationTable<S>();             \
    template std::span<const AlgorithmEntry<OrientationFactory<S>>> orientationUpdateTable<S>(); \
    template std::span<const AlgorithmEntry<RestitutionFactory<S>>> restitutionTable<S>();       \
    template std::span<const AlgorithmEntry<ManifoldFunction<S>>> manifoldTable<S>();            \
    template std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

// --- traits
#define FALSE_ENTRY(lie, factory, honest, change) \
    {"false_" #lie, with(honest##Traits(), [](auto& t) { change; })},
std::span<const TraitsEntry<SolverTraits>> solverTraitsTable() {
    static const TraitsEntry<SolverTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/solvers/solvers.def"
        SOLVER_LIARS};
    return table;
}
std::span<const TraitsEntry<FrictionTraits>> frictionTraitsTable() {
    static const TraitsEntry<FrictionTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/solvers/frictions.def"
        FRICTION_LIARS};
    return table;
}
std::span<const TraitsEntry<IntegratorTraits>> integratorTraitsTable() {
    static const TraitsEntry<IntegratorTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/integrators/integrators.def"
        INTEGRATOR_LIARS};
    return table;
}
std::span<const TraitsEntry<RotationTraits>> rotationTraitsTable() {
    static const TraitsEntry<RotationTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/integrators/rotations.def"
        ROTATION_LIARS};
    return table;
}
std::span<const TraitsEntry<OrientationTraits>> orientationTraitsTable() {
    static const TraitsEntry<OrientationTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/integrators/orientation_updates.def"
        ORIENTATION_LIARS};
    return table;
}
std::span<const TraitsEntry<ContinuousCollisionTraits>> continuousCollisionTraitsTable() {
    static const TraitsEntry<ContinuousCollisionTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/ccd/continuous_collisions.def"
        COLLISION_LIARS};
    return table;
}
std::span<const TraitsEntry<ManifoldTraits>> manifoldTraitsTable() {
    static const TraitsEntry<ManifoldTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/narrowphase/manifolds.def"
        MANIFOLD_LIARS};
    return table;
}
#undef FALSE_ENTRY

}  // namespace rigor::engine
