// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One extrapolation step: T(j,1) from n_j = 2 j substeps of the modified midpoint rule, then
// T(j,k+1) = T(j,k) + (T(j,k) - T(j-1,k)) / ((n_j/n_(j-k))^2 - 1); the difference of the last two diagonal
// entries is the error estimate.
#include "validation/references/numerics/ode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rigor::validation::numerics {
namespace {

constexpr int kColumns = 8;  // order 16
constexpr int kMaxSteps = 20000;
constexpr Real kInfinite = std::numeric_limits<Real>::infinity();
// An oscillation takes a panel or two: some thousand of them, and a few seconds of computing.
constexpr std::size_t kMostPanels = 4000;
constexpr int kGrowAfter = 4;     // panels of one length, before a longer one is tried
constexpr int kPanelDegree = 15;  // 16 nodes
// A panel that 16 nodes resolve needs one or two steps of order 16 between two nodes. A trial panel that
// needs many is far too long, and is given up before the rest of it is integrated.
constexpr int kMostStepsToNode = 24;

void midpointRule(const OdeRhs& f, Real t, const OdeState& y, const OdeState& dydt, Real step, int n,
                  OdeState& result, OdeState& previous, OdeState& slope) {
    const Real h = step / n;
    const std::size_t size = y.size();
    previous = y;
    result.resize(size);
    slope.resize(size);
    for (std::size_t i = 0; i < size; ++i) result[i] = y[i] + h * dydt[i];
    for (int k = 1; k < n; ++k) {
        f(t + k * h, result, slope);
        for (std::size_t i = 0; i < size; ++i) {
            const Real next = previous[i] + 2 * h * slope[i];
            previous[i] = result[i];
            result[i] = next;
        }
    }
    f(t + step, result, slope);
    for (std::size_t i = 0; i < size; ++i) result[i] = (result[i] + previous[i] + h * slope[i]) / 2;
}

Real scaleOf(const OdeState& scale, std::size_t i) {
    return scale.empty() ? Real(1) : scale[i];
}

/// The evaluations that the limits allow are used up.
class EvaluationsSpent : public std::runtime_error {
  public:
    EvaluationsSpent() : std::runtime_error("the motion takes too many evaluations of its equations") {}
};

/// f for at most `left` evaluations, which it counts down.
OdeRhs counted(const OdeRhs& f, std::size_t& left) {
    return [&f, &left](Real t, const OdeState& y, OdeState& dydt) {
        if (left == 0) throw EvaluationsSpent();
        --left;
        f(t, y, dydt);
    };
}

struct Step {
    OdeState y;
    Real error = 0;  ///< relative to the tolerance
    int column = 0;  ///< column in which it converged
};

Step extrapolate(const OdeRhs& f, Real t, const OdeState& y, const OdeState& dydt, Real step, Real tolerance,
                 const OdeState& scale) {
    std::array<std::vector<OdeState>, kColumns> table;
    OdeState previous, slope;
    Step result;
    for (int j = 0; j < kColumns; ++j) {
        auto& row = table[j];
        row.resize(j + 1);
        midpointRule(f, t, y, dydt, step, 2 * (j + 1), row[0], previous, slope);
        for (int k = 1; k <= j; ++k) {
            const auto c = static_cast<std::size_t>(k);
            const auto& above = table[j - 1][c - 1];
            const Real ratio = static_cast<Real>(j + 1) / static_cast<Real>(j + 1 - k);
            const Real factor = 1 / (ratio * ratio - 1);
            row[c].resize(y.size());
            for (std::size_t i = 0; i < y.size(); ++i)
                row[c][i] = row[c - 1][i] + factor * (row[c - 1][i] - above[i]);
        }
        if (j == 0) continue;
        const auto d = static_cast<std::size_t>(j);
        result.error = 0;
        for (std::size_t i = 0; i < y.size(); ++i) {
            const Real beside = std::max({scaleOf(scale, i), std::abs(y[i]), std::abs(row[d][i])});
            const Real off = std::abs(row[d][i] - row[d - 1][i]);
            const Real ratio = off == 0 ? 0 : off / (tolerance * beside);
            result.error = std::max(result.error, std::isfinite(ratio) ? ratio : kInfinite);
        }
        result.y = row[d];
        result.column = j;
        if (!(result.error > 1)) break;
    }
    return result;
}

/// Chebyshev-Lobatto point j of [-1, 1], ascending.
Real chebyshevPoint(int j) {
    static const auto points = [] {
        std::array<Real, kPanelDegree + 1> x{};
        for (int i = 0; i <= kPanelDegree; ++i) x[i] = -std::cos(kPi * i / kPanelDegree);
        return x;
    }();
    return points[j];
}

/// integrateOde() in at most `mostSteps` steps, tried ones included; empty where they do not suffice.
std::optional<OdeState> integrateInSteps(const OdeRhs& f, Real t0, const OdeState& y0, Real t1,
                                         Real tolerance, Real firstStep, const OdeState& scale,
                                         int mostSteps) {
    OdeState y = y0;
    OdeState dydt(y0.size());
    Real t = t0;
    const Real span = t1 - t0;
    if (span == 0) return y;
    Real step = firstStep != 0 ? firstStep : span / 16;
    for (int count = 0; (t1 - t) * span > 0; ++count) {
        if (count > mostSteps) return std::nullopt;
        if (std::abs(step) > std::abs(t1 - t)) step = t1 - t;
        f(t, y, dydt);
        Step trial = extrapolate(f, t, y, dydt, step, tolerance, scale);
        if (!(trial.error <= 1)) {
            step *= std::isfinite(trial.error)
                        ? std::clamp(std::pow(trial.error, Real(-1) / (2 * kColumns - 1)) * 0.8L, 0.1L, 0.7L)
                        : 0.1L;
            if (std::abs(step) < 1e-14L * std::max(std::abs(span), std::abs(t)))
                throw std::runtime_error("integrateOde: the step became too small");
            continue;
        }
        const bool last = step == t1 - t;
        t = last ? t1 : t + step;
        y = std::move(trial.y);
        if (trial.column < kColumns - 2) step *= 1.5L;
        if (trial.column == kColumns - 1) step *= 0.85L;
    }
    return y;
}

}  // namespace

OdeState integrateOde(const OdeRhs& f, Real t0, const OdeState& y0, Real t1, Real tolerance, Real firstStep,
                      const OdeState& scale) {
    auto y = integrateInSteps(f, t0, y0, t1, tolerance, firstStep, scale, kMaxSteps);
    if (!y) throw std::runtime_error("integrateOde: too many steps");
    return std::move(*y);
}

OdeLimits OdeLimits::ofEvaluations(std::size_t most) {
    OdeLimits limits;
    limits.evaluations = most;
    return limits;
}

OdeLimits OdeLimits::neighbourOf(Real tolerance, Real apart, OdeState scale) {
    OdeLimits limits;
    limits.neighbour = tolerance;
    limits.agrees = [apart, scale = std::move(scale)](const OdeState& y, const OdeState& neighbour) {
        for (std::size_t i = 0; i < y.size(); ++i)
            if (!(std::abs(y[i] - neighbour[i]) <= apart * std::max(scaleOf(scale, i), std::abs(y[i]))))
                return false;
        return true;
    };
    return limits;
}

Real lastTimeOf(const std::function<bool(const OdeState&)>& holds, const OdeRhs& f, Real t0, OdeState y,
                Real t1, int looks, const std::function<Real(const OdeState&)>& pace, const OdeState& scale,
                std::size_t evaluations) {
    constexpr int kMostLooks = 100000;
    const OdeRhs bounded = counted(f, evaluations);
    const Real longest = (t1 - t0) / looks, shortest = (t1 - t0) * 1e-15L;
    Real t = t0, bound = longest;
    for (int look = 0; t < t1; ++look) {
        if (look > kMostLooks) throw std::runtime_error("lastTimeOf: too many steps");
        const Real step = std::min({bound, pace(y), t1 - t});
        if (!(step > shortest)) return t1 - t > 2 * shortest ? t : t1;
        std::optional<OdeState> next;
        try {
            next = integrateOde(bounded, t, y, t + step, 1e-12L, 0, scale);
        } catch (const EvaluationsSpent&) {
            return t;
        } catch (const std::runtime_error&) {
        }
        if (!next || !holds(*next)) {
            bound = step / 2;
            continue;
        }
        t = step == t1 - t ? t1 : t + step;
        y = *next;
    }
    return t1;
}

bool DenseSolution::build(const OdeRhs& f, const OdeState& y0, Real tolerance, const OdeState& scale,
                          Panel& panel) {
    const Real middle = (panel.begin + panel.end) / 2, half = (panel.end - panel.begin) / 2;
    panel.nodes.assign(1, y0);
    std::vector<std::pair<Real, OdeState>> checks;
    const auto follow = [&](const OdeState& y, Real from, Real to) {
        return integrateInSteps(f, from, y, to, tolerance / 100, to - from, scale, kMostStepsToNode);
    };
    Real t = panel.begin;
    for (int j = 1; j <= kPanelDegree; ++j) {
        const Real next = middle + half * chebyshevPoint(j);
        const bool check = j == 2 || j == kPanelDegree / 2 + 1 || j == kPanelDegree - 1;
        const Real between = (t + next) / 2;
        std::optional<OdeState> y;
        if (check) {
            y = follow(panel.nodes.back(), t, between);
            if (!y) return false;
            checks.emplace_back(between, *y);
            y = follow(*y, between, next);
        } else {
            y = follow(panel.nodes.back(), t, next);
        }
        if (!y) return false;
        panel.nodes.push_back(std::move(*y));
        t = next;
    }
    for (const auto& [time, exact] : checks) {
        const OdeState value = evaluate(panel, time);
        for (std::size_t i = 0; i < exact.size(); ++i)
            if (!(std::abs(value[i] - exact[i]) <=
                  tolerance * std::max(scaleOf(scale, i), std::abs(exact[i]))))
                return false;
    }
    return true;
}

DenseSolution::DenseSolution(const OdeRhs& f, Real t0, const OdeState& y0, Real t1, Real tolerance,
                             std::vector<Real> breaks, const OdeState& scale, const OdeLimits& limits) {
    std::size_t left = limits.evaluations;
    const OdeRhs bounded = counted(f, left);
    OdeState y = y0;
    OdeState neighbour = y0;
    std::sort(breaks.begin(), breaks.end());
    breaks.push_back(t1);
    Real begin = t0;
    try {
        for (const Real time : breaks) {
            if (!whole_ || !(time > begin && time <= t1)) continue;
            // The right-hand side at the end of a smooth part is the one just before it.
            const OdeRhs part = [&bounded, time](Real t, const OdeState& state, OdeState& dydt) {
                bounded(t < time ? t : std::nextafter(time, -kInfinite), state, dydt);
            };
            append(time < t1 ? part : bounded, begin, y, neighbour, time, tolerance, scale, limits);
            begin = time;
        }
    } catch (const std::runtime_error&) {
        if (!limits.agrees || panels_.empty()) throw;
        whole_ = false;
    }
    if (panels_.empty()) panels_.push_back({t0, t0, {y0}});
}

void DenseSolution::append(const OdeRhs& f, Real t0, OdeState& y, OdeState& neighbour, Real t1,
                           Real tolerance, const OdeState& scale, const OdeLimits& limits) {
    Real length = t1 - t0;
    const Real shortest = (t1 - t0) * 1e-6L;
    int inOneGo = 0;  // panels of this length
    for (Real t = t0; t < t1;) {
        Panel panel;
        panel.begin = t;
        panel.end = t1 - t <= length * 1.0001L ? t1 : t + length;
        bool built = false;
        try {
            built = build(f, y, tolerance, scale, panel);
        } catch (const EvaluationsSpent&) {
            throw;
        } catch (const std::runtime_error&) {
            // A singular point within the panel: with a neighbour the solution may end before it.
            if (!limits.agrees) throw;
        }
        if (!built) {
            length = (panel.end - panel.begin) / 2;
            inOneGo = 0;
            if (length < shortest) throw std::runtime_error("DenseSolution: panels became too short");
            continue;
        }
        if (limits.agrees) {
            neighbour = integrateOde(f, t, neighbour, panel.end, limits.neighbour, panel.end - t, scale);
            if (!limits.agrees(panel.nodes.back(), neighbour)) {
                if (panels_.empty())
                    throw std::runtime_error("DenseSolution: neighbouring motions part at the start");
                whole_ = false;
                return;
            }
        }
        t = panel.end;
        y = panel.nodes.back();
        panels_.push_back(std::move(panel));
        // One quick moment must not leave short panels to the end.
        if (++inOneGo == kGrowAfter) {
            length *= 2;
            inOneGo = 0;
        }
        if (panels_.size() > kMostPanels)
            throw std::runtime_error("DenseSolution: the motion is too long for its oscillations");
    }
}

OdeState DenseSolution::evaluate(const Panel& panel, Real t) {
    if (panel.nodes.size() == 1) return panel.nodes.front();
    const Real x = (2 * t - panel.begin - panel.end) / (panel.end - panel.begin);
    OdeState sum(panel.nodes.front().size(), 0);
    Real weights = 0;
    for (int j = 0; j <= kPanelDegree; ++j) {
        const Real d = x - chebyshevPoint(j);
        const auto& node = panel.nodes[j];
        if (d == 0) return node;
        Real w = (j % 2 == 0 ? 1 : -1) / d;
        if (j == 0 || j == kPanelDegree) w /= 2;
        weights += w;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * node[i];
    }
    for (auto& value : sum) value /= weights;
    return sum;
}

std::vector<Real> DenseSolution::nodes() const {
    std::vector<Real> times;
    for (const Panel& panel : panels_) {
        const Real middle = (panel.begin + panel.end) / 2;
        const Real half = (panel.end - panel.begin) / 2;
        for (int j = times.empty() ? 0 : 1; j <= kPanelDegree; ++j)
            times.push_back(middle + half * chebyshevPoint(j));
    }
    return times;
}

std::optional<Real> DenseSolution::lastTimeOf(const std::function<bool(const OdeState&)>& holds,
                                              Real until) const {
    constexpr int kHalvings = 60;
    std::optional<Real> low;
    for (const Real node : nodes()) {
        const Real time = std::min(node, until);
        if (!holds(at(time))) {
            if (!low) return std::nullopt;
            Real high = time;
            for (int k = 0; k < kHalvings; ++k) {
                const Real middle = *low + (high - *low) / 2;
                (holds(at(middle)) ? *low : high) = middle;
            }
            return low;
        }
        low = time;
        if (node >= until) break;
    }
    return low;
}

OdeState DenseSolution::at(Real t) const {
    const auto after = std::upper_bound(panels_.begin(), panels_.end(), t,
                                        [](Real value, const Panel& p) { return value < p.begin; });
    const Panel& panel = after == panels_.begin() ? panels_.front() : *(after - 1);
    return evaluate(panel, std::clamp(t, panel.begin, panel.end));
}

}  // namespace rigor::validation::numerics
