// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// ODE's spaces, fed with geoms of a user class whose bounding box is exactly the box given: a dBox would be
// rebuilt from its centre and sides and lose touching pairs to rounding.
#include "adapters/ode/broadphase.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "adapters/ode/library.hpp"

namespace rigor::ode {
namespace {

using adapter::Aabb;
using adapter::Pair;

struct Proxy {
    int index;
    Aabb box;
};

void boxOf(dGeomID geom, dReal bounds[6]) {
    const Aabb& box = static_cast<const Proxy*>(dGeomGetClassData(geom))->box;
    bounds[0] = box.min.x;
    bounds[1] = box.max.x;
    bounds[2] = box.min.y;
    bounds[3] = box.max.y;
    bounds[4] = box.min.z;
    bounds[5] = box.max.z;
}
dColliderFn* noCollider(int) {
    return nullptr;
}

int proxyClass() {
    static const int number = [] {
        dGeomClass c{};
        c.bytes = sizeof(Proxy);
        c.collider = noCollider;
        c.aabb = boxOf;
        return dCreateGeomClass(&c);
    }();
    return number;
}

class OdeBroadPhase final : public adapter::TimedBroadPhase {
  public:
    explicit OdeBroadPhase(std::string algorithm) : algorithm_(std::move(algorithm)) {}
    ~OdeBroadPhase() override { clear(); }

    void take(std::span<const Aabb> boxes) override {
        useLibrary();
        if (space_ == nullptr || boxes.size() != geoms_.size()) rebuild(boxes);
        boxes_.assign(boxes.begin(), boxes.end());
    }
    void run() override {
        useLibrary();
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            static_cast<Proxy*>(dGeomGetClassData(geoms_[i]))->box = boxes_[i];
            dGeomSetPosition(geoms_[i], 0, 0, 0);  // marks the bounds as out of date
        }
        found_.clear();
        dSpaceCollide(space_, &found_, [](void* out, dGeomID g, dGeomID h) {
            const int p = static_cast<const Proxy*>(dGeomGetClassData(g))->index;
            const int q = static_cast<const Proxy*>(dGeomGetClassData(h))->index;
            static_cast<std::vector<Pair>*>(out)->push_back({std::min(p, q), std::max(p, q)});
        });
    }
    void held(std::vector<Pair>& pairs) override { pairs = found_; }

  private:
    void clear() {
        for (const dGeomID geom : geoms_) dGeomDestroy(geom);
        geoms_.clear();
        if (space_ != nullptr) dSpaceDestroy(space_);
        space_ = nullptr;
    }

    void rebuild(std::span<const Aabb> boxes) {
        clear();
        create(boxes);
        dSpaceSetCleanup(space_, 0);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const dGeomID geom = dCreateGeom(proxyClass());
            *static_cast<Proxy*>(dGeomGetClassData(geom)) = {static_cast<int>(i), boxes[i]};
            dSpaceAdd(space_, geom);
            geoms_.push_back(geom);
        }
    }

    void create(std::span<const Aabb> boxes) {
        if (algorithm_ == "simple") {
            space_ = dSimpleSpaceCreate(nullptr);
        } else if (algorithm_ == "hash") {
            space_ = dHashSpaceCreate(nullptr);
        } else if (algorithm_ == "sap") {
            space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
        } else {
            // Boxes that leave this region are kept in the root block, where they are still found.
            double reach = 1.0;
            for (const Aabb& box : boxes)
                for (const double v : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z})
                    reach = std::max(reach, 2.0 * std::abs(v));
            const dVector3 middle = {0, 0, 0}, extents = {reach, reach, reach};
            space_ = dQuadTreeSpaceCreate(nullptr, middle, extents, 6);
        }
    }

    std::string algorithm_;
    dSpaceID space_ = nullptr;
    std::vector<dGeomID> geoms_;
    std::vector<Aabb> boxes_;
    std::vector<Pair> found_;
};

}  // namespace

std::unique_ptr<adapter::TimedBroadPhase> OdeBroadPhaseEngine::createTimed(const std::string& algorithm,
                                                                           int dimension,
                                                                           const adapter::Settings*) const {
    const auto known = algorithms();
    if (std::find(known.begin(), known.end(), algorithm) == known.end())
        throw adapter::notInAdapter("ode", "broad phase '" + algorithm + "'");
    if (dimension != 2 && dimension != 3)
        throw adapter::notInAdapter("ode", "broad phase of dimension " + std::to_string(dimension));
    useLibrary();
    return std::make_unique<OdeBroadPhase>(algorithm);
}

}  // namespace rigor::ode
