// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "validation/statistics/bootstrap.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

constexpr int kResamples = 2000;
constexpr double kFinest = 1.0 / 400;  // fraction of a range: far below the resolution of any recording
constexpr double kSearchShare = 2.0 / 3, kGridShare = 0.4;

Interval meanInterval(const Losses& losses, std::uint64_t seed) {
    const auto mean = [&](const Picks& picks) {
        double sum = 0.0;
        for (const std::size_t i : picks[0]) sum += losses[i];
        return std::vector<double>{sum / losses.size()};
    };
    return bootstrap({losses.size()}, seed, kResamples, mean)[0];
}

/// All points of base + {-1, 0, 1}^d steps (or an even grid) inside the box.
class Grid {
  public:
    explicit Grid(const std::vector<FitParameter>& parameters) : parameters_(parameters) {}

    /// Every combination of the given values per parameter.
    static std::vector<FitPoint> product(const std::vector<std::vector<double>>& axes) {
        std::vector<FitPoint> points{{}};
        for (const auto& axis : axes) {
            std::vector<FitPoint> longer;
            for (const FitPoint& p : points)
                for (const double v : axis) {
                    longer.push_back(p);
                    longer.back().push_back(v);
                }
            points = std::move(longer);
        }
        return points;
    }
    static std::vector<double> even(double low, double high, int count) {
        std::vector<double> values;
        for (int k = 0; k < count; ++k)
            values.push_back(count == 1 ? 0.5 * (low + high) : low + (high - low) * k / (count - 1));
        return values;
    }
    std::vector<FitPoint> around(const FitPoint& center, const std::vector<double>& step) const {
        std::vector<std::vector<double>> axes;
        for (std::size_t i = 0; i < center.size(); ++i) {
            std::vector<double> axis;
            for (const int k : {-1, 0, 1}) {
                const double v = std::clamp(center[i] + k * step[i], parameters_[i].low, parameters_[i].high);
                if (std::find(axis.begin(), axis.end(), v) == axis.end()) axis.push_back(v);
            }
            axes.push_back(std::move(axis));
        }
        return product(axes);
    }

  private:
    const std::vector<FitParameter>& parameters_;
};

class Search {
  public:
    Search(const std::vector<FitParameter>& parameters, Summary summary, int budget, std::uint64_t seed,
           const LossFunction& losses)
        : parameters_(parameters),
          summary_(summary),
          budget_(budget),
          seed_(seed),
          losses_(losses),
          grid_(parameters) {}

    std::optional<SearchResult> run() {
        if (!coarse() || !refine() || !survey()) return std::nullopt;
        return std::move(result_);
    }

  private:
    std::size_t dimension() const { return parameters_.size(); }
    int perAxis(double points) const {
        return std::max(3, static_cast<int>(std::floor(std::pow(points, 1.0 / dimension()) + 1e-9)));
    }
    int left(double share) const {
        return static_cast<int>(share * budget_) - static_cast<int>(result_.all.size());
    }

    bool add(std::vector<FitPoint> points) {
        std::erase_if(points, [&](const FitPoint& p) {
            return std::any_of(result_.all.begin(), result_.all.end(),
                               [&](const Evaluated& e) { return e.point == p; });
        });
        if (points.empty()) return true;
        const auto found = losses_(points);
        if (!found) return false;
        for (std::size_t k = 0; k < points.size(); ++k) result_.all.push_back({points[k], (*found)[k]});
        for (std::size_t k = 0; k < result_.all.size(); ++k)
            if (summarise(result_.all[k].losses, summary_) <
                summarise(result_.all[result_.best].losses, summary_))
                result_.best = k;
        return true;
    }

    bool coarse() {
        const int count = perAxis(kGridShare * budget_);
        std::vector<std::vector<double>> axes;
        FitPoint start;
        for (const FitParameter& p : parameters_) {
            axes.push_back(Grid::even(p.low, p.high, count));
            step_.push_back(0.5 * (p.high - p.low) / (count - 1));
            start.push_back(p.start);
        }
        std::vector<FitPoint> points = Grid::product(axes);
        points.push_back(start);
        return add(std::move(points));
    }

    bool refine() {
        while (step_[0] > kFinest * (parameters_[0].high - parameters_[0].low)) {
            const std::size_t before = result_.best;
            const auto points = grid_.around(result_.all[before].point, step_);
            if (left(kSearchShare) < static_cast<int>(points.size()) - 1) break;
            if (!add(points)) return false;
            if (result_.best == before)
                for (double& step : step_) step *= 0.5;
        }
        return true;
    }

    /// An even grid over where resampled recordings put the minimum, a step wider on every side.
    bool survey() {
        result_.resolution = step_;
        if (left(1.0) < static_cast<int>(std::pow(3.0, dimension()))) return true;
        const auto where = minimiserIntervals(result_, parameters_, summary_, seed_);
        const int count = perAxis(left(1.0));
        std::vector<std::vector<double>> axes;
        for (std::size_t i = 0; i < dimension(); ++i) {
            const FitParameter& p = parameters_[i];
            const double wider = std::max(step_[i], 0.25 * (where[i].high - where[i].low));
            const double low = std::max(p.low, where[i].low - wider),
                         high = std::min(p.high, where[i].high + wider);
            axes.push_back(Grid::even(low, high, count));
            result_.resolution[i] = (high - low) / (count - 1);
        }
        return add(Grid::product(axes));
    }

    const std::vector<FitParameter>& parameters_;
    Summary summary_;
    int budget_;
    std::uint64_t seed_;
    const LossFunction& losses_;
    Grid grid_;
    std::vector<double> step_;
    SearchResult result_;
};

}  // namespace

double summarise(const Losses& losses, Summary summary) {
    if (summary == Summary::Median) return median(losses);
    return std::accumulate(losses.begin(), losses.end(), 0.0) / losses.size();
}

ScoreSummary scoreOf(const Losses& losses, std::uint64_t seed) {
    ScoreSummary s;
    s.mean = summarise(losses, Summary::Mean);
    s.median = summarise(losses, Summary::Median);
    s.meanInterval = meanInterval(losses, seed);
    s.medianInterval = medianInterval(losses).value_or(Interval{
        *std::min_element(losses.begin(), losses.end()), *std::max_element(losses.begin(), losses.end())});
    s.runs = losses.size();
    s.broken = std::count_if(losses.begin(), losses.end(), [](double v) { return !std::isfinite(v); });
    return s;
}

std::pair<double, Interval> meanChange(const Losses& a, const Losses& b, std::uint64_t seed) {
    Losses change;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (std::isfinite(a[k]) && std::isfinite(b[k])) change.push_back(b[k] - a[k]);
    if (change.empty()) {
        const double none = std::numeric_limits<double>::quiet_NaN();
        return {none, {none, none}};
    }
    return {summarise(change, Summary::Mean), meanInterval(change, seed)};
}

std::optional<SearchResult> searchMinimum(const std::vector<FitParameter>& parameters, Summary summary,
                                          int budget, std::uint64_t seed, const LossFunction& losses) {
    return Search(parameters, summary, budget, seed, losses).run();
}

std::vector<Interval> minimiserIntervals(const SearchResult& search,
                                         const std::vector<FitParameter>& parameters, Summary summary,
                                         std::uint64_t seed) {
    const std::size_t recordings = search.all.front().losses.size();
    Losses drawn(recordings);
    const auto minimiser = [&](const Picks& picks) {
        double least = std::numeric_limits<double>::infinity();
        const FitPoint* best = &search.all[search.best].point;
        for (const Evaluated& e : search.all) {
            for (std::size_t i = 0; i < recordings; ++i) drawn[i] = e.losses[picks[0][i]];
            if (const double value = summarise(drawn, summary); value < least) {
                least = value;
                best = &e.point;
            }
        }
        return *best;
    };
    std::vector<Interval> intervals = bootstrap({recordings}, seed, kResamples, minimiser);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        Interval& interval = intervals[i];
        const double best = search.all[search.best].point[i], half = 0.5 * search.resolution[i];
        interval.low = std::max(parameters[i].low, std::min(interval.low, best) - half);
        interval.high = std::min(parameters[i].high, std::max(interval.high, best) + half);
    }
    return intervals;
}

}  // namespace rigor::validation
