// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// References decide and integrate by the scales of the scene: in units six decades off, the scenes of the
// library have the same solutions. Rounding is the same in powers of two, so only an absolute threshold can
// make a difference.
#include <gtest/gtest.h>

#include "scenarios/loader/loader.hpp"
#include "validation/references/parts.hpp"
#include "validation/references/tests/other_units.hpp"

namespace rigor::validation {
namespace {

using testing::inUnits;
using testing::Units;

class InOtherUnits : public ::testing::TestWithParam<const char*> {};

TEST_P(InOtherUnits, TheAnswerIsTheSame) {
    const Scenario s =
        scenario::loadScenario(std::string(RIGOR_SOURCE_DIR "/scenarios/library/") + GetParam() + ".json")
            .scenario;
    const auto one = makeReference(s);
    const double big = std::ldexp(1.0, 20), small = std::ldexp(1.0, -20);
    const double end = std::min(s.duration, one->validUntil());
    for (const Units& u : {Units{big, 1024, 1}, Units{small, 1, small}, Units{small, 1.0 / 1024, big}}) {
        Scenario other = s;
        ASSERT_TRUE(inUnits(other, u));
        const auto same = makeReference(other);
        EXPECT_NEAR(std::min(other.duration, same->validUntil()) / u.time, end, 1e-12 * end);
        const auto all = one->quantities(s.timeSteps[0], adapter::Scheme::Unknown),
                   others = same->quantities(other.timeSteps[0], adapter::Scheme::Unknown);
        EXPECT_EQ(all.size(), others.size());
        for (const int body : one->bodies())
            for (int k = 0; k <= 8; ++k) {
                const PartialState a = one->exact(body, end * k / 8),
                                   b = same->exact(body, end * k / 8 * u.time);
                const double size = sizeOf(s.bodies[body]);
                if (a.position) {
                    EXPECT_LT(norm(*b.position / u.length - *a.position), 1e-10 * (size + norm(*a.position)));
                }
                if (a.velocity) {
                    EXPECT_LT(norm(*b.velocity / u.speed() - *a.velocity),
                              1e-10 * (size / end + norm(*a.velocity)));
                }
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Library, InOtherUnits,
                         ::testing::Values("3d/sliding_disc", "3d/spinning_ring", "3d/tripod_slide",
                                           "2d/impact_stronge_2d", "2d/rocking_block_2d",
                                           "2d/cart_pendulum_2d", "2d/double_pendulum_2d",
                                           "3d/heavy_top_steady", "3d/rotating_hoop", "3d/tippe_top",
                                           "2d/quadratic_drag_2d", "3d/damped_springs", "3d/rod_pendulum",
                                           "3d/roll_off_ball", "2d/newtons_cradle_2d", "2d/touching_row_2d",
                                           "2d/slider_crank_2d", "2d/hinge_motor_2d", "3d/rope"),
                         [](const auto& one) {
                             const std::string name = one.param;
                             return name.substr(3);
                         });

}  // namespace
}  // namespace rigor::validation
