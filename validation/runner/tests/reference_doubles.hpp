// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// References with one fault each, by their names in a scenario; every other name is the real reference.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "validation/references/reference.hpp"

namespace rigor::doubles {

[[noreturn]] inline void hang() {
    for (;;) pause();
}

[[noreturn]] inline void eatMemory() {
    constexpr std::size_t kBlock = 64 << 20;
    for (;;) std::memset(::operator new(kBlock), 1, kBlock);
}

/// Reference at rest for ever; it fails when it is evaluated in the first half of the run.
class FailsWhenEvaluated final : public validation::Reference {
  public:
    FailsWhenEvaluated(double duration, void (*fault)()) : duration_(duration), fault_(fault) {}
    std::vector<int> bodies() const override { return {1}; }
    validation::PartialState exact(int, double t) const override {
        if (t < 0.5 * duration_) fault_();
        return {};
    }

  private:
    double duration_;
    void (*fault_)();
};

inline std::unique_ptr<validation::Reference> makeReference(const scenario::Scenario& s) {
    const std::string name = s.reference ? s.reference->name : "";
    if (name == "double_hangs") hang();
    if (name == "double_eats_memory") eatMemory();
    if (name == "double_crashes") std::abort();
    if (name == "double_hangs_when_evaluated") return std::make_unique<FailsWhenEvaluated>(s.duration, hang);
    if (name == "double_crashes_when_evaluated")
        return std::make_unique<FailsWhenEvaluated>(s.duration, std::abort);
    return validation::makeReference(s);
}

}  // namespace rigor::doubles
