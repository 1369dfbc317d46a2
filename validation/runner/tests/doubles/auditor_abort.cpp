// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor that aborts on every query.
#include <cstdlib>

#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class Faulty : public BallCollisions {
  protected:
    CollisionAnswer answer(const ContactPoint& truth) const override {
        if (truth.depth > -1e300) std::abort();
        return {};
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::Faulty>)
