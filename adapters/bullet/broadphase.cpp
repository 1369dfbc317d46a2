// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bullet's broad phases as sets of boxes. All of them are conservative (fattened, quantised or stale pairs).
#include "adapters/bullet/broadphase.hpp"

#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rigor::bullet {
namespace {

using adapter::Aabb;
using adapter::Pair;
using adapter::Vec3;

/// Rounded away from the box where the scalar is coarser than double, so that no overlap is lost.
btScalar roundedDown(double v) {
    const auto s = static_cast<btScalar>(v);
    return s > v ? std::nextafter(s, -std::numeric_limits<btScalar>::max()) : s;
}
btScalar roundedUp(double v) {
    return -roundedDown(-v);
}
btVector3 lower(const Aabb& box) {
    return {roundedDown(box.min.x), roundedDown(box.min.y), roundedDown(box.min.z)};
}
btVector3 upper(const Aabb& box) {
    return {roundedUp(box.max.x), roundedUp(box.max.y), roundedUp(box.max.z)};
}

/// The dispatcher is only there to be passed on: no pools of manifolds for it.
btDefaultCollisionConstructionInfo smallPools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 1;
    return info;
}

class BulletBroadPhase final : public adapter::TimedBroadPhase {
  public:
    explicit BulletBroadPhase(std::string algorithm)
        : algorithm_(std::move(algorithm)), configuration_(smallPools()), dispatcher_(&configuration_) {}
    ~BulletBroadPhase() override { clear(); }

    void take(std::span<const Aabb> boxes) override {
        boxes_.resize(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[i] = {lower(boxes[i]), upper(boxes[i])};
        if (boxes.size() != proxies_.size() || !broadphase_) rebuild(boxes);
    }
    void run() override {
        for (std::size_t i = 0; i < boxes_.size(); ++i)
            broadphase_->setAabb(proxies_[i], boxes_[i].low, boxes_[i].high, &dispatcher_);
        broadphase_->calculateOverlappingPairs(&dispatcher_);
    }
    void held(std::vector<Pair>& pairs) override {
        pairs.clear();
        const btBroadphasePairArray& found =
            broadphase_->getOverlappingPairCache()->getOverlappingPairArray();
        for (int k = 0; k < found.size(); ++k) {
            if (found[k].m_pProxy0 == nullptr || found[k].m_pProxy1 == nullptr) continue;
            const int first = indexOf(*found[k].m_pProxy0), second = indexOf(*found[k].m_pProxy1);
            pairs.push_back({std::min(first, second), std::max(first, second)});
        }
    }

  private:
    struct Box {
        btVector3 low, high;
    };
    static int indexOf(const btBroadphaseProxy& proxy) {
        return static_cast<int>(reinterpret_cast<std::intptr_t>(proxy.m_clientObject)) - 1;
    }

    void clear() {
        for (btBroadphaseProxy* proxy : proxies_) broadphase_->destroyProxy(proxy, &dispatcher_);
        proxies_.clear();
        broadphase_.reset();
    }

    void rebuild(std::span<const Aabb> boxes) {
        clear();
        create(boxes);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            // The client pointer only has to be distinct and not null: Bullet keeps it and never looks
            // inside.
            void* client = reinterpret_cast<void*>(static_cast<std::intptr_t>(i + 1));
            proxies_.push_back(broadphase_->createProxy(boxes_[i].low, boxes_[i].high, BOX_SHAPE_PROXYTYPE,
                                                        client, btBroadphaseProxy::DefaultFilter,
                                                        btBroadphaseProxy::AllFilter, &dispatcher_));
        }
    }

    void create(std::span<const Aabb> boxes) {
        const auto count = boxes.size() + 1;
        if (algorithm_ == "simple") {
            broadphase_ = std::make_unique<btSimpleBroadphase>(static_cast<int>(count));
        } else if (algorithm_ == "dbvt") {
            broadphase_ = std::make_unique<btDbvtBroadphase>();
        } else {
            // Coordinates are quantised to 32 bits within these bounds and clamped outside, which can only
            // add pairs.
            double reach = 1.0;
            for (const Aabb& box : boxes)
                for (const double v : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z})
                    reach = std::max(reach, 4.0 * std::abs(v));
            const auto bound = static_cast<btScalar>(reach);
            broadphase_ = std::make_unique<bt32BitAxisSweep3>(btVector3(-bound, -bound, -bound),
                                                              btVector3(bound, bound, bound),
                                                              static_cast<unsigned>(count));
        }
    }

    std::string algorithm_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    std::unique_ptr<btBroadphaseInterface> broadphase_;
    std::vector<btBroadphaseProxy*> proxies_;
    std::vector<Box> boxes_;
};

}  // namespace

std::unique_ptr<adapter::TimedBroadPhase> BulletBroadPhaseEngine::createTimed(
    const std::string& algorithm, int dimension, const adapter::Settings*) const {
    const auto known = algorithms();
    if (std::find(known.begin(), known.end(), algorithm) == known.end())
        throw adapter::notInAdapter("bullet", "broad phase '" + algorithm + "'");
    if (dimension != 2 && dimension != 3)
        throw adapter::notInAdapter("bullet", "broad phase of dimension " + std::to_string(dimension));
    return std::make_unique<BulletBroadPhase>(algorithm);
}

}  // namespace rigor::bullet
