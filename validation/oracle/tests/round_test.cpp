// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cylinders and cones: closed forms, and a second method that knows no features: the sphere of directions is
// cut into triangles, and those that cannot hold the least support of the Minkowski difference are dropped.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kPi = std::numbers::pi;
const Quat kLying = fromAxisAngle({0, 0, 1}, kPi / 2);   // axis y to -x
const Quat kLyingZ = fromAxisAngle({1, 0, 0}, kPi / 2);  // axis y to z

Pose placed(double x, double y, double z, Quat q = {}) {
    return {{x, y, z}, q};
}
OracleAnswer roundContact(const Geometry& a, const Pose& Xa, const Geometry& b, const Pose& Xb) {
    return exactContact(a, Xa, b, Xb, 3).value();
}
double roundDistance(const Geometry& a, const Pose& Xa, const Geometry& b, const Pose& Xb) {
    return roundContact(a, Xa, b, Xb).signedDistance;
}
bool hasNormal(const OracleAnswer& answer, Vec3 n) {
    for (const Vec3& m : answer.normals)
        if (norm(m - n) < 1e-9) return true;
    return false;
}

// ------------------------------------------------------------------------------------------ closed forms
const Geometry kCan = Cylinder{0.5, 1.0};
const Geometry kHat = Cone{0.6, 0.4};  // side: 0.6 across on 0.8 up, so its normals are (0.8, 0.6)

TEST(RoundOracle, BallsAroundACylinder) {
    EXPECT_NEAR(roundDistance(kCan, {}, Sphere{0.1}, placed(0.9, 0.3, 0)), 0.3, 1e-15);    // side
    EXPECT_NEAR(roundDistance(kCan, {}, Sphere{0.1}, placed(0.1, 1.5, 0.2)), 0.4, 1e-15);  // cap
    EXPECT_NEAR(roundDistance(kCan, {}, Sphere{0.1}, placed(0.8, 1.4, 0)), 0.4, 1e-15);    // rim: 3, 4, 5
    EXPECT_NEAR(roundDistance(kCan, {}, Sphere{0.1}, placed(0.3, 0.2, 0)), -0.3,
                1e-15);  // inside, near the side
    EXPECT_NEAR(roundDistance(kCan, {}, Sphere{0.1}, placed(0.1, 0.8, 0)), -0.3,
                1e-15);  // inside, near the cap
}

TEST(RoundOracle, BallsAroundACone) {
    // The side's line: 0.8 r + 0.6 y = 0.24.
    EXPECT_NEAR(roundDistance(kHat, {}, Sphere{0.1}, placed(0.9, 0, 0)), 0.8 * 0.9 - 0.24 - 0.1, 1e-15);
    EXPECT_NEAR(roundDistance(kHat, {}, Sphere{0.1}, placed(0, 0.7, 0)), 0.2, 1e-15);      // apex
    EXPECT_NEAR(roundDistance(kHat, {}, Sphere{0.1}, placed(0.9, -0.8, 0)), 0.4, 1e-15);   // rim: 3, 4, 5
    EXPECT_NEAR(roundDistance(kHat, {}, Sphere{0.1}, placed(0.1, -0.3, 0)), -0.2, 1e-15);  // inside, base
    EXPECT_NEAR(roundDistance(kHat, {}, Sphere{0.1}, placed(0, 0.1, 0.1)), 0.08 + 0.06 - 0.34, 1e-15);
}

TEST(RoundOracle, HalfSpaces) {
    const Geometry floor = HalfSpace{{0, 1, 0}, 0.25};
    const auto standing = roundContact(floor, {}, kCan, placed(3, 1.2, 1));
    EXPECT_NEAR(standing.signedDistance, -0.05, 1e-15);
    EXPECT_NEAR(norm(standing.witnessB - Vec3{3, 0.2, 1}), 0, 1e-15);
    EXPECT_NEAR(roundDistance(kCan, placed(0, 1, 0, kLying), floor, {}), 0.25, 1e-15);
    const Quat tilt = fromAxisAngle({0, 0, 1}, std::atan2(3.0, 4.0));
    EXPECT_NEAR(roundDistance(floor, {}, kCan, placed(0, 2, 0, tilt)), 2 - 0.8 - 0.3 - 0.25, 1e-15);
    EXPECT_NEAR(roundDistance(floor, {}, kHat, placed(0, 2, 0, fromAxisAngle({1, 0, 0}, kPi))), 1.35, 1e-15);
}

TEST(RoundOracle, TwoCylinders) {
    EXPECT_NEAR(roundDistance(kCan, {}, kCan, placed(0.9, 0.3, 0)), -0.1, 1e-15);            // side by side
    EXPECT_NEAR(roundDistance(kCan, {}, kCan, placed(0.9, 1.95, 0)), -0.05, 1e-15);          // cap on cap
    EXPECT_NEAR(roundDistance(kCan, {}, kCan, placed(0.2, 0.1, 0.9, kLying)), -0.1, 1e-15);  // crossed sides
    EXPECT_NEAR(roundDistance(kCan, {}, kCan, placed(0, 1.4, 0, kLying)), -0.1, 1e-15);      // side on cap
    EXPECT_NEAR(roundDistance(kCan, {}, kCan, placed(1.3, 2.4, 0)), 0.5, 1e-15);             // rims: 3, 4, 5
    const auto crossed = roundContact(kCan, {}, kCan, placed(0, 0, 0, kLying));
    EXPECT_NEAR(crossed.signedDistance, -1.0, 1e-15);
    EXPECT_EQ(crossed.normals.size(), 2u);
    EXPECT_TRUE(hasNormal(crossed, {0, 0, 1}) && hasNormal(crossed, {0, 0, -1}));
}

/// Every direction around a common axis is equally good: a continuum, with samples all around.
TEST(RoundOracle, CoaxialAndIdentical) {
    const Geometry pin = Cylinder{0.2, 3.0};
    const Quat any = normalized(Quat{0.3, -0.5, 0.7, 0.2});
    const auto pinned = roundContact(kCan, placed(1, 2, 3, any), pin, placed(1, 2, 3, any));
    EXPECT_NEAR(pinned.signedDistance, -0.7, 1e-15);
    EXPECT_TRUE(pinned.continuum);
    EXPECT_GE(pinned.normals.size(), 16u);
    const Vec3 axis = rotate(any, {0, 1, 0});
    for (const Vec3& n : pinned.normals) EXPECT_NEAR(dot(n, axis), 0, 1e-15);
    // A cone in itself, apex to base: along the normals of its side, twice the way from them to the axis'
    // ends.
    const double r = 0.3, half = 0.8;
    const auto same = roundContact(Cone{r, half}, placed(1, 2, 3, any), Cone{r, half}, placed(1, 2, 3, any));
    EXPECT_TRUE(same.continuum);
    EXPECT_NEAR(same.signedDistance, -4 * half * r / std::hypot(r, 2 * half), 1e-15);
    const auto flat = roundContact(Cylinder{1.0, 0.1}, {}, Cylinder{1.0, 0.1}, {});
    EXPECT_NEAR(flat.signedDistance, -0.2, 1e-15);
    EXPECT_FALSE(flat.continuum);
    EXPECT_EQ(flat.normals.size(), 2u);
    const auto nearly = roundContact(kCan, {}, pin, placed(1e-5, 0, 0));
    EXPECT_NEAR(nearly.signedDistance, -0.7 + 1e-5, 1e-15);
    EXPECT_FALSE(nearly.continuum);
}

/// A box with an edge on the axis of a cylinder: half a ring of penetration vectors, of which a quarter is as
/// short.
TEST(RoundOracle, PartOfARing) {
    const auto answer = roundContact(kCan, {}, Box{{2, 2, 2}}, placed(2, 0, 2));
    EXPECT_NEAR(answer.signedDistance, -0.5, 1e-15);
    EXPECT_TRUE(answer.continuum);
    EXPECT_TRUE(hasNormal(answer, {1, 0, 0}) && hasNormal(answer, {0, 0, 1}));
    EXPECT_FALSE(hasNormal(answer, {-1, 0, 0}));
}

TEST(RoundOracle, CapsulesAndBoxes) {
    EXPECT_NEAR(roundDistance(kCan, {}, Capsule{0.1, 1}, placed(0.7, 0.3, 0)), 0.1, 1e-15);
    EXPECT_NEAR(roundDistance(kCan, {}, Capsule{0.1, 1}, placed(0, 0, 0.55, kLying)), -0.05, 1e-15);
    EXPECT_TRUE(roundContact(kCan, {}, Capsule{0.1, 4}, {}).continuum);
    EXPECT_NEAR(roundDistance(Box{{1, 1, 1}}, {}, kHat, placed(0.2, 1.3, 0.1)), -0.1, 1e-15);
    EXPECT_NEAR(roundDistance(Box{{1, 1, 1}}, {}, kCan, placed(0, 1.4, 0, kLyingZ)), -0.1, 1e-15);
}

// -------------------------------------------------------------------------------- a method without features
/// Point of a shape that is farthest along d, in the world. Its own formulas.
Vec3 farthest(const Geometry& g, const Pose& X, Vec3 d) {
    const Vec3 l = rotate(conjugate(X.orientation), d);
    Vec3 p;
    const double across = std::hypot(l.x, l.z);
    const Vec3 out = across > 0 ? Vec3{l.x / across, 0, l.z / across} : Vec3{1, 0, 0};
    if (const auto* s = std::get_if<Sphere>(&g)) p = s->radius / norm(l) * l;
    if (const auto* c = std::get_if<Capsule>(&g))
        p = Vec3{0, std::copysign(c->halfLength, l.y), 0} + c->radius / norm(l) * l;
    if (const auto* c = std::get_if<Cylinder>(&g))
        p = Vec3{0, std::copysign(c->halfLength, l.y), 0} + c->radius * out;
    if (const auto* c = std::get_if<Cone>(&g)) {
        const Vec3 apex{0, c->halfLength, 0}, rim = Vec3{0, -c->halfLength, 0} + c->radius * out;
        p = dot(apex, l) > dot(rim, l) ? apex : rim;
    }
    if (const auto* b = std::get_if<Box>(&g)) {
        const Vec3 h = b->halfExtents;
        p = {std::copysign(h.x, l.x), std::copysign(h.y, l.y), std::copysign(h.z, l.z)};
    }
    if (const auto* h = std::get_if<ConvexHull>(&g)) {
        p = h->vertices.front();
        for (const Vec3& v : h->vertices)
            if (dot(v, l) > dot(p, l)) p = v;
    }
    return X.position + rotate(X.orientation, p);
}

struct Bracket {
    double low, high;  ///< bounds of the signed distance
};

/// A triangle of directions, with the points of K = A - B that support its corners. Every point x of K bounds
/// the support of K over the triangle by the least x . n over it.
class Search {
  public:
    Search(const Geometry& a, const Pose& Xa, const Geometry& b, const Pose& Xb)
        : a_(a), b_(b), Xa_(Xa), Xb_(Xb) {}

    Bracket run(double tolerance, std::size_t mostTriangles) {
        const Vec3 e[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        std::vector<Triangle> triangles;
        for (int i : {0, 1})
            for (int j : {2, 3})
                for (int k : {4, 5}) triangles.push_back({corner(e[i]), corner(e[j]), corner(e[k])});
        double bound = -1e300;
        while (!triangles.empty() && triangles.size() < mostTriangles) {
            std::vector<Triangle> next;
            bound = best_;
            for (const Triangle& t : triangles) {
                const double low = lowest(t);
                bound = std::min(bound, low);
                if (low > best_ - tolerance) continue;
                const Corner x = corner(t[0].n + t[1].n), y = corner(t[1].n + t[2].n),
                             z = corner(t[2].n + t[0].n);
                next.insert(next.end(), {{t[0], x, z}, {x, t[1], y}, {z, y, t[2]}, {x, y, z}});
            }
            triangles.swap(next);
        }
        return {-best_, -std::min(bound, best_ - tolerance)};
    }

  private:
    struct Corner {
        Vec3 n, x;
    };
    using Triangle = std::array<Corner, 3>;

    Corner corner(Vec3 v) {
        const Vec3 n = v / norm(v);
        const Vec3 x = farthest(a_, Xa_, n) - farthest(b_, Xb_, -1.0 * n);
        best_ = std::min(best_, dot(x, n));
        return {n, x};
    }
    static double lowest(const Triangle& t) {
        double best = -1e300;
        for (const Corner& c : t) {
            double low = 1e300;
            for (const Corner& at : t) low = std::min(low, dot(c.x, at.n));
            // A direction of the triangle is a mean of the corners, made longer by at most this.
            const double shortest = norm(t[0].n + t[1].n + t[2].n) / 3.0 < 0.9 ? 0.5 : 1 - farApart(t);
            best = std::max(best, low < 0 ? low / shortest : low);
        }
        return best;
    }
    /// The mean of unit vectors within an angle of s of each other is at least 1 - s^2 long.
    static double farApart(const Triangle& t) {
        const double s = std::max({norm(t[0].n - t[1].n), norm(t[1].n - t[2].n), norm(t[2].n - t[0].n)});
        return s * s;
    }

    const Geometry &a_, &b_;
    const Pose &Xa_, &Xb_;
    double best_ = 1e300;
};

struct RandomRound {
    std::mt19937 generator;
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator);
    }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator); }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        const Vec3 v{normal(generator), normal(generator), normal(generator)};
        return v / norm(v);
    }
    Quat rotation() {
        std::normal_distribution<double> n;
        return normalized(Quat{n(generator), n(generator), n(generator), n(generator)});
    }
    double length() { return below(8) == 0 ? 0.002 : uniform(0.3, 1.0); }
    Geometry round() {
        return below(2) == 0 ? Geometry{Cylinder{length(), length()}} : Geometry{Cone{length(), length()}};
    }
    Geometry shape() {
        switch (below(7)) {
            case 0:
                return Sphere{length()};
            case 1:
                return Box{{length(), length(), length()}};
            case 2:
                return Capsule{0.5 * length(), length()};
            case 3: {
                ConvexHull hull;
                for (int i = 0; i < 12; ++i) hull.vertices.push_back(uniform(0.3, 1.0) * direction());
                return hull;
            }
            default:
                return round();
        }
    }
    /// Pose of B in the frame of the other solid: any pose, or turned by quarter turns and little more, and
    /// moved along no, one or all axes.
    Pose pose() {
        static const double kTilts[] = {0.0, 0.0, 1e-9, 1e-4};
        Quat q = rotation();
        if (below(2) == 0) {
            const Quat turns[] = {{}, kLying, kLyingZ};
            q = turns[below(3)] * fromAxisAngle(direction(), kTilts[below(4)]);
        }
        const double reach = uniform(0.0, 2.2);
        const Vec3 places[] = {{}, {0, reach, 0}, {reach, 0, 0}, reach * direction(), reach * direction()};
        return {places[below(5)], q};
    }
};

TEST(RoundOracle, IsBracketedByTheSearchOverDirections) {
    RandomRound random{std::mt19937(5)};
    int overlapping = 0, apart = 0, rings = 0;
    for (int i = 0; i < 400; ++i) {
        const Geometry a = random.round(), b = random.shape();
        const Pose Xa{}, Xb = random.pose();
        const auto answer = roundContact(a, Xa, b, Xb);
        const Bracket bracket = Search(a, Xa, b, Xb).run(1e-9, 40000);
        EXPECT_GE(answer.signedDistance, bracket.low - 1e-14) << i;
        EXPECT_LE(answer.signedDistance, bracket.high + 1e-14) << i;
        // Rings of equal directions are cut into the triangles that there are.
        EXPECT_LE(bracket.high - bracket.low, answer.continuum ? 1e-3 : 1e-5) << i;
        (answer.signedDistance < 0 ? overlapping : apart)++;
        rings += answer.continuum;
        ASSERT_FALSE(answer.normals.empty());
        for (const Vec3& n : answer.normals)
            EXPECT_NEAR(*separationAlong(a, Xa, b, Xb, 3, n), answer.signedDistance, 3e-9) << i;
        EXPECT_NEAR(*separationAlong(a, Xa, b, Xb, 3, answer.normals[0]), answer.signedDistance, 1e-14) << i;
        // The distance is bounded from below by the direction, from above by the points.
        const Vec3 gap = answer.witnessB - answer.witnessA;
        // Directions are known to half the digits of a value that is flat over them.
        EXPECT_LE(norm(gap - answer.signedDistance * answer.normals[0]), 2e-10) << i;
        const double dot = 1e-9;  // the points are on the surfaces
        EXPECT_NEAR(roundDistance(a, Xa, Sphere{dot}, {answer.witnessA, {}}), -dot, 2e-10) << i;
        EXPECT_NEAR(roundDistance(b, Xb, Sphere{dot}, {answer.witnessB, {}}), -dot, 2e-10) << i;
    }
    EXPECT_GT(overlapping, 100);
    EXPECT_GT(apart, 100);
    EXPECT_GT(rings, 10);
}

/// B moved out along the best way by t is t nearer to separation, whatever t: touching, near touching and
/// apart have the same result as deep. Turned, moved far, swapped and scaled: the same.
TEST(RoundOracle, MovesAndFramesKeepTheAnswer) {
    RandomRound random{std::mt19937(6)};
    for (int i = 0; i < 150; ++i) {
        const Geometry a = random.round(), b = random.shape();
        const Pose Xa{}, Xb = random.pose();
        const auto answer = roundContact(a, Xa, b, Xb);
        const double sd = answer.signedDistance;
        const double left = std::max(0.0, -sd);
        for (const double target : {-0.5 * left, -1e-3, -1e-9, 0.0, 1e-9, 1e-3, 0.3}) {
            if (target < sd) continue;
            const Pose moved{Xb.position + (target - sd) * answer.normals[0], Xb.orientation};
            const auto then = roundContact(a, Xa, b, moved);
            EXPECT_NEAR(then.signedDistance, target, 1e-15) << i;
            EXPECT_TRUE(hasNormal(then, answer.normals[0])) << i << " " << target;
        }
        EXPECT_NEAR(roundDistance(b, Xb, a, Xa), sd, 1e-15) << i;
        const Pose far{{1e4, -2e4, 1e4}, random.rotation()};
        EXPECT_NEAR(roundDistance(a, far * Xa, b, far * Xb), sd, 2e-11) << i;
    }
}

TEST(RoundOracle, ScalesWithTheShapes) {
    RandomRound random{std::mt19937(8)};
    for (int i = 0; i < 100; ++i) {
        const double r = random.length(), h = random.length(), s = random.length(), k = random.length();
        const Pose X = random.pose();
        const double sd = roundDistance(Cone{r, h}, {}, Cylinder{s, k}, X);
        for (const double scale : {1.0 / 1024, 1024.0}) {
            const Pose scaled{scale * X.position, X.orientation};
            EXPECT_NEAR(roundDistance(Cone{scale * r, scale * h}, {}, Cylinder{scale * s, scale * k}, scaled),
                        scale * sd, scale * 1e-17)
                << i;
        }
    }
}

}  // namespace
}  // namespace rigor::validation
