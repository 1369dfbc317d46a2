// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lagrange's equations of n arms with c_ij the way along arm j to the centre of mass of arm i (its length for
// j < i, its centre for j = i) and C_jk = sum_i m_i c_ij c_ik:
//   sum_k (C_jk cos(th_j - th_k) + I_j delta_jk) th_k'' =
//       - sum_k C_jk sin(th_j - th_k) th_k'^2 + g sum_i m_i c_ij sin th_j - k_j (th_j' - th_(j-1)')
//       + k_(j+1) (th_(j+1)' - th_j'),
// by the Runge-Kutta rule of order four with steps of half a sample. Source: Goldstein, Poole, Safko,
// Classical Mechanics, 2002, chapter 1; Kaheman et al., arXiv 2205.06231 (2022).
#include "validation/import/arm_model.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::validation {
namespace {

using Values = std::vector<double>;

/// x of m x = f, m symmetric and positive definite, by rows; m and f are used up.
Values solved(Values m, Values f) {
    const std::size_t n = f.size();
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = k + 1; i < n; ++i) {
            const double share = m[i * n + k] / m[k * n + k];
            for (std::size_t j = k; j < n; ++j) m[i * n + j] -= share * m[k * n + j];
            f[i] -= share * f[k];
        }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) f[i] -= m[i * n + j] * f[j];
        f[i] /= m[i * n + i];
    }
    return f;
}

Values accelerations(const ArmModel& model, const ArmState& s) {
    const std::size_t n = model.arms();
    const auto way = [&](std::size_t i, std::size_t j) {
        return j < i ? model.length[j] : (j == i ? model.com[i] : 0.0);
    };
    Values matrix(n * n, 0.0), load(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = j; i < n; ++i)
            load[j] += model.gravity * model.mass[i] * way(i, j) * std::sin(s.angles[j]);
        for (std::size_t k = 0; k < n; ++k) {
            double coupling = 0.0;
            for (std::size_t i = std::max(j, k); i < n; ++i)
                coupling += model.mass[i] * way(i, j) * way(i, k);
            const double between = s.angles[j] - s.angles[k];
            matrix[j * n + k] = coupling * std::cos(between);
            load[j] -= coupling * std::sin(between) * s.rates[k] * s.rates[k];
        }
        matrix[j * n + j] += model.inertia[j];
        const double torque = model.braking[j] * (s.rates[j] - (j > 0 ? s.rates[j - 1] : 0.0));
        load[j] -= torque;
        if (j > 0) load[j - 1] += torque;
    }
    return solved(std::move(matrix), std::move(load));
}

ArmState moved(const ArmState& s, const Values& rates, const Values& accelerations, double h) {
    ArmState next = s;
    for (std::size_t i = 0; i < s.angles.size(); ++i) {
        next.angles[i] += h * rates[i];
        next.rates[i] += h * accelerations[i];
    }
    return next;
}

ArmState stepped(const ArmModel& model, const ArmState& s, double h) {
    const Values a1 = accelerations(model, s);
    const ArmState s2 = moved(s, s.rates, a1, h / 2);
    const Values a2 = accelerations(model, s2);
    const ArmState s3 = moved(s, s2.rates, a2, h / 2);
    const Values a3 = accelerations(model, s3);
    const ArmState s4 = moved(s, s3.rates, a3, h);
    const Values a4 = accelerations(model, s4);
    ArmState next = s;
    for (std::size_t i = 0; i < s.angles.size(); ++i) {
        next.angles[i] += h / 6 * (s.rates[i] + 2 * s2.rates[i] + 2 * s3.rates[i] + s4.rates[i]);
        next.rates[i] += h / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]);
    }
    return next;
}

}  // namespace

Values predictAngles(const ArmModel& model, const ArmState& start, double interval, std::size_t samples) {
    Values angles;
    ArmState s = start;
    for (std::size_t sample = 0; sample < samples; ++sample) {
        angles.insert(angles.end(), s.angles.begin(), s.angles.end());
        s = stepped(model, stepped(model, s, interval / 2), interval / 2);
    }
    return angles;
}

ArmState fitStart(const ArmModel& model, const ArmState& guess, const Values& recorded, double interval,
                  std::size_t samples) {
    constexpr int kIterations = 8;
    constexpr double kNudge = 1e-6;
    const std::size_t n = model.arms(), unknowns = 2 * n;
    const auto part = [n](ArmState& s, std::size_t k) -> double& {
        return k < n ? s.angles[k] : s.rates[k - n];
    };
    ArmState best = guess;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        const Values now = predictAngles(model, best, interval, samples);
        std::vector<Values> slopes;
        for (std::size_t k = 0; k < unknowns; ++k) {
            ArmState beside = best;
            part(beside, k) += kNudge;
            Values slope = predictAngles(model, beside, interval, samples);
            for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - now[i]) / kNudge;
            slopes.push_back(std::move(slope));
        }
        Values normal(unknowns * unknowns, 0.0), right(unknowns, 0.0);
        for (std::size_t k = 0; k < unknowns; ++k)
            for (std::size_t i = 0; i < now.size(); ++i) {
                right[k] += slopes[k][i] * (recorded[i] - now[i]);
                for (std::size_t l = 0; l < unknowns; ++l)
                    normal[k * unknowns + l] += slopes[k][i] * slopes[l][i];
            }
        const Values change = solved(std::move(normal), std::move(right));
        for (std::size_t k = 0; k < unknowns; ++k) part(best, k) += change[k];
    }
    return best;
}

double worstRms(const Values& one, const Values& other, std::size_t arms) {
    Values sums(arms, 0.0);
    for (std::size_t i = 0; i < one.size(); ++i) sums[i % arms] += (one[i] - other[i]) * (one[i] - other[i]);
    const double samples = static_cast<double>(one.size()) / static_cast<double>(arms);
    return std::sqrt(*std::max_element(sums.begin(), sums.end()) / samples);
}

}  // namespace rigor::validation
