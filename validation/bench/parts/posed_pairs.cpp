// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/parts/posed_pairs.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "scenarios/generators/generator.hpp"
#include "scenarios/model/hull.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

constexpr double kTurn = 2 * std::numbers::pi;
/// The oracle takes milliseconds for hulls: of these so many pairs are made, the others are the same pairs
/// elsewhere in the world.
constexpr std::size_t kDistinctHulls = 50;

class PairMaker {
  public:
    PairMaker(const PairKind& kind, std::uint64_t seed) : kind_(kind), random_(seed) {}

    void add(PosedPairs& pairs) {
        const Geometry& a = pairs.shapes.emplace_back(shape(kind_.a));
        const Geometry& b = pairs.shapes.emplace_back(shape(kind_.b));
        Pose Xa, Xb;
        if (kind_.closeness == Closeness::Face) {
            if (kind_.dimension == 3) Xb.orientation = fromAxisAngle({0, 1, 0}, kTurn * random_.unit());
            Xb.position.y = std::get<Box>(a).halfExtents.y + std::get<Box>(b).halfExtents.y - 0.01;
        } else {
            Xa.orientation = rotation();
            Xb.orientation = rotation();
            const Vec3 d = direction();
            Xb.position = touch(a, Xa, b, Xb, d);
            Xb.position += (kind_.closeness == Closeness::Overlap ? -0.05 : 0.1) * d;
        }
        adapter::CollisionQuery query;
        query.a = {&a, Xa};
        query.b = {&b, Xb};
        query.dimension = kind_.dimension;
        query.maxContacts = 4;
        pairs.queries.push_back(query);
    }

    /// Pair i again, both shapes turned and moved as one.
    void addMoved(PosedPairs& pairs, std::size_t i) {
        const Pose to{2.0 * direction(), rotation()};
        adapter::CollisionQuery query = pairs.queries[i];
        pairs.shapes.push_back(pairs.shapes[2 * i]);
        query.a.geometry = &pairs.shapes.back();
        pairs.shapes.push_back(pairs.shapes[2 * i + 1]);
        query.b.geometry = &pairs.shapes.back();
        query.a.pose = to * query.a.pose;
        query.b.pose = to * query.b.pose;
        pairs.queries.push_back(query);
    }

  private:
    Vec3 direction() {
        const double z = kind_.dimension == 2 ? 0.0 : random_.between(-1, 1), a = kTurn * random_.unit();
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }
    Quat rotation() {  // uniform (Shoemake, Graphics Gems III, 1992)
        if (kind_.dimension == 2) return fromAxisAngle({0, 0, 1}, kTurn * random_.unit());
        const double u = random_.unit(), a = kTurn * random_.unit(), b = kTurn * random_.unit();
        const double s = std::sqrt(1 - u), t = std::sqrt(u);
        return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
    }
    Geometry shape(const std::string& name) {
        const auto length = [this] { return random_.between(0.4, 0.6); };
        if (name == "sphere" || name == "circle") return Sphere{length()};
        if (name == "capsule") return Capsule{length() / 2, length()};
        if (name == "box") {
            const double x = length(), y = length(), z = length();
            return Box{{x, y, kind_.dimension == 2 ? 0.0 : z}};
        }
        if (name == "hull16") return round(16);
        if (name == "polygon6") return round(6);
        throw std::invalid_argument("pair kind of '" + name + "'");
    }
    /// Points spread evenly (3D: Fibonacci's spiral), shifted at random and brought to 0.55 m: all of them
    /// are corners.
    ConvexHull round(int count) {
        ConvexHull hull;
        for (int i = 0; i < count; ++i) {
            const double share = (i + 0.5) / count, z = kind_.dimension == 2 ? 0.0 : 1 - 2 * share;
            const double r = std::sqrt(1 - z * z);
            const double angle = kind_.dimension == 2 ? kTurn * share : 2.399963229728653 * i;
            const auto shift = [this] { return random_.between(-0.1, 0.1); };
            Vec3 v{r * std::cos(angle), r * std::sin(angle), z};
            v.x += shift();
            v.y += shift();
            if (kind_.dimension == 3) v.z += shift();
            hull.vertices.push_back(0.55 / norm(v) * v);
        }
        if (kind_.dimension == 2) hull.vertices = convexHull2d(hull.vertices);
        return hull;
    }
    /// Position of B at which it touches A when moved along -d: Newton's method on the signed distance, which
    /// is convex along the way; its slope is the minimising normal's component along d. Iterates from
    /// outside.
    Vec3 touch(const Geometry& a, const Pose& Xa, const Geometry& b, Pose Xb, const Vec3& d) const {
        double t = 3.0;
        for (int k = 0; k < 50; ++k) {
            Xb.position = t * d;
            const auto exact = exactContact(a, Xa, b, Xb, kind_.dimension);
            if (!exact) throw std::invalid_argument("pair kind without an exact result: " + kind_.name());
            if (exact->signedDistance < 1e-9) break;
            t -= exact->signedDistance / std::max(0.05, dot(exact->normals.front(), d));
        }
        return t * d;
    }

    PairKind kind_;
    PortableRandom random_;
};

}  // namespace

std::string PairKind::name() const {
    const char* word = closeness == Closeness::Overlap ? "overlap"
                       : closeness == Closeness::Face  ? "face"
                                                       : "apart";
    return std::to_string(dimension) + "D " + a + "-" + b + " " + word;
}

const std::vector<PairKind>& pairKinds() {
    using enum Closeness;
    static const std::vector<PairKind> kinds{
        {"box", "box", Overlap, 3},         {"box", "box", Face, 3},
        {"box", "box", Apart, 3},           {"hull16", "hull16", Overlap, 3},
        {"hull16", "hull16", Apart, 3},     {"box", "hull16", Overlap, 3},
        {"sphere", "box", Overlap, 3},      {"sphere", "box", Apart, 3},
        {"sphere", "sphere", Overlap, 3},   {"sphere", "sphere", Apart, 3},
        {"capsule", "capsule", Overlap, 3}, {"capsule", "box", Overlap, 3},
        {"capsule", "box", Apart, 3},       {"capsule", "hull16", Overlap, 3},
        {"box", "box", Overlap, 2},         {"box", "box", Face, 2},
        {"box", "box", Apart, 2},           {"polygon6", "polygon6", Overlap, 2},
        {"circle", "circle", Overlap, 2},   {"circle", "box", Overlap, 2},
        {"circle", "polygon6", Overlap, 2}, {"circle", "box", Apart, 2}};
    return kinds;
}

PosedPairs makePosedPairs(const PairKind& kind, std::size_t count, std::size_t known, std::uint64_t seed) {
    PosedPairs pairs;
    PairMaker maker(kind, seed);
    const bool slow = kind.a.starts_with("hull") || kind.b.starts_with("hull");
    const std::size_t distinct = slow ? std::min(count, kDistinctHulls) : count;
    for (std::size_t i = 0; i < distinct; ++i) maker.add(pairs);
    for (std::size_t i = distinct; i < count; ++i) maker.addMoved(pairs, i % distinct);
    for (std::size_t i = 0; i < std::min(count, known); ++i) {
        if (i >= distinct) {
            pairs.depths.push_back(pairs.depths[i % distinct]);
            continue;
        }
        const adapter::CollisionQuery& q = pairs.queries[i];
        pairs.depths.push_back(
            -exactContact(*q.a.geometry, q.a.pose, *q.b.geometry, q.b.pose, kind.dimension)->signedDistance);
    }
    return pairs;
}

}  // namespace rigor::validation
