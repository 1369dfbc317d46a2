// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "reports/encoding/json.hpp"
#include "reports/plots/study.hpp"

namespace rigor::report {
namespace {

constexpr std::size_t kLeastPlaces = 3;  ///< least number of places on an axis

std::optional<double> asNumber(const Json& value) {
    if (value.is_number()) return value.get<double>();
    if (!value.is_string()) return std::nullopt;
    const auto& text = value.get_ref<const std::string&>();
    if (text == "inf") return std::numeric_limits<double>::infinity();
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// Something in which the rows of a part differ.
struct Way {
    std::string name, axis;
    std::function<Json(const Json& row)> of;
};

std::vector<Way> waysOf(const Json& rows) {
    std::vector<Way> ways;
    for (const auto& [key, value] : rows.front().at("parameters").items())
        ways.push_back({key, key, [key](const Json& row) { return row.at("parameters").at(key); }});
    ways.push_back({"bodies", "bodies", [](const Json& row) { return row.at("bodies"); }});
    ways.push_back({"dt", "time step [s]", [](const Json& row) { return row.at("dt"); }});
    return ways;
}

std::size_t differentValues(const Json& rows, const Way& way) {
    std::set<std::string> seen;
    for (const auto& row : rows) seen.insert(way.of(row).dump());
    return seen.size();
}

/// The way that makes the axis; none: the rows are bars.
std::optional<Way> axisOf(const Json& rows, const std::vector<Way>& ways) {
    std::optional<Way> chosen;
    std::size_t most = kLeastPlaces - 1;
    for (const Way& way : ways) {
        if (!std::all_of(rows.begin(), rows.end(), [&](const Json& r) { return asNumber(way.of(r)); }))
            continue;
        const std::size_t places = differentValues(rows, way);
        if (places > most) {
            chosen = way;
            most = places;
        }
    }
    return chosen;
}

std::string shownValue(const Way& way, const Json& row) {
    const Json value = way.of(row);
    if (way.name == "dt") return timeStepLabel(value.get<double>());
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// The variant, where there are several, and what else varies apart from the axis.
std::string labelOf(const Json& rows, const Json& row, const std::vector<Way>& ways,
                    const std::optional<Way>& axis) {
    std::vector<Way> varying;
    for (const Way& way : ways)
        if (way.name != "bodies" && (!axis || way.name != axis->name) && differentValues(rows, way) > 1)
            varying.push_back(way);
    const Way variant{"variant", "", [](const Json& r) { return r.at("variant"); }};
    std::string label;
    if (differentValues(rows, variant) > 1 || varying.empty()) label = row.at("variant").get<std::string>();
    const bool named = !label.empty() || varying.size() > 1;  // one way alone needs no name
    for (const Way& way : varying)
        label += (label.empty() ? "" : ", ") + (named && way.name != "dt" ? way.name + "=" : "") +
                 shownValue(way, row);
    return label;
}

/// True if the positive values span more than two decades, and none is below zero; the axis is then
/// logarithmic.
bool spansDecades(const std::vector<StudyPoint>& points) {
    double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
    for (const auto& p : points) {
        if (!p.value || !std::isfinite(*p.value)) continue;
        if (*p.value < 0.0) return false;
        if (*p.value > 0.0) {
            least = std::min(least, *p.value);
            greatest = std::max(greatest, *p.value);
        }
    }
    return greatest > 100.0 * least;
}

/// True for an axis over a factor of at least `factor`.
bool spansFactor(const std::vector<StudyPoint>& points, double factor) {
    double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
    for (const auto& p : points) {
        least = std::min(least, *p.x);
        greatest = std::max(greatest, *p.x);
    }
    return least > 0.0 && greatest >= factor * least;
}

StudyChart chartOf(const Json& part, const Json& rows, const std::string& scenario,
                   const std::string& metric) {
    const auto ways = waysOf(rows);
    const auto axis = axisOf(rows, ways);
    StudyChart chart;
    chart.part = part.at("name");
    chart.scenario = scenario;
    chart.metric = metric;
    chart.axis = axis ? axis->axis : "";
    for (const auto& row : rows) {
        const Json& cell = row.at("metrics").at(metric);
        StudyPoint point;
        point.label = labelOf(rows, row, ways, axis);
        point.outcome = row.at("ran").get<bool>() ? row.at("outcome").get<std::string>() : "not run";
        point.value = asNumber(cell.at("value"));
        if (axis) point.x = asNumber(axis->of(row));
        if (cell.contains("low")) point.low = asNumber(cell.at("low"));
        if (cell.contains("high")) point.high = asNumber(cell.at("high"));
        point.note = cell.value("note", "");
        if (chart.unit.empty()) chart.unit = cell.at("unit").get<std::string>();
        chart.points.push_back(point);
    }
    chart.logarithmic = spansDecades(chart.points);
    if (!axis) return chart;
    // time steps are refined by factors, other parameters only if they go over a wide range
    chart.logarithmicX = spansFactor(chart.points, axis->name == "dt" ? 1.5 : 8.0);
    std::vector<std::string> order;
    for (const auto& p : chart.points)
        if (std::find(order.begin(), order.end(), p.label) == order.end()) order.push_back(p.label);
    std::stable_sort(chart.points.begin(), chart.points.end(), [&](const auto& a, const auto& b) {
        const auto place = [&](const auto& p) { return std::find(order.begin(), order.end(), p.label); };
        return place(a) != place(b) ? place(a) < place(b) : *a.x < *b.x;
    });
    return chart;
}

/// The same values over what the runs cost; the axis is only what orders a line's points.
std::optional<StudyChart> overCost(const StudyChart& chart, const StudyChart& cost) {
    if (chart.axis.empty() || chart.metric.starts_with("time.")) return std::nullopt;
    StudyChart over = chart;
    over.axis = cost.metric + " [s]";
    over.metric = chart.metric + " against " + cost.metric;
    over.logarithmicX = true;
    for (std::size_t i = 0; i < over.points.size(); ++i) {
        over.points[i].x = cost.points[i].value;
        if (!over.points[i].x || !(*over.points[i].x > 0.0)) {
            over.points[i].value.reset();
            over.points[i].x = 0.0;
        }
    }
    return over;
}

bool hasSomething(const StudyChart& chart) {
    return std::any_of(chart.points.begin(), chart.points.end(),
                       [](const auto& p) { return p.value.has_value(); });
}

/// The columns of some rows, then those that have a cost to stand against.
void addCharts(const Json& part, const Json& rows, const std::string& scenario,
               std::vector<StudyChart>& charts) {
    std::vector<StudyChart> columns;
    const StudyChart* cost = nullptr;
    for (const auto& [metric, cell] : rows.front().at("metrics").items())
        if (auto chart = chartOf(part, rows, scenario, metric); hasSomething(chart))
            columns.push_back(std::move(chart));
    for (const auto& chart : columns)
        if (chart.metric.starts_with("time.")) cost = &chart;
    charts.insert(charts.end(), columns.begin(), columns.end());
    if (cost == nullptr) return;
    for (const auto& chart : columns)
        if (auto over = overCost(chart, *cost)) charts.push_back(std::move(*over));
}

}  // namespace

std::vector<StudyChart> studyCharts(const Json& study) {
    std::vector<StudyChart> charts;
    for (const auto& part : study.at("parts")) {
        const Json& all = part.at("rows");
        if (all.empty()) continue;
        // Scenarios that differ in their number of bodies alone are places on one axis.
        const Way bodies{"bodies", "bodies", [](const Json& row) { return row.at("bodies"); }};
        std::vector<std::string> bases;
        for (const auto& row : all)
            if (const auto base = row.at("base").get<std::string>();
                std::find(bases.begin(), bases.end(), base) == bases.end())
                bases.push_back(base);
        const bool together = bases.size() >= kLeastPlaces && differentValues(all, bodies) == bases.size();
        for (const auto& base : bases) {
            Json rows = Json::array();
            for (const auto& row : all)
                if (together || row.at("base") == base) rows.push_back(row);
            addCharts(part, rows, together || bases.size() == 1 ? "" : base, charts);
            if (together) break;
        }
    }
    return charts;
}

std::string studyPageJson(const Json& study) {
    Json page = study, list = Json::array();
    for (const auto& chart : studyCharts(study)) {
        Json points = Json::array();
        for (const auto& p : chart.points)
            points.push_back({{"label", p.label},
                              {"x", number(p.x)},
                              {"value", number(p.value)},
                              {"low", number(p.low)},
                              {"high", number(p.high)},
                              {"note", p.note},
                              {"outcome", p.outcome}});
        list.push_back({{"part", chart.part},
                        {"scenario", chart.scenario},
                        {"metric", chart.metric},
                        {"unit", chart.unit},
                        {"axis", chart.axis},
                        {"logarithmic", chart.logarithmic},
                        {"logarithmicX", chart.logarithmicX},
                        {"points", points}});
    }
    page["charts"] = list;
    return page.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rigor::report
