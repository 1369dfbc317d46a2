// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/command.hpp"
#include "reports/model/view_model.hpp"
#include "scenarios/model/printable.hpp"
#include "validation/results/files.hpp"

namespace rigor::cli {
namespace {

std::string clock(double seconds) {
    const long total = std::lround(seconds);
    char text[32];
    std::snprintf(text, sizeof text, "%ld:%02ld", total / 60, total % 60);
    return text;
}

constexpr int kBarWidth = 24;

}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), live_(canRewriteLines(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() {
    finish();
}

std::string ProgressLine::liveText(const validation::Progress& p) const {
    const double share = p.total > 0 ? static_cast<double>(p.done) / static_cast<double>(p.total) : 1.0;
    const int filled = static_cast<int>(share * kBarWidth);
    std::string text = "[" + std::string(static_cast<std::size_t>(filled), '#') +
                       std::string(static_cast<std::size_t>(kBarWidth - filled), '.') + "] " +
                       std::to_string(p.done) + "/" + std::to_string(p.total);
    if (p.failed > 0) text += "  " + std::to_string(p.failed) + " failed";
    if (p.crashed > 0) text += "  " + std::to_string(p.crashed) + " crashed";
    if (p.etaSeconds >= 0.0) text += "  ETA " + clock(p.etaSeconds);
    if (!p.current.empty()) text += "  " + p.current;
    const auto columns = static_cast<std::size_t>(std::max(20, terminalColumns(STDERR_FILENO) - 1));
    if (text.size() > columns) text.resize(columns);
    return text;
}

namespace {

/// "C ran", "E known deviation", "C ran, worse than on record".
std::string endingOf(const results::CaseRow& row) {
    std::string text = results::gradeName(row.accuracy.grade);
    text += (text.empty() ? "" : " ") + std::string(report::shownText(report::shownOf(row)).word);
    if (row.regression == results::Regression::Worse || row.regression == results::Regression::Better)
        text += std::string(", ") + results::regressionName(row.regression) + " than on record";
    return text;
}

}  // namespace

void ProgressLine::update(const validation::Progress& p) {
    if (quiet_) return;
    if (live_) {
        std::fprintf(stderr, "\r\033[K%s", liveText(p).c_str());
        std::fflush(stderr);
        shown_ = true;
    } else if (p.finished != nullptr) {
        const auto& c = *p.finished;
        const std::string eta = p.etaSeconds >= 0.0 && p.done < p.total ? "  ETA " + clock(p.etaSeconds) : "";
        std::fprintf(stderr, "[%lld/%lld] %s  %s  dt=%.6g  %s  %.2f s%s%s%s\n",
                     static_cast<long long>(p.done), static_cast<long long>(p.total), c.scenario.c_str(),
                     c.spec.c_str(), c.dt, endingOf(c).c_str(), c.wallSeconds, eta.c_str(),
                     c.reason.empty() ? "" : "  ", scenario::printable(c.reason).c_str());
    }
}

void ProgressLine::finish() {
    if (shown_) std::fprintf(stderr, "\r\033[K");
    shown_ = false;
}

results::Run orStopped(ProgressLine& line, const std::function<std::string()>& again,
                       const std::function<results::Run()>& work) {
    try {
        auto run = work();
        line.finish();
        return run;
    } catch (const results::EnvironmentError& error) {
        line.finish();
        throw results::EnvironmentError(std::string("the run stopped: ") + error.what() +
                                        ". No case is judged by it. Go on with: " + again());
    }
}

}  // namespace rigor::cli
