// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/benchmarks/edges/slide.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <vector>

#include "engine/benchmarks/settings_text.hpp"
#include "engine/pipeline/world.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::engine::edges {
namespace {

constexpr double kSize = 0.3;     ///< size of the bodies [m]
constexpr double kMargin = 0.45;  ///< ground beside, before and after the way [m]
constexpr double kGravity = 9.81;

/// The longest way that the body may take [m].
double longestWay(const Case& what) {
    const double t = what.duration;
    return what.speed * t + 0.5 * kGravity * std::sin(what.slope) * t * t;
}

/// The grid of a ground's vertices: its x axis makes the case's angle with the way, which starts at its
/// origin. The grid is offset by a third of a square, so that no way runs along its lines.
class Grid {
  public:
    explicit Grid(const Case& what)
        : what_(what), side_(what.squares * kSize), way_(longestWay(what)), random_(5) {}

    double side() const { return side_; }
    /// Columns or rows from the first to the last that the way comes near.
    int first(int axis) const { return static_cast<int>(std::floor((low(axis) - kMargin) / side_)) - 1; }
    int last(int axis) const { return static_cast<int>(std::ceil((high(axis) + kMargin) / side_)) + 1; }
    double coordinate(int i) const { return side_ * (i + 1.0 / 3); }
    bool isNear(double x, double z) const {
        const double along = x * direction(0) + z * direction(1),
                     across = z * direction(0) - x * direction(1);
        const double margin = kMargin + 1.5 * side_;
        return along > -margin && along < way_ + margin && std::abs(across) < margin;
    }
    double shift() {
        if (!what_.jitter) return 0;
        return std::uniform_real_distribution<double>(-0.25, 0.25)(random_) * side_;
    }

  private:
    double direction(int axis) const { return axis == 0 ? std::cos(what_.angle) : std::sin(what_.angle); }
    double low(int axis) const { return std::min(0.0, way_ * direction(axis)); }
    double high(int axis) const { return std::max(0.0, way_ * direction(axis)); }
    Case what_;
    double side_, way_;
    std::mt19937 random_;
};

template <class V>
void print(const char* name, const V& v) {
    std::printf(" %s", name);
    for (int k = 0; k < v.size(); ++k) std::printf(" %.6f", static_cast<double>(v[k]));
}

template <class S>
typename S::Rot aboutZ(double angle) {
    using R = typename S::Real;
    if constexpr (S::dim == 2)
        return S::Rot::fromAngle(static_cast<R>(angle));
    else
        return typename S::Rot(Eigen::AngleAxis<R>(static_cast<R>(angle), S::Vec::UnitZ()));
}

template <class S>
Shape<S> makeChainGround(const Case& what, Grid& grid) {
    using R = typename S::Real;
    std::vector<typename S::Vec> line;
    for (int i = grid.first(0); i <= grid.last(0); ++i) {
        const double x = grid.coordinate(i) + grid.shift();
        line.push_back({static_cast<R>(x * std::cos(what.slope)), static_cast<R>(-x * std::sin(what.slope))});
    }
    return makeChain<S>(line, false);
}

template <class S>
Shape<S> makeMeshGround(const Case& what, Grid& grid) {
    using R = typename S::Real;
    std::vector<typename S::Vec> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::map<std::pair<int, int>, std::uint32_t> known;
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(-what.slope, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(what.angle, Eigen::Vector3d::UnitY()))
                                     .toRotationMatrix();
    const auto vertex = [&](int i, int k) {
        const auto [place, isNew] = known.try_emplace({i, k}, static_cast<std::uint32_t>(vertices.size()));
        if (isNew) {
            const double x = grid.coordinate(i) + grid.shift(), z = grid.coordinate(k) + grid.shift();
            vertices.push_back((turn * Eigen::Vector3d(x, 0, z)).template cast<R>());
        }
        return place->second;
    };
    for (int k = grid.first(1); k < grid.last(1); ++k)
        for (int i = grid.first(0); i < grid.last(0); ++i) {
            if (!grid.isNear(grid.coordinate(i), grid.coordinate(k))) continue;
            const std::uint32_t a = vertex(i, k), b = vertex(i + 1, k), c = vertex(i, k + 1),
                                d = vertex(i + 1, k + 1);
            triangles.push_back({a, c, b});
            triangles.push_back({b, c, d});
        }
    return makeTriangleMesh<S>(vertices, triangles);
}

/// A height field lies around the middle of its extent; `middle`: where that is in the grid.
template <class S>
Shape<S> makeFieldGround(const Grid& grid, Eigen::Vector3d& middle) {
    using R = typename S::Real;
    const int columns = grid.last(0) - grid.first(0) + 1, rows = grid.last(1) - grid.first(1) + 1;
    middle = {0.5 * (grid.coordinate(grid.first(0)) + grid.coordinate(grid.last(0))), 0,
              0.5 * (grid.coordinate(grid.first(1)) + grid.coordinate(grid.last(1)))};
    const std::vector<R> heights(static_cast<std::size_t>(columns * rows), R(0));
    return makeHeightField<S>(columns, rows, static_cast<R>(grid.side()), static_cast<R>(grid.side()),
                              heights, R(1));
}

template <class S>
class Slide {
  public:
    using R = typename S::Real;
    using V = typename S::Vec;

    /// `pieces`: on the case's ground; else on a half-space.
    Slide(const Case& what, bool pieces) : world_(settings(what)) {
        const std::uint32_t material = world_.addMaterial(static_cast<R>(what.friction), R(0));
        BodyDef<S> still;
        still.type = BodyType::Static;
        Shape<S> ground = HalfSpace<S>{rotate(aboutZ<S>(-what.slope), V(V::Unit(1))), R(0)};
        if (pieces) ground = makeGround(what, still.pose);
        world_.addShape(world_.addBody(still), {ground, {}, material});
        addBody(what, material);
    }

    void step() { world_.step(R(1) / 60); }
    V position() const { return world_.pose(body_).p; }
    V velocity() const { return world_.velocity(body_); }
    typename S::Ang spin() const { return world_.angularVelocity(body_); }
    int pieces() const { return pieces_; }
    void printContacts(const char* name) const {
        std::vector<ContactView<S>> contacts;
        world_.readContacts(contacts);
        for (const ContactView<S>& c : contacts) {
            std::printf("    %s", name);
            print("point", c.pointB);
            print("normal", c.normal);
            print("friction", c.frictionImpulse);
            std::printf(" separation %.6f impulse %.6f\n", static_cast<double>(c.separation),
                        static_cast<double>(c.normalImpulse));
        }
    }

  private:
    static WorldDef<S> settings(const Case& what) {
        WorldDef<S> def;
        def.gravity[1] = static_cast<R>(-kGravity);
        if (what.fast) preferSpeed(def);
        applySettings<S>(what.settings, def);
        return def;
    }

    Shape<S> makeGround(const Case& what, Pose<S>& pose) {
        Grid grid(what);
        Shape<S> ground;
        if constexpr (S::dim == 2) {
            ground = makeChainGround<S>(what, grid);
        } else if (what.ground == Ground::Mesh) {
            ground = makeMeshGround<S>(what, grid);
        } else {
            Eigen::Vector3d middle;
            ground = makeFieldGround<S>(grid, middle);
            const Eigen::Quaterniond turn = Eigen::AngleAxisd(-what.slope, Eigen::Vector3d::UnitZ()) *
                                            Eigen::AngleAxisd(what.angle, Eigen::Vector3d::UnitY());
            pose.q = turn.cast<R>();
            pose.p = (turn * middle).template cast<R>();
        }
        withSurface<S>(ground, [&](const auto& data) { pieces_ = static_cast<int>(data.pieceCount()); });
        return ground;
    }

    static Shape<S> makeBody(Body kind) {
        switch (kind) {
            case Body::Sphere:
                return Sphere<S>{R(0.5 * kSize)};
            case Body::Box:
                return Box<S>{V::Constant(R(0.5 * kSize))};
            case Body::CapsuleAlong:
            case Body::CapsuleAcross:
                break;
        }
        return Capsule<S>{R(0.25 * kSize), R(0.25 * kSize)};
    }
    /// Capsules have their axis along y.
    static typename S::Rot turnOf(const Case& what) {
        const typename S::Rot slope = aboutZ<S>(-what.slope);
        if (what.body == Body::CapsuleAlong) return compose(slope, aboutZ<S>(0.5 * M_PI));
        if constexpr (S::dim == 3)
            if (what.body == Body::CapsuleAcross)
                return compose(slope, typename S::Rot(Eigen::AngleAxis<R>(R(0.5 * M_PI), V::UnitX())));
        return slope;
    }

    void addBody(const Case& what, std::uint32_t material) {
        const Shape<S> shape = makeBody(what.body);
        const MassProperties<S> m = massProperties<S>(shape, R(1000));
        const bool capsule = what.body == Body::CapsuleAlong || what.body == Body::CapsuleAcross;
        const typename S::Rot slope = aboutZ<S>(-what.slope);
        BodyDef<S> body;
        body.mass = m.mass;
        body.inertia = m.inertia;
        body.pose.q = turnOf(what);
        body.pose.p = rotate(slope, V(R((capsule ? 0.25 : 0.5) * kSize) * V::Unit(1)));
        body.velocity = rotate(slope, V(static_cast<R>(what.speed) * V::Unit(0)));
        body_ = world_.addBody(body);
        world_.addShape(body_, {shape, {}, material});
    }

    World<S> world_;
    BodyId body_;
    int pieces_ = 0;
};

template <class S>
Outcome runIn(const Case& what, bool follow) {
    Slide<S> pieces(what, true), plane(what, false);
    Outcome out;
    out.pieces = pieces.pieces();
    const int steps = static_cast<int>(std::lround(60 * what.duration));
    typename S::Vec last = plane.position();
    double seconds = 0;
    for (int step = 1; step <= steps; ++step) {
        const auto start = std::chrono::steady_clock::now();
        pieces.step();
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        plane.step();
        out.way += static_cast<double>((plane.position() - last).norm());
        last = plane.position();
        const double away = static_cast<double>((pieces.position() - plane.position()).norm());
        const double faster = static_cast<double>((pieces.velocity() - plane.velocity()).norm());
        const typename S::Ang turn = pieces.spin() - plane.spin();
        out.position = std::max(out.position, away / std::max(out.way, kSize));
        out.velocity = std::max(out.velocity, faster / what.speed);
        out.spin = std::max(out.spin, std::sqrt(static_cast<double>(dotAng(turn, turn))));
        if (!follow) continue;
        std::printf("step %d", step);
        print("x", pieces.position());
        print("plane", plane.position());
        print("v", pieces.velocity());
        print("plane", plane.velocity());
        if constexpr (S::dim == 3) print("spin", pieces.spin());
        std::printf(" spin difference %.6f\n", std::sqrt(static_cast<double>(dotAng(turn, turn))));
        pieces.printContacts("piece");
        plane.printContacts("plane");
    }
    out.secondsPerStep = seconds / steps;
    return out;
}

constexpr const char* kGrounds[] = {"mesh", "field", "chain"};
constexpr const char* kBodies[] = {"sphere", "box", "capsule_along", "capsule_across"};

}  // namespace

Outcome run(const Case& what, bool follow) {
    if (what.ground == Ground::Chain)
        return what.single ? runIn<Space2f>(what, follow) : runIn<Space2d>(what, follow);
    return what.single ? runIn<Space3f>(what, follow) : runIn<Space3d>(what, follow);
}

std::string describe(const Case& what) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "ground=%s body=%s angle=%g slope=%g speed=%g squares=%g friction=%g jitter=%d preset=%s "
                  "precision=%s duration=%g",
                  kGrounds[static_cast<int>(what.ground)], kBodies[static_cast<int>(what.body)], what.angle,
                  what.slope, what.speed, what.squares, what.friction, what.jitter ? 1 : 0,
                  what.fast ? "fast" : "default", what.single ? "f32" : "f64", what.duration);
    return what.settings.empty() ? text : text + std::string(" settings=") + what.settings;
}

}  // namespace rigor::engine::edges
