// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/dart/model.hpp"

#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>

#include "adapters/dart/shapes.hpp"

namespace rigor::dart_adapter {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::SkeletonPtr;
using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::JointAxis;

/// Mass of a node between the joints of one body, as part of the body's: DART warns of none.
constexpr double kCarrierMass = 1e-12;

class Builder {
  public:
    Builder(const adapter::Scenario& scenario, bool planar, const std::string& narrowPhase)
        : scenario_(scenario), planar_(planar), narrowPhase_(narrowPhase), model_(narrowPhase) {
        model_.forest = adapter::spanningForest(scenario, planar);
        model_.bodies.resize(scenario.bodies.size());
        model_.shapeNodes.resize(scenario.bodies.size());
        model_.coordinates.resize(scenario.bodies.size());
        for (const int body : model_.forest.order) addBody(body);
    }
    Model take() { return std::move(model_); }

  private:
    const Link& link(int body) const { return model_.forest.links[body]; }
    /// The node that a body hangs on, in whose skeleton it is then; null for the world and static bodies.
    BodyNode* parentOf(int body) const {
        const int parent = link(body).parent;
        return parent == kNone || link(parent).fixed ? nullptr : model_.bodies[parent];
    }

    void addBody(int index) {
        const Body& body = scenario_.bodies[index];
        BodyNode* parent = parentOf(index);
        SkeletonPtr skeleton;
        if (parent == nullptr) {
            skeleton = dart::dynamics::Skeleton::create("tree" + std::to_string(model_.skeletons.size()));
            // Gravity is a force of the adapter where a body has its own, and for kinematic bodies.
            skeleton->setMobile(body.type != BodyType::Static);
            model_.skeletons.push_back(skeleton);
        } else {
            skeleton = parent->getSkeleton();
        }
        dart::dynamics::BodyNode::Properties properties;
        properties.mName = "body" + std::to_string(index);
        const Link& own = link(index);
        if (body.type == BodyType::Dynamic)
            properties.mInertia = dart::dynamics::Inertia(body.massProperties.mass, Eigen::Vector3d::Zero(),
                                                          Eigen::Matrix3d(toDart(own.moments).asDiagonal()));
        BodyNode* node = createNode(*skeleton, parent, index, properties);
        model_.bodies[index] = node;
        if (body.type != BodyType::Dynamic || body.gravityScale != 1.0) node->setGravityMode(false);
        addShapes(index);
    }

    template <class JointKind>
    BodyNode* create(dart::dynamics::Skeleton& skeleton, BodyNode* parent,
                     const typename JointKind::Properties& joint, const BodyNode::Properties& body) {
        return skeleton.createJointAndBodyNodePair<JointKind>(parent, joint, body).second;
    }

    BodyNode* createNode(dart::dynamics::Skeleton& skeleton, BodyNode* parent, int index,
                         const BodyNode::Properties& body) {
        const Link& own = link(index);
        dart::dynamics::Joint::Properties frame;
        frame.mName = "joint" + std::to_string(index);
        if (own.fixed) {
            frame.mT_ParentBodyToJoint = toDart(scenario_.bodies[index].pose * own.frame);
            dart::dynamics::WeldJoint::Properties weld;
            static_cast<dart::dynamics::Joint::Properties&>(weld) = frame;
            return create<dart::dynamics::WeldJoint>(skeleton, parent, weld, body);
        }
        if (own.joint == kNone) return createFree(skeleton, frame, index, body);
        return createTied(skeleton, parent, frame, index, body);
    }

    BodyNode* createFree(dart::dynamics::Skeleton& skeleton, const dart::dynamics::Joint::Properties& frame,
                         int index, const BodyNode::Properties& body) {
        if (planar_ && scenario_.bodies[index].type == BodyType::Dynamic) {
            dart::dynamics::PlanarJoint::Properties planar;
            static_cast<dart::dynamics::Joint::Properties&>(planar) = frame;
            return create<dart::dynamics::PlanarJoint>(skeleton, nullptr, planar, body);
        }
        dart::dynamics::FreeJoint::Properties free;
        static_cast<dart::dynamics::Joint::Properties&>(free) = frame;
        BodyNode* node = create<dart::dynamics::FreeJoint>(skeleton, nullptr, free, body);
        // A kinematic body's velocity is prescribed: nothing changes it.
        if (scenario_.bodies[index].type == BodyType::Kinematic)
            node->getParentJoint()->setActuatorType(dart::dynamics::Joint::VELOCITY);
        return node;
    }

    /// The joint's frame has the axes of the child's frame at the initial poses. Every coordinate has a joint of its own;
    /// between two of them is a node without shapes, in the joint's frame.
    BodyNode* createTied(dart::dynamics::Skeleton& skeleton, BodyNode* parent,
                         dart::dynamics::Joint::Properties frame, int index,
                         const BodyNode::Properties& body) {
        using namespace dart::dynamics;
        const Link& own = link(index);
        const Pose anchor{anchorIn(own, scenario_.joints[own.joint]), {}};
        Pose base;
        if (own.parent != kNone && link(own.parent).fixed)
            base = scenario_.bodies[own.parent].pose * link(own.parent).frame;
        frame.mT_ParentBodyToJoint = toDart(base * own.rest * anchor);
        std::vector<Coordinate> coordinates = coordinatesOf(own, scenario_, planar_);
        const std::string name = frame.mName;
        for (std::size_t k = 0; k + 1 < coordinates.size(); ++k) {
            BodyNode::Properties carrier;
            carrier.mName = body.mName + "_carrier" + std::to_string(k);
            carrier.mInertia =
                Inertia(kCarrierMass * body.mInertia.getMass(), Eigen::Vector3d::Zero(),
                        Eigen::Matrix3d(kCarrierMass * body.mInertia.getMoment().diagonal().asDiagonal()));
            parent = createOne(skeleton, parent, frame, coordinates[k], carrier);
            frame.mName = name + "_" + std::to_string(k + 1);
            frame.mT_ParentBodyToJoint.setIdentity();
        }
        frame.mT_ChildBodyToJoint = toDart(anchor);
        if (coordinates.empty()) {
            WeldJoint::Properties weld;
            static_cast<dart::dynamics::Joint::Properties&>(weld) = frame;
            return create<WeldJoint>(skeleton, parent, weld, body);
        }
        BodyNode* node = createOne(skeleton, parent, frame, coordinates.back(), body);
        model_.coordinates[index] = std::move(coordinates);
        return node;
    }

    BodyNode* createOne(dart::dynamics::Skeleton& skeleton, BodyNode* parent,
                        const dart::dynamics::Joint::Properties& frame, Coordinate& coordinate,
                        const BodyNode::Properties& body) {
        using namespace dart::dynamics;
        BodyNode* node = nullptr;
        if (coordinate.kind == CoordinateKind::Ball) {
            BallJoint::Properties ball;
            static_cast<dart::dynamics::Joint::Properties&>(ball) = frame;
            node = create<BallJoint>(skeleton, parent, ball, body);
        } else if (coordinate.kind == CoordinateKind::Turn) {
            RevoluteJoint::Properties hinge;
            static_cast<dart::dynamics::Joint::Properties&>(hinge) = frame;
            hinge.mAxis = toDart(coordinate.axis);
            node = create<RevoluteJoint>(skeleton, parent, hinge, body);
        } else {
            PrismaticJoint::Properties slider;
            static_cast<dart::dynamics::Joint::Properties&>(slider) = frame;
            slider.mAxis = toDart(coordinate.axis);
            node = create<PrismaticJoint>(skeleton, parent, slider, body);
        }
        coordinate.joint = node->getParentJoint();
        if (coordinate.use != nullptr) equip(*coordinate.joint, *coordinate.use);
        return node;
    }

    /// Stops, spring and motor of a joint's one coordinate.
    void equip(dart::dynamics::Joint& joint, const JointAxis& use) {
        if (use.mode == AxisMode::Limited) {
            joint.setLimitEnforcement(true);
            if (use.lower > -1e299) joint.setPositionLowerLimit(0, use.lower);
            if (use.upper < 1e299) joint.setPositionUpperLimit(0, use.upper);
        }
        if (use.hasSpring()) {
            joint.setSpringStiffness(0, use.stiffness);
            joint.setDampingCoefficient(0, use.damping);
            joint.setRestPosition(0, use.target);
        }
        if (!use.hasMotor()) return;
        joint.setActuatorType(dart::dynamics::Joint::SERVO);
        joint.setForceLowerLimit(0, -use.motorMaxForce);
        joint.setForceUpperLimit(0, use.motorMaxForce);
        model_.motors.emplace_back(&joint, use.motorSpeed);
    }

    void addShapes(int index) {
        const Body& body = scenario_.bodies[index];
        model_.shapeNodes[index].resize(body.shapes.size(), nullptr);
        if (!body.collides) return;
        const Pose toNode = inverse(link(index).frame);
        for (std::size_t k = 0; k < body.shapes.size(); ++k) {
            for (const DartShape& made : makeShapes(body.shapes[k].geometry, narrowPhase_))
                addShape(index, k, made, toNode * body.shapes[k].pose * made.frame);
        }
    }

    void addShape(int body, std::size_t k, const DartShape& made, const Pose& pose) {
        using dart::dynamics::CollisionAspect;
        using dart::dynamics::DynamicsAspect;
        auto* shape = model_.bodies[body]->createShapeNodeWith<CollisionAspect, DynamicsAspect>(
            made.shape, "shape" + std::to_string(model_.shapes.size()));
        shape->setRelativeTransform(toDart(pose));
        if (model_.shapeNodes[body][k] == nullptr) model_.shapeNodes[body][k] = shape;
        model_.shapes[shape] = {body, static_cast<int>(k)};
        if (made.surface) model_.surfaces.add(shape, made.back);
    }

    const adapter::Scenario& scenario_;
    bool planar_;
    std::string narrowPhase_;
    Model model_;
};

}  // namespace

Model buildModel(const adapter::Scenario& scenario, bool planar, const std::string& narrowPhase) {
    return Builder(scenario, planar, narrowPhase).take();
}

}  // namespace rigor::dart_adapter
