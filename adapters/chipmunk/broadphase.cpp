// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/chipmunk/broadphase.hpp"

#include <algorithm>
#include <deque>

#include "adapters/chipmunk/convert.hpp"

namespace rigor::chipmunk {
namespace {

using adapter::Aabb;
using adapter::Pair;

struct Proxy {
    int index = 0;
    cpBB box;
};
cpBB boxOf(void* object) {
    return static_cast<const Proxy*>(object)->box;
}

class Index final : public adapter::BroadPhase {
  public:
    explicit Index(const std::string& algorithm) : algorithm_(algorithm) {}

    void update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) override {
        if (boxes.size() != proxies_.size()) rebuild(boxes);
        for (std::size_t i = 0; i < boxes.size(); ++i) proxies_[i].box = toBox(boxes[i]);
        pairs.clear();
        if (boxes.empty()) return;
        cpSpatialIndexReindexQuery(index_.get(), collect, &pairs);
        // A tree's leaves stay as large as they were; a hash reports a pair for each cell that it shares.
        std::erase_if(pairs, [&](const Pair& pair) {
            return !cpBBIntersects(proxies_[pair.a].box, proxies_[pair.b].box);
        });
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    }

  private:
    static cpBB toBox(const Aabb& box) { return cpBBNew(box.min.x, box.min.y, box.max.x, box.max.y); }
    static cpCollisionID collect(void* first, void* second, cpCollisionID id, void* data) {
        const int i = static_cast<const Proxy*>(first)->index, j = static_cast<const Proxy*>(second)->index;
        static_cast<std::vector<Pair>*>(data)->push_back({std::min(i, j), std::max(i, j)});
        return id;
    }
    void rebuild(std::span<const Aabb> boxes) {
        index_.reset();
        double size = 0.0;
        for (const Aabb& box : boxes) size += box.max.x - box.min.x + box.max.y - box.min.y;
        const double cell =
            boxes.empty() ? 1.0 : std::max(0.5 * size / static_cast<double>(boxes.size()), 1e-6);
        const int cells = 10 * static_cast<int>(boxes.size()) + 1;
        index_.reset(algorithm_ == "bb_tree" ? cpBBTreeNew(boxOf, nullptr)
                                             : cpSpaceHashNew(cell, cells, boxOf, nullptr));
        proxies_.clear();
        for (std::size_t i = 0; i < boxes.size(); ++i)
            proxies_.push_back({static_cast<int>(i), toBox(boxes[i])});
        for (Proxy& proxy : proxies_)
            cpSpatialIndexInsert(index_.get(), &proxy, static_cast<cpHashValue>(proxy.index));
    }

    std::string algorithm_;
    std::deque<Proxy> proxies_;  ///< at stable addresses; the index, destroyed first, points at them
    Owned<cpSpatialIndex> index_;
};

}  // namespace

std::unique_ptr<adapter::BroadPhase> ChipmunkBroadPhaseEngine::create(const std::string& algorithm,
                                                                      int dimension) const {
    const auto known = algorithms();
    if (std::find(known.begin(), known.end(), algorithm) == known.end())
        throw adapter::notInLibrary("chipmunk", "broad phase '" + algorithm + "'",
                                    "chipmunk/cpSpatialIndex.h: a tree and a hash for any shapes");
    if (dimension != 2)
        throw adapter::notInLibrary("chipmunk", "broad phase in three dimensions", kTwoDimensions);
    return std::make_unique<Index>(algorithm);
}

}  // namespace rigor::chipmunk
