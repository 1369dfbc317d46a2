// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/contact_problems/residual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/contact_problems/problem.hpp"

namespace rigor::validation {
namespace {

using adapter::FrictionModel;
using Vec2 = std::array<double, 2>;

double sizeOf(const std::vector<double>& x) {
    double sum = 0.0;
    for (const double v : x) sum += v * v;
    return std::sqrt(sum);
}

/// Squared distance of r = (n, t) from P_K(r - (u + mu |u_T| e_N)).
double coneDefect(double n, const Vec2& t, double uN, const Vec2& uT, double mu) {
    const double x = n - uN - mu * std::hypot(uT[0], uT[1]);
    const Vec2 y{t[0] - uT[0], t[1] - uT[1]};
    const double length = std::hypot(y[0], y[1]);
    double pN = x;
    Vec2 pT = y;
    if (mu * length <= -x) {
        pN = 0.0;
        pT = {0.0, 0.0};
    } else if (length > mu * x) {
        pN = (mu * length + x) / (1.0 + mu * mu);
        pT = {mu * pN * y[0] / length, mu * pN * y[1] / length};
    }
    return (n - pN) * (n - pN) + (t[0] - pT[0]) * (t[0] - pT[0]) + (t[1] - pT[1]) * (t[1] - pT[1]);
}

/// Closest point of the regular polygon with corners at `radius`, the first at angle 0.
Vec2 onPolygon(const Vec2& y, double radius, int corners, int dimension) {
    if (dimension == 2 || corners == 2) return {std::clamp(y[0], -radius, radius), 0.0};
    if (!(radius > 0.0)) return {0.0, 0.0};
    constexpr double kTurn = 6.283185307179586;
    Vec2 best{0.0, 0.0};
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (int k = 0; k < corners; ++k) {
        const auto corner = [&](int i) {
            const double angle = kTurn * i / corners;
            return Vec2{radius * std::cos(angle), radius * std::sin(angle)};
        };
        const Vec2 a = corner(k), b = corner(k + 1), edge{b[0] - a[0], b[1] - a[1]};
        const Vec2 from{y[0] - a[0], y[1] - a[1]};
        inside = inside && edge[0] * from[1] - edge[1] * from[0] >= 0.0;
        const double length2 = edge[0] * edge[0] + edge[1] * edge[1];
        const double s =
            length2 > 0.0 ? std::clamp((from[0] * edge[0] + from[1] * edge[1]) / length2, 0.0, 1.0) : 0.0;
        const Vec2 p{a[0] + s * edge[0], a[1] + s * edge[1]};
        const double distance = std::hypot(y[0] - p[0], y[1] - p[1]);
        if (distance < nearest) {
            nearest = distance;
            best = p;
        }
    }
    return inside ? y : best;
}

double pyramidDefect(double n, const Vec2& t, double uN, const Vec2& uT, double mu,
                     const FrictionModel& model, int dimension) {
    const double normal = n - std::max(0.0, n - uN), radius = mu * std::max(0.0, n);
    const Vec2 y{t[0] - uT[0], t[1] - uT[1]};
    const Vec2 p = model.kind == FrictionModel::Kind::Box
                       ? Vec2{std::clamp(y[0], -radius, radius), std::clamp(y[1], -radius, radius)}
                       : onPolygon(y, radius, model.corners, dimension);
    return normal * normal + (t[0] - p[0]) * (t[0] - p[0]) + (t[1] - p[1]) * (t[1] - p[1]);
}

}  // namespace

ContactResidual contactResidual(const adapter::ContactProblem& problem, const std::vector<double>& r,
                                const FrictionModel& model) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto d = static_cast<std::size_t>(problem.dimension);
    const std::vector<double> u = relativeVelocities(problem, r);
    if (!std::isfinite(sizeOf(u)) || !std::isfinite(sizeOf(r)))
        return {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
    ContactResidual found;
    double sum = 0.0, own = 0.0, outside = 0.0, load = 0.0;
    for (std::size_t c = 0; c < problem.contacts(); ++c) {
        const double *rc = r.data() + c * d, *uc = u.data() + c * d, mu = problem.mu[c];
        const Vec2 t{rc[1], d == 3 ? rc[2] : 0.0}, uT{uc[1], d == 3 ? uc[2] : 0.0};
        const double defect = coneDefect(rc[0], t, uc[0], uT, mu);
        sum += defect;
        own += model.kind == FrictionModel::Kind::Cone
                   ? defect
                   : pyramidDefect(rc[0], t, uc[0], uT, mu, model, problem.dimension);
        found.penetration = std::max(found.penetration, -uc[0]);
        outside = std::max({outside, std::hypot(t[0], t[1]) - mu * rc[0], -rc[0]});
        load = std::max(load, std::abs(rc[0]));
    }
    const double scale = std::max({sizeOf(problem.q), sizeOf(r), sizeOf(u)});
    found.absolute = std::sqrt(sum);
    found.relative = scale > 0.0 ? found.absolute / scale : 0.0;
    found.own = scale > 0.0 ? std::sqrt(own) / scale : 0.0;
    found.cone = outside > 0.0 ? (load > 0.0 ? outside / load : kInfinity) : 0.0;
    return found;
}

}  // namespace rigor::validation
