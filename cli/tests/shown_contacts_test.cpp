// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Test from the engines to the page: the contact that the replay draws at the frame that a link of the
// contact audit opens is the one that was measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "reports/model/view_model.hpp"
#include "reports/replay/data.hpp"
#include "reports/tests/replay_reader.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/metrics/metric_parts.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/audit.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/live.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;
using report::replay_reader::ShownContact;
using scenario::Vec3;
using validation::AuditQuery;

constexpr double kAgree = 1e-6;  // [rad]

/// A plank turned by the test by 0.05 rad a step of 1/60 s, a box and a ball on it.
constexpr const char* kTurningPlank = R"({
  "rigor": 1, "name": "turning_plank", "title": "A plank that turns", "source": "none",
  "description": "A plank is turned at 3 rad/s under a box and a ball.",
  "isolates": ["contact normals"], "dimension": 3, "gravity": [0, -9.81, 0], "duration": 0.4, "dt": [0.016666666666666666],
  "materials": {"wood": {"friction": 0.6, "restitution": 0}},
  "bodies": [
    {"name": "plank", "type": "kinematic", "angular_velocity": [0, 0, 3],
     "shapes": [{"box": {"half_extents": [3, 0.2, 3]}, "material": "wood"}]},
    {"name": "box", "mass": 1, "position": [1.2, 0.499, 0],
     "shapes": [{"box": {"half_extents": [0.3, 0.3, 0.3]}, "material": "wood"}]},
    {"name": "ball", "mass": 1, "position": [2.2, 0.499, 0],
     "shapes": [{"sphere": {"radius": 0.3}, "material": "wood"}]}],
  "observe": ["box", "ball"]
})";

Vec3 vec(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

const adapter::ContactPoint& deepestOf(const AuditQuery& q) {
    return *std::max_element(q.own.begin(), q.own.end(),
                             [](const auto& a, const auto& b) { return a.depth < b.depth; });
}

/// The shown contact of the query's shapes that is at the place of the measured contact.
const ShownContact* shownOf(const AuditQuery& q, const std::vector<ShownContact>& shown) {
    const Vec3 where = deepestOf(q).pointA;
    const ShownContact* nearest = nullptr;
    for (const ShownContact& c : shown) {
        if (c.bodyA != q.bodyA || c.bodyB != q.bodyB || c.shapeA != q.shapeA || c.shapeB != q.shapeB)
            continue;
        if (nearest == nullptr || norm(vec(c.pointA) - where) < norm(vec(nearest->pointA) - where))
            nearest = &c;
    }
    return nearest;
}

/// A run of one scene by several engines, stored as `rigor validate` does it.
class ShownContacts : public testing::Test {
  protected:
    void SetUp() override {
        setenv("RIGOR_ADAPTER_PATH", (fs::path(RIGOR_BINARY_DIR) / "bin/adapters").c_str(), 1);
        auto& about = run_.scenarios.emplace_back();
        about.name = scenario_.name;
        about.timeSteps = {kStep};
        for (const char* spec : {"rigor:preset=default", "bullet:preset=default", "ode:preset=default"}) {
            const adapter::EngineSpec engine = adapter::parseSpec(spec);
            auto whole = validation::runWholeCase(scenario_, engine, kStep, {});
            results::CaseRow& row = whole.live.row;
            row.id = "case" + std::to_string(run_.cases.size());
            const validation::MetricInput input{scenario_, whole.live.trajectory, nullptr, whole.scheme};
            results::writeTrajectory(fileOf(row), validation::trajectoryFile(input, row));
            row.audit.push_back(
                validation::inRunRow(scenario_, validation::findQueries(scenario_, row.id, fileOf(row))));
            run_.cases.push_back(std::move(row));
        }
    }
    fs::path fileOf(const results::CaseRow& row) const { return scratch_.path() / (row.id + ".h5"); }

    static constexpr double kStep = 1.0 / 60.0;
    const scenario::Scenario scenario_ =
        scenario::loadScenarioText(kTurningPlank, "turning_plank.json").scenario;
    validation::ScratchFolder scratch_;
    results::Run run_;
};

bool isMeasured(const AuditQuery& q) {
    return q.actedUpon && !q.own.empty() && q.decided && q.signedDistance < -validation::kTouchTolerance;
}

TEST_F(ShownContacts, AreThoseThatTheAuditMeasured) {
    const report::ViewModel view(run_);
    report::ReplayBudget budget;
    report::replay_reader::Bundle bundle(report::replayBundle(
        view, 0, 0,
        [&](const results::CaseRow& row) { return std::optional(results::readTrajectory(fileOf(row))); },
        budget));
    ASSERT_EQ(bundle.meta["cases"].size(), run_.cases.size());
    double worstOfAll = 0.0;
    for (std::size_t c = 0; c < run_.cases.size(); ++c) {
        const auto row = std::find_if(run_.cases.begin(), run_.cases.end(), [&](const auto& one) {
            return one.id == bundle.meta["cases"][c]["id"];
        });
        ASSERT_NE(row, run_.cases.end());
        SCOPED_TRACE(row->spec);
        const auto shown = report::replay_reader::shownContacts(bundle, c);
        const auto requested = validation::findQueries(scenario_, row->id, fileOf(*row));
        const results::AuditRow& audit = row->audit.front();
        // The frame that the link of the worst normal opens.
        const auto at = audit.worst.find(", step ");
        ASSERT_NE(at, std::string::npos) << audit.worst;
        const long linkedStep = std::stol(audit.worst.substr(at + 7));
        std::size_t compared = 0;
        double worst = -1.0, linked = -1.0;
        for (const AuditQuery& q : requested.queries) {
            if (!isMeasured(q)) continue;
            SCOPED_TRACE("step " + std::to_string(q.step));
            const double measured = validation::nearestAngle(deepestOf(q).normal, q.normals);
            const auto frame = shown.find(static_cast<long>(q.step));
            ASSERT_NE(frame, shown.end());
            const ShownContact* drawn = shownOf(q, frame->second);
            ASSERT_NE(drawn, nullptr);
            const double seen = validation::nearestAngle(vec(drawn->normal), q.normals);
            EXPECT_NEAR(seen, measured, kAgree);
            worst = std::max(worst, measured);
            if (q.step == linkedStep) linked = std::max(linked, seen);
            ++compared;
        }
        EXPECT_GE(compared, 8u);
        EXPECT_EQ(audit.normalErrorMax.value(), worst);
        // A false contact is worse than a wrong normal, and has no exact one.
        if (audit.worst.find("(spurious)") == std::string::npos) {
            EXPECT_NEAR(linked, audit.normalErrorMax.value(), kAgree) << audit.worst;
        }
        worstOfAll = std::max(worstOfAll, worst);
    }
    EXPECT_GT(worstOfAll, 1e-3) << "an engine is wrong here, and is shown to be as wrong as measured";
}

}  // namespace
}  // namespace rigor::cli_test
