// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/same_bits/same_bits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <random>

#include "adapters/interface/prepared_engine.hpp"
#include "validation/runner/stepper.hpp"

namespace rigor::validation {
namespace {

std::string exact(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::size_t stepsOf(const SameBitsCase& one) {
    const auto all = static_cast<std::size_t>(std::max(1.0, std::round(one.scenario.duration / one.dt)));
    return one.mostSteps > 0 ? std::min(one.mostSteps, all) : all;
}

/// Steps to `target` steps; hashes go to their places.
void advance(Stepper& stepper, adapter::World& world, std::size_t target, StateHashes& hashes) {
    while (stepper.steps() < target) {
        stepper.begin();
        world.step();
        stepper.end();
        hashes[stepper.steps() - 1] = stepper.stateHash();
    }
}

}  // namespace

std::string caseKey(const std::string& scenario, const std::string& spec, double dt) {
    return scenario + " " + spec + " " + exact(dt);
}

StateHashes statesOf(const SameBitsCase& one) {
    const adapter::PreparedEngine engine = adapter::prepareEngine(one.spec, one.scenario, one.dt);
    const auto world = engine.build(one.scenario, one.dt);
    Stepper stepper(one.scenario, one.dt, *world);
    StateHashes hashes(stepsOf(one));
    advance(stepper, *world, hashes.size(), hashes);
    return hashes;
}

std::optional<StateHashes> restoredStatesOf(const SameBitsCase& one, unsigned seed) {
    const adapter::PreparedEngine engine = adapter::prepareEngine(one.spec, one.scenario, one.dt);
    const auto world = engine.build(one.scenario, one.dt);
    adapter::Snapshots* const snapshots = world->snapshots();
    if (snapshots == nullptr) return std::nullopt;
    Stepper stepper(one.scenario, one.dt, *world);
    StateHashes hashes(stepsOf(one));
    std::mt19937 random(seed);
    std::vector<unsigned char> saved;
    std::size_t from = 0;
    for (int times = 0; times < 3 && from < hashes.size(); ++times) {
        const std::size_t at = from + random() % (hashes.size() - from);
        advance(stepper, *world, at, hashes);
        snapshots->save(saved);
        const std::size_t ahead = std::min<std::size_t>(hashes.size(), at + 1 + random() % 30);
        advance(stepper, *world, ahead, hashes);
        // A joint may have broken meanwhile: the state before cannot be taken back, and the run goes on.
        if (snapshots->restore(saved)) stepper.jumpTo(at);
        from = at;
    }
    advance(stepper, *world, hashes.size(), hashes);
    return hashes;
}

std::optional<SameBitsCase> onTwoThreads(const SameBitsCase& one) {
    const adapter::LoadedEngine engine = adapter::loadEngine(one.spec);
    for (const adapter::Option& option : engine->options())
        if (option.key == "threads") {
            SameBitsCase other = one;
            other.spec.options["threads"] = "2";
            return other;
        }
    return std::nullopt;
}

std::optional<std::size_t> firstDifference(const StateHashes& a, const StateHashes& b) {
    const std::size_t both = std::min(a.size(), b.size());
    for (std::size_t i = 0; i < both; ++i)
        if (a[i] != b[i]) return i + 1;
    if (a.size() != b.size()) return both + 1;
    return std::nullopt;
}

}  // namespace rigor::validation
