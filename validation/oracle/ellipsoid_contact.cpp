// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance where one of the two shapes, or both, are ellipsoids. Against a half-space in closed form: the
// support of an ellipsoid with centre c, rotation R and half axes E is
//   h(n) = c . n + |E R^T n|, at the point  c + R E^2 R^T n / |E R^T n|.
// Else, with h_K(n) = h_A(n) + h_B(-n),
//   sd(A, B) = max over unit n of -h_K(n)                               [CameronCulley1986]
// The least of h_K is at a face or cap of the other shape (that direction), on the circle of directions of one of its
// edges or sides (one angle), or in the smooth rest (two). Each is sought from many starts over all directions; where
// the support point has no component across n left, h_K is stationary. Angles are found by Newton's method on that
// component, with its derivative by differences. All directions found are evaluated by h_K itself, which bounds the
// distance from below for any of them. Cost: some milliseconds.
#include <algorithm>
#include <numbers>

#include "validation/oracle/directions.hpp"
#include "validation/oracle/ellipsoid_contact.hpp"
#include "validation/oracle/solid.hpp"

namespace rigor::validation::oracle {
namespace {

constexpr int kStarts = 400, kBest = 24, kAngles = 128, kNewtonSteps = 60;
constexpr Real kDifference = 1e-7L;  ///< step of an angle; leaves 12 digits of a derivative

/// A shape as its support function and support point.
struct Support {
    std::optional<Solid> solid;  ///< empty: the ellipsoid
    std::array<Vec, 3> axes;     ///< half axes in the world
    Vec center;
    Real size = 0;

    Vec point(Vec n) const {
        if (solid) return supportPoint(*solid, n);
        Vec sum;
        Real squares = 0;
        for (const Vec& a : axes) {
            sum = sum + dot(a, n) * a;
            squares += dot(a, n) * dot(a, n);
        }
        return center + (1 / std::sqrt(squares)) * sum;
    }
    Real along(Vec n) const {
        if (solid) return supportOf(*solid, n);
        Real squares = 0;
        for (const Vec& a : axes) squares += dot(a, n) * dot(a, n);
        return dot(center, n) + std::sqrt(squares);
    }
};

std::optional<Support> makeSupport(const scenario::Geometry& geometry, const scenario::Pose& pose,
                                   scenario::Vec3 origin) {
    Support s;
    if (const auto* e = std::get_if<scenario::Ellipsoid>(&geometry)) {
        s.center = widen(pose.position) - widen(origin);
        s.axes = {rotate(pose.orientation, Vec{e->halfAxes.x, 0, 0}),
                  rotate(pose.orientation, Vec{0, e->halfAxes.y, 0}),
                  rotate(pose.orientation, Vec{0, 0, e->halfAxes.z})};
        s.size = 2 * std::max({e->halfAxes.x, e->halfAxes.y, e->halfAxes.z});
        return s;
    }
    s.solid = makeSolid(geometry, pose, origin);
    if (!s.solid) return std::nullopt;
    s.size = s.solid->size;
    return s;
}

class Search {
  public:
    Search(const Support& a, const Support& b) : a_(a), b_(b) {
        for (const Support* s : {&a, &b}) {
            if (!s->solid) continue;
            const Real sign = s == &a ? 1 : -1;
            for (const Vec& n : s->solid->faceNormals) consider(n);
            for (const DirectionCircle& c : s->solid->circles) overCircle(c, sign);
        }
        overSphere();
    }
    /// Directions, least of h_K first.
    std::vector<std::pair<Real, Vec>> found() {
        std::sort(found_.begin(), found_.end(),
                  [](const auto& x, const auto& y) { return x.first < y.first; });
        return found_;
    }

  private:
    Real extent(Vec n) const { return a_.along(n) + b_.along(-1 * n); }
    Vec point(Vec n) const { return a_.point(n) - b_.point(-1 * n); }
    void consider(Vec n) { found_.emplace_back(extent(n), n); }

    /// The directions n . axis = height (B's, seen from A: -n), by their angle.
    void overCircle(const DirectionCircle& c, Real sign) {
        const Vec u = anyNormalTo(c.axis), v = cross(c.axis, u);
        const Real across = std::sqrt(std::max(Real(0), 1 - c.height * c.height));
        const auto at = [&](Real angle) {
            return sign * (c.height * c.axis + across * (std::cos(angle) * u + std::sin(angle) * v));
        };
        const Real step = 2 * std::numbers::pi_v<Real> / kAngles;
        for (int k = 0; k < kAngles; ++k) {
            const Real low = extent(at(step * k));
            if (low > extent(at(step * (k - 1))) || low > extent(at(step * (k + 1)))) continue;
            consider(at(
                leastBetween([&](Real angle) { return extent(at(angle)); }, step * (k - 1), step * (k + 1))));
        }
    }
    /// Golden sections, then the vertex of the parabola through three points around.
    template <class F>
    static Real leastBetween(F f, Real a, Real b) {
        const Real golden = (std::sqrt(Real(5)) - 1) / 2;
        while (b - a > 1e-8L) {
            const Real x = b - golden * (b - a), y = a + golden * (b - a);
            if (f(x) < f(y))
                b = y;
            else
                a = x;
        }
        Real middle = (a + b) / 2;
        constexpr Real h = 3e-5L;
        const Real low = f(middle - h), here = f(middle), high = f(middle + h);
        if (low + high - 2 * here > 0) {
            const Real vertex = middle + h * (low - high) / (2 * (low + high - 2 * here));
            if (f(vertex) < here) middle = vertex;
        }
        return middle;
    }

    void overSphere() {
        std::vector<std::pair<Real, Vec>> starts;
        for (int i = 0; i < kStarts; ++i) {  // a spiral
            const Real z = 1 - (2 * i + Real(1)) / kStarts,
                       angle = i * (3 - std::sqrt(Real(5))) * std::numbers::pi_v<Real>;
            const Real r = std::sqrt(1 - z * z);
            const Vec n{r * std::cos(angle), r * std::sin(angle), z};
            starts.emplace_back(extent(n), n);
        }
        for (const Support* s : {&a_, &b_})
            if (!s->solid)
                for (const Vec& axis : s->axes)
                    for (const Real sign : {1, -1})
                        starts.emplace_back(extent(sign * unit(axis)), sign * unit(axis));
        std::sort(starts.begin(), starts.end(),
                  [](const auto& x, const auto& y) { return x.first < y.first; });
        for (std::size_t i = 0; i < std::min<std::size_t>(kBest, starts.size()); ++i)
            consider(stationary(starts[i].second));
        for (std::size_t i = kBest; i < starts.size(); ++i) found_.push_back(starts[i]);
    }
    /// Follows the component of the support point across n to zero; a step that does not lower h_K is shortened.
    Vec stationary(Vec n) const {
        Real now = extent(n);
        for (int k = 0; k < kNewtonSteps; ++k) {
            const Vec s = anyNormalTo(n), t = cross(n, s);
            const auto turned = [&](Real x, Real y) { return unit(n + x * s + y * t); };
            const auto slope = [&](Vec m) {
                const Vec w = point(m);
                return std::array<Real, 2>{dot(w - dot(w, m) * m, s), dot(w - dot(w, m) * m, t)};
            };
            const auto g = slope(n), gs = slope(turned(kDifference, 0)), gt = slope(turned(0, kDifference));
            const Real a = (gs[0] - g[0]) / kDifference, b = (gt[0] - g[0]) / kDifference,
                       c = (gs[1] - g[1]) / kDifference, d = (gt[1] - g[1]) / kDifference,
                       det = a * d - b * c;
            Real x = -(d * g[0] - b * g[1]) / det, y = -(a * g[1] - c * g[0]) / det;
            if (!(a > 0 && det > 0)) {
                const Real stiff = std::abs(a) + std::abs(d) + std::abs(now) + 1e-9L;
                x = -g[0] / stiff;
                y = -g[1] / stiff;
            }
            Real scale = std::min(Real(1), Real(0.3) / (std::hypot(x, y) + 1e-30L));
            Vec next = turned(scale * x, scale * y);
            for (int half = 0; half < 30 && extent(next) > now; ++half) {
                scale /= 2;
                next = turned(scale * x, scale * y);
            }
            if (!(extent(next) <= now)) break;
            n = next;
            now = extent(n);
            if (scale * std::hypot(x, y) < 1e-17L) break;
        }
        return n;
    }

    const Support &a_, &b_;
    std::vector<std::pair<Real, Vec>> found_;
};

}  // namespace

std::optional<OracleAnswer> ellipsoidContact(const scenario::Geometry& a, const scenario::Pose& poseA,
                                             const scenario::Geometry& b, const scenario::Pose& poseB,
                                             double tie) {
    const scenario::Vec3 origin = poseA.position;
    const auto answerOf = [&](Real distance, Vec n, Vec onA, Vec onB) {
        OracleAnswer answer;
        answer.signedDistance = static_cast<double>(distance);
        answer.normals = {narrow(n)};
        answer.witnessA = narrow(onA + widen(origin));
        answer.witnessB = narrow(onB + widen(origin));
        return answer;
    };
    for (const bool planeIsA : {true, false}) {
        const auto* plane = std::get_if<scenario::HalfSpace>(planeIsA ? &a : &b);
        if (plane == nullptr) continue;
        const auto other = makeSupport(planeIsA ? b : a, planeIsA ? poseB : poseA, origin);
        if (!other) return std::nullopt;
        const scenario::Pose& pose = planeIsA ? poseA : poseB;
        const Vec n = unit(rotate(pose.orientation, widen(plane->normal)));
        const Real offset = plane->offset + dot(n, widen(pose.position) - widen(origin));
        const Real distance = -other->along(-1 * n) - offset;
        const Vec low = other->point(-1 * n), foot = low - distance * n;
        return planeIsA ? answerOf(distance, n, foot, low) : answerOf(distance, -1 * n, low, foot);
    }
    const auto supportA = makeSupport(a, poseA, origin), supportB = makeSupport(b, poseB, origin);
    if (!supportA || !supportB) return std::nullopt;
    const auto found = Search(*supportA, *supportB).found();
    const Real least = found.front().first;
    const Vec n = found.front().second;
    // An ellipsoid has one support point; the other shape's lies across the distance.
    const bool exactA = !supportA->solid;
    const Vec own = exactA ? supportA->point(n) : supportB->point(-1 * n);
    OracleAnswer answer =
        exactA ? answerOf(-least, n, own, own - least * n) : answerOf(-least, n, own + least * n, own);
    const Real slack = tie * std::max(supportA->size, supportB->size);
    for (const auto& [value, direction] : found) {
        if (value > least + slack) break;
        const scenario::Vec3 one = narrow(direction);
        const bool known = std::any_of(answer.normals.begin(), answer.normals.end(),
                                       [&](const scenario::Vec3& m) { return dot(m, one) > 1 - 1e-6; });
        if (!known && answer.normals.size() < kMostNormals) answer.normals.push_back(one);
    }
    answer.continuum = answer.normals.size() > 8;
    return answer;
}

Real ellipsoidReach(const scenario::Ellipsoid& ellipsoid, const scenario::Pose& pose, scenario::Vec3 origin,
                    Vec n) {
    return makeSupport(ellipsoid, pose, origin)->along(n);
}

}  // namespace rigor::validation::oracle
