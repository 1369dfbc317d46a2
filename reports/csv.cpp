// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/text.hpp"
#include "reports/writers.hpp"

namespace rigor::report {
namespace {

constexpr std::size_t kColumns = 27;
constexpr const char* kHeader =
    "scenario,engine,spec,preset,precision,dt,outcome,verdict,metric,subject,kind,value,unit,at,bound,"
    "metric_verdict,note,expectation,exact,scheme_exact,grade,regression,scale,relative,ideal,recorded,"
    "command\n";

std::string optionalNumber(const std::optional<double>& value) {
    return value ? fullNumber(*value) : std::string();
}

void appendLine(std::string& out, const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) out += ',';
        out += csvField(fields[i]);
    }
    out += '\n';
}

}  // namespace

std::string csvReport(const results::Run& run) {
    std::string out = kHeader;
    for (const auto& row : run.cases) {
        const std::vector<std::string> head{row.scenario,
                                            row.engine,
                                            row.spec,
                                            row.preset,
                                            precisionOf(run, row),
                                            fullNumber(row.dt),
                                            results::outcomeName(row.outcome),
                                            results::verdictName(row.verdict)};
        const auto line = [&](const std::vector<std::string>& rest) {
            auto fields = head;
            fields.insert(fields.end(), rest.begin(), rest.end());
            fields.resize(kColumns - 1);
            fields.push_back(row.command);
            appendLine(out, fields);
        };
        for (const auto& m : row.metrics)
            line({m.name, m.subject, m.kind, fullNumber(m.value), m.unit, m.at < 0.0 ? "" : fullNumber(m.at),
                  optionalNumber(m.bound), results::verdictName(m.verdict), m.note,
                  optionalNumber(m.expectation), "", "", results::gradeName(row.accuracy.grade),
                  results::regressionName(row.regression), optionalNumber(m.scale),
                  optionalNumber(m.relative), optionalNumber(m.ideal), optionalNumber(m.recorded)});
        for (const auto& q : row.quantities)
            line({q.name, "", "quantity", optionalNumber(q.measured), q.unit, "", "", "", "", "",
                  fullNumber(q.exact), optionalNumber(q.schemeExact)});
        if (row.metrics.empty() && row.quantities.empty())  // every case is in the file
            line({"", "", "", "", "", "", "", "", row.reason, "", "", ""});
    }
    return out;
}

}  // namespace rigor::report
