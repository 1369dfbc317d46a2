// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The in-house engine's step in stages, and its snapshots.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "adapters/interface/staged.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::adapter {

/// Indices of the scenario's objects in the engine. Bodies are never removed: a dense index is the scenario's
/// plus one, 0 the engine's own body, the world.
struct ScenarioIndices {
    std::vector<int> shape;              ///< index of each shape within its body, by engine shape id
    std::vector<engine::JointId> joint;  ///< joint id by scenario joint
    static int body(std::uint32_t dense) { return static_cast<int>(dense) - 1; }
};

template <class S>
class RigorStaged final : public StagedWorld {
  public:
    RigorStaged(engine::World<S>& world, typename S::Real dt, const ScenarioIndices& indices)
        : world_(world), dt_(dt), indices_(indices) {}

    void beginStep() override {
        iterations_.clear();
        world_.beginStep(dt_);
    }
    bool stepping() const override { return world_.stepping(); }
    std::string nextStage() const override {
        return world_.stepping() ? engine::phaseName(world_.nextPhase()) : "";
    }
    int substep() const override { return world_.stepping() ? world_.substep() : 0; }
    void runStage() override { world_.runPhase(); }

    std::vector<ShapeBox> boxes() const override {
        std::vector<ShapeBox> result;
        for (std::size_t i = 0; i < world_.boxes().size(); ++i) {
            const engine::Aabb<S>& box = world_.boxes()[i];
            result.push_back(
                {shape(static_cast<std::uint32_t>(i)),
                 {fromEngineVec(typename S::Vec(box.min)), fromEngineVec(typename S::Vec(box.max))}});
        }
        return result;
    }
    std::vector<ShapePair> pairs() const override {
        std::vector<ShapePair> result;
        for (const engine::ProxyPair& pair : world_.pairs()) {
            const ShapeName one = shape(pair.a), other = shape(pair.b);
            result.push_back({std::min(one, other), std::max(one, other)});
        }
        return result;
    }

    std::vector<StagedManifold> manifolds() const override {
        std::vector<StagedManifold> result;
        for (const engine::Contact<S>& contact : world_.manifolds()) {
            StagedManifold& m = result.emplace_back();
            m.a = shape(contact.shapeA);
            m.b = shape(contact.shapeB);
            m.normal = fromEngineVec(contact.manifold.normal);
            for (int i = 0; i < contact.manifold.count; ++i) {
                const auto k = static_cast<std::size_t>(i);
                const engine::ManifoldPoint<S>& found = contact.manifold.points[k];
                const bool hasRow = contact.block[k] < world_.rows().blocks.size();
                m.points.push_back({fromEngineVec(found.pointA), fromEngineVec(found.pointB),
                                    -static_cast<double>(found.separation), found.feature,
                                    static_cast<double>(contact.impulses[k].normal),
                                    hasRow ? static_cast<int>(world_.rows().blocks[contact.block[k]].first)
                                           : scenario::kNone});
            }
        }
        return result;
    }

    std::vector<StagedRow> rows() const override {
        const engine::ConstraintRows<S>& from = world_.rows();
        std::vector<StagedRow> result(from.rows.size());
        for (const engine::Block<S>& block : from.blocks)
            for (std::uint32_t k = 0; k < block.rows; ++k)
                fill(result[block.first + k], block, from.rows[block.first + k], k);
        for (std::size_t j = 0; j < indices_.joint.size(); ++j) {
            if (!world_.contains(indices_.joint[j])) continue;
            const auto [first, count] = world_.jointRows(indices_.joint[j]);
            for (std::size_t i = first; i < std::min<std::size_t>(first + count, result.size()); ++i)
                result[i].joint = j;
        }
        return result;
    }

    std::vector<std::vector<int>> islands() const override {
        std::vector<std::vector<int>> result;
        for (std::size_t k = 0; k < world_.islands().count(); ++k) {
            result.emplace_back();
            for (const std::uint32_t body : world_.islands().members(k))
                result.back().push_back(ScenarioIndices::body(body));
        }
        return result;
    }

    void watchIterations(bool on) override {
        iterations_.clear();
        if (!on) return world_.observeIterations(nullptr);
        world_.observeIterations(
            [this](int, const engine::ConstraintRows<S>& rows, typename S::Real residual) {
                StagedIteration& it = iterations_.emplace_back();
                it.substep = substep();
                it.residual = static_cast<double>(residual);
                for (const engine::Row<S>& row : rows.rows)
                    it.impulses.push_back(static_cast<double>(row.impulse));
            });
    }
    const std::vector<StagedIteration>& iterations() const override { return iterations_; }

  private:
    ShapeName shape(std::uint32_t dense) const {
        const engine::ShapeRecord<S>& record = world_.shapes()[dense];
        return {ScenarioIndices::body(record.body), indices_.shape[record.id.index]};
    }
    static void fill(StagedRow& out, const engine::Block<S>& block, const engine::Row<S>& row,
                     std::uint32_t place) {
        using Kind = StagedRow::Kind;
        if (engine::isOfContact(block.kind))
            out.kind = place == 0 && block.kind == engine::BlockKind::Contact ? Kind::Normal : Kind::Friction;
        else
            out.kind = block.kind == engine::BlockKind::Joint ? Kind::Joint : Kind::Limit;
        out.bodyA = ScenarioIndices::body(block.a);
        out.bodyB = ScenarioIndices::body(block.b);
        out.impulse = static_cast<double>(row.impulse);
        out.bias = static_cast<double>(row.bias);
        out.softness = static_cast<double>(row.softness);
        out.error = static_cast<double>(row.error);
        out.effectiveMass = static_cast<double>(row.invK);
    }

    engine::World<S>& world_;
    typename S::Real dt_;
    const ScenarioIndices& indices_;
    std::vector<StagedIteration> iterations_;
};

template <class S>
class RigorSnapshots final : public Snapshots {
  public:
    explicit RigorSnapshots(engine::World<S>& world) : world_(world) {}
    void save(std::vector<unsigned char>& bytes) const override { world_.saveSnapshot(bytes); }
    bool restore(const std::vector<unsigned char>& bytes) override {
        try {
            world_.restoreSnapshot(bytes);
        } catch (const engine::EngineError& error) {
            if (error.id() == "snapshot_world") return false;
            throw;
        }
        return true;
    }

  private:
    engine::World<S>& world_;
};

}  // namespace rigor::adapter
