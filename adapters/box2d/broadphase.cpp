// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// b2BroadPhase (a dynamic tree of fattened boxes) as a set of boxes, used as b2World uses it: boxes move with
// their displacement, for which the tree leaves room; UpdatePairs reports pairs that may be new, and pairs
// are kept until their fattened boxes part.
#include "adapters/box2d/broadphase.hpp"

#include <box2d/b2_broad_phase.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "adapters/box2d/convert.hpp"

namespace rigor::box2d {
namespace {

using adapter::Aabb;
using adapter::Pair;

/// Rounded away from the box, so that no overlap is lost in single precision.
float roundedDown(double v) {
    const auto f = static_cast<float>(v);
    return f > v ? std::nextafter(f, -std::numeric_limits<float>::max()) : f;
}
b2AABB boxToBox2d(const Aabb& box) {
    b2AABB aabb;
    aabb.lowerBound.Set(roundedDown(box.min.x), roundedDown(box.min.y));
    aabb.upperBound.Set(-roundedDown(-box.max.x), -roundedDown(-box.max.y));
    return aabb;
}

class Box2dBroadPhase final : public adapter::TimedBroadPhase {
  public:
    void take(std::span<const Aabb> boxes) override {
        if (boxes.size() != proxies_.size()) rebuild(boxes);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const b2AABB box = boxToBox2d(boxes[i]);
            moves_[i].displacement = box.GetCenter() - moves_[i].box.GetCenter();
            moves_[i].box = box;
        }
    }
    void run() override {
        for (std::size_t i = 0; i < proxies_.size(); ++i)
            tree_->MoveProxy(proxies_[i], moves_[i].box, moves_[i].displacement);
        Collector collector{reported_};
        tree_->UpdatePairs(&collector);
    }
    void held(std::vector<Pair>& pairs) override {
        kept_.insert(kept_.end(), reported_.begin(), reported_.end());
        reported_.clear();
        std::erase_if(kept_, [this](const Pair& pair) {
            return !tree_->TestOverlap(proxies_[pair.a], proxies_[pair.b]);
        });
        std::sort(kept_.begin(), kept_.end());
        kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
        pairs = kept_;
    }

  private:
    struct Move {
        b2AABB box;
        b2Vec2 displacement;
    };
    struct Collector {
        std::vector<Pair>& pairs;
        void AddPair(void* first, void* second) {
            const auto indexOf = [](void* data) {
                return static_cast<int>(reinterpret_cast<std::intptr_t>(data));
            };
            const int i = indexOf(first), j = indexOf(second);
            pairs.push_back({std::min(i, j), std::max(i, j)});
        }
    };

    void rebuild(std::span<const Aabb> boxes) {
        tree_ = std::make_unique<b2BroadPhase>();
        proxies_.clear();
        moves_.clear();
        reported_.clear();
        kept_.clear();
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            moves_.push_back({boxToBox2d(boxes[i]), b2Vec2(0.0f, 0.0f)});
            proxies_.push_back(
                tree_->CreateProxy(moves_[i].box, reinterpret_cast<void*>(static_cast<std::intptr_t>(i))));
        }
    }

    std::unique_ptr<b2BroadPhase> tree_ = std::make_unique<b2BroadPhase>();
    std::vector<int32> proxies_;
    std::vector<Move> moves_;
    std::vector<Pair> reported_;  ///< pairs since the last call of held()
    std::vector<Pair> kept_;
};

}  // namespace

std::unique_ptr<adapter::TimedBroadPhase> Box2dBroadPhaseEngine::createTimed(const std::string& algorithm,
                                                                             int dimension,
                                                                             const adapter::Settings*) const {
    if (algorithm != "dynamic_tree")
        throw adapter::notInLibrary("box2d", "broad phase '" + algorithm + "'",
                                    "b2_broad_phase.h, b2BroadPhase: a dynamic tree");
    if (dimension != 2)
        throw adapter::notInLibrary("box2d", "broad phase in three dimensions", kTwoDimensions);
    return std::make_unique<Box2dBroadPhase>();
}

}  // namespace rigor::box2d
