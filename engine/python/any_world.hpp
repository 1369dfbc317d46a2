// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// rigor.World: one class of Python for worlds of both dimensions and precisions. TypedWorld<S> does the work.
//
// Bodies, shapes and joints have the numbers in which they were added; none is removed but joints, whose numbers are not
// used again. Calls from two threads at once are refused (Turn).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "engine/python/joint_args.hpp"
#include "engine/python/numbers.hpp"
#include "engine/python/shape_args.hpp"

namespace rigor::engine::python {

/// A body, shape or joint by its number or name.
using Key = std::variant<py::ssize_t, std::string>;
/// None: the world itself.
using MaybeKey = std::optional<Key>;

struct BodyArgs {
    std::string name, type;
    MaybeNumbers position, orientation, velocity, angularVelocity, centerOfMass, inertia;
    double mass = 0, linearVelocityKept = 1, angularVelocityKept = 1, gravityScale = 1;
    bool collides = true;
    std::optional<bool> continuous;
};

struct ShapePlace {
    MaybeNumbers position, orientation, surfaceVelocity, surfaceAngularVelocity;
    Key material = py::ssize_t{1};
    double density = 1000;
    bool sensor = false;
    std::uint32_t layers = 1, mask = 0xffffffffu;
    int group = 0;
};

struct MaterialArgs {
    double friction = 0, restitution = 0, staticFriction = 0, rollingFriction = 0, torsionalFriction = 0;
};

/// The right to use a world, held during a call. Throws std::runtime_error where another thread holds it.
class Turn {
  public:
    explicit Turn(std::atomic_flag& taken) : taken_(taken) {
        if (taken_.test_and_set(std::memory_order_acquire))
            throw std::runtime_error("the world is in use by another thread");
    }
    ~Turn() { taken_.clear(std::memory_order_release); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

  private:
    std::atomic_flag& taken_;
};

/// Names and their numbers.
class Names {
  public:
    explicit Names(const char* kind) : kind_(kind) {}
    /// Throws EngineError "name" for one that is there already.
    void check(const std::string& name) const;
    /// Checks the name, and adds it. An empty one becomes the kind and the number.
    void add(const std::string& name);
    std::size_t size() const { return names_.size(); }
    const std::vector<std::string>& all() const { return names_; }
    /// Throws IndexError for a number out of range, KeyError for an unknown name.
    std::size_t find(const Key& key) const;

  private:
    const char* kind_;
    std::vector<std::string> names_;
};

class AnyBatch;

class AnyWorld {
  public:
    virtual ~AnyWorld() = default;

    virtual int dimension() const = 0;
    virtual const char* precision() const = 0;
    virtual py::dict settings() const = 0;
    double timeStep() const { return timeStep_; }
    void setTimeStep(double h);
    const Names& bodies() const { return bodies_; }
    const Names& joints() const { return joints_; }
    const Names& materials() const { return materials_; }

    // --- building
    virtual std::size_t addMaterial(const MaterialArgs& args, const std::string& name) = 0;
    virtual void setPair(const Key& a, const Key& b, const MaterialArgs& args) = 0;
    virtual std::size_t addBody(const BodyArgs& args) = 0;
    virtual std::size_t addShape(const Key& body, const ShapeArgs& shape, const ShapePlace& place) = 0;
    virtual std::size_t addJoint(const JointArgs& args, const MaybeKey& a, const MaybeKey& b,
                                 const std::string& name) = 0;
    virtual void addConstantForce(const Key& body, const Numbers& force, const MaybeNumbers& torque,
                                  double start, double end) = 0;
    virtual void addDrag(const Key& body, double linear, double quadratic) = 0;
    virtual void addSpring(const MaybeKey& a, const MaybeKey& b, const MaybeNumbers& anchorA,
                           const MaybeNumbers& anchorB, double stiffness, double damping, double length) = 0;

    // --- running
    virtual void step(py::ssize_t steps, std::optional<double> h) = 0;
    virtual void applyForce(const Key& body, const Numbers& force, const MaybeNumbers& torque) = 0;
    virtual void applyImpulse(const Key& body, const Numbers& impulse, const MaybeNumbers& angular) = 0;
    virtual void applyWrenches(const Numbers& wrenches) = 0;

    // --- state
    virtual double time() const = 0;
    virtual py::array states() const = 0;
    virtual void setStates(const Numbers& states) = 0;
    virtual void setPose(const Key& body, const Numbers& position, const MaybeNumbers& orientation) = 0;
    virtual void setVelocity(const Key& body, const Numbers& velocity, const MaybeNumbers& angular) = 0;
    virtual py::object gravity() const = 0;
    virtual void setGravity(const Numbers& gravity) = 0;
    virtual py::dict body(const Key& body) const = 0;
    virtual double energy() const = 0;
    virtual py::array contacts() const = 0;
    virtual py::dict lastStep() const = 0;
    virtual py::list events() const = 0;

    // --- joints
    virtual bool jointHolds(const Key& joint) const = 0;
    virtual double jointCoordinate(const Key& joint, int axis) const = 0;
    virtual double jointSpeed(const Key& joint, int axis) const = 0;
    virtual py::object jointForce(const Key& joint) const = 0;
    virtual py::object jointTorque(const Key& joint) const = 0;
    virtual void setJointAxis(const Key& joint, int axis, const AxisArgs& control) = 0;
    virtual void setJointMotor(const Key& joint, int axis, double speed, double maxForce) = 0;
    virtual void setJointTarget(const Key& joint, int axis, double target) = 0;
    virtual void removeJoint(const Key& joint) = 0;

    // --- queries
    virtual py::array castRays(const Numbers& origins, const Numbers& translations) = 0;
    virtual py::object castRay(const Numbers& origin, const Numbers& translation) = 0;
    virtual py::object castShape(const ShapeArgs& shape, const Numbers& position, const Numbers& translation,
                                 const MaybeNumbers& orientation) = 0;
    virtual py::array overlapping(const ShapeArgs& shape, const Numbers& position,
                                  const MaybeNumbers& orientation) = 0;
    virtual py::object nearest(const Numbers& point, double most) = 0;

    // --- saving and going on
    virtual py::bytes snapshot() const = 0;
    virtual void restore(const py::bytes& snapshot) = 0;
    virtual std::uint64_t stateHash() const = 0;
    virtual std::shared_ptr<AnyWorld> copy() const = 0;

    /// Worlds of a batch: copies of this one, or one for each of `worlds`, which have this one's type.
    virtual std::shared_ptr<AnyBatch> batch(std::size_t count, int threads) const = 0;
    virtual std::shared_ptr<AnyBatch> batchOf(const std::vector<std::shared_ptr<AnyWorld>>& worlds,
                                              int threads) const = 0;

  protected:
    AnyWorld() = default;
    AnyWorld(const AnyWorld& other)
        : bodies_(other.bodies_),
          joints_(other.joints_),
          materials_(other.materials_),
          timeStep_(other.timeStep_) {}

    Names bodies_{"body"}, joints_{"joint"}, materials_{"material"};
    double timeStep_ = 1.0 / 60;
    mutable std::atomic_flag taken_ = ATOMIC_FLAG_INIT;
};

/// An empty world of a dimension and precision with settings over those of a preset.
std::shared_ptr<AnyWorld> makeWorld(int dimension, const std::string& precision, const std::string& preset,
                                    const MaybeNumbers& gravity, double h, const py::dict& settings);

using WorldClass = py::class_<AnyWorld, std::shared_ptr<AnyWorld>>;
WorldClass bindWorld(py::module_& module);

}  // namespace rigor::engine::python
