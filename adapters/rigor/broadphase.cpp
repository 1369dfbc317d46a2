// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The in-house broad phases on boxes of their own.
#include <cmath>
#include <limits>

#include "adapters/interface/timed.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/parts.hpp"
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::adapter {
namespace {

template <class S>
class RigorBoxes final : public TimedBroadPhase {
  public:
    explicit RigorBoxes(const std::string& algorithm)
        : broadPhase_(engine::findAlgorithm(engine::broadPhaseTable<S>(), "broad_phase", algorithm).make()) {}

    void take(std::span<const Aabb> boxes) override {
        boxes_.clear();
        for (const Aabb& box : boxes) boxes_.push_back({lower(box.min), upper(box.max)});
        movable_.assign(boxes.size(), 1);
    }
    void run() override { broadPhase_->update(boxes_, movable_, found_); }
    void held(std::vector<Pair>& pairs) override {
        pairs.clear();
        for (const engine::ProxyPair& pair : found_)
            pairs.push_back({static_cast<int>(pair.a), static_cast<int>(pair.b)});
    }

  private:
    using Real = typename S::Real;
    /// Rounded away from the box where the engine's numbers are coarser, so that no overlap is lost.
    static typename S::Vec lower(const Vec3& v) {
        typename S::Vec low = toEngineVec<S>(v);
        const double from[3] = {v.x, v.y, v.z};
        for (int i = 0; i < S::dim; ++i)
            if (static_cast<double>(low[i]) > from[i])
                low[i] = std::nextafter(low[i], -std::numeric_limits<Real>::max());
        return low;
    }
    static typename S::Vec upper(const Vec3& v) { return -lower({-v.x, -v.y, -v.z}); }

    std::unique_ptr<engine::BroadPhase<S>> broadPhase_;
    std::vector<engine::Aabb<S>> boxes_;
    std::vector<std::uint8_t> movable_;
    std::vector<engine::ProxyPair> found_;
};

class RigorBroadPhase final : public TimedBroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override {
        std::vector<std::string> names;
        for (const auto& entry : engine::broadPhaseTable<engine::Space3d>()) names.emplace_back(entry.name);
        return names;
    }
    std::string option() const override { return "broad_phase"; }
    std::unique_ptr<TimedBroadPhase> createTimed(const std::string& algorithm, int dimension,
                                                 const Settings* settings) const override {
        const bool single = settings != nullptr && textSetting(*settings, "precision") == "f32";
        try {
            if (dimension == 2 && single) return std::make_unique<RigorBoxes<engine::Space2f>>(algorithm);
            if (dimension == 2) return std::make_unique<RigorBoxes<engine::Space2d>>(algorithm);
            if (single) return std::make_unique<RigorBoxes<engine::Space3f>>(algorithm);
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
