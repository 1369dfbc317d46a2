// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every input of the corpora, without a fuzzer: seeds, and inputs by which something was found once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "validation/fuzz/hdf5_tree.hpp"
#include "validation/fuzz/targets.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path corpusOf(const Target& target) {
    return fs::path(RIGOR_SOURCE_DIR) / "validation/fuzz/corpus" / target.name;
}

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Replay : public testing::TestWithParam<Target> {};

TEST_P(Replay, EveryInputOfTheCorpus) {
    std::size_t inputs = 0;
    for (const auto& entry : fs::directory_iterator(corpusOf(GetParam()))) {
        SCOPED_TRACE(entry.path().filename().string());
        const std::string bytes = contentOf(entry.path());
        EXPECT_NO_THROW(GetParam().read(bytes));
        // Each is also cut short and with a byte changed.
        for (const std::size_t end : {bytes.size() / 2, bytes.size() * 9 / 10})
            EXPECT_NO_THROW(GetParam().read(bytes.substr(0, end)));
        std::string changed = bytes;
        if (!changed.empty()) changed[changed.size() / 3] ^= 0x10;
        EXPECT_NO_THROW(GetParam().read(changed));
        ++inputs;
    }
    EXPECT_GE(inputs, 1u);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, testing::ValuesIn(targets()),
                         [](const auto& one) { return std::string(one.param.name); });

/// The seed is a trajectory, so that changed ones get past the first check.
TEST(TrajectoryTrees, TheSeedIsWhole) {
    const fs::path seed = fs::path(RIGOR_SOURCE_DIR) / "validation/fuzz/corpus/trajectory/seed";
    const auto file = results::parseTrajectory(hdf5From(contentOf(seed)));
    EXPECT_EQ(file.bodies.size(), 2u);
    EXPECT_EQ(file.contacts.size(), 1u);
}

}  // namespace
}  // namespace rigor::fuzz
