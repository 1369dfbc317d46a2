// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body on three feet slides and spins on a plane. The loads follow from statics: with rho_i the feet from
// the centre of mass along the plane, H its height, u_i their velocities,
//   F_i = N_i (n - mu u_i/|u_i|),  sum F_i.n = -m g.n,  sum (rho_i - H n) x F_i has no part along the plane,
//   m v' = sum F_i + m g,  I psi'' = n . sum rho_i x F_i,
// integrated to 1e-12 in x, y, psi. Source: Farkas et al., Phys. Rev. Lett. 90 (2003) 248302 (friction of
// sliding and spinning bodies); Voyenli and Eriksen, Am. J. Phys. 53 (1985) 1149; Mason, Mechanics of Robotic
// Manipulation, 2001, ch. 7. Assumes: exactly three lowest points (balls or corners) that all slide, the
// normal along a principal axis; gravity and contact only. Valid until a foot has almost stopped or lifts.
// A disc or a box on its whole face is not determinate: its pressure is not given by the laws of rigid
// bodies.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

class TripodSlide : public Reference {
  public:
    TripodSlide(const Scenario& scenario, int index, int floor)
        : scenario_(scenario),
          index_(index),
          body_(scenario.bodies[static_cast<std::size_t>(index)]),
          plane_(planeOf(scenario, floor, centerOfMass(body_))) {
        const std::string who = bodyTitle(scenario, index);
        require(scenario.dimension == 3, "a tripod needs three dimensions");
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        requireStill(scenario, floor);
        const Footing footing = footingOf(scenario, index, plane_);
        require(std::abs(footing.gap) <= 1e-4 * sizeOf(body_), who + " does not stand on the floor");
        require(footing.points.size() == 3, who + " does not stand on exactly three points");
        const Vec3 n = plane_.normal, com = centerOfMass(body_), w = body_.angularVelocity;
        along_ = perpendicular(n);
        across_ = cross(n, along_);
        height_ = plane_.height(com);
        for (const Vec3 p : footing.points) feet_.push_back({dot(along_, p - com), dot(across_, p - com)});
        require(norm(cross(w, n)) <= 1e-9 * norm(w), who + " does not spin about the normal");
        require(std::abs(dot(body_.velocity, n)) <= 1e-9 * norm(body_.velocity), who + " leaves the floor");
        const Vec3 moment = worldInertia(body_) * n;
        inertia_ = dot(n, moment);
        require(norm(moment - dot(n, moment) * n) <= 1e-9 * norm(moment),
                "the normal is not along a principal axis of " + who);
        mass_ = body_.massProperties.mass;
        mu_ = pairCoefficients(scenario, footing.material, plane_.material).friction;
        const Vec3 g = gravityOn(scenario, index);
        pull_ = {dot(g, along_), dot(g, across_), dot(g, n)};
        const OdeState y{0, 0, 0, dot(along_, body_.velocity), dot(across_, body_.velocity), dot(n, w)};
        findEnd(y);
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int, double t) const override {
        const OdeState y = solution_.at(t);
        const auto d = [&](std::size_t i) { return static_cast<double>(y[i]); };
        return stateOf(
            body_, centerOfMass(body_) + d(0) * along_ + d(1) * across_,
            scenario::normalized(scenario::fromAxisAngle(plane_.normal, d(2)) * body_.pose.orientation),
            d(3) * along_ + d(4) * across_, d(5) * plane_.normal);
    }

  private:
    struct Foot {
        Real x = 0, y = 0;
    };
    struct Loads {
        std::vector<Real> normal;
        std::vector<Foot> place, slip;  ///< slip: unit velocity
        Real slowest = 1e30L;
    };

    Loads loadsIn(const OdeState& y) const {
        Loads loads;
        const Real c = std::cos(y[2]), s = std::sin(y[2]);
        std::vector<std::vector<Real>> m(3, std::vector<Real>(3));
        for (std::size_t i = 0; i < 3; ++i) {
            const Foot p{c * feet_[i].x - s * feet_[i].y, s * feet_[i].x + c * feet_[i].y};
            const Foot u{y[3] - y[5] * p.y, y[4] + y[5] * p.x};
            const Real speed = std::hypot(u.x, u.y);
            loads.slowest = std::min(loads.slowest, speed);
            loads.place.push_back(p);
            loads.slip.push_back({u.x / speed, u.y / speed});
            // (p - H n) x (N (n - mu u)): along the first axis and the second.
            m[0][i] = 1;
            m[1][i] = p.y - height_ * mu_ * loads.slip[i].y;
            m[2][i] = -p.x + height_ * mu_ * loads.slip[i].x;
        }
        loads.normal = {-mass_ * pull_[2], 0, 0};
        solveDense(m, loads.normal);
        return loads;
    }

    void derivative(const OdeState& y, OdeState& d) const {
        const Loads loads = loadsIn(y);
        Real fx = 0, fy = 0, torque = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Real x = -mu_ * loads.normal[i] * loads.slip[i].x,
                       z = -mu_ * loads.normal[i] * loads.slip[i].y;
            fx += x, fy += z;
            torque += loads.place[i].x * z - loads.place[i].y * x;
        }
        d = {y[3], y[4], y[5], fx / mass_ + pull_[0], fy / mass_ + pull_[1], torque / inertia_};
    }

    void findEnd(const OdeState& start) {
        const auto rhs = [this](Real, const OdeState& y, OdeState& d) { derivative(y, d); };
        const Loads first = loadsIn(start);
        const double whole = horizon(scenario_);
        const int pieces = 400;
        double end = whole;
        OdeState y = start;
        const Real least = 0.02L * (std::hypot(start[3], start[4]) +
                                    std::abs(start[5]) * std::hypot(feet_[0].x, feet_[0].y));
        require(first.slowest > least,
                "a foot of " + bodyTitle(scenario_, index_) + " does not slide at the start");
        for (int k = 0; k < pieces; ++k) {
            const OdeState next = integrateOde(rhs, whole * k / pieces, y, whole * (k + 1) / pieces, 1e-10L);
            const Loads loads = loadsIn(next);
            if (loads.slowest < least || *std::min_element(loads.normal.begin(), loads.normal.end()) <= 0) {
                end = whole * k / pieces;
                break;
            }
            y = next;
        }
        require(end > 0.0, bodyTitle(scenario_, index_) + " tips or stops at once");
        solution_ = DenseSolution(rhs, 0, start, end);
        if (end < whole) validUntil_ = end;
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    Plane plane_;
    Vec3 along_, across_;
    std::vector<Foot> feet_;
    Real height_ = 0, inertia_ = 0, mass_ = 0, mu_ = 0;
    std::array<Real, 3> pull_{};
    DenseSolution solution_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeTripodSlide(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "floor"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<TripodSlide>(scenario, body, parts.support("floor", body));
}

}  // namespace rigor::validation
