// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Traits of solvers and friction laws (core/traits.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/traits.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// The set that the friction impulse of a contact point with the normal impulse n is taken from. All but None
/// are the same in 2D.
enum class FrictionShape : std::uint8_t {
    None,
    Cone,     ///< |f| <= mu n, against the slip
    Box,      ///< |f_1| <= mu n, |f_2| <= mu n: up to sqrt 2 mu n
    Polygon,  ///< the hull of WorldDef::pyramidDirections directions of length mu n
    Line,     ///< |f| <= mu n along the slip that there would be without friction
};

struct FrictionTraits {
    FrictionShape shape = FrictionShape::Cone;
};
std::span<const TraitsEntry<FrictionTraits>> frictionTraitsTable();

/// Treatment of position errors of contacts and joints.
enum class ErrorHandling : std::uint8_t {
    Correction,  ///< rows are rigid, the world's position correction removes errors
    Springs,     ///< damped springs of WorldDef::contactFrequency and jointFrequency, at most a quarter of
                 ///< the sub-step rate
    Positions,   ///< bodies move first, and the solver puts their positions right
};

/// Criterion that ends the iterations before their maximum number.
enum class StopRule : std::uint8_t {
    Never,     ///< all are made
    Change,    ///< one changes less than WorldDef::velocityTolerance
    Residual,  ///< the problem is solved to WorldDef::residualTolerance
};

/// Form of the contacts that a solver takes (contacts/contact_model.hpp).
enum class ContactForm : std::uint8_t {
    Rows,
    Patches,  ///< it is a PatchSolver (solvers/wide/patch_solver.hpp)
};

struct SolverTraits {
    int substeps = 1;                    ///< used if WorldDef::substeps is 0
    std::optional<int> iterations = {};  ///< iterations of a sub-step if velocityIterations is 0; empty: 50
    int relaxIterations = 0;             ///< more of them after the bodies have moved
    ErrorHandling errors = ErrorHandling::Correction;
    /// Fraction used with ErrorHandling::Springs: joints that are linearised (WorldDef::relinearizedJoints
    /// off) are rigid and lose this fraction of their error in each sub-step.
    std::optional<double> linearJointBaumgarte = {};
    std::optional<FrictionShape> friction = {};  ///< a law of its own; empty: that of WorldDef::friction
    ContactForm contacts = ContactForm::Rows;
    /// The contacts of two shapes have friction as one, at their center of pressure, which is the law of the
    /// points only where they slide without turning or turn without sliding.
    bool frictionOfPatches = false;
    bool contactsInSingle = false;  ///< contacts are reckoned in f32 in worlds of f64, too
    bool direct = false;            ///< one iteration solves contacts without friction, however many
    StopRule stops = StopRule::Change;
    bool warmStarts = true;  ///< the impulses of the last step matter to it, where WorldDef::warmStarting
    /// The solver of islands with more contacts than WorldDef::islandContacts (pipeline/island_method.hpp);
    /// empty: all islands have this one.
    std::string_view largeIslands = {};
};
std::span<const TraitsEntry<SolverTraits>> solverTraitsTable();

inline const SolverTraits& solverTraits(const std::string& name) {
    return findTraits(solverTraitsTable(), "solver", name);
}
inline FrictionShape frictionShape(const std::string& name) {
    return findTraits(frictionTraitsTable(), "friction", name).shape;
}

/// Requirements of a solver with these traits on the step around it.
template <class S>
SolverStyle<S> styleOf(const SolverTraits& traits) {
    using Real = typename S::Real;
    SolverStyle<S> style;
    style.substeps = traits.substeps;
    style.iterations = traits.iterations;
    style.relaxIterations = traits.relaxIterations;
    style.positions = traits.errors == ErrorHandling::Positions;
    style.ownsCorrection = traits.errors != ErrorHandling::Correction;
    if (traits.errors == ErrorHandling::Springs) style.bias = softBiasRule<Real>();
    if (traits.errors == ErrorHandling::Positions) style.bias = BiasRule<Real>{};
    if (traits.linearJointBaumgarte) {
        BiasRule<Real> joints;
        joints.baumgarte = static_cast<Real>(*traits.linearJointBaumgarte);
        style.linearJointBias = joints;
    }
    return style;
}

}  // namespace rigor::engine
