// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/refusal.hpp"

#include <gmock/gmock.h>

#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using testing::HasSubstr;

class DeclaredRefusal : public fixtures::RunnerTest {
  protected:
    static CasePlan planOf(const std::string& spec) {
        return fixtures::plan({fixtures::thrownBall("ball")}, spec).at(0);
    }
    EngineDescription described() const { return describeEngine("double_free_flight", options().binary); }
};

TEST_F(DeclaredRefusal, IsThatOfTheFirstFeatureThatIsNotDeclared) {
    EngineDescription d = described();
    const CasePlan c = planOf("double_free_flight:preset=default");
    EXPECT_FALSE(declaredRefusal(c, d)) << "it runs";
    d.capabilities.shapes.clear();
    const auto refusal = declaredRefusal(c, d);
    ASSERT_TRUE(refusal);
    EXPECT_THAT(refusal->what(), HasSubstr("double_free_flight"));
    const auto row = refusedRow(c.scenario.name, c.spec, c.dt, *refusal);
    EXPECT_EQ(row.outcome, results::Outcome::Unsupported);
    ASSERT_EQ(row.ledger.size(), 1u);
    EXPECT_EQ(row.ledger[0].realisation, "unsupported");
}

/// Other modules, engines that could not be described, and errors are for the child.
TEST_F(DeclaredRefusal, IsNoneWhereTheChildHasToFindOut) {
    EngineDescription d = described();
    d.capabilities.shapes.clear();
    const CasePlan c = planOf("double_free_flight:preset=default");
    ASSERT_TRUE(declaredRefusal(c, d));
    EXPECT_FALSE(declaredRefusal(planOf("double_free_flight:precision=f32,preset=default"), d));
    CasePlan wrong = c;
    wrong.dt = -1.0;
    EXPECT_FALSE(declaredRefusal(wrong, d)) << "the time step is an error";
    d.problem = "it crashed";
    EXPECT_FALSE(declaredRefusal(c, d));
}

}  // namespace
}  // namespace rigor::validation
