// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The size that lengths of a body compare with.
#pragma once

#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

/// Shortest edge of the bounding box of the shapes along the body's axes, x and y alone in 2D [m]. A
/// cylinder or cone counts as the box about it. Infinite without shapes.
double widthOf(const scenario::Body& body, int dimension);

}  // namespace rigor::validation
