// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// This engine gives answers that do not fit the scenario, or far too much of them; the option "fault" says which.
#include <xmmintrin.h>

#include <cfenv>
#include <stdexcept>

#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

class Hostile : public FreeFlightWorld {
  public:
    Hostile(const Scenario& scenario, double dt, const Settings& settings)
        : FreeFlightWorld(scenario, dt, settings), fault_(textSetting(settings, "fault")) {
        if (fault_ == "long_refusal") throw Unsupported(std::string(100u << 20, 'x'));
    }

    void misbehave() override {
        if (!isDue()) return;
        if (fault_ == "long_exception") throw std::runtime_error("\x1b[31m" + std::string(100u << 20, 'x'));
        if (fault_ == "rounding") std::fesetround(FE_UPWARD);
        if (fault_ == "denormals") _mm_setcsr(_mm_getcsr() | 0x8040u);
    }
    void readContacts(std::vector<ContactPoint>& contacts) const override {
        contacts.clear();
        if (fault_ != "contact") return;
        contacts.emplace_back();
        contacts.back().bodyB = 1000000;
    }
    ReadBack readBack() const override {
        ReadBack back = FreeFlightWorld::readBack();
        if (fault_ == "material") back.pairs.push_back({0, 1000000, 0.1, 0.5});
        return back;
    }
    std::vector<LedgerEntry> ledger() const override {
        if (fault_ != "ledger") return {};
        return std::vector<LedgerEntry>(1000000, {"topic", "this", "that", Realisation::Approximate, "why"});
    }
    StepCounters counters() const override {
        StepCounters counters;
        for (int i = 0; fault_ == "phases" && i < 1000; ++i)
            counters.phaseSeconds["phase " + std::to_string(i)] = 0.0;
        return counters;
    }

  private:
    std::string fault_;
};

class HostileEngine final : public DoubleEngine<Hostile> {
  public:
    std::vector<Option> options() const override {
        auto all = doubleOptions();
        Option fault;
        fault.key = "fault";
        fault.values = {"long_exception", "long_refusal", "contact",  "material",
                        "ledger",         "phases",       "rounding", "denormals"};
        fault.defaultValue = fault.matchedValue = "contact";
        all.push_back(fault);
        return all;
    }
};

std::unique_ptr<Engine> makeHostile() {
    return std::make_unique<HostileEngine>();
}

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeHostile)
