// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Physical pendulum: a rigid body on a hinge, any axis; gravity across the axis counts. With I about the
// axis, d the distance of the centre of mass from it, W^2 = m g d/I and m = sin^2(th0/2) + th0'^2/(4 W^2):
//   m < 1: sin(th/2) = sqrt(m) sn(W t + u0 | m), th' = 2 W sqrt(m) cn, period 4 K(m)/W;
//   m > 1: th = 2 am(sqrt(m) W t + u0 | 1/m), th' = 2 W sqrt(m) dn, period 2 K(1/m)/(W sqrt(m)); m = 1:
//   separatrix.
// Source: Whittaker, Analytical Dynamics, 1937, section 44.
// Stops: at the first limit of its angle (of a ball or cone-twist joint: of its swing) the body loses its
// speed, and stays where gravity pushes it on; where it swings back instead, the answer ends.
// Assumes: a hinge (2D: also a ball joint) to a fixed point, initial motion about its axis, nothing else; on
// a ball or cone-twist joint with a limit, motion about the horizontal across the arm, a principal axis.
// Quantities: period (mean over the passages through the lowest point), amplitude.
#include <algorithm>
#include <cmath>

#include "validation/references/joint_parts.hpp"
#include "validation/references/numerics/elliptic.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

class PhysicalPendulum : public Reference {
  public:
    PhysicalPendulum(const Scenario& scenario, int index, int jointIndex)
        : duration_(scenario.duration),
          index_(index),
          body_(scenario.bodies[static_cast<std::size_t>(index)]),
          hinge_(fixedJoint(scenario, jointIndex, index, true)) {
        const auto type = hinge_.joint->type;
        const bool swings = scenario.dimension == 3 && hinge_.joint->features().size() == 1 &&
                            (type == scenario::JointType::Ball || type == scenario::JointType::ConeTwist);
        require(type == scenario::JointType::Hinge || swings ||
                    (scenario.dimension == 2 && type == scenario::JointType::Ball),
                "joint '" + hinge_.joint->name + "' is not a hinge");
        if (swings) setSwingAxis(scenario);
        requireOnlyJoints(scenario, index, {hinge_.joint});
        requireTurnsAbout(scenario, index, hinge_.anchor);
        const Vec3 a = hinge_.axis, w = body_.angularVelocity;
        require(norm(w - dot(w, a) * a) <= 1e-9 * norm(w),
                bodyTitle(scenario, index) + " spins across the axis of its hinge");
        rate0_ = dot(w, a);
        const Vec3 arm = centerOfMass(body_) - hinge_.anchor, g = gravityOn(scenario, index);
        along_ = dot(arm, a) * a;
        across_ = arm - along_;
        const Vec3 pull = g - dot(g, a) * a;
        const double m = body_.massProperties.mass, d = norm(across_);
        const double moment = dot(a, worldInertia(body_) * a) + m * d * d;
        // Gravity along the axis, or through it: nothing drives the rotation.
        if (negligible(norm(pull), norm(g)) || d == 0.0) return;
        down_ = unit(pull);
        W_ = std::sqrt(m * norm(pull) * d / moment);
        angle0_ = angleOf(across_);
        setUp();
        findStop(swings, horizon(scenario));
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return stays_ ? 1e300 : stop_; }

    PartialState exact(int, double t) const override {
        Real angle = 0, rate = 0;
        solve(std::min(t, stop_), angle, rate);
        if (t >= stop_) rate = 0;
        const auto turn = static_cast<double>(angle - angle0_);
        const Quat q = scenario::fromAxisAngle(hinge_.axis, turn);
        const Vec3 arm = along_ + rotate(q, across_), w = static_cast<double>(rate) * hinge_.axis;
        return stateOf(body_, hinge_.anchor + arm, scenario::normalized(q * body_.pose.orientation),
                       cross(w, arm), w);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (W_ == 0 || m_ == 0 || m_ == 1 || stop_ < duration_) return result;
        if (firstPassage() + period_ <= duration_) {
            Quantity q{"period", "s", static_cast<double>(period_), {}, 0.0, {}};
            q.measure = [this](const Trajectory& run) { return meanPeriod(run); };
            result.push_back(std::move(q));
        }
        if (m_ < 1 && period_ <= duration_) {
            Quantity q{"amplitude", "rad", static_cast<double>(2 * std::asin(std::sqrt(m_))), {}, 0.0, {}};
            q.measure = [this](const Trajectory& run) { return largestAngle(run); };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    /// A cone limits motion about the horizontal across the arm as a stop of a hinge there.
    void setSwingAxis(const Scenario& scenario) {
        const Vec3 arm = centerOfMass(body_) - hinge_.anchor, cone = hinge_.axis;
        const Vec3 a = unit(cross(arm, gravityOn(scenario, index_)));
        require(a != Vec3{}, bodyTitle(scenario, index_) + " hangs straight down from its joint");
        hinge_.axis = a;
        const Mat3 I = worldInertia(body_);
        require(norm(cross(I * a, a)) <= 1e-9 * norm(I * a) && std::abs(dot(cone, a)) <= 1e-9,
                bodyTitle(scenario, index_) + " does not swing in a plane that its joint's axis is in");
    }

    void findStop(bool swings, double end) {
        const auto& joint = *hinge_.joint;
        const auto& axis = joint.axes[joint.type == scenario::JointType::ConeTwist ? 1 : 0];
        if (axis.mode != scenario::AxisMode::Limited) return;
        // The joint's angle grows with B's turn against A; a cone has the same angle on both sides.
        const bool isB = joint.bodyB == index_;
        const double upper = isB || swings ? axis.upper : -axis.lower;
        const double lower = swings ? -axis.upper : isB ? axis.lower : -axis.upper;
        const auto beyond = [&](double t) {
            Real angle = 0, rate = 0;
            solve(t, angle, rate);
            const auto q = static_cast<double>(angle - static_cast<Real>(angle0_));
            return std::max(q - upper, lower - q);
        };
        require(beyond(0.0) <= 1e-12, "joint '" + joint.name + "' starts beyond its limits");
        const int points = 20000;  // the fastest swing of a run of 1000 steps moves little between them
        for (int i = 1; i <= points && stop_ > 1e299; ++i) {
            if (beyond(end * i / points) <= 0.0) continue;
            double low = end * (i - 1) / points, high = end * i / points;
            for (int k = 0; k < 80; ++k) {
                const double middle = 0.5 * (low + high);
                (beyond(middle) > 0.0 ? high : low) = middle;
            }
            stop_ = high;
        }
        if (stop_ > 1e299) return;
        Real angle = 0, rate = 0;
        solve(stop_, angle, rate);
        stays_ = -std::sin(angle) * rate >= 0;
    }

    double angleOf(Vec3 arm) const {
        return std::atan2(dot(hinge_.axis, cross(down_, arm)), dot(down_, arm));
    }

    void setUp() {
        const Real s = std::sin(static_cast<Real>(angle0_) / 2), r = static_cast<Real>(rate0_) / (2 * W_);
        m_ = s * s + r * r;
        if (m_ == 0) return;
        root_ = std::sqrt(m_);
        if (m_ < 1) {
            u0_ = numerics::ellipticF(std::atan2(s / root_, r / root_), m_);
            period_ = 4 * numerics::ellipticK(m_) / W_;
        } else if (m_ > 1) {
            u0_ = numerics::ellipticF(static_cast<Real>(angle0_) / 2, 1 / m_) * (rate0_ < 0 ? -1 : 1);
            period_ = 2 * numerics::ellipticK(1 / m_) / (W_ * root_);
        } else {
            u0_ = std::atanh(rate0_ < 0 ? -s : s);
        }
    }

    void solve(double t, Real& angle, Real& rate) const {
        const Real sign = rate0_ < 0 ? -1 : 1;
        if (W_ == 0) {
            angle = static_cast<Real>(angle0_) + static_cast<Real>(rate0_) * t;
            rate = rate0_;
        } else if (m_ == 0) {
            angle = rate = 0;
        } else if (m_ < 1) {
            const auto f = numerics::jacobi(W_ * t + u0_, m_);
            angle = 2 * std::asin(root_ * f.sn);
            rate = 2 * W_ * root_ * f.cn;
        } else {
            const auto f = numerics::jacobi(root_ * W_ * t + u0_, 1 / m_);
            angle = sign * 2 * f.am;
            rate = sign * 2 * W_ * root_ * f.dn;
        }
    }

    /// First passage through the lowest point after the start, in the direction of growing angle (libration).
    double firstPassage() const {
        const Real inU = m_ < 1 ? 4 * numerics::ellipticK(m_) : 2 * numerics::ellipticK(1 / m_);
        const Real ahead = (std::floor(u0_ / inU) + 1) * inU - u0_;
        return static_cast<double>(ahead / (W_ * (m_ < 1 ? 1 : root_)));
    }

    double angleIn(const Trajectory& run, std::size_t k) const {
        const Vec3 arm = centerOfMass(body_, run.state(k, index_)) - hinge_.anchor;
        return angleOf(arm - dot(arm, hinge_.axis) * hinge_.axis);
    }
    double rateIn(const Trajectory& run, std::size_t k) const {
        return dot(run.state(k, index_).angularVelocity, hinge_.axis);
    }

    std::optional<double> meanPeriod(const Trajectory& run) const {
        const double sign = m_ > 1 && rate0_ < 0 ? -1.0 : 1.0;
        std::optional<double> first, last;
        int count = 0;
        for (std::size_t k = 0; k + 1 < run.frames(); ++k) {
            const double a = sign * angleIn(run, k), b = sign * angleIn(run, k + 1);
            if (!(a < 0.0 && b >= 0.0 && b - a < 3.0)) continue;
            const auto time = upwardCrossing(
                run, k, [&](std::size_t i) { return sign * angleIn(run, i); },
                [&](std::size_t i) { return sign * rateIn(run, i); });
            if (!time) return std::nullopt;
            if (!first) first = time;
            last = time;
            ++count;
        }
        if (count < 2) return std::nullopt;
        return (*last - *first) / (count - 1);
    }

    /// Largest turning point: near the top of an arc cos(th_max) = cos(th) - th'^2/(2 W^2).
    std::optional<double> largestAngle(const Trajectory& run) const {
        std::optional<double> largest;
        const auto W2 = static_cast<double>(W_ * W_);
        for (std::size_t k = 0; k < run.frames(); ++k) {
            const double angle = std::abs(angleIn(run, k)), rate = rateIn(run, k);
            if (!(rate * rate < 0.1 * W2 * std::sin(angle))) continue;
            const double top = std::acos(std::max(-1.0, std::cos(angle) - 0.5 * rate * rate / W2));
            if (!largest || top > *largest) largest = top;
        }
        return largest;
    }

    double duration_;
    int index_;
    const Body& body_;
    FixedJoint hinge_;
    Vec3 along_, across_, down_;
    double angle0_ = 0.0, rate0_ = 0.0;
    double stop_ = 1e300;  ///< when it reaches a limit [s]
    bool stays_ = true;    ///< and gravity holds it there
    Real W_ = 0, m_ = 0, root_ = 0, u0_ = 0, period_ = 0;
};

}  // namespace

std::unique_ptr<Reference> makePhysicalPendulum(const Scenario& scenario,
                                                const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "joint"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<PhysicalPendulum>(scenario, body, parts.joint("joint", body));
}

}  // namespace rigor::validation
