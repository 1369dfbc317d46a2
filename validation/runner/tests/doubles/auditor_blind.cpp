// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor that finds nothing.
#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public BallCollisions {
  protected:
    CollisionAnswer answer(const ContactPoint& truth) const override {
        (void)truth;
        return {};
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::Faulty>)
