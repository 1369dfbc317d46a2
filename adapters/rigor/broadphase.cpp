// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The in-house broad phases on boxes of their own, in double precision.
#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/parts.hpp"
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::adapter {
namespace {

template <class S>
class RigorBoxes final : public BroadPhase {
  public:
    explicit RigorBoxes(const std::string& algorithm)
        : broadPhase_(engine::findAlgorithm(engine::broadPhaseTable<S>(), "broad_phase", algorithm).make()) {}

    void update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) override {
        boxes_.clear();
        for (const Aabb& box : boxes) boxes_.push_back({toEngineVec<S>(box.min), toEngineVec<S>(box.max)});
        movable_.assign(boxes.size(), 1);
        broadPhase_->update(boxes_, movable_, found_);
        pairs.clear();
        for (const engine::ProxyPair& pair : found_)
            pairs.push_back({static_cast<int>(pair.a), static_cast<int>(pair.b)});
    }

  private:
    std::unique_ptr<engine::BroadPhase<S>> broadPhase_;
    std::vector<engine::Aabb<S>> boxes_;
    std::vector<std::uint8_t> movable_;
    std::vector<engine::ProxyPair> found_;
};

class RigorBroadPhase final : public BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override {
        std::vector<std::string> names;
        for (const auto& entry : engine::broadPhaseTable<engine::Space3d>()) names.emplace_back(entry.name);
        return names;
    }
    std::unique_ptr<BroadPhase> create(const std::string& algorithm, int dimension) const override {
        try {
            if (dimension == 2) return std::make_unique<RigorBoxes<engine::Space2d>>(algorithm);
            return std::make_unique<RigorBoxes<engine::Space3d>>(algorithm);
        } catch (const engine::EngineError& error) {
            throw BadInput(error.what());
        }
    }
};

}  // namespace

std::unique_ptr<BroadPhaseEngine> makeRigorBroadPhase() {
    return std::make_unique<RigorBroadPhase>();
}

}  // namespace rigor::adapter
