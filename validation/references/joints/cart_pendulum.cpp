// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A pendulum hinged to a cart that slides on a rail. With s the travel along the rail e, theta the turn about
// the hinge n, d(theta) from the hinge to the pendulum's centre of mass and d' = n x d:
//   (M + m) s'' + m (e.d') theta'' = M gM.e + m gm.e + m (e.d) theta'^2
//   m (e.d') s'' + (I + m d^2) theta'' = m gm.d'
// integrated in extended precision; valid until runs of two tolerances part by 1e-9.
// Source: Landau and Lifshitz, Mechanics, 1976, section 5, problem 2; Goldstein, Poole, Safko 2002,
// chapter 1. Assumes: a slider that holds the cart to the world, a hinge across the rail that holds the
// pendulum to the cart, a principal axis of the pendulum along the hinge, velocities that fit the joints,
// nothing else.
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;
using scenario::JointType;

class CartPendulum : public Reference {
  public:
    CartPendulum(const Scenario& scenario, int cart, int pendulum)
        : scenario_(scenario), cart_(cart), pendulum_(pendulum) {
        const scenario::Joint *rail = nullptr, *hinge = nullptr;
        for (const auto& joint : scenario.joints) {
            const bool holdsCart = joint.bodyA == cart || joint.bodyB == cart;
            const bool holdsPendulum = joint.bodyA == pendulum || joint.bodyB == pendulum;
            if (holdsCart && holdsPendulum && joint.type == JointType::Hinge) hinge = &joint;
            if (holdsCart && !holdsPendulum && joint.type == JointType::Slider) rail = &joint;
        }
        require(rail != nullptr, "no slider holds " + bodyTitle(scenario, cart));
        require(hinge != nullptr,
                "no hinge joins " + bodyTitle(scenario, cart) + " and " + bodyTitle(scenario, pendulum));
        const auto index = static_cast<int>(rail - scenario.joints.data());
        fixedJoint(scenario, index, cart);
        requirePassive(*hinge);
        requireOnlyJoints(scenario, cart, {rail, hinge});
        requireOnlyJoints(scenario, pendulum, {hinge});
        rail_ = unit(scenario.dimension == 2 ? railIn2d(*rail) : axisOf(scenario, *rail));
        axis_ = axisOf(scenario, *hinge);
        require(std::abs(dot(rail_, axis_)) < 1e-9, "the hinge is not across the rail");
        hinge_ = anchorOf(scenario, *hinge, pendulum);
        buildMotion();
    }
    std::vector<int> bodies() const override { return {cart_, pendulum_}; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int body, double t) const override {
        const OdeState y = solution_.at(t);
        const Vec3 travel = static_cast<double>(y[0]) * rail_, speed = static_cast<double>(y[2]) * rail_;
        if (body == cart_)
            return stateOf(cart(), centerOfMass(cart()) + travel, cart().pose.orientation, speed, {});
        const Vec3 arm = toVec3(armAt(y[1])), w = static_cast<double>(y[3]) * axis_;
        const Quat turn = scenario::fromAxisAngle(axis_, static_cast<double>(y[1]));
        return stateOf(pendulum(), hinge_ + travel + arm,
                       scenario::normalized(turn * pendulum().pose.orientation), speed + cross(w, arm), w);
    }

  private:
    const Body& cart() const { return scenario_.bodies[cart_]; }
    const Body& pendulum() const { return scenario_.bodies[pendulum_]; }
    Vec3 railIn2d(const scenario::Joint& rail) const {
        if (rail.bodyA == scenario::kNone) return rail.axisA;
        return rotate(scenario_.bodies[rail.bodyA].pose.orientation, rail.axisA);
    }
    Real3 armAt(Real angle) const {
        return turnedAbout(real3(axis_), std::cos(angle), std::sin(angle), real3(arm_));
    }

    void buildMotion() {
        const std::string subject = bodyTitle(scenario_, pendulum_);
        arm_ = centerOfMass(pendulum()) - hinge_;
        double inertia = pendulum().massProperties.inertia(2, 2);
        if (scenario_.dimension == 3) {
            const Vec3 moment = worldInertia(pendulum()) * axis_;
            inertia = dot(axis_, moment);
            require(norm(moment - inertia * axis_) <= 1e-9 * inertia,
                    "the hinge is not along a principal axis of " + subject);
        }
        const double rate = dot(axis_, pendulum().angularVelocity), speed = dot(rail_, cart().velocity);
        require(norm(pendulum().angularVelocity - rate * axis_) <= 1e-9 * std::abs(rate) &&
                    cart().angularVelocity == Vec3{},
                "the bodies spin as their joints forbid");
        const double scale = norm(cart().velocity) + norm(pendulum().velocity);
        require(norm(cart().velocity - speed * rail_) <= 1e-6 * scale &&
                    norm(pendulum().velocity - speed * rail_ - rate * cross(axis_, arm_)) <= 1e-6 * scale,
                "the velocities of the cart and the pendulum do not fit their joints");
        const Real m = pendulum().massProperties.mass, M = cart().massProperties.mass, I = inertia;
        const Real3 e = real3(rail_), n = real3(axis_), gm = real3(gravityOn(scenario_, pendulum_)),
                    gM = real3(gravityOn(scenario_, cart_));
        const auto rhs = [=, this](Real, const OdeState& y, OdeState& d) {
            const Real3 arm = armAt(y[1]), across = cross(n, arm);
            const Real a = M + m, b = m * dot(e, across), c = I + m * dot(across, across);
            const Real f = dot(e, M * gM + m * gm) + m * dot(e, arm) * y[3] * y[3], q = m * dot(gm, across);
            const Real det = a * c - b * b;
            d[0] = y[2];
            d[1] = y[3];
            d[2] = (c * f - b * q) / det;
            d[3] = (a * q - b * f) / det;
        };
        const OdeState start{0, 0, speed, rate};
        const double end = runEnd(scenario_), size = norm(arm_) + sizeOf(pendulum());
        const double turns =
            1 / end + std::abs(rate) + std::sqrt(norm(gravityOn(scenario_, pendulum_)) / size);
        const OdeState beside{size, 1, std::abs(speed) + size * turns, turns};
        OdeLimits limits;
        limits.neighbour = 1e-12L;
        limits.agrees = [](const OdeState& y, const OdeState& neighbour) {
            return std::abs(y[1] - neighbour[1]) <= 1e-9L;
        };
        solution_ = DenseSolution(rhs, 0, start, end, 1e-14L, {}, beside, limits);
        if (!solution_.isWhole()) validUntil_ = static_cast<double>(solution_.end());
    }

    const Scenario& scenario_;
    int cart_, pendulum_;
    Vec3 rail_, axis_, hinge_, arm_;
    DenseSolution solution_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeCartPendulum(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"cart", "pendulum"});
    const int cart = parts.dynamicBody("cart");
    return std::make_unique<CartPendulum>(scenario, cart, parts.dynamicBody("pendulum", {cart}));
}

}  // namespace rigor::validation
