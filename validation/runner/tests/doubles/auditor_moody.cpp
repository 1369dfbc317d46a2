// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor whose results are right, but that aborts on overlaps of more than 2 m, ends the process on more
// than 1 m, and never comes back from more than 0.5 m.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class Moody : public BallCollisions {
  protected:
    CollisionAnswer answer(const ContactPoint& truth) const override {
        if (truth.depth > 2.0) std::abort();
        if (truth.depth > 1.0) std::exit(0);
        while (truth.depth > 0.5) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return BallCollisions::answer(truth);
    }
};

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::Moody>)
