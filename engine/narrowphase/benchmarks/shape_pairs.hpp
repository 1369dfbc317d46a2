// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs of posed shapes, for benchmarks of narrow phases; the same on every machine but for rounding.
// Orientations are uniform; B is at a distance from A in a random direction, is moved along it to the first
// touch, and from there 0.05 m in (overlap) or 0.1 m out (apart). `face`: boxes 1 cm deep, face on face,
// turned at random about the normal, so that whole faces touch.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/benchmarks/random.hpp"
#include "engine/narrowphase/distance.hpp"

namespace rigor::engine::benchmark_scene {

enum class Closeness { Overlap, Face, Apart };

/// One pair kind of the benchmark: "box", "sphere", "capsule", "hull16" (16 vertices), 2D: "hull6".
struct PairKind {
    const char* a;
    const char* b;
    Closeness closeness;
    std::string name() const {
        const char* word = closeness == Closeness::Overlap ? "overlap"
                           : closeness == Closeness::Face  ? "face"
                                                           : "apart";
        return std::string(a) + "_" + b + "_" + word;
    }
};

inline std::vector<PairKind> pairKinds(int dimension) {
    using enum Closeness;
    if (dimension == 2)
        return {{"box", "box", Overlap},         {"box", "box", Face},         {"box", "box", Apart},
                {"hull6", "hull6", Overlap},     {"hull6", "hull6", Apart},    {"sphere", "sphere", Overlap},
                {"sphere", "box", Overlap},      {"sphere", "box", Apart},     {"capsule", "box", Overlap},
                {"capsule", "capsule", Overlap}, {"sphere", "hull6", Overlap}, {"capsule", "hull6", Overlap}};
    return {{"box", "box", Overlap},         {"box", "box", Face},          {"box", "box", Apart},
            {"hull16", "hull16", Overlap},   {"hull16", "hull16", Apart},   {"box", "hull16", Overlap},
            {"sphere", "sphere", Overlap},   {"sphere", "box", Overlap},    {"sphere", "box", Apart},
            {"capsule", "capsule", Overlap}, {"capsule", "box", Overlap},   {"capsule", "box", Apart},
            {"sphere", "hull16", Overlap},   {"capsule", "hull16", Overlap}};
}

template <class S>
struct ShapePair {
    Shape<S> a, b;
    Pose<S> Xa, Xb;
};

/// Makes one pair after the other, in double precision first.
template <int D>
class PairMaker {
  public:
    using S = Space<double, D>;
    using Vec = typename S::Vec;
    explicit PairMaker(std::uint64_t seed) : random_(seed) {}

    /// The same pair for every precision R.
    template <class R>
    ShapePair<Space<R, D>> make(const PairKind& kind) {
        const auto a = describe(kind.a), b = describe(kind.b);
        Pose<S> Xa, Xb;
        if (kind.closeness == Closeness::Face) {
            Xb.q = yaw();
            Xb.p = Vec::Unit(1) * (a.half[1] + b.half[1] - 0.01);
        } else {
            Xa.q = rotation();
            Xb.q = rotation();
            const Vec d = direction();
            touch(shape<double>(a), Xa, shape<double>(b), Xb, d);
            Xb.p += d * (kind.closeness == Closeness::Overlap ? -0.05 : 0.1);
        }
        return {shape<R>(a), shape<R>(b), cast<R>(Xa), cast<R>(Xb)};
    }

  private:
    struct Description {
        std::string kind;
        Vec half = Vec::Zero();
        std::vector<Vec> points;
    };

    Vec direction() {
        if constexpr (D == 2) {
            const double angle = random_.between(0, 2 * std::numbers::pi);
            return {std::cos(angle), std::sin(angle)};
        } else {
            const double z = random_.between(-1, 1), angle = random_.between(0, 2 * std::numbers::pi);
            const double r = std::sqrt(1 - z * z);
            return {r * std::cos(angle), r * std::sin(angle), z};
        }
    }
    typename S::Rot rotation() {
        if constexpr (D == 2) {
            return S::Rot::fromAngle(random_.between(0, 2 * std::numbers::pi));
        } else {  // Shoemake, Graphics Gems III, 1992
            const double u = random_.unit(), s = std::sqrt(1 - u), t = std::sqrt(u);
            const double a = random_.between(0, 2 * std::numbers::pi);
            const double b = random_.between(0, 2 * std::numbers::pi);
            return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
        }
    }
    typename S::Rot yaw() {  // 2D: none, faces are edges
        if constexpr (D == 2)
            return {};
        else
            return typename S::Rot(Eigen::AngleAxisd(random_.between(0, 2 * std::numbers::pi), Vec::UnitY()));
    }
    Description describe(const std::string& kind) {
        Description made{kind, {}, {}};
        for (int k = 0; k < D; ++k) made.half[k] = random_.between(0.4, 0.6);
        if (kind.starts_with("hull"))
            for (int i = 0, n = std::stoi(kind.substr(4)); i < n; ++i) made.points.push_back(corner(i, n));
        return made;
    }
    /// Points spread evenly (3D: Fibonacci's spiral) and shifted, at 0.55 m: all of them are corners.
    Vec corner(int i, int n) {
        const double share = (i + 0.5) / n;
        Vec v;
        if constexpr (D == 2) {
            v = {std::cos(2 * std::numbers::pi * share), std::sin(2 * std::numbers::pi * share)};
        } else {
            const double z = 1 - 2 * share, r = std::sqrt(1 - z * z), turn = 2.399963229728653 * i;
            v = {r * std::cos(turn), r * std::sin(turn), z};
        }
        for (int k = 0; k < D; ++k) v[k] += random_.between(-0.1, 0.1);
        return 0.55 * v.normalized();
    }
    template <class R>
    static Shape<Space<R, D>> shape(const Description& from) {
        using T = Space<R, D>;
        const typename T::Vec half = from.half.template cast<R>();
        if (from.kind == "sphere") return Sphere<T>{half[0]};
        if (from.kind == "capsule") return Capsule<T>{half[0] / 2, half[1]};
        if (from.kind == "box") return Box<T>{half};
        std::vector<typename T::Vec> points;
        for (const Vec& p : from.points) points.push_back(p.template cast<R>());
        return makeHull<T>(points);
    }
    template <class R>
    static Pose<Space<R, D>> cast(const Pose<S>& X) {
        Pose<Space<R, D>> made;
        made.p = X.p.template cast<R>();
        if constexpr (D == 2)
            made.q = {static_cast<R>(X.q.c), static_cast<R>(X.q.s)};
        else
            made.q = X.q.template cast<R>();
        return made;
    }
    /// Moves B along d from outside to the first touch: a gap in any direction can be closed safely.
    static void touch(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, Pose<S>& Xb, const Vec& d) {
        Xb.p = 3 * d;
        for (int k = 0; k < 500; ++k) {
            const double gap = closestPoints<S>(a, Xa, b, Xb).distance;
            if (!(gap > 1e-6)) return;
            Xb.p -= gap * d;
        }
    }

    Random random_;
};

/// `count` pairs of one kind.
template <class S>
std::vector<ShapePair<S>> shapePairs(const PairKind& kind, std::size_t count) {
    PairMaker<S::dim> maker(12345);
    std::vector<ShapePair<S>> pairs;
    for (std::size_t i = 0; i < count; ++i) pairs.push_back(maker.template make<typename S::Real>(kind));
    return pairs;
}

}  // namespace rigor::engine::benchmark_scene
