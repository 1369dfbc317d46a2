// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <memory>

#include "engine/benchmarks/counted_work.hpp"
#include "engine/broadphase/benchmarks/moving_boxes.hpp"
#include "engine/narrowphase/benchmarks/shape_pairs.hpp"
#include "engine/narrowphase/narrowphases.hpp"

namespace rigor::engine::counted {
namespace {

using namespace benchmark_scene;

/// Updates of `count` boxes in three steps, after two others.
template <class S>
void addBroadPhasesOf(const std::string& space, std::size_t count, std::vector<Work>& all) {
    for (const auto& entry : broadPhaseTable<S>())
        all.push_back({"broad_phase/" + std::string(entry.name) + "/" + space, [entry, count] {
                           struct Scene {
                               std::unique_ptr<BroadPhase<S>> broadPhase;
                               std::vector<MovingBoxes<S>> frames;
                               std::vector<ProxyPair> pairs;
                           };
                           const auto scene = std::make_shared<Scene>();
                           scene->broadPhase = entry.make();
                           MovingBoxes<S> boxes("uniform", count, BoxOrder::Random);
                           scene->pairs.reserve(count);
                           for (int frame = 0; frame < 5; ++frame, boxes.advance())
                               scene->frames.push_back(boxes);
                           const auto update = [scene](std::size_t from, std::size_t to) {
                               for (std::size_t k = from; k < to; ++k)
                                   scene->broadPhase->update(scene->frames[k].boxes, scene->frames[k].movable,
                                                             scene->pairs);
                           };
                           update(0, 2);
                           return [update] { update(2, 5); };
                       }});
}

/// One query of each pair, nothing remembered, and again with what is remembered.
template <class S>
std::function<void()> pairWork(const char* narrowPhase, const PairKind& kind, std::size_t count) {
    const auto pairs = std::make_shared<std::vector<ShapePair<S>>>(shapePairs<S>(kind, count));
    const auto manifolds = std::make_shared<std::vector<Manifold<S>>>(count);
    const CollideFunction<S> collide = findNarrowPhase<S>(narrowPhase);
    return [pairs, manifolds, collide] {
        for (Manifold<S>& m : *manifolds) m.memory = {};
        for (int round = 0; round < 2; ++round)
            for (std::size_t i = 0; i < pairs->size(); ++i) {
                const ShapePair<S>& p = (*pairs)[i];
                collide(p.a, p.Xa, p.b, p.Xb, typename S::Real(1e-3), (*manifolds)[i]);
            }
    };
}

template <class S>
void addPairs(const std::string& space, std::vector<Work>& all) {
    for (const NarrowPhaseEntry& entry : narrowPhases()) {
        // Portal refinement needs up to 10^6 instructions for a pair of round shapes: a few pairs will do.
        const std::size_t count = std::string(entry.name) == "mpr" ? 2 : 20;
        for (const PairKind& kind : pairKinds(S::dim))
            all.push_back({"narrow_phase/" + std::string(entry.name) + "/" + kind.name() + "/" + space,
                           [=] { return pairWork<S>(entry.name, kind, count); }});
    }
}

}  // namespace

void addBroadPhases(std::vector<Work>& all) {
    addBroadPhasesOf<Space3f>("3f", 1000, all);
    addBroadPhasesOf<Space2f>("2f", 1000, all);
}

void addNarrowPhases(std::vector<Work>& all) {
    addPairs<Space3f>("3f", all);
    addPairs<Space3d>("3d", all);
    addPairs<Space2f>("2f", all);
}

}  // namespace rigor::engine::counted
