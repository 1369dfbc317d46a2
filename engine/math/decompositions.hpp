// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Eigen's decompositions of small symmetric matrices; apart from space.hpp, since few files need them and
// they are slow to compile.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "engine/math/space.hpp"
