// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The mistake: every pair of shapes goes to the narrow phase; no bounding volumes are compared first.
// Effect: the results stay right, and a step costs n (n - 1) / 2 of its most expensive tests.
// Cure: bounding boxes, and a broad phase that skips most pairs.
#include "engine/faults/fault.hpp"

namespace rigor::engine {
namespace {

template <class S>
class NoCheapRejection final : public Fault<S> {
  public:
    void pairs(std::span<const std::uint8_t> movable, std::vector<ProxyPair>& pairs) const override {
        pairs.clear();
        const auto n = static_cast<std::uint32_t>(movable.size());
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = i + 1; j < n; ++j)
                if (movable[i] || movable[j]) pairs.push_back({i, j});
    }
};

}  // namespace

RIGOR_FAULT(faultNoCheapRejection, NoCheapRejection);

}  // namespace rigor::engine
