// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every broad phase of the table against a plain double loop, over scenes that are hard for one or another of
// them: points, equal boxes, sizes from 1 mm to 100 m, far from the origin, everything jumping at once,
// changing counts, fixed boxes, boxes that are not numbers. No memory is allocated once a motion repeats
// itself.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/core/tests/counting_new.hpp"

namespace rigor::engine {
namespace {

template <class S>
struct Scene {
    std::vector<Aabb<S>> boxes;
    std::vector<std::uint8_t> movable;
};

template <class S>
std::vector<ProxyPair> oracle(const Scene<S>& scene) {
    std::vector<ProxyPair> pairs;
    for (std::uint32_t i = 0; i < scene.boxes.size(); ++i)
        for (std::uint32_t j = i + 1; j < scene.boxes.size(); ++j) {
            bool overlap = scene.movable[i] || scene.movable[j];
            for (int k = 0; k < S::dim; ++k)
                overlap = overlap && scene.boxes[i].min[k] <= scene.boxes[j].max[k] &&
                          scene.boxes[j].min[k] <= scene.boxes[i].max[k];
            if (overlap) pairs.push_back({i, j});
        }
    return pairs;
}

template <class S>
class Maker {
  public:
    using R = typename S::Real;
    using Vec = typename S::Vec;
    explicit Maker(unsigned seed) : random_(seed) {}
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
    Vec vec(double a, double b) {
        Vec v;
        for (int k = 0; k < S::dim; ++k) v[k] = static_cast<R>(uniform(a, b));
        return v;
    }
    /// Edges are at most `edge` and vary by direction.
    Aabb<S> box(const Vec& center, double edge) {
        const Vec half = vec(0, edge / 2);
        return {center - half, center + half};
    }
    void shift(Scene<S>& scene, double distance) {
        for (auto& box : scene.boxes) {
            const Vec d = vec(-distance, distance);
            box.min += d;
            box.max += d;
        }
    }

  private:
    std::mt19937 random_;
};

/// A scene and how it goes on from round to round.
template <class S>
struct Case {
    const char* name;
    std::function<void(Scene<S>&, Maker<S>&)> fill, change;
    std::size_t atLeast;  ///< pairs over all rounds, or the test looked at nothing
};

template <class S>
void fillWith(Scene<S>& scene, int count, const std::function<Aabb<S>()>& make) {
    for (int i = 0; i < count; ++i) {
        scene.boxes.push_back(make());
        scene.movable.push_back(1);
    }
}

template <class S>
std::vector<Case<S>> cases() {
    using R = typename S::Real;
    using Vec = typename S::Vec;
    using M = Maker<S>;
    const double wide = S::dim == 2 ? 8 : 3;
    const auto ordinary = [wide](M& m) { return m.box(m.vec(-wide, wide), 1); };
    return {
        {"moving", [=](Scene<S>& s, M& m) { fillWith<S>(s, 200, [&] { return ordinary(m); }); },
         [](Scene<S>& s, M& m) { m.shift(s, 0.1); }, 500},
        {"teleporting, all at once",
         [=](Scene<S>& s, M& m) { fillWith<S>(s, 200, [&] { return ordinary(m); }); },
         [=](Scene<S>& s, M& m) {
             for (auto& box : s.boxes) box = ordinary(m);
         },
         500},
        {"reversed along every axis",
         [](Scene<S>& s, M& m) {
             int i = 0;
             fillWith<S>(s, 300, [&] { return m.box(Vec::Constant(static_cast<R>(0.2 * i++)), 1); });
         },
         [](Scene<S>& s, M&) {
             for (auto& box : s.boxes) box = {-box.max, -box.min};
         },
         500},
        {"equal boxes",
         [](Scene<S>& s, M&) { fillWith<S>(s, 60, [] {
                                   return Aabb<S>{Vec::Zero(), Vec::Ones()};
                               }); },
         [](Scene<S>& s, M& m) {  // some leave, some come back to where they were
             for (auto& box : s.boxes) {
                 const R x = static_cast<R>(m.uniform(0, 1) < 0.5 ? 0 : 3);
                 box = {Vec::Constant(x), Vec::Constant(x + 1)};
             }
         },
         5000},
        {"points on a lattice, many on one spot",
         [](Scene<S>& s, M& m) {
             fillWith<S>(s, 200, [&] {
                 const Vec p = m.vec(0, 4).array().floor();
                 return Aabb<S>{p, p};
             });
         },
         [](Scene<S>& s, M& m) {
             for (auto& box : s.boxes)
                 if (m.uniform(0, 1) < 0.3) box.min = box.max = m.vec(0, 4).array().floor();
         },
         500},
        {"all points on one spot, then apart",
         [](Scene<S>& s, M&) { fillWith<S>(s, 40, [] {
                                   return Aabb<S>{Vec::Ones(), Vec::Ones()};
                               }); },
         [](Scene<S>& s, M& m) {
             for (auto& box : s.boxes) box.min = box.max = m.vec(0, 3).array().round();
         },
         500},
        {"sizes from 1 mm to 100 m",
         [](Scene<S>& s, M& m) {
             fillWith<S>(s, 200, [&] { return m.box(m.vec(-60, 60), std::pow(10, m.uniform(-3, 2))); });
         },
         [](Scene<S>& s, M& m) {
             m.shift(s, 1);
             for (auto& box : s.boxes)
                 if (m.uniform(0, 1) < 0.05) box = m.box(m.vec(-60, 60), std::pow(10, m.uniform(-3, 2)));
         },
         500},
        {"far from the origin",
         [=](Scene<S>& s, M& m) {
             fillWith<S>(s, 150, [&] { return m.box(m.vec(-wide, wide) + Vec::Constant(R(1e5)), 1); });
         },
         [](Scene<S>& s, M& m) { m.shift(s, 0.1); }, 200},
        {"one box goes very far and comes back",
         [=](Scene<S>& s, M& m) { fillWith<S>(s, 100, [&] { return ordinary(m); }); },
         [=](Scene<S>& s, M& m) {
             m.shift(s, 0.1);
             const Vec far = m.vec(-1, 1) * static_cast<R>(std::pow(10, m.uniform(0, 17)));
             s.boxes[7] = m.uniform(0, 1) < 0.5 ? m.box(far, 1) : ordinary(m);
             s.boxes[8] = {s.boxes[7].min - Vec::Ones(), s.boxes[7].max + Vec::Ones()};
         },
         100},
        {"counts that change", [=](Scene<S>& s, M& m) { fillWith<S>(s, 100, [&] { return ordinary(m); }); },
         [=](Scene<S>& s, M& m) {
             m.shift(s, 0.1);
             const double what = m.uniform(0, 1);
             if (what < 0.2) fillWith<S>(s, 30, [&] { return ordinary(m); });
             const std::size_t fewer = what < 0.25 ? 1 : s.boxes.size() / 2;
             if (what >= 0.2 && what < 0.4) {
                 s.boxes.resize(fewer);
                 s.movable.resize(fewer);
             }
             if (what > 0.95) {
                 s.boxes.clear();
                 s.movable.clear();
             }
         },
         100},
        {"fixed boxes among movable ones, without bounds some",
         [=](Scene<S>& s, M& m) {
             fillWith<S>(s, 150, [&] { return ordinary(m); });
             for (std::size_t i = 0; i < 150; i += 2) s.movable[i] = 0;
             for (int k = 0; k < S::dim; ++k) {
                 const R all = k == 0 ? std::numeric_limits<R>::max() : std::numeric_limits<R>::infinity();
                 s.boxes.push_back({Vec::Constant(-all), Vec::Constant(all)});
                 s.boxes.back().max[k] = R(-0.5 * wide);
                 s.movable.push_back(0);
             }
         },
         [=](Scene<S>& s, M& m) {
             for (std::size_t i = 0; i < 150; ++i) {
                 const Vec d = m.vec(-0.1, 0.1);
                 s.boxes[i].min += d;
                 s.boxes[i].max += d;
             }
             if (m.uniform(0, 1) < 0.2) s.boxes[11] = s.boxes.back();
             if (m.uniform(0, 1) < 0.2) s.boxes[11] = ordinary(m);
         },
         500},
        {"a box that is not a number",
         [=](Scene<S>& s, M& m) { fillWith<S>(s, 80, [&] { return ordinary(m); }); },
         [=](Scene<S>& s, M& m) {
             m.shift(s, 0.1);
             const R nan = std::numeric_limits<R>::quiet_NaN();
             for (const std::size_t i : {3u, 4u, 40u})
                 if (m.uniform(0, 1) < 0.5)
                     s.boxes[i].min[S::dim - 1] = s.boxes[i].max[S::dim - 1] = nan;
                 else
                     s.boxes[i] = ordinary(m);
         },
         100},
    };
}

template <class S>
class BroadPhaseScenes : public testing::Test {};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(BroadPhaseScenes, Spaces);

TYPED_TEST(BroadPhaseScenes, EqualTheDoubleLoop) {
    using S = TypeParam;
    for (const auto& entry : broadPhaseTable<S>())
        for (const Case<S>& c : cases<S>()) {
            Maker<S> maker(11);
            Scene<S> scene;
            c.fill(scene, maker);
            auto broadPhase = entry.make();
            std::vector<ProxyPair> pairs, again;
            std::size_t found = 0;
            for (int round = 0; round < 40; ++round) {
                broadPhase->update(scene.boxes, scene.movable, pairs);
                const std::vector<ProxyPair> expected = oracle<S>(scene);
                ASSERT_EQ(pairs, expected) << entry.name << ": " << c.name << ", round " << round;
                found += pairs.size();
                broadPhase->update(scene.boxes, scene.movable, again);  // nothing moves
                ASSERT_EQ(again, expected) << entry.name << ": " << c.name << ", round " << round;
                if (round == 20) broadPhase->reset();
                c.change(scene, maker);
            }
            EXPECT_GE(found, c.atLeast) << c.name;
        }
}

TYPED_TEST(BroadPhaseScenes, NoAllocationOnceAMotionRepeatsItself) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& entry : broadPhaseTable<S>()) {
        Maker<S> maker(5);
        Scene<S> scene;
        fillWith<S>(scene, 300, [&] { return maker.box(maker.vec(-5, 5), 1.5); });
        scene.boxes.push_back({S::Vec::Constant(-100), S::Vec::Constant(100)});
        scene.movable.push_back(0);
        std::vector<typename S::Vec> velocity;
        for (int i = 0; i < 300; ++i) velocity.push_back(maker.vec(-0.2, 0.2));
        auto broadPhase = entry.make();
        std::vector<ProxyPair> pairs;
        // There and back, twice to settle; positions are exact multiples so that each period is the same.
        const std::vector<Aabb<S>> start = scene.boxes;
        const auto period = [&] {
            for (int t = 0; t < 40; ++t) {
                const R at = static_cast<R>(t < 20 ? t : 40 - t);
                for (std::size_t i = 0; i < velocity.size(); ++i) {
                    scene.boxes[i].min = start[i].min + at * velocity[i];
                    scene.boxes[i].max = start[i].max + at * velocity[i];
                }
                broadPhase->update(scene.boxes, scene.movable, pairs);
            }
        };
        period();
        period();
        const long before = test::allocationCount();
        period();
        EXPECT_EQ(test::allocationCount() - before, 0) << entry.name;
        EXPECT_GT(pairs.size(), 300u);
    }
}

/// However late that is.
TYPED_TEST(BroadPhaseScenes, NoAllocationWhenFewMoveForTheFirstTime) {
    using S = TypeParam;
    using R = typename S::Real;
    for (const auto& entry : broadPhaseTable<S>()) {
        Maker<S> maker(6);
        Scene<S> scene;
        fillWith<S>(scene, 100, [&] { return maker.box(maker.vec(-3, 3), 1.5); });
        auto broadPhase = entry.make();
        std::vector<ProxyPair> pairs;
        const std::vector<Aabb<S>> start = scene.boxes;
        for (int t = 0; t < 40; ++t) {
            for (std::size_t i = 0; i < start.size(); ++i) {
                scene.boxes[i].min = start[i].min + S::Vec::Constant(R(0.01) * R(t % 2));
                scene.boxes[i].max = start[i].max + S::Vec::Constant(R(0.01) * R(t % 2));
            }
            broadPhase->update(scene.boxes, scene.movable, pairs);
        }
        const std::size_t found = pairs.size();
        const long before = test::allocationCount();
        scene.boxes[7] = start[7];
        broadPhase->update(scene.boxes, scene.movable, pairs);
        EXPECT_EQ(test::allocationCount() - before, 0) << entry.name;
        EXPECT_NEAR(double(pairs.size()), double(found), 2) << entry.name;
    }
}

}  // namespace
}  // namespace rigor::engine
