// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of the isolated parts of a bench and their output: the work is the declared one, and wrong results
// are detected.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "adapters/interface/timed.hpp"
#include "validation/bench/parts/contact_scenes.hpp"
#include "validation/bench/parts/engines.hpp"
#include "validation/bench/parts/moving_boxes.hpp"
#include "validation/bench/parts/posed_pairs.hpp"
#include "validation/contact_problems/residual.hpp"

namespace rigor::validation {

std::vector<PlannedBench> planBroadPhases(const BenchRequest& request);
std::unique_ptr<TimedWork> makeBroadPhase(const PlannedBench& planned);
std::vector<PlannedBench> planNarrowPhases(const BenchRequest& request);
std::unique_ptr<TimedWork> makeNarrowPhase(const PlannedBench& planned);
std::vector<PlannedBench> planContactSolvers(const BenchRequest& request);
std::unique_ptr<TimedWork> makeContactSolver(const PlannedBench& planned);

namespace {

using adapter::Pair;
using testing::AllOf;
using testing::Ge;
using testing::Le;

BenchRequest request(std::vector<std::string> engines) {
    const std::string binaries = RIGOR_BINARY_DIR;
    setenv("RIGOR_ADAPTER_PATH", (binaries + "/bin/adapters:" + binaries + "/tests/bench_doubles").c_str(),
           1);
    BenchRequest r;
    r.engines = std::move(engines);
    r.binary = std::string(RIGOR_BINARY_DIR) + "/bin/rigor";
    return r;
}
double qualityOf(const results::BenchRepetition& done, const std::string& name) {
    for (const auto& quality : done.quality)
        if (quality.name == name) return quality.value;
    ADD_FAILURE() << "no quality " << name;
    return NAN;
}
double countOf(const results::BenchRepetition& done, const std::string& name) {
    for (const auto& count : done.counts)
        if (count.name == name) return count.value;
    ADD_FAILURE() << "no count " << name;
    return NAN;
}
bool valid(const results::BenchRepetition& done) {
    return std::all_of(done.quality.begin(), done.quality.end(), [](const auto& q) { return q.ok; });
}

TEST(MovingBoxes, SortedPairsAreThoseOfBruteForceAndThereAreHalfAsManyAsBoxes) {
    for (const int dimension : {2, 3})
        for (const BoxOrder order : {BoxOrder::Random, BoxOrder::Spatial}) {
            MovingBoxes scene(dimension, 2000, order, 1);
            for (int step = 0; step < 300; ++step, scene.advance()) {
                if (step % 100 != 99) continue;
                const auto exact = exactPairs(scene.boxes());
                EXPECT_EQ(exact, adapter::bruteForcePairs(scene.boxes()));
                EXPECT_THAT(exact.size(), AllOf(Ge(800u), Le(1200u))) << dimension << "D after " << step;
            }
        }
}

TEST(MovingBoxes, OrderIsAllThatDiffers) {
    const MovingBoxes random(3, 500, BoxOrder::Random, 4), spatial(3, 500, BoxOrder::Spatial, 4);
    const auto corners = [](const MovingBoxes& scene) {
        std::vector<std::array<double, 3>> all;
        for (const auto& box : scene.boxes()) all.push_back({box.min.x, box.min.y, box.min.z});
        return all;
    };
    EXPECT_NE(corners(random), corners(spatial));
    EXPECT_THAT(corners(random), testing::UnorderedElementsAreArray(corners(spatial)));
    const auto way = [&](const MovingBoxes& scene) {
        double sum = 0;
        for (std::size_t i = 1; i < scene.boxes().size(); ++i)
            sum += norm(scene.boxes()[i].min - scene.boxes()[i - 1].min);
        return sum;
    };
    EXPECT_LT(way(spatial), 0.5 * way(random)) << "neighbours in the list are near each other";
}

TEST(PairCheck, MissedAndExcessPairsAreCounted) {
    const std::vector<adapter::Aabb> boxes{
        {{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{5, 0, 0}, {6, 1, 1}}};
    const PairCheck good = checkPairs(boxes, {{0, 1}, {0, 1}});
    EXPECT_EQ(good.exact, 1u);
    EXPECT_EQ(good.missed, 0u);
    EXPECT_EQ(good.excess(), 0u);
    const PairCheck wrong = checkPairs(boxes, {{1, 2}, {0, 2}});
    EXPECT_EQ(wrong.missed, 1u);
    EXPECT_EQ(wrong.excess(), 2u);
}

/// Few boxes: they are tested for right pairs; the bench itself tests the large ones.
TEST(BroadPhasePart, EveryChoiceOfEveryEngineFindsAllPairsAndOursNoOthers) {
    BenchRequest r = request({});
    for (const auto& engine : adapter::availableEngines())
        if (!engine.starts_with("double")) r.engines.push_back(engine);
    r.sizes = {300};
    r.only = {"3D, random order", "2D, spatial order"};
    int ran = 0;
    for (const PlannedBench& p : planBroadPhases(r)) {
        SCOPED_TRACE(p.name + ", " + p.engine);
        std::unique_ptr<TimedWork> work;
        try {
            work = makeBroadPhase(p);
        } catch (const adapter::Unsupported&) {
            continue;  // an engine of Debian that is optional has none
        }
        ++ran;
        for (const int round : {0, 1}) {
            const auto done = work->run(round);
            EXPECT_TRUE(valid(done));
            EXPECT_EQ(qualityOf(done, "missed_pairs"), 0.0);
            EXPECT_THAT(countOf(done, "pairs"), AllOf(Ge(100.0), Le(200.0)));
            EXPECT_EQ(countOf(done, "pairs_held"), countOf(done, "pairs") + qualityOf(done, "excess_pairs"));
            if (p.engine.starts_with("rigor")) {
                EXPECT_EQ(qualityOf(done, "excess_pairs"), 0.0);
            }
            EXPECT_GT(done.cpu, 0.0);
        }
    }
    EXPECT_GE(ran, 20);
}

TEST(BroadPhasePart, AForgottenPairMakesATimingInvalid) {
    BenchRequest r = request({"double_careless"});
    r.sizes = {100};
    r.only = {"3D, random order"};
    const auto planned = planBroadPhases(r);
    ASSERT_EQ(planned.size(), 3u) << "every choice of the option";
    for (const PlannedBench& p : planned)
        for (const int round : {0, 1}) {
            SCOPED_TRACE(p.engine + ", round " + std::to_string(round));
            const auto done = makeBroadPhase(p)->run(round);
            const bool forgets = p.engine.ends_with("forgetful"), all = p.engine.ends_with("generous");
            EXPECT_EQ(valid(done), !forgets);
            EXPECT_EQ(qualityOf(done, "missed_pairs"), forgets ? 1.0 : 0.0);
            const double excess = 100.0 * 99.0 / 2.0 - countOf(done, "pairs");
            EXPECT_DOUBLE_EQ(qualityOf(done, "excess_pairs"), all ? excess : 0.0) << "reported, not judged";
        }
}

/// 1e5 boxes, each with every other.
TEST(BroadPhasePart, WhatWouldTakeTooLongIsRefusedWithAnEstimate) {
    BenchRequest r = request({"double_careless:broad_phase=brute_force"});
    r.sizes = {1e5};
    r.only = {"3D, random order"};
    const auto planned = planBroadPhases(r);
    ASSERT_EQ(planned.size(), 1u);
    EXPECT_THROW(makeBroadPhase(planned[0])->run(0), adapter::Unsupported);
}

TEST(BroadPhasePart, ASpecThatNamesItsChoiceIsTimedAlone) {
    BenchRequest r = request({"rigor:broad_phase=octree,precision=f32"});
    r.sizes = {1000};
    r.only = {"3D, random order"};
    const auto planned = planBroadPhases(r);
    ASSERT_EQ(planned.size(), 1u);
    EXPECT_EQ(planned[0].engine, "rigor:broad_phase=octree,precision=f32");
}

/// The usual cases are some of all; an engine that is named is planned, usual or not.
TEST(Parts, UsualCasesAreSomeOfAllAndNamesAreTaken) {
    const auto plan = [](bool full, std::vector<std::string> only) {
        BenchRequest r = request({"rigor:precision=f32,broad_phase=wide_tree,solver=nsgs"});
        r.full = full;
        r.only = std::move(only);
        std::set<std::string> cases;
        for (const auto& planOf : {planBroadPhases, planNarrowPhases, planContactSolvers})
            for (const PlannedBench& p : planOf(r))
                cases.insert(p.name + (p.size > 0 ? " of " + std::to_string(std::llround(p.size)) : "") +
                             ", " + p.engine);
        return cases;
    };
    const auto usual = plan(false, {}), all = plan(true, {});
    EXPECT_TRUE(std::includes(all.begin(), all.end(), usual.begin(), usual.end()));
    EXPECT_LT(usual.size(), 0.7 * all.size());
    const auto has = [](const std::set<std::string>& cases, const std::string& start) {
        const auto found = cases.lower_bound(start);
        return found != cases.end() && found->starts_with(start);
    };
    for (const char* name : {"3D, random order of 10000", "2D, random order of 10000", "3D box-box face",
                             "2D circle-box overlap", "stack_10 to 1e-6", "wall_28 to 1e-6"})
        EXPECT_TRUE(has(usual, name)) << name;
    for (const char* name : {"3D, random order of 100000", "3D, spatial order of 100000", "3D box-box apart",
                             "stack_10 to 1e-9"})
        EXPECT_TRUE(has(all, name) && !has(usual, name)) << name;
    const auto named = plan(false, {"3D box-box apart", "3D, spatial order", "stack_10"});
    EXPECT_EQ(named.size(), 2u + 1u + 3u) << "with the interface, and the three residuals";
}

TEST(PosedPairs, AreAsDeepAsTheyClaim) {
    for (const PairKind& kind : pairKinds()) {
        SCOPED_TRACE(kind.name());
        const PosedPairs pairs = makePosedPairs(kind, 20, 20, 3);
        ASSERT_EQ(pairs.depths.size(), 20u);
        for (const double depth : pairs.depths) {
            // B is moved in by 0.05 m: the least penetration is at most that, and not zero.
            if (kind.closeness == Closeness::Overlap) {
                EXPECT_THAT(depth, AllOf(Ge(0.005), Le(0.05 + 1e-6)));
            }
            if (kind.closeness == Closeness::Face) {
                EXPECT_NEAR(depth, 0.01, 1e-12);
            }
            if (kind.closeness == Closeness::Apart) {
                EXPECT_THAT(depth, AllOf(Ge(-0.1 - 1e-6), Le(-0.01)));
            }
        }
        const PosedPairs again = makePosedPairs(kind, 20, 20, 3), other = makePosedPairs(kind, 20, 20, 4);
        EXPECT_EQ(pairs.depths, again.depths);
        if (kind.closeness != Closeness::Face) {
            EXPECT_NE(pairs.depths, other.depths);
        }
    }
}

/// The timed batch gives the same results as single queries.
TEST(NarrowPhasePart, ABatchSaysWhatSingleQueriesSay) {
    request({});
    for (const std::string spec :
         {"rigor", "rigor:precision=f32,narrow_phase=gjk_epa", "bullet", "ode", "fcl"}) {
        const auto engine = adapter::loadEngine(adapter::parseSpec(spec));
        const auto settings = adapter::resolveSettings(adapter::parseSpec(spec), *engine);
        for (const PairKind& kind : pairKinds()) {
            if (kind.dimension != 3 || kind.a.starts_with("hull") || kind.b.starts_with("hull")) continue;
            SCOPED_TRACE(spec + ", " + kind.name());
            PosedPairs pairs = makePosedPairs(kind, 10, 0, 5);
            for (auto& query : pairs.queries) {
                query.settings = &settings;
                query.maxContacts = 64;
                if (const auto found = settings.find("narrow_phase"); found != settings.end())
                    query.algorithm = found->second;
            }
            const auto* timed = dynamic_cast<const adapter::TimedCollisionEngine*>(engine->collision());
            ASSERT_NE(timed, nullptr);
            const auto batch = timed->batch(pairs.queries);
            EXPECT_EQ(batch->run(), batch->run()) << "nothing is remembered";
            for (std::size_t i = 0; i < pairs.queries.size(); ++i) {
                const auto single = engine->collision()->collide(pairs.queries[i]);
                double depth = 0.0, together = 0.0;
                for (const auto& c : single.contacts) depth = std::max(depth, c.depth);
                for (const auto& c : batch->contacts(i)) together = std::max(together, c.depth);
                EXPECT_NEAR(depth, together, 1e-9) << "pair " << i;
            }
        }
    }
}

TEST(NarrowPhasePart, TheExactOnesAreValidAndTheInterfaceIsCheap) {
    BenchRequest r = request({"rigor:precision=f32"});
    r.only = {"3D box-box face", "2D circle-box overlap"};
    const auto planned = planNarrowPhases(r);
    ASSERT_EQ(planned.size(), 4u);
    for (const PlannedBench& p : planned) {
        const auto done = makeNarrowPhase(p)->run(1);
        EXPECT_TRUE(valid(done)) << p.engine;
        if (p.engine == "interface") {
            EXPECT_LT(done.cpu, 50e-9) << "per pair";
        } else {
            EXPECT_LT(qualityOf(done, "mean_depth_error"), 1e-5);
        }
    }
}

TEST(NarrowPhasePart, WrongAnswersMakeATimingInvalid) {
    struct Expected {
        const char *kind, *narrowPhase;
        double meanError, wrong;
    };
    const Expected all[] = {{"3D sphere-sphere overlap", "balls", 0.0, 0.0},
                            {"3D sphere-sphere overlap", "deep", 0.01, 0.0},
                            {"3D sphere-sphere overlap", "blind", 0.0, 1.0},
                            {"3D sphere-sphere apart", "balls", 0.0, 0.0},
                            {"3D sphere-sphere apart", "excited", 0.0, 1.0}};
    for (const Expected& expected : all) {
        SCOPED_TRACE(std::string(expected.kind) + ", " + expected.narrowPhase);
        BenchRequest r = request({std::string("double_careless:narrow_phase=") + expected.narrowPhase});
        r.only = {expected.kind};
        const auto planned = planNarrowPhases(r);
        ASSERT_EQ(planned.size(), 2u) << "and the interface";
        const auto done = makeNarrowPhase(planned[0])->run(1);
        EXPECT_NEAR(qualityOf(done, "mean_depth_error"), expected.meanError, 1e-9);
        EXPECT_EQ(qualityOf(done, "wrong_answers"), expected.wrong);
        EXPECT_EQ(valid(done), expected.meanError + expected.wrong == 0.0);
    }
}

TEST(ContactScenes, AreCompleteAndSymmetric) {
    const std::map<std::string, std::size_t> contacts{{"stack_10", 40},
                                                      {"pyramid_14", 9 * 4 + 5 * 16},
                                                      {"heavy_on_light", 20},
                                                      {"struck_pyramid", 116},
                                                      {"wall_28", 7 * 2 + 21 * 4}};
    for (const std::string& name : contactScenes()) {
        SCOPED_TRACE(name);
        const ContactProblem p = makeContactScene(name, 1).problem;
        EXPECT_EQ(p.contacts(), contacts.at(name));
        ASSERT_EQ(p.W.size(), p.size() * p.size());
        for (std::size_t i = 0; i < p.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                ASSERT_NEAR(p.W[i * p.size() + k], p.W[k * p.size() + i], 1e-12);
    }
}

/// The floor carries all bodies: m g h.
TEST(ContactSolverPart, ResidualsAreReachedAndTheSolutionIsTheWeight) {
    const auto engine = adapter::loadEngine(adapter::parseSpec("rigor"));
    const auto settings = adapter::resolveSettings(adapter::parseSpec("rigor:solver=nsgs"), *engine);
    const ExportedProblem exported = makeContactScene("stack_10", 1);
    const auto found = engine->contactSolvers()->take(exported.problem, settings)->run(1000, 1e-14);
    double floor = 0.0;
    for (std::size_t c = 0; c < 4; ++c) floor += found.r[3 * c];
    EXPECT_NEAR(floor, 10 * 1000.0 * 9.81 / 60.0, 1e-6 * floor);

    BenchRequest r = request({"rigor:solver=nsgs", "rigor:solver=single_pass"});
    r.only = {"heavy_on_light to 1e-6"};
    const auto planned = planContactSolvers(r);
    ASSERT_EQ(planned.size(), 2u);
    const auto nsgs = makeContactSolver(planned[0])->run(1), single = makeContactSolver(planned[1])->run(1);
    EXPECT_TRUE(valid(nsgs));
    EXPECT_LE(qualityOf(nsgs, "residual"), 1e-6);
    EXPECT_FALSE(valid(single)) << "one pass of impulses does not solve this";
}

}  // namespace
}  // namespace rigor::validation
