// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of NumPy's structured arrays; bodies, shapes and joints by their indices in the Python world, -1: none.
#pragma once

#include <cstdint>

namespace rigor::engine::python {

/// World::readContacts.
template <int Dim>
struct ContactRow {
    std::int32_t bodyA, bodyB, shapeA, shapeB;
    double pointA[Dim], pointB[Dim], normal[Dim];
    double depth, normalImpulse;
    double frictionImpulse[Dim];
};

/// A hit of a ray or of a moved shape, the nearest shape, a shape that overlaps.
template <int Dim>
struct HitRow {
    std::int32_t body, shape, piece;
    double fraction, distance;
    double point[Dim], normal[Dim];
    bool inside;
};

using ContactRow2 = ContactRow<2>;
using ContactRow3 = ContactRow<3>;
using HitRow2 = HitRow<2>;
using HitRow3 = HitRow<3>;

/// Makes the rows known to NumPy.
void registerRows();

}  // namespace rigor::engine::python
