// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor whose depths are a centimetre too large, with a point off the surface to match.
#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public BallCollisions {
  protected:
    CollisionAnswer answer(const ContactPoint& truth) const override {
        CollisionAnswer out = BallCollisions::answer(truth);
        for (auto& c : out.contacts) {
            c.depth += 0.01;
            c.pointB += -0.01 * c.normal;
        }
        return out;
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::Faulty>)
