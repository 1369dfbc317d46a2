// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adapters/interface/unsupported.hpp"
#include "adapters/simbody/forces.hpp"
#include "adapters/simbody/kinematic.hpp"

namespace rigor::simbody {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;
using Kind = Coordinate::Kind;

/// A part of a joint that is to be made; `use` is null for a ball and for what is only free.
struct Part {
    Kind kind;
    Vec3 axis;
    const JointAxis* use = nullptr;
};

class Builder {
  public:
    Builder(const adapter::Scenario& scenario, bool planar) : scenario_(scenario), planar_(planar) {
        model_->forest = adapter::spanningForest(scenario, planar);
        model_->bodies.resize(scenario.bodies.size());
        model_->coordinates.resize(scenario.bodies.size());
        model_->gravity = SimTK::Force::Gravity(model_->forces, model_->matter, toSimbody(scenario.gravity));
        model_->discrete = SimTK::Force::DiscreteForces(model_->forces, model_->matter);
        for (const int body : model_->forest.order) addBody(body);
        for (const Link& tied : model_->forest.links)
            if (tied.joint != kNone) addTreeJoint(scenario.joints[tied.joint]);
        for (std::size_t j = 0; j < scenario.joints.size(); ++j) addLoop(static_cast<int>(j));
        addForces(scenario, *model_);
    }
    std::unique_ptr<Model> take() { return std::move(model_); }

  private:
    const Link& link(int body) const { return model_->forest.links[body]; }

    void addBody(int index) {
        const Body& body = scenario_.bodies[index];
        const Link& own = link(index);
        if (own.fixed) {
            model_->bodies[index] = model_->matter.updGround();
            return;
        }
        if (own.joint == kNone)
            addFree(index);
        else
            addTied(index);
        if (body.type != BodyType::Dynamic || body.gravityScale != 1.0)
            model_->gravity.setDefaultBodyIsExcluded(model_->bodies[index], true);
    }

    SimTK::Body::Rigid massOf(int index) const {
        const Body& body = scenario_.bodies[index];
        if (body.type != BodyType::Dynamic)
            return SimTK::Body::Rigid(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1.0)));
        const Vec3& m = link(index).moments;
        const double most = std::max({m.x, m.y, m.z});
        if (2.0 * most > (1.0 + 1e-9) * (m.x + m.y + m.z))
            throw adapter::notInLibrary(
                "simbody", "body with a moment of inertia above the sum of the others",
                "SimTKcommon/internal/MassProperties.h, Inertia_", "body '" + body.name + "'");
        return SimTK::Body::Rigid(
            SimTK::MassProperties(body.massProperties.mass, SimTK::Vec3(0), SimTK::Inertia(toSimbody(m))));
    }

    void addFree(int index) {
        SimTK::MobilizedBody& ground = model_->matter.updGround();
        const bool moved = scenario_.bodies[index].type == BodyType::Kinematic;
        if (planar_ && !moved) {
            model_->bodies[index] = SimTK::MobilizedBody::Planar(ground, massOf(index));
            return;
        }
        model_->bodies[index] = SimTK::MobilizedBody::Free(ground, massOf(index));
        if (moved) prescribe(scenario_.bodies[index], link(index).frame, model_->bodies[index]);
    }

    /// The parts of a joint one behind the other, from the parent to the child. All but the last end at a body without
    /// mass, whose frame is at the anchor and has the child's axes at the initial poses.
    void addTied(int index) {
        const Link& own = link(index);
        const Joint& joint = scenario_.joints[own.joint];
        const Pose anchor{anchorIn(own, joint), {}};
        SimTK::MobilizedBody parent = model_->matter.getGround();
        Pose inboard = own.rest * anchor;
        if (own.parent != kNone) {
            parent = model_->bodies[own.parent];
            if (link(own.parent).fixed)
                inboard = scenario_.bodies[own.parent].pose * link(own.parent).frame * inboard;
        }
        const std::vector<Part> parts = partsOf(own, joint);
        if (parts.empty())
            model_->bodies[index] =
                SimTK::MobilizedBody::Weld(parent, toSimbody(inboard), massOf(index), toSimbody(anchor));
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const bool last = k + 1 == parts.size();
            const Pose outboard = last ? anchor : Pose{};
            if (last)
                parent = create(parts[k], parent, inboard, massOf(index), outboard);
            else
                parent = create(parts[k], parent, inboard, SimTK::Body::Massless(), outboard);
            inboard = {};
            model_->coordinates[index].push_back({parts[k].kind, parts[k].axis, parent});
            if (parts[k].use != nullptr) equip(parent, *parts[k].use);
            model_->bodies[index] = parent;
        }
    }

    static SimTK::MobilizedBody create(const Part& part, SimTK::MobilizedBody& parent, const Pose& inboard,
                                       const SimTK::Body& body, const Pose& outboard) {
        const auto with = [](const Pose& pose, const SimTK::Rotation& turn) {
            return toSimbody(pose) * SimTK::Transform(turn);
        };
        if (part.kind == Kind::Ball)
            return SimTK::MobilizedBody::Ball(parent, toSimbody(inboard), body, toSimbody(outboard));
        if (part.kind == Kind::Turn) {
            const SimTK::Rotation turn = axisTo(part.axis, SimTK::ZAxis);
            return SimTK::MobilizedBody::Pin(parent, with(inboard, turn), body, with(outboard, turn));
        }
        const SimTK::Rotation turn = axisTo(part.axis, SimTK::XAxis);
        return SimTK::MobilizedBody::Slider(parent, with(inboard, turn), body, with(outboard, turn));
    }

    /// Spring and motor of a coordinate.
    void equip(const SimTK::MobilizedBody& mobilizer, const JointAxis& use) {
        if (use.stiffness > 0.0)
            SimTK::Force::MobilityLinearSpring(model_->forces, mobilizer, SimTK::MobilizerQIndex(0),
                                               use.stiffness, use.target);
        if (use.damping > 0.0)
            SimTK::Force::MobilityLinearDamper(model_->forces, mobilizer, SimTK::MobilizerUIndex(0),
                                               use.damping);
        if (!use.hasMotor()) return;
        SimTK::MobilizedBody of = mobilizer;
        SimTK::Constraint::ConstantSpeed hold(of, SimTK::MobilizerUIndex(0), use.motorSpeed);
        hold.setDisabledByDefault(true);
        model_->motors.push_back({use.motorSpeed, use.motorMaxForce, hold, mobilizer, nullptr});
    }

    std::vector<Part> partsOf(const Link& own, const Joint& joint) const {
        switch (joint.type) {
            case JointType::Fixed:
                return {};
            case JointType::Ball:
            case JointType::ConeTwist:
                return ballOrCone(own, joint);
            case JointType::Wheel:
                return wheel(own, joint);
            case JointType::SixDof:
                return sixDof(own, joint);
            default:
                break;
        }
        if (joint.axes[0].mode == AxisMode::Locked) return {};
        if (joint.type == JointType::Slider) return {{Kind::Travel, axisIn(own, joint), &joint.axes[0]}};
        return {{Kind::Turn, planar_ ? Vec3{0, 0, 1} : axisIn(own, joint), &joint.axes[0]}};
    }

    std::vector<Part> ballOrCone(const Link& own, const Joint& joint) const {
        if (planar_) return {{Kind::Turn, {0, 0, 1}, &joint.axes[0]}};
        const bool cone = joint.type == JointType::ConeTwist;
        if (joint.axes[cone ? 1 : 0].mode != AxisMode::Locked) return {{Kind::Ball, {}}};
        if (cone && joint.axes[0].mode == AxisMode::Locked) return {};
        return {{Kind::Turn, axisIn(own, joint), cone ? &joint.axes[0] : nullptr}};
    }

    /// A part that turns moves the axes of the next one.
    std::vector<Part> wheel(const Link& own, const Joint& joint) const {
        std::vector<Part> parts;
        if (joint.axes[0].mode != AxisMode::Locked)
            parts.push_back({Kind::Travel, axisIn(own, joint), &joint.axes[0]});
        if (joint.axes[1].mode != AxisMode::Locked)
            parts.push_back({Kind::Turn, spinIn(own, scenario_, joint), &joint.axes[1]});
        if (own.reversed) std::reverse(parts.begin(), parts.end());
        return parts;
    }

    /// Travels along A's axes, and an angle where one is open alone, else a ball.
    std::vector<Part> sixDof(const Link& own, const Joint& joint) const {
        const std::array<Vec3, 3> axes = sixDofAxesIn(own, scenario_, joint);
        const auto& use = joint.axes;
        std::vector<Part> parts;
        for (std::size_t k = 0; k < 3; ++k)
            if (isOpen(use[k])) parts.push_back({Kind::Travel, axes[k], &use[k]});
        const int angles = openAngles(joint);
        if (angles > 1) parts.push_back({Kind::Ball, {}});
        for (std::size_t k = 0; k < 3; ++k)
            if (angles == 1 && isOpen(use[3 + k])) parts.push_back({Kind::Turn, axes[k], &use[3 + k]});
        if (own.reversed) std::stable_partition(parts.begin(), parts.end(), isTurn);
        return parts;
    }
    static bool isTurn(const Part& part) { return part.kind != Kind::Travel; }

    /// Angles that are locked, springs and motors are constraints and forces beside a ball's mobilizer.
    void addTreeJoint(const Joint& joint) {
        const Sides sides = sidesOf(scenario_, *model_, joint, planar_);
        const bool isCone = joint.type == JointType::ConeTwist && joint.axes[1].mode != AxisMode::Locked;
        if (isCone || (joint.type == JointType::SixDof && openAngles(joint) > 1))
            keepAngles(sides, model_->matter);
        for (const Driven& driven : drivenCoordinates(sides, true)) addDriven(*model_, driven);
    }

    void addLoop(int index) {
        const Joint& joint = scenario_.joints[index];
        const auto& loops = model_->forest.loops;
        if (joint.type != JointType::Distance && std::find(loops.begin(), loops.end(), index) == loops.end())
            return;
        const Sides sides = sidesOf(scenario_, *model_, joint, planar_);
        LoopJoint loop(sides, index, model_->matter);
        for (const Driven& driven : drivenCoordinates(sides, false))
            for (const Acting& acting : addDriven(*model_, driven)) loop.add(acting);
        model_->loops.push_back(std::move(loop));
    }

    const adapter::Scenario& scenario_;
    bool planar_;
    std::unique_ptr<Model> model_ = std::make_unique<Model>();
};

}  // namespace

std::unique_ptr<Model> buildModel(const adapter::Scenario& scenario, bool planar) {
    return Builder(scenario, planar).take();
}

}  // namespace rigor::simbody
