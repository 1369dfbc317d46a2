// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/benchmarks/lost/rain.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "engine/benchmarks/lost/ground.hpp"
#include "engine/pipeline/world.hpp"
#include "engine/shapes/inner_sphere.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::lost {
namespace {

constexpr double kSpacing = 0.6;  ///< distance of the start positions, such that no bodies touch [m]
constexpr double kBullet = 300;   ///< speed of bodies that are shot [m/s]
constexpr int kBulletSteps = 3;   ///< after which all bodies that are shot have come to the ground

constexpr const char* kGrounds[] = {"mesh", "field", "chain", "plate"};
constexpr const char* kMotions[] = {"drop", "pile", "roll", "slide", "shoot"};
constexpr const char* kForms[] = {"flat", "rough", "slope", "ridges", "slivers"};
constexpr const char* kContinuous[] = {"none", "conservative_advancement", "speculative"};

using Random = std::mt19937;
double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// One of the shapes in turn, 0.5 to 1.5 times as large as usual.
template <class S>
Shape<S> makeShape(int index, Random& random) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const double s = between(random, 0.5, 1.5);
    const auto size = [s](double x) { return static_cast<R>(s * x); };
    V plate = V::Constant(size(0.12));
    plate[1] = size(0.03);
    const int kind = index % (S::dim == 2 ? 4 : 5);
    if (kind == 0) return Sphere<S>{size(0.12)};
    if (kind == 1) return Capsule<S>{size(0.06), size(0.1)};
    if (kind == 2) return Box<S>{plate};
    if constexpr (S::dim == 3)
        if (kind == 4) return Cylinder<S>{size(0.12), size(0.05)};
    std::vector<V> points;
    for (int k = 0; k < 12; ++k) {
        V p;
        for (int axis = 0; axis < S::dim; ++axis) p[axis] = static_cast<R>(between(random, -1, 1));
        points.push_back(size(0.15) / p.norm() * p);
    }
    return makeHull<S>(points);
}

template <class S>
double radiusOf(const Shape<S>& shape, const typename S::Vec& center) {
    const Aabb<S> box = boundingBox<S>(shape, Pose<S>{});
    return static_cast<double>((box.max - center).cwiseMax(center - box.min).norm());
}

template <class S>
class Rain {
  public:
    using R = typename S::Real;
    using V = typename S::Vec;

    explicit Rain(const Case& what)
        : what_(what),
          random_(static_cast<Random::result_type>(what.seed)),
          heights_(what, half(what), random_),
          world_(settings(what)) {
        stuff_ = world_.addMaterial(R(what.motion == Motion::Slide ? 0.1 : 0.5), R(0.2));
        BodyDef<S> still;
        still.type = BodyType::Static;
        ground_ = world_.addBody(still);
        Pose<S> pose;
        const Shape<S> ground = heights_.template shape<S>(what.ground, pose);
        world_.addShape(ground_, {ground, pose, stuff_});
        for (int i = 0; i < what.bodies; ++i) add(i);
    }

    Outcome run(int follow) {
        Outcome out;
        const int steps = static_cast<int>(std::lround(60 * what_.duration));
        const auto start = std::chrono::steady_clock::now();
        for (int step = 1; step <= steps; ++step) {
            world_.step(R(1) / 60);
            if (follow >= 0) printState(step, bodies_[follow]);
            for (Body& body : bodies_) look(step, body, out);
        }
        for (const Body& body : bodies_) {
            double x = 0, z = 0;
            const double height = -depthOf(body, x, z) / body.inner;
            if (!body.done && height < 0.5) out.sunk.push_back({body.index, body.shape, height});
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        out.secondsPerStep = took.count() / steps;
        return out;
    }

  private:
    struct Body {
        BodyId id;
        int index = 0;
        std::string shape;
        double radius = 0;  ///< no point is further from the centre of mass [m]
        double inner = 0;   ///< radius of a sphere inside the shape [m]
        bool done = false;  ///< lost, or away
    };

    static double half(const Case& what) {
        return what.ground == Ground::Chain ? 4 + 0.05 * what.bodies
                                            : std::max(4.0, 0.3 * std::sqrt(what.bodies));
    }
    static WorldDef<S> settings(const Case& what) {
        WorldDef<S> def;
        def.gravity[1] = R(-9.81);
        if (what.fast) preferSpeed(def);
        def.continuousCollision = kContinuous[static_cast<int>(what.continuous)];
        return def;
    }

    /// Layer by layer over the middle of the ground.
    V placeOf(int index) {
        const double share = what_.motion == Motion::Pile ? 0.25 : 0.75;
        const auto count = [&](double half) {
            return std::max(1, static_cast<int>(2 * share * half / kSpacing));
        };
        const int nx = count(heights_.halfX()), nz = S::dim == 2 ? 1 : count(heights_.halfZ());
        const auto along = [&](int i, int n) {
            return kSpacing * (i - 0.5 * (n - 1)) + between(random_, -0.02, 0.02);
        };
        const double x = along(index % nx, nx), z = S::dim == 2 ? 0 : along(index / nx % nz, nz);
        const bool falls = what_.motion == Motion::Drop || what_.motion == Motion::Pile;
        const double above = what_.motion == Motion::Drop ? 4 : falls ? 1 : 0.4;
        const double base = what_.motion == Motion::Pile ? highest_ : heights_.at(x, z);
        V p = V::Zero();
        p[0] = static_cast<R>(x);
        p[1] = static_cast<R>(base + above + kSpacing * (index / nx / nz));
        if constexpr (S::dim == 3) p[2] = static_cast<R>(z);
        return p;
    }

    void add(int index) {
        const Shape<S> shape = makeShape<S>(index, random_);
        const MassProperties<S> m = massProperties<S>(shape, R(1000));
        BodyDef<S> body;
        body.mass = m.mass;
        body.inertia = m.inertia;
        body.centerOfMass = m.center;
        body.pose.p = placeOf(index);
        const auto any = [this](double most) { return static_cast<R>(between(random_, -most, most)); };
        if constexpr (S::dim == 3) {
            body.pose.q = typename S::Rot(any(1), any(1), any(1), any(1));
            body.pose.q.normalize();
        } else {
            body.pose.q = S::Rot::fromAngle(any(3));
        }
        setMotion(body);
        if (what_.motion == Motion::Shoot) aim(body);
        bodies_.push_back({world_.addBody(body), index, shapeName<S>(shape), radiusOf<S>(shape, m.center),
                           static_cast<double>(inscribedRadiusOf<S>(shape))});
        world_.addShape(bodies_.back().id, {shape, {}, stuff_});
    }

    void setMotion(BodyDef<S>& body) {
        const auto any = [this](double most) { return static_cast<R>(between(random_, -most, most)); };
        const bool drops = what_.motion == Motion::Drop;
        const double speed = what_.motion == Motion::Slide ? 12 : what_.motion == Motion::Roll ? 6 : 1;
        V v = V::Zero();
        v[0] = any(speed);
        if constexpr (S::dim == 3) v[2] = any(speed);
        v[1] = drops ? any(2) - R(4) : R(0);
        body.velocity = v;
        const double spin = what_.motion == Motion::Roll ? 30 : 5;
        if constexpr (S::dim == 3)
            body.angularVelocity = {any(spin), any(spin), any(spin)};
        else
            body.angularVelocity = any(spin);
    }

    /// A shot from 2 to 12 m away (5 m are the way of a step), from a direction at most 80 degrees off the
    /// vertical in which nothing is in the way.
    void aim(BodyDef<S>& body) {
        double steep = between(random_, 0, 80 * M_PI / 180);
        const double turn = between(random_, -M_PI, M_PI), distance = between(random_, 2, 12);
        V target = body.pose.p;
        target[1] = static_cast<R>(heights_.at(xOf(target), zOf(target)));
        const auto wayFor = [turn](double angle) {
            const double out = std::sin(angle);
            V way = V::Zero();
            way[0] = static_cast<R>(S::dim == 2 ? std::copysign(out, turn) : out * std::cos(turn));
            way[1] = static_cast<R>(-std::cos(angle));
            if constexpr (S::dim == 3) way[2] = static_cast<R>(out * std::sin(turn));
            return way;
        };
        while (!isFree(target, wayFor(steep), distance)) steep *= 0.7;
        body.velocity = R(kBullet) * wayFor(steep);
        body.pose.p = target - static_cast<R>(distance) * wayFor(steep);
    }

    /// True where the way to `target` is over the ground but for its last half metre.
    bool isFree(const V& target, const V& way, double distance) const {
        for (double d = 0.5; d <= distance; d += 0.05) {
            const V x = target - static_cast<R>(d) * way;
            if (static_cast<double>(x[1]) < heights_.at(xOf(x), zOf(x)) + 0.3) return way[1] < R(-0.99);
        }
        return true;
    }
    static double xOf(const V& p) { return static_cast<double>(p[0]); }
    static double zOf(const V& p) { return S::dim == 3 ? static_cast<double>(p[S::dim - 1]) : 0; }

    /// Depth of the centre of mass under the ground [m].
    double depthOf(const Body& body, double& x, double& z) const {
        const Pose<S> pose = world_.pose(body.id);
        const V center = toWorld<S>(pose, world_.constants(body.id).centerOfMass);
        x = xOf(center);
        z = zOf(center);
        return heights_.depth(x, static_cast<double>(center[1]), z);
    }

    void look(int step, Body& body, Outcome& out) const {
        if (body.done) return;
        double x = 0, z = 0;
        const double depth = depthOf(body, x, z);
        if (!heights_.holds(x, z)) {
            if (what_.motion == Motion::Shoot && step <= kBulletSteps) return;
            body.done = true;
            ++out.away;
        } else if (!(depth < 2 * body.radius)) {
            body.done = true;
            out.lost.push_back({body.index, step, body.shape});
        }
    }

    void printState(int step, const Body& body) const {
        double x = 0, z = 0;
        const double depth = depthOf(body, x, z);
        const auto v = world_.velocity(body.id);
        std::printf("step %d %s depth %.5f at (%.4f, %.4f) speed %.4f vertical %.4f\n", step,
                    body.shape.c_str(), depth, x, z, static_cast<double>(v.norm()),
                    static_cast<double>(v[1]));
        std::vector<ContactView<S>> contacts;
        world_.readContacts(contacts);
        for (const ContactView<S>& c : contacts) {
            if (c.bodyA != body.id && c.bodyB != body.id) continue;
            const bool ground = c.bodyA == ground_ || c.bodyB == ground_;
            std::printf("    %s normal", ground ? "ground" : "body  ");
            const V n = c.bodyB == body.id ? c.normal : V(-c.normal);
            for (int k = 0; k < S::dim; ++k) std::printf(" %.4f", static_cast<double>(n[k]));
            std::printf(" separation %.5f impulse %.4f\n", static_cast<double>(c.separation),
                        static_cast<double>(c.normalImpulse));
        }
    }

    Case what_;
    Random random_;
    Heights heights_;
    double highest_ = heights_.at(0, 0) + 0.5 * heights_.halfX() * 0.4;
    World<S> world_;
    BodyId ground_;
    std::uint32_t stuff_ = 0;
    std::vector<Body> bodies_;
};

}  // namespace

Outcome run(const Case& what, int follow) {
    if (what.ground == Ground::Chain)
        return what.single ? Rain<Space2f>(what).run(follow) : Rain<Space2d>(what).run(follow);
    return what.single ? Rain<Space3f>(what).run(follow) : Rain<Space3d>(what).run(follow);
}

std::string describe(const Case& what) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "ground=%s motion=%s form=%s squares=%g preset=%s precision=%s ccd=%s bodies=%d "
                  "duration=%g seed=%llu",
                  kGrounds[static_cast<int>(what.ground)], kMotions[static_cast<int>(what.motion)],
                  kForms[static_cast<int>(what.form)], what.squares, what.fast ? "fast" : "default",
                  what.single ? "f32" : "f64", kContinuous[static_cast<int>(what.continuous)], what.bodies,
                  what.duration, static_cast<unsigned long long>(what.seed));
    return text;
}

void setGroundOfSeed(Case& what) {
    if (what.ground == Ground::Plate) {
        what.form = what.seed % 2 == 0 ? Form::Flat : Form::Slope;
        return;
    }
    constexpr double kSquares[] = {1, 0.3, 10, 0.1, 3};
    what.form = static_cast<Form>(what.seed % 5);
    what.squares = kSquares[what.seed / 5 % 5];
}

}  // namespace rigor::engine::lost
