// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// AnyWorld over one Space.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "engine/python/any_world.hpp"
#include "engine/python/rows.hpp"
#include "engine/python/state_array.hpp"
#include "engine/queries/world_queries.hpp"

namespace rigor::engine::python {

/// Called before every step with its length [s]: what a scenario schedules.
template <class S>
using BeforeStep = std::function<void(World<S>& world, typename S::Real h)>;

/// A world that was built elsewhere, with its handles in the order in which they were added.
template <class S>
struct BuiltWorld {
    World<S> world;
    std::vector<BodyId> bodies;
    std::vector<JointId> joints;
    std::vector<std::string> bodyNames, jointNames, materialNames;
    std::vector<std::uint32_t> materials;
    double timeStep = 1.0 / 60;
    BeforeStep<S> beforeStep;
};

template <class S>
class TypedWorld final : public AnyWorld {
  public:
    using R = typename S::Real;
    using Row = std::conditional_t<S::dim == 2, ContactRow2, ContactRow3>;
    using Hit = std::conditional_t<S::dim == 2, HitRow2, HitRow3>;

    explicit TypedWorld(BuiltWorld<S> built);
    TypedWorld(const TypedWorld& other);

    const World<S>& engineWorld() const { return world_; }
    /// The names and the schedule of this one with another world of the same parts.
    std::shared_ptr<AnyWorld> withEngineWorld(const World<S>& world) const;
    const BeforeStep<S>& beforeStep() const { return beforeStep_; }
    const std::vector<JointId>& jointIds() const { return jointIds_; }
    Turn turn() const { return Turn(taken_); }

    int dimension() const override { return S::dim; }
    const char* precision() const override { return sizeof(R) == sizeof(float) ? "f32" : "f64"; }
    py::dict settings() const override;

    std::size_t addMaterial(const MaterialArgs& args, const std::string& name) override;
    void setPair(const Key& a, const Key& b, const MaterialArgs& args) override;
    std::size_t addBody(const BodyArgs& args) override;
    std::size_t addShape(const Key& body, const ShapeArgs& shape, const ShapePlace& place) override;
    std::size_t addJoint(const JointArgs& args, const MaybeKey& a, const MaybeKey& b,
                         const std::string& name) override;
    void addConstantForce(const Key& body, const Numbers& force, const MaybeNumbers& torque, double start,
                          double end) override;
    void addDrag(const Key& body, double linear, double quadratic) override;
    void addSpring(const MaybeKey& a, const MaybeKey& b, const MaybeNumbers& anchorA,
                   const MaybeNumbers& anchorB, double stiffness, double damping, double length) override;

    void step(py::ssize_t steps, std::optional<double> h) override;
    void applyForce(const Key& body, const Numbers& force, const MaybeNumbers& torque) override;
    void applyImpulse(const Key& body, const Numbers& impulse, const MaybeNumbers& angular) override;
    void applyWrenches(const Numbers& wrenches) override;

    double time() const override { return world_.time(); }
    py::array states() const override { return states_.view(); }
    void setStates(const Numbers& states) override;
    void setPose(const Key& body, const Numbers& position, const MaybeNumbers& orientation) override;
    void setVelocity(const Key& body, const Numbers& velocity, const MaybeNumbers& angular) override;
    py::object gravity() const override { return fromVec(world_.def().gravity); }
    void setGravity(const Numbers& gravity) override;
    py::dict body(const Key& body) const override;
    double energy() const override;
    py::array contacts() const override;
    py::dict lastStep() const override;
    py::list events() const override;

    bool jointHolds(const Key& joint) const override;
    double jointCoordinate(const Key& joint, int axis) const override;
    double jointSpeed(const Key& joint, int axis) const override;
    py::object jointForce(const Key& joint) const override;
    py::object jointTorque(const Key& joint) const override;
    void setJointAxis(const Key& joint, int axis, const AxisArgs& control) override;
    void setJointMotor(const Key& joint, int axis, double speed, double maxForce) override;
    void setJointTarget(const Key& joint, int axis, double target) override;
    void removeJoint(const Key& joint) override;

    py::array castRays(const Numbers& origins, const Numbers& translations) override;
    py::object castRay(const Numbers& origin, const Numbers& translation) override;
    py::object castShape(const ShapeArgs& shape, const Numbers& position, const Numbers& translation,
                         const MaybeNumbers& orientation) override;
    py::array overlapping(const ShapeArgs& shape, const Numbers& position,
                          const MaybeNumbers& orientation) override;
    py::object nearest(const Numbers& point, double most) override;

    py::bytes snapshot() const override;
    void restore(const py::bytes& snapshot) override;
    std::uint64_t stateHash() const override;
    std::shared_ptr<AnyWorld> copy() const override;
    std::shared_ptr<AnyBatch> batch(std::size_t count, int threads) const override;
    std::shared_ptr<AnyBatch> batchOf(const std::vector<std::shared_ptr<AnyWorld>>& worlds,
                                      int threads) const override;

  private:
    BodyId id(const Key& body) const { return bodyIds_[bodies_.find(body)]; }
    BodyId id(const MaybeKey& body) const { return body ? id(*body) : BodyId{}; }
    /// Throws EngineError "joint_broken" for a joint that does not hold any more.
    JointId jointId(const Key& joint) const;
    std::uint32_t material(const Key& key) const { return materialIds_[materials_.find(key)]; }
    std::int32_t number(BodyId body) const;
    std::int32_t number(ShapeId shape) const { return shapeNumbers_[shape.index]; }
    /// Bodies were moved or changed: the states and what queries know are those of before.
    void changed();
    void resizeStates();
    void fillStates();
    WorldQueries<S>& queries();
    template <class Found>
    Hit hitOf(const Found& found, const typename S::Vec& way) const;
    /// Number of steps that were made: all, unless a velocity or pose is no longer finite.
    py::ssize_t stepMany(py::ssize_t steps, R h);

    World<S> world_;
    std::vector<BodyId> bodyIds_;
    std::vector<JointId> jointIds_;
    std::vector<std::uint32_t> materialIds_;
    std::vector<std::int32_t> bodyNumbers_, shapeNumbers_;  ///< numbers by the index of the handle
    std::int32_t shapes_ = 0;
    BeforeStep<S> beforeStep_;
    StateArray<R> states_;
    std::optional<WorldQueries<S>> queries_;
    bool queriesStale_ = true;
};

}  // namespace rigor::engine::python
