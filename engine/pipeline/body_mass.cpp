// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/pipeline/body_mass.hpp"

#include <cmath>

#include "engine/math/decompositions.hpp"
#include "engine/pipeline/require.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Inertia unitInertia() {
    if constexpr (S::dim == 2)
        return typename S::Real(1);
    else
        return S::Inertia::Identity();
}

/// Inertia of a point mass at r about the origin.
template <class S>
typename S::Inertia pointInertia(typename S::Real mass, const typename S::Vec& r) {
    if constexpr (S::dim == 2)
        return mass * r.squaredNorm();
    else
        return mass * (r.squaredNorm() * S::Inertia::Identity() - r * r.transpose());
}

template <class S>
bool positiveDefinite(const typename S::Inertia& I) {
    if constexpr (S::dim == 2) {
        return I > 0 && std::isfinite(I);
    } else {
        if (!I.allFinite()) return false;
        const typename S::Real size = I.cwiseAbs().maxCoeff();
        if ((I - I.transpose()).cwiseAbs().maxCoeff() > typename S::Real(1e-4) * size) return false;
        return Eigen::SelfAdjointEigenSolver<typename S::Mat>(I, Eigen::EigenvaluesOnly)
                   .eigenvalues()
                   .minCoeff() > 0;
    }
}

}  // namespace

template <class S>
bool BodyMass<S>::byHand() const {
    if constexpr (S::dim == 2)
        return inertia != 0;
    else
        return !inertia.isZero(0);
}

template <class S>
MassProperties<S> BodyMass<S>::properties() const {
    using Real = typename S::Real;
    if (byHand()) return {mass, center, inertia};
    if (!(shapes.mass > 0)) return {mass > 0 ? mass : Real(1), center, unitInertia<S>()};
    const Real scale = mass > 0 ? mass / shapes.mass : Real(1);
    return {scale * shapes.mass, shapes.center, typename S::Inertia(scale * shapes.inertia)};
}

template <class S>
void addMass(const MassProperties<S>& part, MassProperties<S>& whole) {
    using Real = typename S::Real;
    if (!(part.mass > 0)) return;
    if (!(whole.mass > 0)) {
        whole = part;
        return;
    }
    const Real mass = whole.mass + part.mass;
    const typename S::Vec between = part.center - whole.center;
    whole.inertia +=
        typename S::Inertia(part.inertia + pointInertia<S>(whole.mass * part.mass / mass, between));
    whole.center += (part.mass / mass) * between;
    whole.mass = mass;
}

template <class S>
MassProperties<S> massOfShape(const ShapeRecord<S>& shape, const typename S::Vec& centerOfMass) {
    if (!(shape.density > 0)) return {0, S::Vec::Zero(), zeroInertia<S>()};
    MassProperties<S> own = massProperties<S>(shape.shape, shape.density);
    own.center = toWorld<S>(shape.local, own.center) + centerOfMass;
    own.inertia = worldInertia<S>(shape.local.q, own.inertia);
    return own;
}

template <class S>
void checkMass(const MassProperties<S>& properties) {
    require(properties.mass > 0 && std::isfinite(properties.mass), "body_mass",
            "mass of a dynamic body must be positive");
    require(properties.center.allFinite(), "body_center_of_mass", "centre of mass must be finite");
    require(positiveDefinite<S>(properties.inertia), "body_inertia",
            "inertia of a dynamic body must be symmetric and positive definite");
}

#define RIGOR_INSTANTIATE(S)                                                         \
    template bool BodyMass<S>::byHand() const;                                       \
    template MassProperties<S> BodyMass<S>::properties() const;                      \
    template void addMass<S>(const MassProperties<S>&, MassProperties<S>&);          \
    template MassProperties<S> massOfShape<S>(const ShapeRecord<S>&, const S::Vec&); \
    template void checkMass<S>(const MassProperties<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
