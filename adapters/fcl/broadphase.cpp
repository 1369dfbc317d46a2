// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// FCL's managers. Each box is a collision object at the identity whose local bounds are overwritten with the
// box (a little grown), so that no rounding of a centre and sides comes between.
#include "adapters/fcl/broadphase.hpp"

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>
#include <fcl/geometry/shape/box.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "adapters/fcl/shapes.hpp"

namespace rigor::fcl_adapter {
namespace {

using adapter::Aabb;
using adapter::Pair;
using Manager = fcl::BroadPhaseCollisionManagerd;

/// Relative growth of the boxes given to FCL: its sorted lists miss pairs whose ends coincide. Pairs that
/// only the growth adds are removed again.
constexpr double kGrowth = 1e-12;

/// Cells of twice the mean extent over twice the region of the boxes: those that leave it are paired with all
/// others that did. The hash has as many buckets as boxes, at least the default.
std::unique_ptr<Manager> spatialHash(std::span<const Aabb> boxes) {
    fcl::Vector3d low(0, 0, 0), high(1, 1, 1);
    double extent = 0.0;
    for (const Aabb& box : boxes) {
        low = low.cwiseMin(toFcl(box.min));
        high = high.cwiseMax(toFcl(box.max));
        const adapter::Vec3 size = box.max - box.min;
        extent += std::max({size.x, size.y, size.z}) / boxes.size();
    }
    const fcl::Vector3d room = 0.5 * (high - low);
    low -= room;
    high += room;
    const double cell = std::max(2.0 * extent, 1e-3 * (high - low).maxCoeff());
    const auto buckets = static_cast<unsigned>(std::max<std::size_t>(1000, boxes.size()));
    return std::make_unique<fcl::SpatialHashingCollisionManagerd<>>(cell, low, high, buckets);
}

int indexOf(const fcl::CollisionObjectd& object) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(object.getUserData()));
}
bool addPair(fcl::CollisionObjectd* p, fcl::CollisionObjectd* q, void* found) {
    const auto [a, b] = std::minmax({indexOf(*p), indexOf(*q)});
    if (a != b) static_cast<std::vector<Pair>*>(found)->push_back({a, b});
    return false;  // go on
}
/// Callback of the hash, which passes all objects of a bucket, and all that left its region, without a test
/// of their bounds: the callback tests them.
bool addPairInTouch(fcl::CollisionObjectd* p, fcl::CollisionObjectd* q, void* found) {
    return p->getAABB().overlap(q->getAABB()) && addPair(p, q, found);
}

struct Algorithm {
    const char* name;
    std::unique_ptr<Manager> (*create)(std::span<const Aabb> boxes);
    fcl::CollisionCallBack<double> add = addPair;
};
template <class M>
std::unique_ptr<Manager> createManager(std::span<const Aabb>) {
    return std::make_unique<M>();
}
constexpr Algorithm kAlgorithms[] = {
    {"naive", createManager<fcl::NaiveCollisionManagerd>},
    {"ssap", createManager<fcl::SSaPCollisionManagerd>},
    {"sap", createManager<fcl::SaPCollisionManagerd>},
    {"interval_tree", createManager<fcl::IntervalTreeCollisionManagerd>},
    {"spatial_hash", spatialHash, addPairInTouch},
    {"dynamic_aabb_tree", createManager<fcl::DynamicAABBTreeCollisionManagerd>},
    {"dynamic_aabb_tree_array", createManager<fcl::DynamicAABBTreeCollisionManager_Array<double>>},
};

class FclBroadPhase final : public adapter::TimedBroadPhase {
  public:
    explicit FclBroadPhase(const Algorithm& algorithm) : algorithm_(algorithm) {}

    void take(std::span<const Aabb> boxes) override {
        boxes_.clear();
        for (const Aabb& box : boxes) boxes_.push_back(grown(box));
        if (boxes.empty() || (manager_ && boxes.size() == objects_.size())) return;
        rebuild(boxes);
    }
    void run() override {
        found_.clear();
        if (boxes_.empty()) return;
        for (std::size_t i = 0; i < boxes_.size(); ++i) place(i);
        manager_->update();
        manager_->collide(&found_, algorithm_.add);
    }
    void held(std::vector<Pair>& pairs) override { pairs = found_; }

  private:
    static fcl::AABBd grown(const Aabb& box) {
        fcl::Vector3d low = toFcl(box.min), high = toFcl(box.max);
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] -= kGrowth * (1.0 + std::abs(low[axis]));
            high[axis] += kGrowth * (1.0 + std::abs(high[axis]));
        }
        return {low, high};
    }

    void place(std::size_t i) {
        geometries_[i]->aabb_local = boxes_[i];
        objects_[i]->computeAABB();
    }

    void rebuild(std::span<const Aabb> boxes) {
        manager_.reset();
        objects_.clear();
        geometries_.clear();
        std::vector<fcl::CollisionObjectd*> raw;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            geometries_.push_back(std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0));
            objects_.push_back(std::make_unique<fcl::CollisionObjectd>(geometries_.back()));
            objects_.back()->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
            place(i);
            raw.push_back(objects_.back().get());
        }
        manager_ = algorithm_.create(boxes);
        manager_->registerObjects(raw);
        manager_->setup();
    }

    const Algorithm& algorithm_;
    std::vector<std::shared_ptr<fcl::Boxd>> geometries_;
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
    std::unique_ptr<Manager> manager_;
    std::vector<fcl::AABBd> boxes_;
    std::vector<Pair> found_;
};

}  // namespace

std::vector<std::string> FclBroadPhaseEngine::algorithms() const {
    std::vector<std::string> names;
    for (const Algorithm& algorithm : kAlgorithms) names.emplace_back(algorithm.name);
    return names;
}

std::unique_ptr<adapter::TimedBroadPhase> FclBroadPhaseEngine::createTimed(const std::string& name,
                                                                           int dimension,
                                                                           const adapter::Settings*) const {
    if (dimension != 2 && dimension != 3)
        throw adapter::notInAdapter("fcl", "broad phase of dimension " + std::to_string(dimension));
    for (const Algorithm& algorithm : kAlgorithms)
        if (name == algorithm.name) return std::make_unique<FclBroadPhase>(algorithm);
    throw adapter::notInAdapter("fcl", "broad phase '" + name + "'");
}

}  // namespace rigor::fcl_adapter
