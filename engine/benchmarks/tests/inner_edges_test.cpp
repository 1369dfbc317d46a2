// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Inner edges do not catch: bodies that slide and roll over planes of pieces have the position and velocity
// of the same bodies on a half-space, within 1e-3 of the way and of the speed. The short form of
// engine_measure_inner_edges.
#include <gtest/gtest.h>

#include "engine/benchmarks/edges/slide.hpp"

namespace rigor::engine::edges {
namespace {

class InnerEdges : public testing::TestWithParam<std::tuple<Ground, bool, bool>> {};

/// Bound of the differences. A capsule of single precision at rest, whose manifolds are cached while it moves
/// by less than a millimetre, has 0.91 mm/s (of 0.5 m/s) measured.
double boundOf(const Case& what) {
    const bool rests = what.friction > 0 && what.speed < 1 && what.body == Body::CapsuleAlong;
    return what.fast && what.single && rests ? 3e-3 : 1e-3;
}

void check(const Case& what) {
    const Outcome outcome = run(what);
    EXPECT_LE(outcome.position, boundOf(what)) << describe(what);
    EXPECT_LE(outcome.velocity, boundOf(what)) << describe(what);
}

TEST_P(InnerEdges, AreNotFelt) {
    Case what;
    std::tie(what.ground, what.fast, what.single) = GetParam();
    int run = 0;
    for (const Body body : {Body::Sphere, Body::Box, Body::CapsuleAlong, Body::CapsuleAcross})
        for (const double angle : {0.0, 0.4, 0.785})
            for (const double squares : {0.1, 0.3, 1.0, 10.0})
                for (const double speed : {0.5, 3.0, 10.0}) {
                    if (what.ground == Ground::Chain && (angle != 0 || body == Body::CapsuleAcross)) continue;
                    what.body = body;
                    what.angle = angle;
                    what.squares = squares;
                    what.speed = speed;
                    what.friction = ++run % 2 == 0 ? 0.3 : 0;
                    what.jitter = run % 3 == 0 && what.ground != Ground::Field;
                    what.duration = squares < 0.2 ? 0.25 : 1;
                    check(what);
                }
}

TEST_P(InnerEdges, OfASlopeAreNotFelt) {
    Case what;
    std::tie(what.ground, what.fast, what.single) = GetParam();
    what.slope = 0.3;
    what.angle = what.ground == Ground::Chain ? 0 : 0.4;
    for (const Body body : {Body::Sphere, Body::Box})
        for (const double squares : {0.3, 1.0})
            for (const double friction : {0.0, 0.3}) {
                what.body = body;
                what.squares = squares;
                what.friction = friction;
                check(what);
            }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, InnerEdges,
                         testing::Combine(testing::Values(Ground::Mesh, Ground::Field, Ground::Chain),
                                          testing::Bool(), testing::Bool()));

}  // namespace
}  // namespace rigor::engine::edges
