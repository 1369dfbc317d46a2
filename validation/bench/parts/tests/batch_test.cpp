// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Batches of worlds in a bench: the worlds that are timed end as one that is stepped alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "adapters/interface/unsupported.hpp"
#include "validation/bench/parts/engines.hpp"

namespace rigor::validation {

std::vector<PlannedBench> planBatches(const BenchRequest& request);
std::unique_ptr<TimedWork> makeBatch(const PlannedBench& planned);

namespace {

BenchRequest batchRequest(std::vector<std::string> engines) {
    setenv("RIGOR_ADAPTER_PATH", RIGOR_BINARY_DIR "/bin/adapters", 1);
    BenchRequest r;
    r.engines = std::move(engines);
    r.binary = RIGOR_BINARY_DIR "/bin/rigor";
    r.sizes = {3};
    return r;
}

TEST(BatchPart, WorldsEndAsOneThatIsSteppedAlone) {
    BenchRequest r = batchRequest({"rigor"});
    r.threads = {1, 2};
    const std::vector<PlannedBench> all = planBatches(r);
    std::set<std::string> names;
    for (const PlannedBench& planned : all) names.insert(planned.name);
    EXPECT_EQ(names.size(), 4u);
    EXPECT_EQ(all.size(), 4u * 2 * 2) << "scenes, precisions, numbers of threads";
    for (const PlannedBench& planned : all) {
        const results::BenchRepetition done = makeBatch(planned)->run(1);
        ASSERT_EQ(done.quality.size(), 1u);
        EXPECT_TRUE(done.quality[0].ok) << planned.name << ": " << done.quality[0].value << " m";
        EXPECT_GT(done.wall, 0);
        EXPECT_EQ(done.counts[0].value, 3);
    }
}

TEST(BatchPart, EnginesWithoutBatchesLoopOverWorldsInOneThread) {
    if (!std::filesystem::exists(RIGOR_BINARY_DIR "/bin/adapters/rigor_adapter_ode.so"))
        GTEST_SKIP() << "no ODE";
    BenchRequest r = batchRequest({"ode:precision=f64"});
    r.only = {"pendulum"};
    r.threads = {1, 2};
    const std::vector<PlannedBench> all = planBatches(r);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_TRUE(makeBatch(all[0])->run(1).quality[0].ok);
    EXPECT_THROW(makeBatch(all[1])->run(1), adapter::Unsupported);
}

}  // namespace
}  // namespace rigor::validation
