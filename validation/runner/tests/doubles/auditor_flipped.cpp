// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor whose normals point from B to A.
#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public BallCollisions {
  protected:
    CollisionAnswer answer(const ContactPoint& truth) const override {
        CollisionAnswer out = BallCollisions::answer(truth);
        for (auto& c : out.contacts) c.normal = -c.normal;
        return out;
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::Faulty>)
