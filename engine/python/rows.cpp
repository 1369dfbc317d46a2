// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/rows.hpp"

#include <pybind11/numpy.h>

namespace rigor::engine::python {

void registerRows() {
    PYBIND11_NUMPY_DTYPE_EX(ContactRow2, bodyA, "body_a", bodyB, "body_b", shapeA, "shape_a", shapeB,
                            "shape_b", pointA, "point_a", pointB, "point_b", normal, "normal", depth, "depth",
                            normalImpulse, "normal_impulse", frictionImpulse, "friction_impulse");
    PYBIND11_NUMPY_DTYPE_EX(ContactRow3, bodyA, "body_a", bodyB, "body_b", shapeA, "shape_a", shapeB,
                            "shape_b", pointA, "point_a", pointB, "point_b", normal, "normal", depth, "depth",
                            normalImpulse, "normal_impulse", frictionImpulse, "friction_impulse");
    PYBIND11_NUMPY_DTYPE_EX(HitRow2, body, "body", shape, "shape", piece, "piece", fraction, "fraction",
                            distance, "distance", point, "point", normal, "normal", inside, "inside");
    PYBIND11_NUMPY_DTYPE_EX(HitRow3, body, "body", shape, "shape", piece, "piece", fraction, "fraction",
                            distance, "distance", point, "point", normal, "normal", inside, "inside");
}

}  // namespace rigor::engine::python
