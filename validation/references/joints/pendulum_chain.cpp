// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chain of rigid links joined by parallel hinges, the first to a fixed point; double pendulum and longer.
// With R_j the rotation of link j, b_ij the vector in link j on the way to the centre of mass of link i (to
// the next hinge for j < i, to the centre of mass for j = i):
//   M_jk = sum_i m_i (R_j b_ij).(R_k b_ik) + delta_jk I_j,
//   (M th'')_k = sum_i m_i [g + sum_j th_j'^2 R_j b_ij] . (n x R_k b_ik),
// integrated in extended precision. The solution is valid until runs of two tolerances diverge by 1e-9.
// Source: Goldstein, Poole, Safko 2002, chapter 1; Hairer, Norsett, Wanner, Solving ODEs I, 1993, II.9.
// Assumes: hinges with parallel axes (2D: also ball joints; 3D ball joints where the motion stays in a plane:
// arms, gravity and principal axes in or across it), nothing else.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/linear_system.hpp"
#include "validation/references/numerics/ode.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;
using Point = std::array<Real, 2>;

constexpr std::size_t kChainOperations = 2'500'000'000;  // 2.5 s; see the derivative below

struct Link {
    int body = 0;
    Real mass = 0, inertia = 0;
    Point toNext{}, toCenter{};  ///< vectors from the hinge before, in the initial pose
    Vec3 offPlaneCenter;         ///< part of the centre of mass along the axis, from the first anchor
};

Point rotated(Point p, Real angle) {
    const Real c = std::cos(angle), s = std::sin(angle);
    return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
}
Real dotOf(Point a, Point b) {
    return a[0] * b[0] + a[1] * b[1];
}
/// n . (a x b): the turn from a to b.
Real turnOf(Point a, Point b) {
    return a[0] * b[1] - a[1] * b[0];
}

void derivative(const std::vector<Link>& links, Point gravity, const OdeState& y, OdeState& d) {
    const std::size_t n = links.size();
    std::vector<Point> next(n), center(n);
    for (std::size_t j = 0; j < n; ++j) {
        next[j] = rotated(links[j].toNext, y[j]);
        center[j] = rotated(links[j].toCenter, y[j]);
    }
    const auto size = static_cast<Eigen::Index>(n);
    numerics::Matrix mass = numerics::Matrix::Zero(size, size);
    numerics::Vector force = numerics::Vector::Zero(size);
    for (std::size_t i = 0; i < n; ++i) {
        const auto arm = [&](std::size_t j) { return j < i ? next[j] : center[j]; };
        Point push = gravity;
        for (std::size_t j = 0; j <= i; ++j)
            for (std::size_t c = 0; c < 2; ++c) push[c] += y[n + j] * y[n + j] * arm(j)[c];
        for (std::size_t k = 0; k <= i; ++k) {
            const auto row = static_cast<Eigen::Index>(k);
            force[row] += links[i].mass * turnOf(arm(k), push);
            for (std::size_t j = 0; j <= i; ++j) mass(row, j) += links[i].mass * dotOf(arm(j), arm(k));
        }
        mass(i, i) += links[i].inertia;
    }
    const auto acceleration = numerics::solveDense(std::move(mass), std::move(force));
    if (!acceleration) {
        // A trial step far off: the integrator tries a shorter step.
        std::fill(d.begin(), d.end(), std::numeric_limits<Real>::quiet_NaN());
        return;
    }
    for (std::size_t j = 0; j < n; ++j) {
        d[j] = y[n + j];
        d[n + j] = (*acceleration)[j];
    }
}

class PendulumChain : public Reference {
  public:
    PendulumChain(const Scenario& scenario, const std::vector<int>& order) : scenario_(scenario) {
        findJoints(order);
        chooseAxis();
        OdeState start(2 * order.size());
        for (std::size_t i = 0; i < order.size(); ++i) addLink(i, order[i], start);
        const Vec3 g = gravityOn(scenario, order.front());
        for (const int body : order)
            require(negligible(norm(gravityOn(scenario, body) - g), norm(g)),
                    "gravity acts differently on the links");
        const Point pull = flat(g);
        const auto rhs = [links = links_, pull](Real, const OdeState& y, OdeState& d) {
            derivative(links, pull, y, d);
        };
        const double end = runEnd(scenario);
        const std::size_t n = links_.size();
        Real turns = 1 / end, reach = 0;
        for (std::size_t i = 0; i < n; ++i) {
            turns = std::max(turns, std::abs(start[n + i]));
            reach = std::max(reach, std::hypot(links_[i].toCenter[0], links_[i].toCenter[1]));
        }
        if (reach > 0) turns += std::sqrt(norm(g) / reach);
        OdeState beside(2 * n, 1);
        std::fill(beside.begin() + n, beside.end(), turns);
        numerics::OdeLimits limits;
        limits.neighbour = 1e-12L;
        limits.evaluations = kChainOperations / (300 + 100 * n * n + 5 * n * n * n);
        limits.agrees = [n](const OdeState& y, const OdeState& neighbour) {
            for (std::size_t i = 0; i < n; ++i)
                if (!(std::abs(y[i] - neighbour[i]) < 1e-9L)) return false;
            return true;
        };
        solution_ = numerics::DenseSolution(rhs, 0, start, end, 1e-14L, {}, beside, limits);
        if (!solution_.isWhole()) validUntil_ = static_cast<double>(solution_.end());
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const auto& link : links_) result.push_back(link.body);
        return result;
    }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int body, double t) const override {
        const OdeState y = solution_.at(t);
        const std::size_t n = links_.size();
        Vec3 hinge = anchor_, velocity{};
        for (std::size_t i = 0; i < n; ++i) {
            const Link& link = links_[i];
            const auto rate = static_cast<double>(y[n + i]);
            const auto place = [&](Point p) { return lift(rotated(p, y[i])); };
            if (link.body == body) {
                const Body& b = scenario_.bodies[body];
                const Vec3 arm = place(link.toCenter);
                const Quat q = scenario::fromAxisAngle(axis_, static_cast<double>(y[i]));
                return stateOf(b, hinge + arm + link.offPlaneCenter,
                               scenario::normalized(q * b.pose.orientation),
                               velocity + rate * cross(axis_, arm), rate * axis_);
            }
            const Vec3 arm = place(link.toNext);
            hinge += arm;
            velocity += rate * cross(axis_, arm);
        }
        throw std::invalid_argument("pendulum_chain: unknown body");
    }

  private:
    Point flat(Vec3 v) const { return {static_cast<Real>(dot(ex_, v)), static_cast<Real>(dot(ey_, v))}; }
    Vec3 lift(Point p) const { return static_cast<double>(p[0]) * ex_ + static_cast<double>(p[1]) * ey_; }

    /// joints_[i] holds link i to the link before (or to the world).
    void findJoints(const std::vector<int>& order) {
        for (std::size_t i = 0; i < order.size(); ++i) {
            const scenario::Joint* found = nullptr;
            for (std::size_t j = 0; j < scenario_.joints.size(); ++j) {
                const auto& joint = scenario_.joints[j];
                if (joint.bodyA != order[i] && joint.bodyB != order[i]) continue;
                const int other = joint.bodyA == order[i] ? joint.bodyB : joint.bodyA;
                const bool fixed =
                    other == scenario::kNone || scenario_.bodies[other].type == scenario::BodyType::Static;
                const bool before = i == 0 ? fixed : other == order[i - 1];
                const bool after = i + 1 < order.size() && other == order[i + 1];
                require(before || after, "joint '" + joint.name + "' is not part of the chain");
                if (before) found = &joint;
            }
            require(found != nullptr,
                    bodyTitle(scenario_, order[i]) + " is not joined to the link before it");
            require(found->type == scenario::JointType::Hinge || found->type == scenario::JointType::Ball,
                    "joint '" + found->name + "' is neither a hinge nor a ball joint");
            requirePassive(*found);
            requireUndisturbed(scenario_, order[i], {.joints = true});
            joints_.push_back(found);
        }
        anchor_ = anchorOf(scenario_, *joints_[0],
                           joints_[0]->bodyA == order[0] ? joints_[0]->bodyB : joints_[0]->bodyA);
    }

    void chooseAxis() {
        if (scenario_.dimension == 3) {
            bool hinged = false;
            for (const auto* joint : joints_) {
                if (joint->type != scenario::JointType::Hinge) continue;
                const Vec3 axis = axisOf(scenario_, *joint);
                require(!hinged || norm(cross(axis, axis_)) < 1e-9,
                        "the hinges of the chain are not parallel");
                if (!hinged) axis_ = axis;
                hinged = true;
            }
            if (!hinged) {
                // Ball joints: the plane of gravity and of the first link that hangs askew.
                axis_ = {};
                for (const auto* joint : joints_)
                    for (const int body : {joint->bodyA, joint->bodyB}) {
                        if (body == scenario::kNone || axis_ != Vec3{}) continue;
                        const Vec3 arm = centerOfMass(scenario_.bodies[body]) - anchor_;
                        const Vec3 n = cross(scenario_.gravity, arm);
                        if (!negligible(norm(n), norm(scenario_.gravity) * norm(arm))) axis_ = unit(n);
                    }
                require(axis_ != Vec3{}, "the chain hangs straight: its plane is not defined by ball joints");
            }
        }
        ex_ = perpendicular(axis_);
        ey_ = cross(axis_, ex_);
    }

    void addLink(std::size_t i, int index, OdeState& start) {
        const Body& body = scenario_.bodies[index];
        const std::string subject = bodyTitle(scenario_, index);
        const Vec3 before = anchorOf(scenario_, *joints_[i], index), com = centerOfMass(body);
        const Vec3 next = i + 1 < joints_.size() ? anchorOf(scenario_, *joints_[i + 1], index) : com;
        Link link;
        link.body = index;
        link.mass = body.massProperties.mass;
        const Mat3 inertia = worldInertia(body);
        link.inertia =
            scenario_.dimension == 2 ? body.massProperties.inertia(2, 2) : dot(axis_, inertia * axis_);
        link.toCenter = flat(com - before);
        link.toNext = flat(next - before);
        link.offPlaneCenter = dot(axis_, com - anchor_) * axis_;
        const bool ball = scenario_.dimension == 3 && joints_[i]->type == scenario::JointType::Ball;
        if (ball) {
            const Vec3 moment = inertia * axis_;
            const Vec3 g = gravityOn(scenario_, index);
            require(negligible(norm(moment - dot(moment, axis_) * axis_), norm(moment)) &&
                        negligible(dot(axis_, g), norm(g)) &&
                        std::abs(dot(axis_, com - anchor_)) + std::abs(dot(axis_, before - anchor_)) <=
                            1e-9 * norm(com - before),
                    subject + " does not stay in the plane of the chain");
        }
        const Vec3 w = body.angularVelocity;
        require(norm(w - dot(w, axis_) * axis_) <= 1e-9 * norm(w),
                subject + " spins across the plane of the chain");
        const double rate = dot(w, axis_);
        const Vec3 expected = hingeVelocity_ + rate * cross(axis_, com - before);
        require(norm(body.velocity - expected) <= 1e-6 * std::max(norm(body.velocity), norm(expected)),
                "the velocity of " + subject + " does not fit its joint");
        hingeVelocity_ += rate * cross(axis_, next - before);
        start[joints_.size() + i] = rate;
        links_.push_back(link);
    }

    const Scenario& scenario_;
    std::vector<const scenario::Joint*> joints_;
    std::vector<Link> links_;
    Vec3 anchor_, axis_{0, 0, 1}, ex_, ey_, hingeVelocity_;
    numerics::DenseSolution solution_;
    double validUntil_ = 1e300;
};

/// The links in order, found by following the joints from the fixed one.
std::vector<int> followJoints(const Scenario& scenario) {
    const auto fixed = [&](int b) {
        return b == scenario::kNone || scenario.bodies[b].type == scenario::BodyType::Static;
    };
    std::vector<int> order;
    std::vector<bool> used(scenario.joints.size(), false);
    int current = scenario::kNone;
    for (;;) {
        std::size_t found = scenario.joints.size();
        for (std::size_t j = 0; j < scenario.joints.size(); ++j) {
            const auto& joint = scenario.joints[j];
            const bool here = order.empty() ? fixed(joint.bodyA) != fixed(joint.bodyB)
                                            : joint.bodyA == current || joint.bodyB == current;
            if (used[j] || !here) continue;
            require(found == scenario.joints.size(),
                    "the joints do not form a single chain: name its bodies");
            found = j;
        }
        if (found == scenario.joints.size()) break;
        const auto& joint = scenario.joints[found];
        used[found] = true;
        current = order.empty() ? (fixed(joint.bodyA) ? joint.bodyB : joint.bodyA)
                                : (joint.bodyA == current ? joint.bodyB : joint.bodyA);
        order.push_back(current);
    }
    require(!order.empty(), "no joint holds a body to the world");
    return order;
}

}  // namespace

std::unique_ptr<Reference> makePendulumChain(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    const bool named = spec.parameters.count("bodies") > 0;
    return std::make_unique<PendulumChain>(scenario,
                                           named ? parts.dynamicBodies("bodies") : followJoints(scenario));
}

}  // namespace rigor::validation
