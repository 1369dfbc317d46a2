// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No body gets through a mesh, a height field or a chain: the short form of engine_count_lost_bodies, three
// seeds for each ground, motion, preset and precision, which together have all forms of ground and sizes of
// triangles.
#include <gtest/gtest.h>

#include "engine/benchmarks/lost/rain.hpp"

namespace rigor::engine::lost {
namespace {

class LostBodies : public testing::TestWithParam<std::tuple<Ground, Motion>> {};

TEST_P(LostBodies, AreNone) {
    constexpr std::uint64_t kSeeds = 3;
    const auto [ground, motion] = GetParam();
    std::uint64_t seed =
        kSeeds * (4 * static_cast<std::uint64_t>(ground) + static_cast<std::uint64_t>(motion));
    for (const bool fast : {false, true})
        for (const bool single : {false, true})
            for (std::uint64_t k = 0; k < kSeeds; ++k) {
                Case what;
                what.ground = ground;
                what.motion = motion;
                what.fast = fast;
                what.single = single;
                what.bodies = fast ? 60 : 25;
                what.duration = 1.5;
                what.seed = seed++;
                setGroundOfSeed(what);
                for (const Loss& loss : run(what).lost)
                    ADD_FAILURE() << "body " << loss.body << ", a " << loss.shape << ", in step " << loss.step
                                  << " of " << describe(what);
            }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, LostBodies,
                         testing::Combine(testing::Values(Ground::Mesh, Ground::Field, Ground::Chain),
                                          testing::Values(Motion::Drop, Motion::Pile, Motion::Roll,
                                                          Motion::Slide)));

}  // namespace
}  // namespace rigor::engine::lost
