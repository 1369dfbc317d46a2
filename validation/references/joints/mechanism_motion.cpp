// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See mechanism_motion.hpp.
#include "validation/references/joints/mechanism_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigor::validation {

using namespace numerics;

namespace {

constexpr Real3 kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Solves m x = f for a symmetric positive definite m, whose lower half is used; f becomes x. Zeros left of
/// the first entry of a row stay zeros and are passed over: joints couple neighbours only.
void solveSymmetric(std::vector<std::vector<Real>>& m, std::vector<Real>& f) {
    const std::size_t n = f.size();
    std::vector<std::size_t> first(n);
    for (std::size_t i = 0; i < n; ++i) {
        while (first[i] < i && m[i][first[i]] == 0) ++first[i];
        for (std::size_t j = first[i]; j < i; ++j)
            for (std::size_t k = std::max(first[i], first[j]); k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
        for (std::size_t j = first[i]; j < i; ++j) {
            const Real scaled = m[i][j] / m[j][j];
            m[i][i] -= scaled * m[i][j];
            m[i][j] = scaled;
            f[i] -= scaled * f[j];
        }
        if (!(m[i][i] > 0)) {
            // A trial step far off, or a singular position: the integrator tries a shorter step.
            f.assign(n, std::numeric_limits<Real>::quiet_NaN());
            return;
        }
    }
    for (std::size_t i = 0; i < n; ++i) f[i] /= m[i][i];
    for (std::size_t i = n; i-- > 0;)
        for (std::size_t j = first[i]; j < i; ++j) f[j] -= m[i][j] * f[i];
}

/// The factor that makes the value of an equation a length.
Real lengthOf(const MechanismMotion::Equation& equation, Real size) {
    return equation.kind == MechanismMotion::Equation::Kind::Direction ? size : 1;
}

}  // namespace

std::vector<MechanismMotion::Pose> MechanismMotion::posesOf(const OdeState& y) const {
    std::vector<Pose> poses(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Real* s = &y[kStride * i];
        Pose& pose = poses[i];
        pose.turn = rotationOf(s[3], s[4], s[5], s[6]);
        pose.place = {s[0], s[1], s[2]};
        pose.velocity = {s[7], s[8], s[9]};
        pose.spin = pose.turn * Real3{s[10], s[11], s[12]};
        if (members[i].driven) continue;
        // R I^-1 R^T, row by row: both are symmetric.
        Real33 half{};
        for (std::size_t k = 0; k < 3; ++k) half[k] = inverses_[i] * transposed(pose.turn, kAxes[k]);
        for (std::size_t k = 0; k < 3; ++k) pose.inverse[k] = pose.turn * half[k];
    }
    return poses;
}

MechanismMotion::Spot MechanismMotion::spotOf(const std::vector<Pose>& poses, const Fixed& point) {
    if (point.body < 0) return {{}, point.local, {}, {}};
    const Pose& p = poses[point.body];
    const Real3 arm = p.turn * point.local, whirl = cross(p.spin, arm);
    return {arm, p.place + arm, p.velocity + whirl, cross(p.spin, whirl)};
}

Real3 MechanismMotion::turned(const std::vector<Pose>& poses, int body, Real3 local) {
    return body < 0 ? local : poses[body].turn * local;
}

MechanismMotion::Row MechanismMotion::rowOf(const std::vector<Pose>& poses, const Equation& e) const {
    Row row;
    row.a = e.a.body;
    row.b = e.b.body;
    const auto spinOf = [&](int body) { return body < 0 ? Real3{} : poses[body].spin; };
    const Real3 wa = spinOf(e.a.body), wb = spinOf(e.b.body);
    if (e.kind == Equation::Kind::Direction) {
        const Real3 t = turned(poses, e.a.body, e.axis), n = turned(poses, e.b.body, e.b.local);
        const Real3 across = cross(n, t);
        row.value = dot(t, n);
        row.rate = dot(across, wb - wa);
        row.bend = dot(cross(cross(wb, n), t) + cross(n, cross(wa, t)), wb - wa);
        row.wb = across;
        row.wa = -1 * across;
        return row;
    }
    const Spot a = spotOf(poses, e.a), b = spotOf(poses, e.b);
    const Real3 d = b.place - a.place, v = b.velocity - a.velocity, bend = b.bend - a.bend;
    Real3 along = e.axis;
    if (e.kind == Equation::Kind::Distance) {
        const Real l = norm(d);
        along = (1 / l) * d;
        row.value = l - e.length;
        row.rate = dot(along, v);
        row.bend = dot(along, bend) + (dot(v, v) - row.rate * row.rate) / l;
    } else if (e.kind == Equation::Kind::Offset) {
        along = turned(poses, e.a.body, e.axis);
        const Real3 swing = cross(wa, along);
        row.value = dot(along, d);
        row.rate = dot(swing, d) + dot(along, v);
        row.bend = dot(cross(wa, swing), d) + 2 * dot(swing, v) + dot(along, bend);
    } else {
        row.value = dot(along, d);
        row.rate = dot(along, v);
        row.bend = dot(along, bend);
    }
    row.vb = along;
    row.wb = cross(b.arm, along);
    row.va = -1 * along;
    row.wa = -1 * cross(a.arm, along);
    // The direction itself turns with a.
    if (e.kind == Equation::Kind::Offset) row.wa = row.wa + cross(along, d);
    return row;
}

void MechanismMotion::push(Real t, const std::vector<Pose>& poses, std::vector<Real3>& force,
                           std::vector<Real3>& torque) const {
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Real3 w = transposed(poses[i].turn, poses[i].spin);
        force[i] = members[i].mass * members[i].gravity;
        torque[i] = -1 * (poses[i].turn * cross(w, members[i].inertia * w));
    }
    for (const auto& load : loads) {
        if (t < load.start || t >= load.end) continue;
        const auto i = static_cast<std::size_t>(load.body);
        force[i] = force[i] + load.force;
        torque[i] = torque[i] + load.torque;
    }
    for (const auto& spring : springs) {
        const Spot a = spotOf(poses, spring.a), b = spotOf(poses, spring.b);
        const Real3 d = b.place - a.place;
        const Real l = norm(d);
        const Real3 n = (1 / l) * d;
        const Real pull =
            spring.stiffness * (l - spring.restLength) + spring.damping * dot(n, b.velocity - a.velocity);
        const auto add = [&](const Fixed& end, const Spot& spot, Real sign) {
            if (end.body < 0) return;
            const auto i = static_cast<std::size_t>(end.body);
            force[i] = force[i] + (sign * pull) * n;
            torque[i] = torque[i] + cross(spot.arm, (sign * pull) * n);
        };
        add(spring.a, a, 1);
        add(spring.b, b, -1);
    }
}

std::vector<std::vector<Real>> MechanismMotion::gram(const std::vector<Pose>& poses,
                                                     const std::vector<Row>& rows,
                                                     std::vector<Row>& inverse) const {
    const std::size_t n = rows.size();
    inverse = rows;
    for (Row& row : inverse) {
        const auto scale = [&](int body, Real3& v, Real3& w) {
            const auto i = static_cast<std::size_t>(body);
            if (body < 0 || members[i].driven) {
                v = w = {};
                return;
            }
            v = (1 / members[i].mass) * v;
            w = poses[i].inverse * w;
        };
        scale(row.a, row.va, row.wa);
        scale(row.b, row.vb, row.wb);
    }
    std::vector<std::vector<Real>> m(n, std::vector<Real>(n, 0));
    const auto share = [](int x, const Real3& v, const Real3& w, int y, const Real3& pv, const Real3& pw) {
        return x >= 0 && x == y ? dot(v, pv) + dot(w, pw) : Real(0);
    };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const Row &r = rows[i], &q = inverse[j];
            // Most rows of a long loop have no body in common.
            if (r.a != q.a && r.a != q.b && r.b != q.a && r.b != q.b) continue;
            m[i][j] = m[j][i] =
                share(r.a, r.va, r.wa, q.a, q.va, q.wa) + share(r.a, r.va, r.wa, q.b, q.vb, q.wb) +
                share(r.b, r.vb, r.wb, q.a, q.va, q.wa) + share(r.b, r.vb, r.wb, q.b, q.vb, q.wb);
        }
    return m;
}

void MechanismMotion::prepare(const OdeState& y, Real rate) {
    rate_ = rate;
    inverses_.assign(members.size(), {});
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) inverses_[i][k] = solve(members[i].inertia, kAxes[k]);
    const auto poses = posesOf(y);
    std::vector<Row> rows, inverse;
    for (const auto& e : equations) rows.push_back(rowOf(poses, e));
    auto m = gram(poses, rows, inverse);
    const std::size_t n = rows.size();
    // Scaled to one on the diagonal; then elimination takes the equation with the largest part of its own.
    std::vector<Real> unit(n);
    for (std::size_t i = 0; i < n; ++i) unit[i] = m[i][i] > 0 ? 1 / std::sqrt(m[i][i]) : 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) m[i][j] *= unit[i] * unit[j];
    chosen_.clear();
    std::vector<bool> used(n, false);
    for (;;) {
        std::size_t best = n;
        for (std::size_t i = 0; i < n; ++i)
            if (!used[i] && m[i][i] > 1e-9L && (best == n || m[i][i] > m[best][best])) best = i;
        if (best == n) break;
        used[best] = true;
        chosen_.push_back(best);
        for (std::size_t i = 0; i < n; ++i) {
            if (used[i]) continue;
            const Real factor = m[i][best] / m[best][best];
            for (std::size_t j = 0; j < n; ++j) m[i][j] -= factor * m[best][j];
        }
    }
    std::sort(chosen_.begin(), chosen_.end());
}

void MechanismMotion::derivative(Real t, const OdeState& y, OdeState& d) const {
    const auto poses = posesOf(y);
    std::vector<Real3> force(members.size()), torque(members.size());
    push(t, poses, force, torque);
    std::vector<Real3> a(members.size()), spin(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members[i].driven) continue;
        a[i] = (1 / members[i].mass) * force[i];
        spin[i] = poses[i].inverse * torque[i];
    }
    std::vector<Row> rows, inverse;
    std::vector<Real> lambda;
    for (const std::size_t k : chosen_) {
        rows.push_back(rowOf(poses, equations[k]));
        const Row& r = rows.back();
        Real missing = -r.bend - 2 * rate_ * r.rate - rate_ * rate_ * r.value;
        if (r.a >= 0) {
            const auto i = static_cast<std::size_t>(r.a);
            missing -= dot(r.va, a[i]) + dot(r.wa, spin[i]);
        }
        if (r.b >= 0) {
            const auto i = static_cast<std::size_t>(r.b);
            missing -= dot(r.vb, a[i]) + dot(r.wb, spin[i]);
        }
        lambda.push_back(missing);
    }
    if (!rows.empty()) {
        auto m = gram(poses, rows, inverse);
        solveSymmetric(m, lambda);
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& q = inverse[k];
        const auto add = [&](int body, Real3 v, Real3 w) {
            if (body < 0) return;
            const auto i = static_cast<std::size_t>(body);
            a[i] = a[i] + lambda[k] * v;
            spin[i] = spin[i] + lambda[k] * w;
        };
        add(q.a, q.va, q.wa);
        add(q.b, q.vb, q.wb);
    }
    d.assign(y.size(), 0);
    for (std::size_t i = 0; i < members.size(); ++i) {
        const std::size_t at = kStride * i;
        const Real3 v = poses[i].velocity, w = transposed(poses[i].turn, poses[i].spin);
        // R^T w of a changing R: d(R^T w)/dt = R^T w' as w x w = 0.
        const Real3 rate = transposed(poses[i].turn, spin[i]);
        d[at] = v.x;
        d[at + 1] = v.y;
        d[at + 2] = v.z;
        quaternionRate(y, at + 3, w, d);
        d[at + 7] = a[i].x;
        d[at + 8] = a[i].y;
        d[at + 9] = a[i].z;
        d[at + 10] = rate.x;
        d[at + 11] = rate.y;
        d[at + 12] = rate.z;
    }
}

Real MechanismMotion::gap(const OdeState& y, Real size) const {
    const auto poses = posesOf(y);
    Real worst = 0;
    for (const auto& e : equations)
        worst = std::max(worst, std::abs(rowOf(poses, e).value) * lengthOf(e, size));
    return worst;
}

Real MechanismMotion::gapRate(const OdeState& y, Real size) const {
    const auto poses = posesOf(y);
    Real worst = 0;
    for (const auto& e : equations)
        worst = std::max(worst, std::abs(rowOf(poses, e).rate) * lengthOf(e, size));
    return worst;
}

std::size_t MechanismMotion::operations() const {
    // Fitted to the times of loops of 3 to 7 bodies with 17 to 29 equations; the last part, the elimination of
    // a matrix without zeros, is the most that it can take.
    const std::size_t n = chosen_.size();
    return 600 * members.size() + 450 * n + 7 * n * n + n * n * n / 6;
}

std::size_t MechanismMotion::freedom() const {
    std::size_t sum = 0;
    for (const auto& m : members) sum += m.driven ? 0 : (planar ? 3 : 6);
    return sum - chosen_.size();
}

}  // namespace rigor::validation
