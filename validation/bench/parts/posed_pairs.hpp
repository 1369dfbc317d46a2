// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of posed shapes for narrow phases. Orientations are uniform; B stands off A in a random direction, is
// moved along it to the first touch, by the exact oracle, and from there 0.05 m in (overlap) or 0.1 m out
// (apart). `face`: boxes 1 cm deep, face on face, turned at random about the normal.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::validation {

enum class Closeness { Overlap, Face, Apart };

struct PairKind {
    std::string a, b;  ///< "box", "sphere", "capsule", "hull16"; 2D: "circle", "box", "polygon6"
    Closeness closeness = Closeness::Overlap;
    int dimension = 3;
    std::string name() const;  ///< "3D box-box face"
};
const std::vector<PairKind>& pairKinds();

struct PosedPairs {
    std::deque<scenario::Geometry> shapes;  ///< shapes of pair i are at 2 i and 2 i + 1
    std::vector<adapter::CollisionQuery> queries;
    std::vector<double> depths;  ///< exact, < 0: apart [m]; of the first ones that were requested
};
/// The same for the same request. The oracle computes the depth of the first `known` pairs.
PosedPairs makePosedPairs(const PairKind& kind, std::size_t count, std::size_t known, std::uint64_t seed);

}  // namespace rigor::validation
