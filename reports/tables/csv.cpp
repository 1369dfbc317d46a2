// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/tables/csv.hpp"

#include "reports/encoding/text.hpp"
#include "reports/model/view_model.hpp"
#include "validation/results/insertion_orders.hpp"

namespace rigor::report {
namespace {

constexpr std::size_t kColumns = 34;
constexpr const char* kHeader =
    "scenario,engine,spec,preset,precision,dt,outcome,verdict,metric,subject,kind,value,unit,at,bound,"
    "metric_verdict,note,expectation,exact,scheme_exact,grade,regression,scale,relative,ideal,recorded,"
    "order_min,order_max,order_count,orders,orders_failed,order_dependent,bound_min,command,non_finite\n";

/// The numbers of a line; those that are not finite leave their cell empty and are named at its end.
class Numbers {
  public:
    std::string operator()(const char* column, const std::optional<double>& value) {
        if (!value) return "";
        const std::string text = finiteText(*value);
        if (text.empty()) reason_ += (reason_.empty() ? "" : "; ") + nonFiniteText(column, *value);
        return text;
    }
    const std::string& reason() const { return reason_; }

  private:
    std::string reason_;
};

std::string countText(const std::optional<std::int64_t>& count) {
    return count ? std::to_string(*count) : "";
}

void appendLine(std::string& out, const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) out += ',';
        out += csvField(fields[i]);
    }
    out += '\n';
}

}  // namespace

void csvReport(const results::Run& run, const std::function<void(std::string_view)>& write) {
    write(kHeader);
    for (const auto& row : run.cases) {
        std::string out;
        const std::vector<std::string> head{row.scenario,
                                            row.engine,
                                            row.spec,
                                            row.preset,
                                            precisionOf(run, row),
                                            fullNumber(row.dt),
                                            results::outcomeName(row.outcome),
                                            results::verdictName(row.verdict)};
        const std::string dependence = results::orderDependenceName(results::orderDependence(row));
        const auto line = [&](const std::vector<std::string>& rest, const std::string& nonFinite) {
            auto fields = head;
            fields.insert(fields.end(), rest.begin(), rest.end());
            fields.resize(kColumns - 1);
            fields.push_back(row.command);
            fields.push_back(nonFinite);
            appendLine(out, fields);
        };
        for (const auto& m : row.metrics) {
            Numbers number;
            const std::string value = number("value", m.value), at = m.at < 0.0 ? "" : number("at", m.at),
                              bound = number("bound", m.bound),
                              expectation = number("expectation", m.expectation),
                              scale = number("scale", m.scale), relative = number("relative", m.relative),
                              ideal = number("ideal", m.ideal), recorded = number("recorded", m.recorded),
                              orderMin = number("order_min", m.orderMin),
                              orderMax = number("order_max", m.orderMax),
                              boundMin = number("bound_min", m.boundMin);
            line({m.name,
                  m.subject,
                  m.kind,
                  value,
                  m.unit,
                  at,
                  bound,
                  results::verdictName(m.verdict),
                  m.note,
                  expectation,
                  "",
                  "",
                  results::gradeName(row.accuracy.grade),
                  results::regressionName(row.regression),
                  scale,
                  relative,
                  ideal,
                  recorded,
                  orderMin,
                  orderMax,
                  countText(m.orderCount),
                  countText(row.orders.run),
                  countText(row.orders.failed),
                  dependence,
                  boundMin},
                 number.reason());
        }
        for (const auto& q : row.quantities) {
            Numbers number;
            const std::string value = number("value", q.measured), exact = number("exact", q.exact),
                              scheme = number("scheme_exact", q.schemeExact);
            line({q.name, "", "quantity", value, q.unit, "", "", "", "", "", exact, scheme}, number.reason());
        }
        const bool hasNumbers = !row.metrics.empty() || !row.quantities.empty();
        if (!hasNumbers || row.outcome != results::Outcome::Completed)  // every case is in the file
            line({"", "", "", "", "", "", "", "", row.reason, "", "", ""}, "");
        write(out);
    }
}

std::string csvReport(const results::Run& run) {
    std::string out;
    csvReport(run, [&](std::string_view lines) { out += lines; });
    return out;
}

}  // namespace rigor::report
