// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/replay/events.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "reports/encoding/json.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::report {
namespace {

using results::BodyChannels;
using results::TrajectoryFile;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kAngleWorthAMark = 1e-6;  // [rad] normals nearer than this are right

const double* positionAt(const BodyChannels& body, std::size_t frame) {
    return 3 * frame + 3 <= body.position.values.size() ? body.position.values.data() + 3 * frame : nullptr;
}

double distance(const double* a, const double* b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Furthest finite distance of a body from its first position.
double reachOf(const BodyChannels& body, std::size_t frames) {
    double reach = 0.0;
    for (std::size_t f = 1; f < frames; ++f)
        if (const double* p = positionAt(body, f)) {
            const double d = distance(p, positionAt(body, 0));
            if (std::isfinite(d)) reach = std::max(reach, d);
        }
    return reach;
}

ReplayEvent eventAt(const TrajectoryFile& file, std::size_t frame, std::string kind) {
    ReplayEvent event;
    event.frame = frame;
    event.time = file.times[frame];
    event.kind = std::move(kind);
    event.value = kNone;
    return event;
}

void addLargest(const TrajectoryFile& file, const results::CaseRow& row, std::vector<ReplayEvent>& out) {
    for (const auto& metric : row.metrics) {
        if (!(metric.at >= 0.0)) continue;
        ReplayEvent event = eventAt(file, nearestFrame(file.times, metric.at), "largest");
        event.what = metric.name;
        event.subject = metric.subject;
        event.value = metric.value;
        event.unit = metric.unit;
        out.push_back(std::move(event));
    }
}

/// Frame of "... at t=0.25, step 15 (...)", `at` the place of the time; by the time alone where a store of an
/// older version names no step.
std::size_t frameOf(const TrajectoryFile& file, const std::string& worst, std::size_t at) {
    constexpr std::string_view kStep = ", step ";
    char* end = nullptr;
    const double time = std::strtod(worst.c_str() + at, &end);
    if (std::string_view(end).substr(0, kStep.size()) != kStep) return nearestFrame(file.times, time);
    const long step = std::strtol(end + kStep.size(), nullptr, 10);
    const std::size_t frame = static_cast<std::size_t>(std::max(0L, step / std::max(1, file.stride)));
    return std::min(frame, file.times.size() - 1);
}

/// Contact of the frame that "... at t=0.25, step 15, contact 3 (normal)" names; -1 if it names none.
long contactOf(const std::string& worst) {
    constexpr std::string_view kContact = ", contact ";
    const auto at = worst.rfind(kContact);
    return at == std::string::npos ? -1 : std::strtol(worst.c_str() + at + kContact.size(), nullptr, 10);
}

/// Worst place of an auditor in a store of an older version, which kept no findings.
void addWorst(const TrajectoryFile& file, const results::AuditRow& audit, std::vector<ReplayEvent>& out) {
    const auto at = audit.worst.find(" at t=");
    const bool wrong =
        audit.missed + audit.spurious > 0 || audit.normalErrorMax.value_or(0.0) >= kAngleWorthAMark;
    if (at == std::string::npos || !wrong) return;
    ReplayEvent event = eventAt(file, frameOf(file, audit.worst, at + 6), "audit");
    event.what = audit.auditor;
    event.subject = audit.worst.substr(0, at);
    event.value = audit.normalErrorMax.value_or(kNone);
    event.unit = "rad";
    event.text = audit.worst;
    event.contact = contactOf(audit.worst);
    out.push_back(std::move(event));
}

/// True for findings that are worth a mark: wrong normals, missed and false overlaps of every auditor, and the
/// worst depth of the contacts that the run acted upon.
bool isMarked(const Json& found, const results::AuditRow& audit) {
    const auto what = found.at("what").get<std::string>();
    if (!found.at("error").is_number()) return false;
    if (what == "normal") return found.at("error").get<double>() >= kAngleWorthAMark;
    if (what == "point_normal") return false;  // the metric normal_error has its own mark
    return what != "depth" || audit.auditor == "in_run";
}

/// The worst of each kind by each auditor, at its own frame.
void addAudit(const TrajectoryFile& file, const results::CaseRow& row, std::vector<ReplayEvent>& out) {
    for (const auto& audit : row.audit) {
        if (audit.findings.empty()) {
            addWorst(file, audit, out);
            continue;
        }
        for (const auto& found : Json::parse(audit.findings)) {
            if (!isMarked(found, audit)) continue;
            const auto step = found.at("step").get<std::size_t>();
            const std::size_t frame = step / static_cast<std::size_t>(std::max(1, file.stride));
            ReplayEvent event = eventAt(file, std::min(frame, file.times.size() - 1), "audit");
            event.what = audit.auditor;
            event.subject =
                found.at("names").at(0).get<std::string>() + "|" + found.at("names").at(1).get<std::string>();
            event.value = found.at("error");
            event.unit = found.at("unit");
            event.text = found.at("what");
            event.contact = found.at("contact");
            out.push_back(std::move(event));
        }
    }
}

void addDivergence(const TrajectoryFile& file, double threshold, std::vector<ReplayEvent>& out) {
    for (std::size_t f = 0; f < file.times.size(); ++f)
        for (const auto& exact : file.reference) {
            const auto body = std::find_if(file.bodies.begin(), file.bodies.end(),
                                           [&](const auto& b) { return b.name == exact.name; });
            const double* there = positionAt(exact, f);
            if (body == file.bodies.end() || there == nullptr || !std::isfinite(there[0])) continue;
            const double* here = positionAt(*body, f);
            if (here == nullptr || distance(here, there) <= threshold) continue;
            ReplayEvent event = eventAt(file, f, "divergence");
            event.subject = exact.name;
            event.value = distance(here, there);
            event.unit = "m";
            event.threshold = threshold;
            out.push_back(std::move(event));
            return;
        }
}

void addNonFinite(const TrajectoryFile& file, std::vector<ReplayEvent>& out) {
    for (std::size_t f = 0; f < file.times.size(); ++f)
        for (const auto& body : file.bodies)
            if (const double* p = positionAt(body, f); p && !std::isfinite(p[0] + p[1] + p[2])) {
                out.push_back(eventAt(file, f, "nonfinite"));
                out.back().subject = body.name;
                return;
            }
}

using Pairs = std::set<std::pair<int, int>>;

void addChanges(const TrajectoryFile& file, std::size_t frame, const Pairs& before, const Pairs& now,
                std::vector<ReplayEvent>& out) {
    const auto add = [&](const Pairs& from, const Pairs& without, const char* kind) {
        for (const auto& [a, b] : from) {
            if (without.contains({a, b}) || static_cast<std::size_t>(std::max(a, b)) >= file.bodies.size() ||
                std::min(a, b) < 0)
                continue;
            out.push_back(eventAt(file, frame, kind));
            out.back().subject = file.bodies[a].name + "|" + file.bodies[b].name;
        }
    };
    add(now, before, "contact_begin");
    add(before, now, "contact_end");
}

/// Pairs that touch in the first frame with contacts begin there.
void addContactEvents(const TrajectoryFile& file, std::vector<ReplayEvent>& out) {
    std::vector<ReplayEvent> found;
    Pairs before;
    std::size_t next = 0;
    const auto stride = static_cast<std::size_t>(std::max(1, file.contactStride));
    for (std::size_t f = 0; f < file.times.size() && found.size() < kMostContactEvents; f += stride) {
        if (!results::contactsStored(file, f)) continue;
        Pairs now;
        for (; next < file.contacts.size() && file.contacts[next].time <= file.times[f]; ++next)
            if (const auto& c = file.contacts[next]; c.time == file.times[f])
                now.insert(std::minmax(c.bodyA, c.bodyB));
        addChanges(file, f, before, now, found);
        before = std::move(now);
    }
    if (found.size() > kMostContactEvents) found.resize(kMostContactEvents);
    std::move(found.begin(), found.end(), std::back_inserter(out));
}

}  // namespace

std::size_t nearestFrame(const std::vector<double>& times, double t) {
    const auto after = std::lower_bound(times.begin(), times.end(), t);
    if (after == times.end()) return times.empty() ? 0 : times.size() - 1;
    const auto index = static_cast<std::size_t>(after - times.begin());
    return index > 0 && t - times[index - 1] < times[index] - t ? index - 1 : index;
}

double sceneLength(const TrajectoryFile& file) {
    double low[3], high[3];
    std::fill_n(low, 3, std::numeric_limits<double>::infinity());
    std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
    std::vector<double> reaches;
    for (const auto& body : file.bodies) {
        const double reach = reachOf(body, file.times.size());
        if (reach == 0.0) continue;
        reaches.push_back(reach);
        const double* p = positionAt(body, 0);
        for (int k = 0; k < 3; ++k)
            if (std::isfinite(p[k])) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
    }
    const double spread = reaches.empty() || !(high[0] >= low[0]) ? 0.0 : distance(low, high);
    return std::max(1e-6, spread + (reaches.empty() ? 0.0 : validation::median(reaches)));
}

std::vector<ReplayEvent> replayEvents(const TrajectoryFile& file, const results::CaseRow& row) {
    std::vector<ReplayEvent> out;
    if (file.times.empty()) return out;
    addLargest(file, row, out);
    addAudit(file, row, out);
    addDivergence(file, kDivergenceFraction * sceneLength(file), out);
    addNonFinite(file, out);
    addContactEvents(file, out);
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
    return out;
}

ReplayEvent engineDivergenceOf(const TrajectoryFile& file, const TrajectoryFile& other, double threshold) {
    ReplayEvent none;
    none.frame = file.times.size();
    if (file.bodies.size() != other.bodies.size()) return none;
    const double slack = 1e-9 + 1e-6 * std::abs(file.dt);
    for (std::size_t f = 0, g = 0; f < file.times.size(); ++f) {
        while (g < other.times.size() && other.times[g] < file.times[f] - slack) ++g;
        if (g == other.times.size()) break;
        if (other.times[g] > file.times[f] + slack) continue;
        for (std::size_t b = 0; b < file.bodies.size(); ++b) {
            const double *p = positionAt(file.bodies[b], f), *q = positionAt(other.bodies[b], g);
            if (p == nullptr || q == nullptr || distance(p, q) <= threshold) continue;
            ReplayEvent event = eventAt(file, f, "engine_divergence");
            event.subject = file.bodies[b].name;
            event.value = distance(p, q);
            event.unit = "m";
            event.threshold = threshold;
            event.what = other.spec;
            return event;
        }
    }
    return none;
}

}  // namespace rigor::report
