// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See force_balance.hpp.
#include "validation/references/statics/force_balance.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>

namespace rigor::validation {
namespace {

using numerics::Real;
using numerics::Real3;
using Rational = boost::multiprecision::cpp_rational;

const Rational kBalanced(1, 100000000000);  // tolerance as a fraction of a body's load
const Rational kUnbalanced(1, 1000000000);  // threshold as a fraction of a body's load
const Rational kMostForce(1000000);         // largest force relative to all loads

struct RationalVector {
    Rational x, y, z;
};
RationalVector exact(Vec3 v) {
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
RationalVector exact(Real3 v) {
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
RationalVector operator+(const RationalVector& a, const RationalVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
RationalVector operator-(const RationalVector& a, const RationalVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Rational dot(const RationalVector& a, const RationalVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
RationalVector cross(const RationalVector& a, const RationalVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Rational sumOf(const RationalVector& v) {
    return abs(v.x) + abs(v.y) + abs(v.z);
}
bool within(const RationalVector& v, const Rational& most) {
    return abs(v.x) <= most && abs(v.y) <= most && abs(v.z) <= most;
}

Rational allLoads(const LoadedBodies& problem) {
    Rational sum = 0;
    for (const auto& body : problem.bodies) sum += Rational(body.load);
    return sum;
}

/// |v_t| |n| <= most, with v_t the part of v across n.
bool acrossWithin(const RationalVector& v, const RationalVector& n, const Rational& most) {
    const Rational along = dot(v, n);
    return most >= 0 && dot(v, v) * dot(n, n) - along * along <= most * most;
}

/// Velocity of the body at the point; zero for fixed bodies.
RationalVector velocityAt(const LoadedBodies& problem, const VirtualMotion& motion, int body,
                          const RationalVector& point) {
    if (body < 0) return {};
    const auto i = static_cast<std::size_t>(body);
    return exact(motion.velocity[i]) + cross(exact(motion.spin[i]), point - exact(problem.bodies[i].center));
}

/// Least eta >= 0 found with f.u + cost n.f >= -eta n.f for every force f of the cone of the contact.
Rational shortfall(const LoadedBodies& problem, const LoadedBodies::Contact& contact, int cost,
                   const VirtualMotion& motion) {
    const RationalVector point = exact(contact.point), n = exact(contact.normal);
    const RationalVector u =
        velocityAt(problem, motion, contact.b, point) - velocityAt(problem, motion, contact.a, point);
    const Rational opening = dot(u, n) + cost * dot(n, n);
    if (problem.dimension == 2) {
        // The two rays of the cone: n + mu t and n - mu t.
        const Rational slip = abs(u.y * n.x - u.x * n.y) * Rational(contact.friction);
        return std::max(Rational(0), Rational((slip - opening) / dot(n, n)));
    }
    if (contact.friction == 0.0) return std::max(Rational(0), Rational(-opening / dot(n, n)));
    // opening + eta >= friction |u_t|: an eta from the rounded square root, raised until it fits.
    const Rational mu(contact.friction);
    const auto fits = [&](const Rational& eta) {
        return mu == 0 ? opening + eta >= 0 : acrossWithin(u, n, Rational((opening + eta) / mu));
    };
    if (fits(0)) return 0;
    const RationalVector across = cross(n, u);
    const Real slip = std::sqrt(static_cast<Real>(dot(across, across)));
    Rational eta = std::max(Rational(0), Rational(mu * Rational(slip) - opening));
    Rational more = (abs(opening) + eta) / Rational(Real(1e18L)) + Rational(Real(1e-300L));
    for (; !fits(eta); more *= 2) eta += more;
    return eta / dot(n, n);
}

/// Power of the loads less the most that contact forces within the cones can take.
Rational gain(const LoadedBodies& problem, const std::vector<int>& cost, const VirtualMotion& motion) {
    Rational power = 0, worst = 0;
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
        const auto& body = problem.bodies[i];
        power += dot(exact(body.force), exact(motion.velocity[i])) +
                 dot(exact(body.torque), exact(motion.spin[i]));
    }
    for (std::size_t c = 0; c < problem.contacts.size(); ++c)
        worst = std::max(worst, shortfall(problem, problem.contacts[c], cost.empty() ? 0 : cost[c], motion));
    return power - worst * kMostForce * allLoads(problem);
}

}  // namespace

bool balance(const LoadedBodies& problem, const std::vector<Real3>& forces) {
    std::vector<RationalVector> force, torque;
    for (const auto& body : problem.bodies) {
        force.push_back(exact(body.force));
        torque.push_back(exact(body.torque));
    }
    Rational together = 0;
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
        const auto& contact = problem.contacts[c];
        const RationalVector f = exact(forces[c]), n = exact(contact.normal), point = exact(contact.point);
        const Rational normal = dot(f, n);
        if (normal < 0) return false;
        together += normal;
        double least = 1e300;
        for (const int body : {contact.a, contact.b}) {
            if (body < 0) continue;
            const auto i = static_cast<std::size_t>(body);
            const RationalVector onIt = body == contact.b ? f : RationalVector{} - f;
            force[i] = force[i] + onIt;
            torque[i] = torque[i] + cross(point - exact(problem.bodies[i].center), onIt);
            least = std::min(least, problem.bodies[i].load);
        }
        if (!acrossWithin(f, n, Rational(contact.friction) * normal + kBalanced * Rational(least)))
            return false;
    }
    if (together > kMostForce * allLoads(problem)) return false;
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
        const auto& body = problem.bodies[i];
        const Rational most = kBalanced * Rational(body.load);
        if (!within(force[i], most) || !within(torque[i], most * Rational(body.size))) return false;
    }
    return true;
}

bool gainsEnergy(const LoadedBodies& problem, const VirtualMotion& motion) {
    Rational taken = 0;
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
        const auto& body = problem.bodies[i];
        taken += kUnbalanced * Rational(body.load) *
                 (sumOf(exact(motion.velocity[i])) + Rational(body.size) * sumOf(exact(motion.spin[i])));
    }
    return gain(problem, {}, motion) > taken;
}

double leastSum(const LoadedBodies& problem, const std::vector<int>& cost, const VirtualMotion& motion) {
    return static_cast<double>(gain(problem, cost, motion));
}

}  // namespace rigor::validation
