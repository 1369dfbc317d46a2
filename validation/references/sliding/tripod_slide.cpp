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
#include <limits>

#include "validation/references/numerics/linear_system.hpp"
#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"
#include "validation/references/parts.hpp"
#include "validation/references/sliding/flat_motion.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

class TripodSlide : public Reference {
  public:
    TripodSlide(const Scenario& scenario, int index, const FlatMotion& motion, double height)
        : scenario_(scenario), index_(index), motion_(motion), height_(height), mu_(motion.friction) {
        require(motion_.support.points.size() == 3,
                bodyTitle(scenario, index) + " does not stand on exactly three points");
        for (const Vec3 p : motion_.support.points) feet_.push_back(motion_.place(p));
        const Vec3 g = gravityOn(scenario, index);
        pull_ = {dot(g, motion_.along), dot(g, motion_.across), dot(g, motion_.normal)};
        findEnd(motion_.start());
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return validUntil_; }
    PartialState exact(int, double t) const override { return motion_.state(solution_.at(t)); }

  private:
    using Foot = FlatMotion::Place;
    struct Loads {
        std::vector<Real> normal;
        std::vector<Foot> place, slip;  ///< slip: unit velocity
        Real slowest = 1e30L;
    };

    Loads loadsIn(const OdeState& y) const {
        Loads loads;
        const Real c = std::cos(y[2]), s = std::sin(y[2]);
        Matrix m(3, 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const Foot p{c * feet_[i].x - s * feet_[i].y, s * feet_[i].x + c * feet_[i].y};
            const Foot u{y[3] - y[5] * p.y, y[4] + y[5] * p.x};
            const Real speed = std::hypot(u.x, u.y);
            loads.slowest = std::min(loads.slowest, speed);
            loads.place.push_back(p);
            loads.slip.push_back({u.x / speed, u.y / speed});
            // (p - H n) x (N (n - mu u)): along the first axis and the second.
            m.col(i) << 1, p.y - height_ * mu_ * loads.slip[i].y, -p.x + height_ * mu_ * loads.slip[i].x;
        }
        const auto normal = solveDense(m, Vector::Unit(3, 0) * (-motion_.mass * pull_[2]));
        // A trial step far off has no loads: the integrator tries a shorter one.
        if (normal)
            loads.normal.assign(normal->begin(), normal->end());
        else
            loads.normal.assign(3, std::numeric_limits<Real>::quiet_NaN());
        return loads;
    }

    void derivative(const OdeState& y, OdeState& d) const {
        const Loads loads = loadsIn(y);
        Real fx = 0, fy = 0, torque = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Real x = -mu_ * loads.normal[i] * loads.slip[i].x,
                       z = -mu_ * loads.normal[i] * loads.slip[i].y;
            fx += x;
            fy += z;
            torque += loads.place[i].x * z - loads.place[i].y * x;
        }
        d = {y[3],
             y[4],
             y[5],
             fx / motion_.mass + pull_[0],
             fy / motion_.mass + pull_[1],
             torque / motion_.inertia};
    }

    void findEnd(const OdeState& start) {
        const auto rhs = [this](Real, const OdeState& y, OdeState& d) { derivative(y, d); };
        const double whole = runEnd(scenario_);
        Real reach = 0;
        for (const Foot& foot : feet_) reach = std::max(reach, std::hypot(foot.x, foot.y));
        const Real speed = std::hypot(start[3], start[4]) + std::abs(start[5]) * reach, least = 0.02L * speed;
        const auto holds = [&](const OdeState& y) {
            const Loads loads = loadsIn(y);
            return loads.slowest > least && *std::min_element(loads.normal.begin(), loads.normal.end()) > 0;
        };
        require(loadsIn(start).slowest > least,
                "a foot of " + bodyTitle(scenario_, index_) + " does not slide at the start");
        require(holds(start), bodyTitle(scenario_, index_) + " tips at the start");
        const OdeState scale{reach, reach, 1, speed, speed, speed / reach};
        const Real spinUp = motion_.mass * reach * reach / motion_.inertia;
        const auto end = static_cast<double>(lastTimeOf(
            holds, rhs, 0, start, whole, 400,
            [&](const OdeState& y) {
                // Half of what the slowest foot needs at least to come to rest.
                const Real loss = mu_ * std::abs(pull_[2]) * (1 + spinUp) + std::hypot(pull_[0], pull_[1]) +
                                  std::abs(y[5]) * std::hypot(y[3], y[4]);
                return loss > 0 ? loadsIn(y).slowest / (2 * loss) : Real(whole);
            },
            scale, 400'000));
        require(end > 0.0, bodyTitle(scenario_, index_) + " tips or stops at once");
        solution_ = DenseSolution(rhs, 0, start, end, 1e-14L, {}, scale, OdeLimits::ofEvaluations(400'000));
        if (end < whole) validUntil_ = end;
    }

    const Scenario& scenario_;
    int index_;
    FlatMotion motion_;
    Real height_, mu_;  ///< height of the centre of mass
    std::vector<Foot> feet_;
    std::array<Real, 3> pull_{};
    DenseSolution solution_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeTripodSlide(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "floor"});
    const int body = parts.dynamicBody("body");
    const int floor = parts.support("floor", body);
    const Vec3 centre = centerOfMass(scenario.bodies[body]);
    const Plane plane = planeOf(scenario, floor, centre);
    return std::make_unique<TripodSlide>(scenario, body, FlatMotion(scenario, body, floor, plane),
                                         plane.height(centre));
}

}  // namespace rigor::validation
