// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of the scenario format as Box2D joints: hinge and ball are a revolute joint in the plane, slider a
// prismatic joint, fixed a weld, distance a distance joint of one length. Reference angles are the initial
// ones.
#include "adapters/box2d/joints.hpp"

namespace rigor::box2d {
namespace {

using scenario::Joint;
using scenario::JointType;

struct Ends {
    const JointEnd& a;
    const JointEnd& b;
    b2Vec2 anchorA, anchorB;
    float referenceAngle;
    bool collideConnected;
};

template <class Def>
Def common(const Ends& ends) {
    Def def;
    def.bodyA = ends.a.body;
    def.bodyB = ends.b.body;
    def.collideConnected = ends.collideConnected;
    def.localAnchorA = ends.anchorA;
    def.localAnchorB = ends.anchorB;
    return def;
}

}  // namespace

void addJoint(b2World& world, const Joint& joint, const JointEnd& a, const JointEnd& b, double scale) {
    const double turn = angleAboutZ(conjugate(a.bodyPose.orientation) * b.bodyPose.orientation);
    const Ends ends{a,
                    b,
                    toBox2d(inverse(a.frame) * joint.anchorA, scale),
                    toBox2d(inverse(b.frame) * joint.anchorB, scale),
                    static_cast<float>(turn),
                    joint.collideConnected};
    switch (joint.type) {
        case JointType::Ball:
        case JointType::Hinge: {
            auto def = common<b2RevoluteJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            world.CreateJoint(&def);
            return;
        }
        case JointType::Slider: {
            auto def = common<b2PrismaticJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            def.localAxisA = toBox2d(joint.axisA, 1.0);
            world.CreateJoint(&def);
            return;
        }
        case JointType::Fixed: {
            auto def = common<b2WeldJointDef>(ends);
            def.referenceAngle = ends.referenceAngle;
            world.CreateJoint(&def);
            return;
        }
        case JointType::Distance: {
            auto def = common<b2DistanceJointDef>(ends);
            def.length = def.minLength = def.maxLength = static_cast<float>(scale * joint.length);
            if (def.length <= b2_linearSlop)
                throw adapter::Unsupported("box2d has no distance joint shorter than its slop (joint '" +
                                           joint.name + "')");
            world.CreateJoint(&def);
            return;
        }
    }
}

}  // namespace rigor::box2d
