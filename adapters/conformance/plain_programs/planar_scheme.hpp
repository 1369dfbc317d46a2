// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hinges and sliders of a plane mechanism held in three ways, written out without any library. A library whose
// trajectory agrees with one of them to its rounding uses that scheme, and the error of another scheme shows
// the effect of the one difference. All three move bodies by
//     v' = v + h g + M^-1 J^T lambda,   x' = x + h v',   theta' = theta + h omega'
// (symplectic Euler), solved to the end:
//     Velocities: J v' = -(erp / h) C, J and C of the start of the step;
//     Projection: J v' = 0, and x' is moved onto C = 0 joint by joint afterwards, without the velocities;
//     Positions:  C(x') = 0, J of the start of the step (Ryckaert, Ciccotti and Berendsen 1977).
#pragma once

#include <array>
#include <cstddef>

#include "adapters/conformance/plain_programs/plain_program.hpp"

namespace rigor::plain {

enum class Hold { Velocities, Projection, Positions };

class PlanarScheme {
  public:
    /// `erp` of Velocities; `slop` [m] of Projection: a pass over the joints is the last when no error before
    /// it was larger.
    explicit PlanarScheme(const Scenario& scene, Hold hold, double erp = 0.0, double slop = 0.0)
        : scene_(scene), hold_(hold), erp_(erp), slop_(slop) {
        for (const scenario::Body& body : scene.bodies) {
            const Quat& q = body.pose.orientation;
            x_.insert(x_.end(), {body.pose.position.x, body.pose.position.y, 2.0 * std::atan2(q.z, q.w)});
            v_.insert(v_.end(), {body.velocity.x, body.velocity.y, body.angularVelocity.z});
            const double mass = body.massProperties.mass;
            inverse_.insert(inverse_.end(),
                            {1.0 / mass, 1.0 / mass, 1.0 / body.massProperties.inertia(2, 2)});
        }
        start_ = x_;
    }

    /// Turns by 2 atan(h omega / 2), a quaternion moved along its rate and normalised, instead of h omega.
    PlanarScheme& turningToFirstOrder() {
        firstOrder_ = true;
        return *this;
    }

    void step(double h) {
        const auto [C, J] = constraints(x_);
        for (std::size_t i = 0; i < v_.size(); i += 3) {
            v_[i] += h * scene_.gravity.x;
            v_[i + 1] += h * scene_.gravity.y;
        }
        if (hold_ == Hold::Positions) {
            for (int pass = 0; pass < 30; ++pass) {
                const auto [ahead, atEnd] = constraints(moved(h));
                const auto isHeld = [](double error) { return std::abs(error) < 1e-15; };
                if (std::all_of(ahead.begin(), ahead.end(), isHeld)) break;
                correct(v_, J, atEnd, scaled(ahead, -1.0 / h));
            }
        } else {
            std::vector<double> wanted(C.size());
            for (std::size_t r = 0; r < C.size(); ++r) {
                wanted[r] = hold_ == Hold::Velocities ? -erp_ / h * C[r] : 0.0;
                for (std::size_t i = 0; i < v_.size(); ++i) wanted[r] -= J[r][i] * v_[i];
            }
            correct(v_, J, J, wanted);
        }
        x_ = moved(h);
        if (hold_ == Hold::Projection) project();
    }

    Trajectory run(double h, int steps) {
        Trajectory trajectory{states()};
        for (int i = 0; i < steps; ++i) {
            step(h);
            trajectory.push_back(states());
        }
        return trajectory;
    }

    std::vector<BodyState> states() const {
        std::vector<BodyState> all;
        for (std::size_t i = 0; i < x_.size(); i += 3)
            all.push_back({{x_[i], x_[i + 1], 0.0},
                           scenario::fromAxisAngle({0.0, 0.0, 1.0}, x_[i + 2]),
                           {v_[i], v_[i + 1], 0.0},
                           {0.0, 0.0, v_[i + 2]}});
        return all;
    }

  private:
    using Vector = std::vector<double>;
    using Rows = std::vector<Vector>;

    Vector moved(double h) const {
        Vector x = x_;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const bool isTurn = i % 3 == 2;
            x[i] += isTurn && firstOrder_ ? 2.0 * std::atan(0.5 * h * v_[i]) : h * v_[i];
        }
        return x;
    }
    static Vector scaled(Vector v, double factor) {
        for (double& x : v) x *= factor;
        return v;
    }

    /// Errors and rows of all joints, two each: a hinge's along x and y, a slider's across its axis and turn.
    std::pair<Vector, Rows> constraints(const Vector& x) const {
        Vector C;
        Rows J;
        for (const scenario::Joint& joint : scene_.joints) addJoint(joint, x, C, J);
        return {C, J};
    }
    void addJoint(const scenario::Joint& joint, const Vector& x, Vector& C, Rows& J) const {
        const auto b = 3 * static_cast<std::size_t>(joint.bodyB);
        const bool hasA = joint.bodyA != scenario::kNone;
        const std::size_t a = hasA ? 3 * static_cast<std::size_t>(joint.bodyA) : 0;
        const auto turned = [](const Vec3& v, double angle) {
            return Vec3{std::cos(angle) * v.x - std::sin(angle) * v.y,
                        std::sin(angle) * v.x + std::cos(angle) * v.y, 0.0};
        };
        const Vec3 rB = turned(joint.anchorB, x[b + 2]);
        const Vec3 rA = hasA ? turned(joint.anchorA, x[a + 2]) : joint.anchorA;
        const Vec3 gap{x[b] + rB.x - rA.x - (hasA ? x[a] : 0.0),
                       x[b + 1] + rB.y - rA.y - (hasA ? x[a + 1] : 0.0), 0.0};
        const auto along = [&](const Vec3& n) {
            Vector row(x.size());
            row[b] = n.x;
            row[b + 1] = n.y;
            row[b + 2] = rB.x * n.y - rB.y * n.x;
            if (hasA) {
                row[a] -= n.x;
                row[a + 1] -= n.y;
                row[a + 2] -= rA.x * n.y - rA.y * n.x;
            }
            J.push_back(row);
            C.push_back(dot(n, gap));
        };
        if (joint.type == scenario::JointType::Hinge) {
            along({1.0, 0.0, 0.0});
            along({0.0, 1.0, 0.0});
            return;
        }
        if (joint.type != scenario::JointType::Slider || hasA)
            throw std::invalid_argument("a hinge, or a slider of the world");
        along({-joint.axisA.y, joint.axisA.x, 0.0});
        Vector row(x.size());
        row[b + 2] = 1.0;
        J.push_back(row);
        C.push_back(x[b + 2] - start_[b + 2]);
    }

    /// y += M^-1 J^T l with K(J) y' = wanted, l by Gaussian elimination with pivots.
    void correct(Vector& y, const Rows& J, const Rows& K, const Vector& wanted) const {
        const std::size_t n = J.size();
        Rows A(n, Vector(n + 1));
        for (std::size_t r = 0; r < n; ++r) {
            for (std::size_t c = 0; c < n; ++c)
                for (std::size_t i = 0; i < y.size(); ++i) A[r][c] += K[r][i] * inverse_[i] * J[c][i];
            A[r][n] = wanted[r];
        }
        for (std::size_t p = 0; p < n; ++p) {
            std::size_t best = p;
            for (std::size_t r = p; r < n; ++r)
                if (std::abs(A[r][p]) > std::abs(A[best][p])) best = r;
            std::swap(A[p], A[best]);
            for (std::size_t r = 0; r < n; ++r) {
                if (r == p) continue;
                const double factor = A[r][p] / A[p][p];
                for (std::size_t c = p; c <= n; ++c) A[r][c] -= factor * A[p][c];
            }
        }
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t i = 0; i < y.size(); ++i) y[i] += inverse_[i] * J[r][i] * A[r][n] / A[r][r];
    }

    void project() {
        for (int pass = 0; pass < 50; ++pass) {
            double largestError = 0.0;
            for (const scenario::Joint& joint : scene_.joints) {
                Vector C;
                Rows J;
                addJoint(joint, x_, C, J);
                largestError = std::max(largestError, std::hypot(C[0], C[1]));
                correct(x_, J, J, scaled(C, -1.0));
            }
            if (largestError <= slop_) return;
        }
    }

    Scenario scene_;
    Hold hold_;
    double erp_, slop_;
    bool firstOrder_ = false;
    Vector x_, v_, inverse_, start_;
};

/// Kinetic energy and that of gravity, of a plane mechanism [J].
inline double energyOf(const Scenario& scene, const std::vector<BodyState>& states) {
    double energy = 0.0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const scenario::MassProperties& m = scene.bodies[i].massProperties;
        const double spin = states[i].angularVelocity.z;
        energy += 0.5 * m.mass * dot(states[i].velocity, states[i].velocity) +
                  0.5 * m.inertia(2, 2) * spin * spin - m.mass * dot(scene.gravity, states[i].position);
    }
    return energy;
}

/// The most that the energy differs from that of the start [J].
inline double energyDrift(const Scenario& scene, const Trajectory& trajectory) {
    double most = 0.0;
    for (const auto& states : trajectory)
        most = std::max(most, std::abs(energyOf(scene, states) - energyOf(scene, trajectory.front())));
    return most;
}

/// Largest distance of bodies from their places in another run [m]; the other one has `every` steps for one.
inline double farthest(const Trajectory& run, const Trajectory& other, std::size_t every = 1) {
    double most = 0.0;
    for (std::size_t i = 0; i < run.size(); ++i)
        for (std::size_t b = 0; b < run[i].size(); ++b)
            most = std::max(most, norm(run[i][b].position - other[i * every][b].position));
    return most;
}

inline constexpr const char* kMechanisms[] = {
    "scenarios/library/2d/physical_pendulum_2d.json", "scenarios/library/2d/four_bar_linkage_2d.json",
    "scenarios/library/2d/cart_pendulum_2d.json",     "scenarios/library/3d/cart_pendulum.json",
    "scenarios/library/2d/double_pendulum_2d.json",   "scenarios/library/3d/slider_crank.json"};

}  // namespace rigor::plain
