// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>

#include "validation/comparison/compare.hpp"

namespace rigor::validation {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, const char* format = "%.4g") {
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string padded(const std::string& text, std::size_t width) {
    return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::string placeName(const std::string& before, const std::string& after) {
    return before == after ? before : before + " -> " + after;
}

std::string stepName(double before, double after) {
    return "dt=" + placeName(number(before, "%.6g"), number(after, "%.6g"));
}

std::string specName(const SpecChange& s) {
    const std::string name = placeName(s.spec, s.specAfter);
    return s.dt > 0.0 ? name + " " + stepName(s.dt, s.dtAfter) : name;
}

/// "1.02 (0.98 .. 1.05) no difference shown; mean 1.30, first step 0.99".
std::string timeText(const SpecChange& s) {
    if (!s.timeRatio) return "not timed";
    std::string text = number(*s.timeRatio, "%.3f");
    if (s.timeInterval) {
        text +=
            " (" + number(s.timeInterval->low, "%.3f") + " .. " + number(s.timeInterval->high, "%.3f") + ")";
        text += s.timeInterval->low > 1.0    ? " slower"
                : s.timeInterval->high < 1.0 ? " faster"
                                             : " no difference shown";
    } else {
        text += " (too few cases for an interval)";
    }
    if (s.meanRatio) text += "; mean " + number(*s.meanRatio, "%.3f");
    if (s.firstRatio) text += ", first step " + number(*s.firstRatio, "%.3f");
    return text;
}

template <class List, class Line>
void addSome(std::string& text, const std::string& title, const List& list, std::size_t most, Line line) {
    if (list.empty()) return;
    text += title + " (" + std::to_string(list.size()) + ")\n";
    for (std::size_t i = 0; i < std::min(most, list.size()); ++i) text += "  " + line(list[i]) + "\n";
    if (list.size() > most) text += "  and " + std::to_string(list.size() - most) + " more\n";
}

/// The case that another one would be compared with.
const char* partnerName(PairBy by) {
    constexpr const char* kNames[] = {"run", "engine of their preset", "spec of their engine", "time step"};
    return kNames[static_cast<std::size_t>(by)];
}

Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json finite(const std::optional<double>& value) {
    return value ? finite(*value) : Json(nullptr);
}

Json specJson(const SpecChange& s, PairBy by) {
    Json out{{"name", specName(s)}};
    if (by != PairBy::Nothing) out.update({{"spec", s.spec}, {"spec_after", s.specAfter}});
    if (by == PairBy::TimeStep) out.update({{"dt", s.dt}, {"dt_after", s.dtAfter}});
    out.update({{"cases", s.cases},
                {"better", s.better},
                {"worse", s.worse},
                {"same", s.same},
                {"cases_better", s.casesBetter},
                {"cases_worse", s.casesWorse},
                {"p_cases", s.pCases},
                {"timed", s.timed},
                {"time_ratio", finite(s.timeRatio)},
                {"time_interval",
                 s.timeInterval ? Json::array({s.timeInterval->low, s.timeInterval->high}) : Json(nullptr)},
                {"p_time", s.pTime},
                {"mean_time_ratio", finite(s.meanRatio)},
                {"first_time_ratio", finite(s.firstRatio)}});
    return out;
}

}  // namespace

std::string comparisonText(const RunComparison& c, const CompareOptions& options, std::size_t most) {
    std::string text;
    std::size_t width = 6;
    for (const SpecChange& s : c.specs) width = std::max(width, specName(s).size());
    text += padded("engine", width) +
            "  cases  errors better/worse/same  cases better/worse  sign test of cases  time after/before: "
            "median "
            "of a step, median over cases (95 %)\n";
    for (const SpecChange& s : c.specs) {
        const std::string errors =
            std::to_string(s.better) + "/" + std::to_string(s.worse) + "/" + std::to_string(s.same);
        const std::string cases = std::to_string(s.casesBetter) + "/" + std::to_string(s.casesWorse);
        text += padded(specName(s), width) + "  " + padded(std::to_string(s.cases), 5) + "  " +
                padded(errors, 24) + "  " + padded(cases, 18) + "  " +
                padded("p = " + number(s.pCases, "%.2g"), 18) + "  " + timeText(s) + "\n";
    }
    if (c.runsBefore < 3 || c.runsAfter < 3)
        text +=
            "Times: " + std::to_string(c.runsBefore) + " and " + std::to_string(c.runsAfter) +
            " run(s); a change of the machine's load between them is not seen. Give three of each or more.\n";
    const auto where = [](const auto& x) {
        return x.place.scenario + " " + placeName(x.place.spec, x.place.specAfter) + " " +
               stepName(x.place.dt, x.place.dtAfter);
    };
    const std::string changed = c.pairBy == PairBy::Nothing ? "changed" : "differ";
    const auto state = [](const auto& x) {
        return x.worse ? "worse   " : x.better ? "better  " : "other   ";
    };
    addSome(text, "Verdicts that " + changed, c.verdicts, most, [&](const VerdictChange& v) {
        return state(v) + where(v) + ": " + v.before + " -> " + v.after +
               (v.reason.empty() ? "" : " (" + v.reason + ")");
    });
    const auto metric = [&](const MetricChange& m) {
        return state(m) + where(m) + ": " + m.metric + " " + number(m.before) + " -> " + number(m.after) +
               (m.unit == "1" ? "" : " " + m.unit);
    };
    const std::string share = changed + " by more than " + number(100.0 * options.tolerance) + " %";
    const auto others = std::partition_point(c.metrics.begin(), c.metrics.end(),
                                             [](const MetricChange& m) { return m.worse || m.better; });
    addSome(text, "Errors that " + share, std::span(c.metrics.begin(), others), most, metric);
    addSome(text, "Other numbers that " + share + ", neither better nor worse",
            std::span(others, c.metrics.end()), most, metric);
    const auto plain = [](const std::string& line) { return line; };
    addSome(text, "Scenarios whose files differ, not compared", c.changedScenarios, most, plain);
    addSome(text, "Only before", c.onlyBefore, most, plain);
    addSome(text, "Only after", c.onlyAfter, most, plain);
    addSome(text, std::string("Cases without another ") + partnerName(c.pairBy) + ", not compared",
            c.unpaired, most, plain);
    addSome(text, "Other environment", c.environment, most, plain);
    if (c.verdicts.empty() && others == c.metrics.begin())
        text += std::string("No verdict and no error ") +
                (c.pairBy == PairBy::Nothing ? "changed" : "differs") + ".\n";
    return text;
}

std::string comparisonJson(const RunComparison& c) {
    const auto place = [&](const ComparedPlace& p) {
        Json where{{"scenario", p.scenario}, {"spec", p.spec}, {"dt", p.dt}};
        if (c.pairBy != PairBy::Nothing) {
            where["spec_after"] = p.specAfter;
            where["dt_after"] = p.dtAfter;
        }
        return where;
    };
    Json out{{"pair", pairByName(c.pairBy)}, {"worse", becameWorse(c)},
             {"specs", Json::array()},       {"verdicts", Json::array()},
             {"metrics", Json::array()},     {"changed_scenarios", c.changedScenarios},
             {"only_before", c.onlyBefore},  {"only_after", c.onlyAfter},
             {"unpaired", c.unpaired},       {"environment", c.environment}};
    for (const SpecChange& s : c.specs) out["specs"].push_back(specJson(s, c.pairBy));
    for (const VerdictChange& v : c.verdicts) {
        out["verdicts"].push_back(place(v.place));
        out["verdicts"].back().update({{"before", v.before},
                                       {"after", v.after},
                                       {"worse", v.worse},
                                       {"better", v.better},
                                       {"reason", v.reason}});
    }
    for (const MetricChange& m : c.metrics) {
        out["metrics"].push_back(place(m.place));
        out["metrics"].back().update({{"metric", m.metric},
                                      {"unit", m.unit},
                                      {"before", finite(m.before)},
                                      {"after", finite(m.after)},
                                      {"worse", m.worse},
                                      {"better", m.better},
                                      {"size", finite(m.size)}});
    }
    return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rigor::validation
