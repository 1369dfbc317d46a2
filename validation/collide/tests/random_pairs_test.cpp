// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random pairs are what their kinds say, and the same again from the same seed or from the file.
#include "validation/collide/random_pairs.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

double distanceOf(const CollisionCase& c) {
    return exactContact(c.a.geometry, c.a.pose, c.b.geometry, c.b.pose, c.dimension).value().signedDistance;
}

/// Width of a shape along a direction of the world.
double widthAlong(const Shape& s, Vec3 n) {
    const Geometry point = Sphere{0.0};
    const auto gap = [&](Vec3 d) { return *separationAlong(s.geometry, s.pose, point, s.pose, 3, d); };
    return -gap(n) - gap(-1.0 * n);
}
double size(const Shape& s) {
    return std::max({widthAlong(s, {1, 0, 0}), widthAlong(s, {0, 1, 0}), widthAlong(s, {0, 0, 1})});
}

class RandomKind : public testing::TestWithParam<std::string> {
  protected:
    static CollisionFile make(const std::string& kind, int dimension, std::uint64_t seed = 5) {
        return makeRandomPairs({60, seed, dimension, {kind}, {}, {}});
    }
    template <class Check>
    static void each(const std::string& kind, Check check) {
        for (int dimension : {2, 3})
            for (const CollisionCase& c : make(kind, dimension).cases) {
                SCOPED_TRACE(c.text);
                EXPECT_EQ(c.tags.at(0), kind);
                check(c, distanceOf(c));
            }
    }
};
INSTANTIATE_TEST_SUITE_P(Kinds, RandomKind, testing::ValuesIn(randomPairKinds()),
                         [](const auto& instance) { return instance.param; });

TEST_P(RandomKind, SameSeedSamePairs) {
    for (int dimension : {2, 3}) {
        const auto one = make(GetParam(), dimension), two = make(GetParam(), dimension),
                   other = make(GetParam(), dimension, 6);
        ASSERT_EQ(one.cases.size(), 60u);
        for (std::size_t i = 0; i < one.cases.size(); ++i) {
            EXPECT_EQ(one.cases[i].text, two.cases[i].text);
            EXPECT_NE(one.cases[i].text, other.cases[i].text);
        }
    }
}

TEST_P(RandomKind, TheFileHoldsTheSamePairs) {
    const auto made = make(GetParam(), 3);
    const auto path = std::filesystem::temp_directory_path() /
                      ("random_pairs_" + GetParam() + "_" + std::to_string(getpid()) + ".json");
    writeCollisionFile(made, path);
    const auto read = loadCollisionFile(path);
    std::filesystem::remove(path);
    ASSERT_EQ(read.cases.size(), made.cases.size());
    for (std::size_t i = 0; i < made.cases.size(); ++i) {
        EXPECT_EQ(distanceOf(read.cases[i]), distanceOf(made.cases[i])) << made.cases[i].text;
        EXPECT_EQ(read.cases[i].name, made.cases[i].name);
        EXPECT_EQ(read.cases[i].line, made.cases[i].line);
        EXPECT_EQ(read.cases[i].tags, made.cases[i].tags);
    }
}

class RandomKinds : public RandomKind {};
INSTANTIATE_TEST_SUITE_P(All, RandomKinds, testing::Values("all"));

TEST_P(RandomKinds, AreWhatTheySay) {
    each("touching", [](const CollisionCase&, double sd) { EXPECT_LE(std::abs(sd), 1.01e-8); });
    each("grazing", [](const CollisionCase&, double sd) {
        EXPECT_LE(std::abs(sd), 1.01e-3);
        EXPECT_GE(std::abs(sd), 0.99e-8);
    });
    each("deep", [](const CollisionCase& c, double) {
        EXPECT_LE(norm(c.a.pose.position - c.b.pose.position), 0.2 + 1e-15);
    });
    each("concentric",
         [](const CollisionCase& c, double) { EXPECT_EQ(norm(c.a.pose.position - c.b.pose.position), 0.0); });
    each("identical", [](const CollisionCase& c, double sd) {
        EXPECT_EQ(c.a.geometry.index(), c.b.geometry.index());
        EXPECT_EQ(norm(c.a.pose.position - c.b.pose.position), 0.0);
        EXPECT_LT(sd, 0);
    });
    each("far", [](const CollisionCase& c, double) { EXPECT_NEAR(norm(c.a.pose.position), 1e4, 1e-8); });
    for (const CollisionCase& c : make("tiny", 3).cases) EXPECT_NEAR(size(c.a), 2e-3, 2e-3) << c.text;
    for (const CollisionCase& c : make("huge", 3).cases) EXPECT_NEAR(size(c.a), 2e3, 2e3) << c.text;
    int thin = 0;
    for (const CollisionCase& c : make("thin", 3).cases) {
        const Vec3 axis = rotate(c.a.pose.orientation, {0, 1, 0});
        thin += widthAlong(c.a, axis) < 0.004 * size(c.a) ? 1 : 0;
    }
    EXPECT_GT(thin, 30);  // all but capsules and balls
}

/// Random pairs cover both verdicts, every pair of shapes, ties and continua.
TEST(RandomPairs, CoverTheField) {
    for (int dimension : {2, 3}) {
        const auto file = makeRandomPairs({1500, 9, dimension, {}, {}, {}});
        int overlapping = 0, ties = 0, continua = 0;
        std::set<std::pair<std::string, std::string>> pairs;
        for (const CollisionCase& c : file.cases) {
            const auto exact =
                exactContact(c.a.geometry, c.a.pose, c.b.geometry, c.b.pose, dimension).value();
            overlapping += exact.signedDistance < 0 ? 1 : 0;
            ties += exact.normals.size() > 1 ? 1 : 0;
            continua += exact.continuum ? 1 : 0;
            pairs.emplace(c.tags.at(1), c.tags.at(2));
        }
        EXPECT_GT(overlapping, 500);
        EXPECT_LT(overlapping, 1300);
        EXPECT_GT(ties, 50);
        EXPECT_GT(continua, 10);
        const std::size_t shapes = randomPairShapes(dimension).size();
        EXPECT_EQ(pairs.size(), shapes * shapes);
    }
}

TEST(RandomPairs, ShapesAndPairsCanBeChosen) {
    for (const CollisionCase& c : makeRandomPairs({50, 1, 3, {"generic"}, {}, {"box-hull"}}).cases) {
        EXPECT_TRUE(std::holds_alternative<Box>(c.a.geometry));
        EXPECT_TRUE(std::holds_alternative<ConvexHull>(c.b.geometry));
    }
    for (const CollisionCase& c : makeRandomPairs({50, 1, 2, {}, {"circle", "polygon"}, {}}).cases)
        for (const Shape* s : {&c.a, &c.b})
            EXPECT_TRUE(std::holds_alternative<Sphere>(s->geometry) ||
                        std::holds_alternative<ConvexHull>(s->geometry));
}

TEST(RandomPairs, UnknownNamesAreRefused) {
    EXPECT_THROW(makeRandomPairs({1, 1, 3, {"odd"}, {}, {}}), std::invalid_argument);
    EXPECT_THROW(makeRandomPairs({1, 1, 2, {}, {"cone"}, {}}), std::invalid_argument);
    EXPECT_THROW(makeRandomPairs({1, 1, 3, {}, {}, {"box"}}), std::invalid_argument);
    EXPECT_THROW(makeRandomPairs({1, 1, 3, {}, {"box"}, {"box-box"}}), std::invalid_argument);
    try {
        makeRandomPairs({1, 1, 3, {}, {"ball"}, {}});
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("found 'ball', expected one of sphere"), std::string::npos);
    }
}

}  // namespace
}  // namespace rigor::validation
