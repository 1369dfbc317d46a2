// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See contact_forces.hpp. Rows of the linear program: forces over the load of the body, torques over its load
// times its size.
#include "validation/references/statics/contact_forces.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using numerics::LinearProgram;
using numerics::Real;
using numerics::Real3;

constexpr int kSides = 8;           // rays of a cone in 3D at first
constexpr int kRounds = 60;         // rounds in which rays are added
constexpr Real kInside = 1e-17L;    // margin of rays in 3D inside the round cone, for rounding
constexpr Real kViolated = 1e-13L;  // violation, relative to the velocities, of rays that are added
// difference, relative to all loads, at which the least and the greatest force agree
constexpr double kAgree = 1e-9;

std::size_t rowsOf(const LoadedBodies& problem) {
    return problem.bodies.size() * (problem.dimension == 2 ? 3 : 6);
}

/// Calls put(row, value) for a force and a torque on a body.
template <class Put>
void write(const LoadedBodies& problem, int body, Real3 force, Real3 torque, Put put) {
    const auto& b = problem.bodies[body];
    const Real f = 1 / static_cast<Real>(b.load), t = f / static_cast<Real>(b.size);
    if (problem.dimension == 2) {
        const std::size_t row = 3 * static_cast<std::size_t>(body);
        put(row, f * force.x);
        put(row + 1, f * force.y);
        put(row + 2, t * torque.z);
    } else {
        const std::size_t row = 6 * static_cast<std::size_t>(body);
        put(row, f * force.x);
        put(row + 1, f * force.y);
        put(row + 2, f * force.z);
        put(row + 3, t * torque.x);
        put(row + 4, t * torque.y);
        put(row + 5, t * torque.z);
    }
}

std::vector<Real> rightSide(const LoadedBodies& problem) {
    std::vector<Real> right(rowsOf(problem), 0);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
        write(problem, static_cast<int>(i), numerics::real3(-problem.bodies[i].force),
              numerics::real3(-problem.bodies[i].torque), [&](std::size_t row, Real v) { right[row] = v; });
    return right;
}

struct Tangents {
    Real3 n, t, s;
};
Tangents tangentsOf(Vec3 normal) {
    const Real3 n = numerics::real3(normal), guess = numerics::real3(perpendicular(normal));
    const Real3 across = guess - (dot(guess, n) / dot(n, n)) * n;
    const Real3 t = (norm(n) / norm(across)) * across;
    return {n, t, (1 / norm(n)) * cross(n, t)};
}

}  // namespace

ContactForces::ContactForces(const LoadedBodies& problem) : problem_(problem), program_(rightSide(problem)) {
    for (const auto& body : problem.bodies) loads_ += body.load;
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
        const auto& contact = problem.contacts[c];
        const auto [n, t, s] = tangentsOf(contact.normal);
        const Real mu = contact.friction;
        if (mu == 0) {
            addRay(c, n);
        } else if (problem.dimension == 2) {
            const Real3 across{-n.y, n.x, 0};
            addRay(c, n + mu * across);
            addRay(c, n - mu * across);
        } else {
            for (int i = 0; i < kSides; ++i) {
                const Real a = 2 * numerics::kPi * i / kSides, reach = mu * (1 - kInside);
                addRay(c, n + (reach * std::cos(a)) * t + (reach * std::sin(a)) * s);
            }
        }
    }
    decide();
}

void ContactForces::addRay(std::size_t c, Real3 direction) {
    const auto& contact = problem_.contacts[c];
    LinearProgram::Column column;
    Real largest = 0;
    for (const int body : {contact.a, contact.b}) {
        if (body < 0) continue;
        const Real3 force = body == contact.b ? direction : Real(-1) * direction;
        const Real3 arm = numerics::real3(contact.point) - numerics::real3(problem_.bodies[body].center);
        write(problem_, body, force, cross(arm, force), [&](std::size_t row, Real v) {
            if (v != 0) column.push_back({row, v});
            largest = std::max(largest, std::abs(v));
        });
    }
    for (auto& entry : column) entry.value /= largest;
    program_.addColumn(std::move(column));
    rays_.push_back({c, direction, 1 / largest});
}

/// The multipliers with their sign turned, as velocities.
VirtualMotion ContactForces::motion() const {
    const std::vector<Real> y = program_.multipliers();
    VirtualMotion motion;
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i) {
        const auto& body = problem_.bodies[i];
        const Real f = -1 / static_cast<Real>(body.load), t = f / static_cast<Real>(body.size);
        if (problem_.dimension == 2) {
            motion.velocity.push_back({f * y[3 * i], f * y[3 * i + 1], 0});
            motion.spin.push_back({0, 0, t * y[3 * i + 2]});
        } else {
            const std::size_t r = 6 * i;
            motion.velocity.push_back({f * y[r], f * y[r + 1], f * y[r + 2]});
            motion.spin.push_back({t * y[r + 3], t * y[r + 4], t * y[r + 5]});
        }
    }
    return motion;
}

std::vector<Real3> ContactForces::forces() const {
    std::vector<Real3> result(problem_.contacts.size());
    const std::vector<Real> x = program_.point();
    for (std::size_t j = 0; j < x.size(); ++j) {
        Real3& force = result[rays_[j].contact];
        force = force + (x[j] * rays_[j].scale) * rays_[j].direction;
    }
    return result;
}

bool ContactForces::addViolated(const VirtualMotion& motion, const std::vector<int>& cost) {
    if (problem_.dimension == 2) return false;
    bool added = false;
    for (std::size_t c = 0; c < problem_.contacts.size(); ++c) {
        const auto& contact = problem_.contacts[c];
        if (contact.friction == 0.0) continue;
        Real3 u;
        Real size = 0;
        for (const int body : {contact.a, contact.b}) {
            if (body < 0) continue;
            const auto i = static_cast<std::size_t>(body);
            const Real3 arm = numerics::real3(contact.point) - numerics::real3(problem_.bodies[i].center);
            const Real3 v = motion.velocity[i] + cross(motion.spin[i], arm);
            u = body == contact.b ? u + v : u - v;
            size += norm(motion.velocity[i]) + norm(motion.spin[i]) * norm(arm);
        }
        const Real3 n = tangentsOf(contact.normal).n;
        const Real3 across = u - (dot(u, n) / dot(n, n)) * n;
        const Real slip = norm(across), mu = contact.friction;
        if (dot(u, n) + (cost.empty() ? 0 : cost[c]) - mu * slip >= -kViolated * size) continue;
        if (slip == 0) continue;
        addRay(c, n - (mu * (1 - kInside) * norm(n) / slip) * across);
        added = true;
    }
    return added;
}

void ContactForces::decide() {
    for (int round = 0; round < kRounds; ++round) {
        if (program_.reduceViolation() == LinearProgram::Status::Stalled) return;
        if (balance(problem_, forces())) {
            verdict_ = Verdict::Balance;
            return;
        }
        const VirtualMotion found = motion();
        if (gainsEnergy(problem_, found)) {
            verdict_ = Verdict::Move;
            return;
        }
        if (!addViolated(found, {})) return;
    }
}

void ContactForces::noteForces() {
    std::map<int, double> sums;
    const std::vector<Real3> all = forces();
    for (std::size_t c = 0; c < all.size(); ++c) {
        const auto& contact = problem_.contacts[c];
        sums[contact.pair] += static_cast<double>(dot(all[c], numerics::real3(contact.normal)));
    }
    for (const auto& [pair, sum] : sums) {
        const auto [place, isNew] = range_.try_emplace(pair, sum, sum);
        if (isNew) continue;
        place->second.first = std::min(place->second.first, sum);
        place->second.second = std::max(place->second.second, sum);
    }
}

bool ContactForces::agreed(int pair) const {
    const auto& [low, high] = range_.at(pair);
    return high - low <= kAgree * loads_;
}

std::optional<double> ContactForces::least(const std::vector<int>& cost) {
    for (int round = 0; round < kRounds; ++round) {
        std::vector<Real> prices;
        for (const Ray& ray : rays_)
            prices.push_back(static_cast<Real>(cost[ray.contact]) * ray.scale / static_cast<Real>(loads_));
        if (program_.minimise(prices) != LinearProgram::Status::Optimal) return std::nullopt;
        noteForces();
        VirtualMotion found = motion();
        for (auto* part : {&found.velocity, &found.spin})
            for (Real3& v : *part) v = static_cast<Real>(loads_) * v;
        Real value = 0;
        const std::vector<Real> x = program_.point();
        for (std::size_t j = 0; j < x.size(); ++j) value += x[j] * prices[j] * static_cast<Real>(loads_);
        const double bound = leastSum(problem_, cost, found);
        if (bound >= static_cast<double>(value) - kAgree * loads_) return bound;
        if (!addViolated(found, cost)) return std::nullopt;
    }
    return std::nullopt;
}

std::map<int, double> ContactForces::determinate() {
    std::map<int, double> result;
    noteForces();
    const auto seen = range_;
    for (const auto& [pair, unused] : seen) {
        if (!agreed(pair)) continue;
        std::vector<int> cost;
        for (const auto& contact : problem_.contacts) cost.push_back(contact.pair == pair ? 1 : 0);
        const auto low = least(cost);
        if (!low || !agreed(pair)) continue;
        for (int& c : cost) c = -c;
        const auto negative = least(cost);
        if (!negative || !agreed(pair)) continue;
        if (-*negative - *low <= 3 * kAgree * loads_) result[pair] = 0.5 * (*low - *negative);
    }
    return result;
}

}  // namespace rigor::validation
