// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor that reports contact everywhere.
#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public BallCollisions {
  protected:
    CollisionAnswer answer(const ContactPoint& truth) const override {
        CollisionAnswer out = BallCollisions::answer(truth);
        out.overlap = true;
        return out;
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::Faulty>)
