// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// b2BroadPhase (a dynamic tree of fattened boxes) as a set of boxes. Every proxy is touched before each
// update, so that all pairs are reported and not only new ones; they are then tested against the exact boxes.
#include "adapters/box2d/broadphase.hpp"

#include <box2d/b2_broad_phase.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rigor::box2d {
namespace {

using adapter::Aabb;
using adapter::Pair;

/// Rounded away from the box, so that no overlap is lost in single precision.
float roundedDown(double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) > v ? std::nextafter(f, -std::numeric_limits<float>::max()) : f;
}
b2AABB toBox2d(const Aabb& box) {
    b2AABB aabb;
    aabb.lowerBound.Set(roundedDown(box.min.x), roundedDown(box.min.y));
    aabb.upperBound.Set(-roundedDown(-box.max.x), -roundedDown(-box.max.y));
    return aabb;
}

bool overlap(const Aabb& a, const Aabb& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

class Box2dBroadPhase final : public adapter::BroadPhase {
  public:
    void update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) override {
        for (const Aabb& box : boxes)
            if (!isFinite(box.min) || !isFinite(box.max)) throw adapter::BadInput("box: not finite");
        if (boxes.size() != proxies_.size()) rebuild(boxes);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            tree_->MoveProxy(proxies_[i], toBox2d(boxes[i]), b2Vec2(0.0f, 0.0f));
            tree_->TouchProxy(proxies_[i]);
        }
        Collector collector{boxes, pairs};
        pairs.clear();
        tree_->UpdatePairs(&collector);
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    }

  private:
    struct Collector {
        std::span<const Aabb> boxes;
        std::vector<Pair>& pairs;
        void AddPair(void* first, void* second) {
            const auto indexOf = [](void* data) {
                return static_cast<int>(reinterpret_cast<std::intptr_t>(data));
            };
            const int i = indexOf(first), j = indexOf(second);
            const int a = std::min(i, j), b = std::max(i, j);
            if (overlap(boxes[static_cast<std::size_t>(a)], boxes[static_cast<std::size_t>(b)]))
                pairs.push_back({a, b});
        }
    };

    void rebuild(std::span<const Aabb> boxes) {
        tree_ = std::make_unique<b2BroadPhase>();
        proxies_.clear();
        for (std::size_t i = 0; i < boxes.size(); ++i)
            proxies_.push_back(tree_->CreateProxy(toBox2d(boxes[i]),
                                                  reinterpret_cast<void*>(static_cast<std::intptr_t>(i))));
    }

    std::unique_ptr<b2BroadPhase> tree_ = std::make_unique<b2BroadPhase>();
    std::vector<int32> proxies_;
};

}  // namespace

std::unique_ptr<adapter::BroadPhase> Box2dBroadPhaseEngine::create(const std::string& algorithm,
                                                                   int dimension) const {
    if (algorithm != "dynamic_tree")
        throw adapter::Unsupported("box2d has no broad phase '" + algorithm + "'");
    if (dimension != 2) throw adapter::Unsupported("box2d has no broad phase in three dimensions");
    return std::make_unique<Box2dBroadPhase>();
}

}  // namespace rigor::box2d
