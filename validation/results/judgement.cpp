// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/judgement.hpp"

#include <algorithm>

namespace rigor::results {
namespace {

bool fellBehindRecord(const CaseRow& row) {
    if (row.regression != Regression::Worse) return false;
    return row.engine == kInHouseEngine || row.outcome != Outcome::Completed ||
           row.accuracy.grade > recordedGrade(row);
}

}  // namespace

Grade recordedGrade(const CaseRow& row) {
    Grade worst = Grade::None;
    for (const MetricRow& m : row.metrics)
        if (m.recorded && m.scale && *m.scale > 0.0) worst = std::max(worst, gradeOf(*m.recorded / *m.scale));
    return worst;
}

bool isRed(const CaseRow& row) {
    if (fellBehindRecord(row)) return true;
    switch (row.verdict) {
        case Verdict::Pass:
        case Verdict::Unsupported:
        case Verdict::NoReference:
            return false;
        case Verdict::KnownDeviation:
            return row.engine == kInHouseEngine;
        case Verdict::Fail:
        case Verdict::Crashed:
        case Verdict::Timeout:
        case Verdict::NonFinite:
            break;
    }
    return true;
}

}  // namespace rigor::results
