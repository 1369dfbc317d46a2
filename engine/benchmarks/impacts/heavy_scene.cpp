// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/benchmarks/impacts/heavy_scene.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "engine/benchmarks/settings_text.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/pipeline/world.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::impacts {
namespace {

constexpr double kBrick[] = {0.25, 0.125, 0.125};  ///< half extents of a brick [m]
constexpr double kBall = 0.5;                      ///< radius of the ball [m]
constexpr double kBallDensity = 4000;              ///< 2090 kg; a brick has 62 kg
constexpr double kDrum = 0.4;                      ///< half the distance of bodies in the tumbler [m]

template <class S>
class HeavyScene {
  public:
    using R = typename S::Real;
    using V = typename S::Vec;

    explicit HeavyScene(const Case& what)
        : random_(static_cast<std::mt19937::result_type>(what.seed)), world_(settings(what)) {
        stuff_ = world_.addMaterial(R(0.6), R(0));
        if (what.scene == Scene::Wall)
            buildWall(what);
        else
            buildTumbler(what);
    }

    Outcome run(const Case& what, bool follow) {
        Outcome out;
        const int steps = static_cast<int>(std::lround(60 * what.duration));
        double seconds = 0;
        for (int step = 1; step <= steps; ++step) {
            const auto start = std::chrono::steady_clock::now();
            world_.step(R(1) / 60);
            seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            std::string pair;
            const double deepest = deepestOverlap(pair);
            out.mean += deepest / steps;
            if (deepest > out.worst) {
                out.worst = deepest;
                out.worstStep = step;
                out.worstPair = pair;
            }
            if (follow) std::printf("step %d penetration %.5f %s\n", step, deepest, pair.c_str());
        }
        out.secondsPerStep = seconds / steps;
        return out;
    }

  private:
    struct Item {
        BodyId body;
        Shape<S> shape;
        Pose<S> local;
        bool moves = true;
    };
    struct Placed {
        Aabb<S> box;
        Pose<S> pose;
        const Item* item = nullptr;
    };

    static WorldDef<S> settings(const Case& what) {
        WorldDef<S> def;
        def.gravity[1] = R(-9.81);
        if (what.fast) preferSpeed(def);
        applySettings<S>(what.settings, def);
        return def;
    }
    double any(double most) { return std::uniform_real_distribution<double>(-most, most)(random_); }
    static V vec(double x, double y, double z) {
        return {static_cast<R>(x), static_cast<R>(y), static_cast<R>(z)};
    }

    BodyDef<S> solid(const Shape<S>& shape, double density, const V& p) const {
        const MassProperties<S> m = massProperties<S>(shape, static_cast<R>(density));
        BodyDef<S> body;
        body.mass = m.mass;
        body.inertia = m.inertia;
        body.centerOfMass = m.center;
        body.pose.p = p;
        return body;
    }
    void add(const BodyDef<S>& body, const Shape<S>& shape) {
        const BodyId id = world_.addBody(body);
        world_.addShape(id, {shape, {}, stuff_});
        items_.push_back({id, shape, {}, body.type == BodyType::Dynamic});
    }

    /// Bricks in stretcher bond, 20 in a course.
    void buildWall(const Case& what) {
        constexpr int kCourse = 20;
        BodyDef<S> floor;
        floor.type = BodyType::Static;
        add(floor, HalfSpace<S>{V::UnitY(), R(0)});
        const Shape<S> brick = Box<S>{vec(kBrick[0], kBrick[1], kBrick[2])};
        for (int i = 0; i < what.bodies; ++i) {
            const int course = i / kCourse, place = i % kCourse;
            const double x = 2 * kBrick[0] * (place - 0.5 * kCourse + 0.5 * (course % 2));
            add(solid(brick, 2000, vec(x, kBrick[1] * (2 * course + 1), 0)), brick);
        }
        const double middle = kBrick[1] * what.bodies / kCourse;
        const Shape<S> ball = Sphere<S>{R(kBall)};
        BodyDef<S> body = solid(ball, kBallDensity, vec(0.13, std::max(kBall, middle), -3 + any(0.15)));
        body.velocity = vec(0, 0, what.speed);
        add(body, ball);
    }

    /// One of five shapes in turn, 0.6 to 1.4 times as large as usual.
    Shape<S> mixedShape(int index) {
        const double s = 1 + any(0.4);
        const auto size = [s](double x) { return static_cast<R>(s * x); };
        switch (index % 5) {
            case 0:
                return Sphere<S>{size(0.2)};
            case 1:
                return Capsule<S>{size(0.12), size(0.16)};
            case 2:
                return Box<S>{V(size(0.2), size(0.15), size(0.2))};
            case 3:
                return Cylinder<S>{size(0.2), size(0.15)};
            default:
                break;
        }
        std::vector<V> points;
        for (int k = 0; k < 12; ++k) points.push_back(R(s * 0.22) * vec(any(1), any(1), any(1)).normalized());
        return makeHull<S>(points);
    }

    /// A closed box that turns about z, filled to about half.
    void buildTumbler(const Case& what) {
        const int side = static_cast<int>(std::ceil(std::cbrt(2.0 * what.bodies)));
        const double half = kDrum * (side + 0.5), thick = 0.25;
        BodyDef<S> drum;
        drum.type = BodyType::Kinematic;
        drum.angularVelocity = vec(0, 0, what.speed / half);
        const BodyId id = world_.addBody(drum);
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                V extents = V::Constant(static_cast<R>(half + 2 * thick)), p = V::Zero();
                extents[axis] = static_cast<R>(thick);
                p[axis] = static_cast<R>(sign * (half + thick));
                const Shape<S> wall = Box<S>{extents};
                const Pose<S> local{p, Pose<S>::identityRot()};
                world_.addShape(id, {wall, local, stuff_});
                items_.push_back({id, wall, local, false});
            }
        for (int i = 0; i < what.bodies; ++i) {
            const auto place = [side](int k) { return 2 * kDrum * (k - 0.5 * (side - 1)); };
            const Shape<S> shape = mixedShape(i);
            BodyDef<S> body =
                solid(shape, 1000, vec(place(i % side), place(i / side / side), place(i / side % side)));
            body.pose.q = typename S::Rot(R(any(1)), R(any(1)), R(any(1)), R(any(1)));
            body.pose.q.normalize();
            add(body, shape);
        }
    }

    /// Largest penetration of any two bodies now, by closest points [m].
    double deepestOverlap(std::string& pair) const {
        std::vector<Placed> all;
        for (const Item& item : items_) {
            const Pose<S> pose = compose<S>(world_.pose(item.body), item.local);
            all.push_back({boundingBox<S>(item.shape, pose), pose, &item});
        }
        std::sort(all.begin(), all.end(),
                  [](const Placed& a, const Placed& b) { return a.box.min.x() < b.box.min.x(); });
        double deepest = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = i + 1; j < all.size() && all[j].box.min.x() <= all[i].box.max.x(); ++j) {
                if (!(all[i].item->moves || all[j].item->moves) || !all[i].box.overlaps(all[j].box)) continue;
                const ClosestPoints<S> closest =
                    closestPoints<S>(all[i].item->shape, all[i].pose, all[j].item->shape, all[j].pose);
                const double depth = -static_cast<double>(closest.distance);
                if (depth <= deepest) continue;
                deepest = depth;
                pair = shapeName<S>(all[i].item->shape) + std::string("-") + shapeName<S>(all[j].item->shape);
                if (!(all[i].item->moves && all[j].item->moves)) pair += " (wall)";
            }
        return deepest;
    }

    std::mt19937 random_;
    World<S> world_;
    std::uint32_t stuff_ = 0;
    std::vector<Item> items_;
};

}  // namespace

Outcome run(const Case& what, bool follow) {
    return what.single ? HeavyScene<Space3f>(what).run(what, follow)
                       : HeavyScene<Space3d>(what).run(what, follow);
}

std::string describe(const Case& what) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "scene=%s preset=%s precision=%s bodies=%d speed=%g duration=%g seed=%llu",
                  what.scene == Scene::Wall ? "wall" : "tumbler", what.fast ? "fast" : "default",
                  what.single ? "f32" : "f64", what.bodies, what.speed, what.duration,
                  static_cast<unsigned long long>(what.seed));
    std::string all = text;
    if (!what.settings.empty()) all += " settings=" + what.settings;
    return all;
}

}  // namespace rigor::engine::impacts
