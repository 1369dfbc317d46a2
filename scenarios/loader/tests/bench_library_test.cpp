// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenes of the bench: every file is complete, grows with its size, and starts without bodies in each
// other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

std::size_t dynamicBodies(const Scenario& s) {
    return static_cast<std::size_t>(std::count_if(s.bodies.begin(), s.bodies.end(),
                                                  [](const Body& b) { return b.type == BodyType::Dynamic; }));
}

class BenchLibrary : public testing::TestWithParam<LibraryEntry> {};

TEST_P(BenchLibrary, IsComplete) {
    const Scenario s = loadScenario(GetParam().file).scenario;
    EXPECT_EQ(s.name, GetParam().file.stem().string());
    EXPECT_THAT(s.name, testing::StartsWith("bench_"));
    EXPECT_THAT(s.tags, testing::Contains("bench"));
    EXPECT_GT(s.title.size(), 10u);
    EXPECT_GT(s.description.size(), 40u);
    EXPECT_FALSE(s.isolates.empty());
    ASSERT_TRUE(s.size);
    ASSERT_TRUE(s.bench);
    EXPECT_GE(s.bench->warmUpSteps, 100);
    EXPECT_GE(s.bench->timedSteps, 100);
    EXPECT_LE(s.bench->qualityStep * s.timeSteps[0], s.duration * (1 + 1e-9)) << "the run is as long";
    EXPECT_GE(s.bench->sizes.size(), 4u);
    EXPECT_FALSE(s.bench->quality.empty());
    for (const Body& b : s.bodies) EXPECT_EQ(b.linearVelocityKept, 1.0) << "no damping";
}

TEST_P(BenchLibrary, GrowsWithItsSize) {
    const Scenario s = loadScenario(GetParam().file).scenario;
    std::size_t before = 0;
    for (const int size : s.bench->sizes) {
        const Scenario other = loadScenario(GetParam().file, {"size=" + std::to_string(size)}).scenario;
        EXPECT_GT(dynamicBodies(other), before) << size;
        EXPECT_GE(dynamicBodies(other), 8u);
        before = dynamicBodies(other);
        for (const QualityBound& bound : other.bench->quality) EXPECT_LE(bound.min, bound.max);
    }
}

/// Radius of a sphere around the body's frame that holds its shapes.
double reach(const Body& body) {
    double r = 0.0;
    for (const Shape& shape : body.shapes) {
        double own = 0.0;
        if (const auto* ball = std::get_if<Sphere>(&shape.geometry)) own = ball->radius;
        if (const auto* box = std::get_if<Box>(&shape.geometry)) own = norm(box->halfExtents);
        if (const auto* capsule = std::get_if<Capsule>(&shape.geometry))
            own = capsule->radius + capsule->halfLength;
        if (const auto* hull = std::get_if<ConvexHull>(&shape.geometry))
            for (const Vec3& v : hull->vertices) own = std::max(own, norm(v));
        r = std::max(r, own + norm(shape.pose.position));
    }
    return r;
}

/// Half the side of the largest cube around the centre, with the axes of the body, that a shape fills; for
/// balls and hulls of the ball inside.
double core(const Body& body) {
    double r = 1e9;
    for (const Shape& shape : body.shapes) {
        if (const auto* ball = std::get_if<Sphere>(&shape.geometry)) r = std::min(r, ball->radius);
        if (const auto* capsule = std::get_if<Capsule>(&shape.geometry)) r = std::min(r, capsule->radius);
        if (const auto* box = std::get_if<Box>(&shape.geometry))
            r = std::min({r, box->halfExtents.x, box->halfExtents.y,
                          box->halfExtents.z > 0 ? box->halfExtents.z : 1e9});
        if (std::holds_alternative<ConvexHull>(shape.geometry)) r = std::min(r, 0.4);
    }
    return r;
}

/// No two moving bodies have overlapping cores, and none is in a wall: at the smallest, the usual and the
/// largest size.
TEST_P(BenchLibrary, StartsApart) {
    const Scenario usual = loadScenario(GetParam().file).scenario;
    for (const int size : {usual.bench->sizes.front(), *usual.size, usual.bench->sizes.back()}) {
        const Scenario s = loadScenario(GetParam().file, {"size=" + std::to_string(size)}).scenario;
        if (!s.bodies.back().collides) continue;
        std::vector<const Body*> moving;
        for (const Body& b : s.bodies)
            if (b.type == BodyType::Dynamic) moving.push_back(&b);
        std::sort(moving.begin(), moving.end(),
                  [](const Body* a, const Body* b) { return a->pose.position.x < b->pose.position.x; });
        long close = 0;
        for (std::size_t i = 0; i < moving.size(); ++i)
            for (std::size_t k = i + 1; k < moving.size(); ++k) {
                const Vec3 d = moving[k]->pose.position - moving[i]->pose.position;
                if (d.x > 2.0) break;
                if (norm(d) < (core(*moving[i]) + core(*moving[k])) * (1 - 1e-12)) ++close;
            }
        EXPECT_EQ(close, 0) << "size " << size;
        for (const Body& wall : s.bodies) {
            if (wall.type == BodyType::Dynamic) continue;
            for (const Shape& shape : wall.shapes) {
                const Vec3 h = std::get<Box>(shape.geometry).halfExtents;
                for (const Body* b : moving) {
                    const Vec3 d = b->pose.position - wall.pose.position - shape.pose.position;
                    const double gap = std::max({std::abs(d.x) - h.x, std::abs(d.y) - h.y,
                                                 s.dimension == 3 ? std::abs(d.z) - h.z : -1e9});
                    const bool turned = b->pose.orientation.w != 1.0;
                    EXPECT_GE(gap, (turned ? reach(*b) : core(*b)) * (1 - 1e-9))
                        << b->name << " at size " << size;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Files, BenchLibrary, testing::ValuesIn(listBenchScenarios()),
                         [](const auto& each) { return each.param.name; });

/// Required numbers of bodies of the bench's scenes.
TEST(BenchScenes, HaveTheBodiesTheySay) {
    const std::map<std::string, std::size_t> counts{{"bench_box_pyramid", 1240},
                                                    {"bench_box_pyramid_drop", 1240},
                                                    {"bench_sphere_pile", 2000},
                                                    {"bench_box_pile", 1000},
                                                    {"bench_hull_pile", 500},
                                                    {"bench_chain_heavy_end", 101},
                                                    {"bench_chains", 2000},
                                                    {"bench_joint_net", 900},
                                                    {"bench_pyramid_2d", 5050},
                                                    {"bench_many_pyramids", 1470},
                                                    {"bench_many_pyramids_2d", 2200},
                                                    {"bench_pile_2d", 2000},
                                                    {"bench_ragdolls", 2200},
                                                    {"bench_bridge", 200},
                                                    {"bench_tumbler", 1000},
                                                    {"bench_tumbler_2d", 900},
                                                    {"bench_rain", 1000},
                                                    {"bench_rain_2d", 1000}};
    for (const auto& [name, count] : counts)
        EXPECT_EQ(dynamicBodies(loadScenario(findScenario(name)).scenario), count) << name;
}

TEST(BenchScenes, AreTheSuiteAndNoSuiteHasThemByAccident) {
    std::vector<std::string> names;
    for (const LibraryEntry& entry : listBenchScenarios()) names.push_back(entry.name);
    EXPECT_GE(names.size(), 16u);
    EXPECT_THAT(loadSuite(findSuite("bench")).scenarios, testing::UnorderedElementsAreArray(names));
    EXPECT_THAT(loadSuite(findSuite("full")).scenarios,
                testing::Not(testing::Contains(testing::StartsWith("bench_"))));
}

}  // namespace
}  // namespace rigor::scenario
