// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The same bits today as yesterday, in Debug as in Release: the state hashes of a table of scenes against
// recorded ones (golden_hashes.def). They depend on IEEE arithmetic, on the order of operations that the
// source prescribes (-ffp-contract=off, no fast-math), and on Eigen's SSE2 kernels, hence x86-64; not on libm, of which a
// step uses no function that is not exact (math/portable.hpp). Other processors: cmake/cross/README.md.
//
// A difference says that results have changed. If the change was intended, renew the file by
//     RIGOR_RENEW_GOLDEN=1 build/release/tests/engine_pipeline_state_test --gtest_filter=Golden.*
// and say in the commit why. If it was not, or if Debug and Release differ, look for what depends on the
// compiler: libm calls folded at compile time, uninitialised values, the order of evaluation.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "engine/pipeline/tests/golden_scenes.hpp"

namespace rigor::engine::test {
namespace {

const char* const kFile = RIGOR_SOURCE_DIR "/engine/pipeline/tests/golden_hashes.def";

std::map<std::string, std::uint64_t> recorded() {
    std::map<std::string, std::uint64_t> golden;
#define GOLDEN(scene, hash) golden[#scene] = hash##ull;
#include "engine/pipeline/tests/golden_hashes.def"
#undef GOLDEN
    return golden;
}

TEST(Golden, EverySceneHasItsBits) {
#if !defined(__x86_64__)
    GTEST_SKIP() << "the recorded hashes are those of x86-64";
#endif
    std::map<std::string, std::uint64_t> hashes;
    forEachGolden([&hashes](const std::string& name, const GoldenResult& result) {
        EXPECT_TRUE(result.finite) << name;
        EXPECT_GT(result.contacts, 0u) << name;
        hashes[name] = result.hash;
    });
    std::map<std::uint64_t, std::string> sceneOf;
    for (const auto& [name, hash] : hashes) {
        const auto [other, isNew] = sceneOf.emplace(hash, name);
        EXPECT_TRUE(isNew) << name << " is no other than " << other->second;
    }
    if (std::getenv("RIGOR_RENEW_GOLDEN") != nullptr) {
        std::ofstream out(kFile);
        out << "// SPDX-License-Identifier: MIT\n// SPDX-FileCopyrightText: 2026 The Rigor authors\n"
            << "// GOLDEN(scene, state hash), written by golden_test.cpp, which describes how and when.\n";
        for (const auto& [name, hash] : hashes) {
            char line[100];
            std::snprintf(line, sizeof line, "GOLDEN(%s, 0x%016llx)\n", name.c_str(),
                          static_cast<unsigned long long>(hash));
            out << line;
        }
        ASSERT_TRUE(out.good()) << kFile;
        GTEST_SKIP() << "renewed " << kFile;
    }
    const std::map<std::string, std::uint64_t> golden = recorded();
    for (const auto& [name, hash] : hashes) {
        ASSERT_TRUE(golden.count(name)) << name << " has no golden hash";
        EXPECT_EQ(hash, golden.at(name)) << name;
    }
    EXPECT_EQ(hashes.size(), golden.size()) << "golden hashes of scenes that are gone";
}

}  // namespace
}  // namespace rigor::engine::test
