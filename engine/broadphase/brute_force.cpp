// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests every pair. Cost n(n-1)/2 box tests per update; no state. The oracle for the other broad phases.
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {
namespace {

template <class S>
class BruteForce final : public BroadPhase<S> {
  public:
    std::unique_ptr<BroadPhase<S>> clone() const override { return std::make_unique<BruteForce>(*this); }
    void reset() override {}
    void update(std::span<const Aabb<S>> boxes, std::span<const std::uint8_t> movable,
                std::vector<ProxyPair>& pairs, const Tasks&) override {
        pairs.clear();
        const auto n = static_cast<std::uint32_t>(boxes.size());
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = i + 1; j < n; ++j)
                if ((movable[i] || movable[j]) && this->overlap(boxes[i], boxes[j])) pairs.push_back({i, j});
    }
};

}  // namespace

template <class S>
std::unique_ptr<BroadPhase<S>> makeBruteForce() {
    return std::make_unique<BruteForce<S>>();
}
RIGOR_INSTANTIATE_FACTORY(makeBruteForce, BroadPhase);

}  // namespace rigor::engine
