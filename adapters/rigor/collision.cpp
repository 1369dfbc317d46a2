// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Collision queries by the in-house narrow phases, in double precision unless the settings say single.
// Contacts are those of the requested algorithm. The signed distance of overlapping shapes is its depth;
// shapes that are apart have the distance and points of closestPoints, exact for every pair.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/timed.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/foreign_narrow_phase.hpp"
#include "adapters/rigor/parts.hpp"
#include "engine/core/error.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::adapter {
namespace {

template <class S>
std::shared_ptr<const engine::NarrowPhase<S>> narrowPhaseOf(const std::string& name) {
    if (isForeignNarrowPhase(name)) {
        if constexpr (S::dim == 3)
            return makeForeignNarrowPhase<S>(name);
        else
            throw notInAdapter("rigor", "narrow_phase=" + name + " in 2D");
    }
    return engine::makeNarrowPhase<S>(name);
}

/// Closest points of shapes that are apart. False where there is no distance (two half-spaces).
template <class S>
bool answerDistance(const engine::Shape<S>& a, const engine::Pose<S>& Xa, const engine::Shape<S>& b,
                    const engine::Pose<S>& Xb, CollisionAnswer& answer) {
    const engine::ClosestPoints<S> found = engine::closestPoints<S>(a, Xa, b, Xb);
    if (!std::isfinite(found.distance) || found.distance == std::numeric_limits<typename S::Real>::lowest())
        return false;
    // The algorithm has found no overlap: below rounding the two may differ.
    answer.signedDistance = std::max(0.0, static_cast<double>(found.distance));
    answer.witnessA = fromEngineVec(found.pointA);
    answer.witnessB = fromEngineVec(found.pointB);
    return true;
}

/// The points of a manifold, in its order.
template <class S>
std::vector<ContactPoint> contactsOf(const engine::Manifold<S>& manifold) {
    std::vector<ContactPoint> points;
    for (int i = 0; i < manifold.count; ++i) {
        const auto& p = manifold.points[i];
        ContactPoint c;
        c.bodyA = 0;
        c.bodyB = 1;
        c.pointA = fromEngineVec(p.pointA);
        c.pointB = fromEngineVec(p.pointB);
        c.normal = fromEngineVec(manifold.normal);
        c.depth = -static_cast<double>(p.separation);
        points.push_back(c);
    }
    return points;
}

template <class S>
CollisionAnswer collideIn(const CollisionQuery& query, const engine::NarrowPhase<S>& narrowPhase) {
    const engine::Shape<S> a = toEngineShape<S>(*query.a.geometry), b = toEngineShape<S>(*query.b.geometry);
    const engine::Pose<S> Xa = toEnginePose<S>(query.a.pose), Xb = toEnginePose<S>(query.b.pose);
    engine::Manifold<S> manifold;
    narrowPhase.collide(a, Xa, b, Xb, typename S::Real(0), manifold);

    CollisionAnswer answer;
    std::vector<ContactPoint> points = contactsOf<S>(manifold);
    orderDeepestFirst(points);
    if (!points.empty()) {
        answer.overlap = points.front().depth >= 0;
        answer.signedDistance = -points.front().depth;
        answer.witnessA = points.front().pointA;
        answer.witnessB = points.front().pointB;
    } else {
        answerDistance<S>(a, Xa, b, Xb, answer);
    }
    for (const ContactPoint& c : points)
        if (c.depth >= 0 && static_cast<int>(answer.contacts.size()) < query.maxContacts)
            answer.contacts.push_back(c);
    return answer;
}

template <class S>
class RigorBatch final : public CollisionBatch {
  public:
    RigorBatch(std::span<const CollisionQuery> queries,
               std::shared_ptr<const engine::NarrowPhase<S>> narrowPhase)
        : narrowPhase_(std::move(narrowPhase)), manifolds_(queries.size()) {
        for (const CollisionQuery& query : queries)
            pairs_.push_back({toEngineShape<S>(*query.a.geometry), toEngineShape<S>(*query.b.geometry),
                              toEnginePose<S>(query.a.pose), toEnginePose<S>(query.b.pose)});
    }
    std::size_t run() override {
        std::size_t contacts = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) contacts += runQuery(i);
        return contacts;
    }
    std::vector<ContactPoint> contacts(std::size_t i) override {
        runQuery(i);
        return contactsOf<S>(manifolds_[i]);
    }

  private:
    struct PosedPair {
        engine::Shape<S> a, b;
        engine::Pose<S> Xa, Xb;
    };
    std::size_t runQuery(std::size_t i) {
        const PosedPair& p = pairs_[i];
        manifolds_[i].memory = {};
        narrowPhase_->collide(p.a, p.Xa, p.b, p.Xb, typename S::Real(0), manifolds_[i]);
        return manifolds_[i].count;
    }
    std::shared_ptr<const engine::NarrowPhase<S>> narrowPhase_;
    std::vector<PosedPair> pairs_;
    std::vector<engine::Manifold<S>> manifolds_;
};

class RigorCollision final : public TimedCollisionEngine {
  public:
    std::vector<std::string> algorithms() const override {
        std::vector<std::string> names = foreignNarrowPhases();
        for (const engine::NarrowPhaseEntry& entry : engine::narrowPhases()) names.push_back(entry.name);
        std::sort(names.begin(), names.end());
        return names;
    }
    CollisionAnswer collide(const CollisionQuery& query) const override {
        checkQueryInput(query);
        const std::string name = algorithmOf(query);
        try {
            if (isSingle(query)) {
                if (query.dimension == 2) return collideIn<engine::Space2f>(query, *planarSingle_.get(name));
                return collideIn<engine::Space3f>(query, *spatialSingle_.get(name));
            }
            if (query.dimension == 2) return collideIn<engine::Space2d>(query, *planar_.get(name));
            return collideIn<engine::Space3d>(query, *spatial_.get(name));
        } catch (const engine::EngineError& error) {
            throw BadInput(error.what());
        }
    }

    std::unique_ptr<CollisionBatch> batch(std::span<const CollisionQuery> queries) const override {
        if (queries.empty()) throw BadInput("a batch of no pairs");
        for (const CollisionQuery& query : queries) checkQueryInput(query);
        const CollisionQuery& first = queries.front();
        const std::string name = algorithmOf(first);
        const auto in = [&]<class S>(const Made<S>& made) -> std::unique_ptr<CollisionBatch> {
            return std::make_unique<RigorBatch<S>>(queries, made.get(name));
        };
        try {
            if (isSingle(first)) return first.dimension == 2 ? in(planarSingle_) : in(spatialSingle_);
            return first.dimension == 2 ? in(planar_) : in(spatial_);
        } catch (const engine::EngineError& error) {
            throw BadInput(error.what());
        }
    }

  private:
    /// Narrow phases by name, made at the first request: another engine's module is loaded once.
    template <class S>
    class Made {
      public:
        std::shared_ptr<const engine::NarrowPhase<S>> get(const std::string& name) const {
            const std::lock_guard lock(mutex_);
            auto& entry = made_[name];
            if (!entry) entry = narrowPhaseOf<S>(name);
            return entry;
        }

      private:
        mutable std::mutex mutex_;
        mutable std::map<std::string, std::shared_ptr<const engine::NarrowPhase<S>>> made_;
    };
    static std::string algorithmOf(const CollisionQuery& query) {
        return query.algorithm.empty() ? engine::WorldDef<engine::Space3d>().narrowPhase : query.algorithm;
    }
    static bool isSingle(const CollisionQuery& query) {
        if (query.settings == nullptr) return false;
        const auto precision = query.settings->find("precision");
        return precision != query.settings->end() && precision->second == "f32";
    }

    Made<engine::Space2f> planarSingle_;
    Made<engine::Space3f> spatialSingle_;
    Made<engine::Space2d> planar_;
    Made<engine::Space3d> spatial_;
};

}  // namespace

std::unique_ptr<CollisionEngine> makeRigorCollision() {
    return std::make_unique<RigorCollision>();
}

}  // namespace rigor::adapter
