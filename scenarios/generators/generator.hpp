// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Generators write the bodies and joints of large scenes as if they had been written out, so that every
// engine gets the same scene from the same file. They work on JSON: what they make is read and checked like
// the rest.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "scenarios/json/node.hpp"

namespace rigor::scenario {

/// More is a mistake in a file: growth curves of the bench go to 10^5 bodies, and a body costs about a
/// kilobyte of JSON while it is read.
inline constexpr int kMaxBodies = 200000;

struct Generated {
    std::vector<Json> bodies, joints;
};

/// A line of the table of generators.
struct Generator {
    const char* name;
    const char* summary;
    Generated (*make)(const Node&);
};
const std::vector<Generator>& generatorTable();

/// Expands one entry of "generators": an object with one key, the generator's name. Reports unknown names.
Generated generate(const Node& entry);

Generated generateGrid(const Node& node);
Generated generatePyramid(const Node& node);
Generated generatePile(const Node& node);
Generated generateChain(const Node& node);
Generated generateContainer(const Node& node);
Generated generateGroup(const Node& node);
Generated generateHullPile(const Node& node);
Generated generateNet(const Node& node);
Generated generateRain(const Node& node);
Generated generateRepeat(const Node& node);
Generated generateTumbler(const Node& node);

/// Uniform numbers that are the same on every platform: the engine is specified by the standard, its
/// distributions are not.
class PortableRandom {
  public:
    explicit PortableRandom(std::uint64_t seed) : engine_(seed) {}
    /// Uniform random number in [0, 1), 53 random bits.
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double a, double b) { return a + (b - a) * unit(); }

  private:
    std::mt19937_64 engine_;
};

/// A uniformly distributed orientation: "orientation" in 3D (Shoemake, Graphics Gems III, 1992), "angle" in
/// 2D.
void turnAtRandom(Json& body, PortableRandom& random, int dimension);
/// Piles up bodies from templates, as `pile` does; also used by generators that make their own templates. The
/// caller has read "seed".
Generated pileUp(const Node& node, const std::vector<Json>& templates, PortableRandom& random);
/// A box shape of these half extents at `position` in its body, of the node's "material" where it has one.
Json boxShape(const Node& node, const Vec3& halfExtents, const Vec3& position);

/// A vector as it stands in a file: three numbers, or two in 2D.
Json vectorJson(const Vec3& v, int dimension);
/// A copy of the template with name and position.
Json placed(const Json& body, const std::string& name, const Vec3& position, int dimension);

}  // namespace rigor::scenario
