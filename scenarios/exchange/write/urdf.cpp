// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios as URDF: a tree from the link "world". The frame of a link is that of the joint above it, so that links
// other than free ones have other frames than the scenario's bodies; masses, shapes and joints are where they were.
#include <array>
#include <cmath>

#include "scenarios/exchange/common/builder.hpp"
#include "scenarios/exchange/write/coordinates.hpp"
#include "scenarios/exchange/write/write.hpp"
#include "scenarios/model/hull.hpp"

namespace rigor::models {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointType;
using scenario::kNone;
using scenario::Pose;
using scenario::Scenario;
using scenario::Vec3;

bool isLinkJoint(const Joint& j) {
    return j.type == JointType::Hinge || j.type == JointType::Slider || j.type == JointType::Fixed ||
           isPlanar(j);
}

/// A surface as an OBJ file.
std::string objText(const std::vector<Vec3>& vertices, const std::vector<std::array<int, 3>>& triangles) {
    std::string out;
    for (const Vec3& v : vertices) out += "v " + digits(v) + "\n";
    for (const auto& t : triangles) {
        out += "f";
        for (const int i : t) out += " " + std::to_string(i + 1);
        out += "\n";
    }
    return out;
}

/// The surface of the hull of points, as triangles.
scenario::TriangleMesh surfaceOf(const scenario::ConvexHull& shape) {
    const scenario::HullMesh hull = scenario::convexHull3d(shape.vertices);
    scenario::TriangleMesh mesh{hull.vertices, {}};
    for (const auto& face : hull.faces)
        for (std::size_t k = 2; k < face.size(); ++k)
            mesh.triangles.push_back({face[0], face[k - 1], face[k]});
    return mesh;
}

/// Roll, pitch and yaw of R = Rz(yaw) Ry(pitch) Rx(roll); at a pitch of a quarter turn the yaw is 0.
Vec3 rollPitchYaw(const scenario::Quat& q) {
    const scenario::Mat3 r = toMatrix(q);
    const double level = std::hypot(r(0, 0), r(1, 0));
    if (level < 1e-9) return {std::atan2(-r(1, 2), r(1, 1)), std::atan2(-r(2, 0), level), 0.0};
    return {std::atan2(r(2, 1), r(2, 2)), std::atan2(-r(2, 0), level), std::atan2(r(1, 0), r(0, 0))};
}

std::string origin(const Pose& pose) {
    return "<origin xyz=\"" + digits(pose.position) + "\" rpy=\"" + digits(rollPitchYaw(pose.orientation)) +
           "\"/>";
}

class UrdfWriter {
  public:
    UrdfWriter(const Scenario& s, Report& report, FilesBeside& beside)
        : s_(s), report_(report), beside_(beside), place_{s.name, 0} {
        std::vector<bool> edges;
        for (const Joint& j : s.joints) edges.push_back(isLinkJoint(j));
        tree_ = treeOf(s, edges);
        frames_.resize(s.bodies.size());
        for (const int index : tree_.order) {
            const TreeJoint& t = above(index);
            Pose& frame = frames_[static_cast<std::size_t>(index)];
            frame = body(index).pose;
            if (t.joint != kNone) {
                const Joint& j = s.joints[static_cast<std::size_t>(t.joint)];
                frame.position = body(index).pose * (t.isReversed ? j.anchorA : j.anchorB);
            }
        }
    }

    std::string write() {
        refuse();
        std::string out =
            "<?xml version=\"1.0\"?>\n<robot name=\"" + escaped(s_.name) + "\">\n  <link name=\"world\"/>\n";
        for (const int index : tree_.order) out += link(index) + joint(index);
        return out + "</robot>\n";
    }

  private:
    const Body& body(int index) const { return s_.bodies[static_cast<std::size_t>(index)]; }
    const TreeJoint& above(int index) const { return tree_.above[static_cast<std::size_t>(index)]; }
    const Pose& frame(int index) const { return frames_[static_cast<std::size_t>(index)]; }

    void refuse() {
        for (const int index : tree_.loops) {
            const Joint& j = s_.joints[static_cast<std::size_t>(index)];
            report_.leavesOut(std::string(jointName(j.type)) + "_joints", "joints", place_,
                              std::string("the joint '") + j.name + "', a " + jointName(j.type) +
                                  (isLinkJoint(j) ? " that closes a loop" : ""));
        }
        for (const Body& b : s_.bodies) {
            if (b.type == BodyType::Kinematic)
                report_.leavesOut("kinematic", "kinematic", place_, "the given motion of '" + b.name + "'");
            if (norm(b.velocity) > 0.0 || norm(b.angularVelocity) > 0.0)
                report_.leavesOut("velocities", "velocity", place_,
                                  "URDF has no velocities ('" + b.name + "')");
        }
        if (!s_.materials.empty())
            report_.leavesOut("friction", "materials", place_, "URDF has no friction and restitution");
        if (!s_.layers.empty())
            report_.leavesOut("contact_filters", "layers", place_, "URDF has no contact filters");
        report_.changed("gravity", place_,
                        "URDF has no gravity: that of this scenario is " + digits(s_.gravity));
    }

    std::string link(int index) {
        const Body& b = body(index);
        const Pose inFrame = inverse(frame(index)) * b.pose;
        std::string out = "  <link name=\"" + escaped(b.name) + "\">\n";
        if (b.type == BodyType::Dynamic) {
            const scenario::Mat3 turn = toMatrix(inFrame.orientation);
            const scenario::Mat3 i = turn * b.massProperties.inertia * transpose(turn);
            out += "    <inertial>\n      " + origin({inFrame * b.massProperties.centerOfMass, {}}) +
                   "\n      <mass value=\"" + digits({b.massProperties.mass}) +
                   "\"/>\n      <inertia ixx=\"" + digits({i(0, 0)}) + "\" ixy=\"" + digits({i(0, 1)}) +
                   "\" ixz=\"" + digits({i(0, 2)}) + "\" iyy=\"" + digits({i(1, 1)}) + "\" iyz=\"" +
                   digits({i(1, 2)}) + "\" izz=\"" + digits({i(2, 2)}) + "\"/>\n    </inertial>\n";
        }
        for (std::size_t k = 0; k < b.shapes.size(); ++k) out += collision(b.shapes[k], inFrame, b, k);
        return out + "  </link>\n";
    }

    /// A surface as a file beside the model.
    std::string meshFile(const scenario::TriangleMesh& mesh, const std::string& part) {
        const std::string file = besideName(s_, part) + ".obj";
        beside_[file] = objText(mesh.vertices, mesh.triangles);
        report_.changed("mesh", place_, "hulls and meshes are files beside the model");
        return "<mesh filename=\"" + file + "\"/>";
    }

    std::string collision(const scenario::Shape& shape, const Pose& inFrame, const Body& b,
                          std::size_t number) {
        Pose pose = inFrame * shape.pose;
        std::string kind;
        if (const auto* g = std::get_if<scenario::Sphere>(&shape.geometry))
            kind = "<sphere radius=\"" + digits({g->radius}) + "\"/>";
        if (const auto* g = std::get_if<scenario::Box>(&shape.geometry))
            kind = "<box size=\"" + digits(2.0 * g->halfExtents) + "\"/>";
        if (const auto* g = std::get_if<scenario::Cylinder>(&shape.geometry)) {
            kind = "<cylinder radius=\"" + digits({g->radius}) + "\" length=\"" +
                   digits({2.0 * g->halfLength}) + "\"/>";
            pose = pose * inverse(SceneBuilder::fromZ());
        }
        const std::string part = b.name + "_" + std::to_string(number);
        if (const auto* g = std::get_if<scenario::ConvexHull>(&shape.geometry))
            kind = meshFile(surfaceOf(*g), part);
        if (const auto* g = std::get_if<scenario::TriangleMesh>(&shape.geometry)) kind = meshFile(*g, part);
        if (kind.empty()) {
            report_.leavesOut(std::string(geometryName(shape.geometry, 3)) + "_shapes", "shapes", place_,
                              std::string("a ") + geometryName(shape.geometry, 3) + " of '" + b.name + "'");
            return "";
        }
        if (!b.collides) return "";
        return "    <collision>\n      " + origin(pose) + "\n      <geometry>" + kind +
               "</geometry>\n    </collision>\n";
    }

    std::string joint(int index) {
        const TreeJoint& t = above(index);
        const bool isHeld = t.joint != kNone;
        const Pose parent = isHeld && t.parent != kNone ? frame(t.parent) : Pose{};
        const std::string parentName = isHeld && t.parent != kNone ? escaped(body(t.parent).name) : "world";
        const Joint* j = isHeld ? &s_.joints[static_cast<std::size_t>(t.joint)] : nullptr;
        std::string type = body(index).type == BodyType::Dynamic ? "floating" : "fixed", inner;
        if (j && j->type == JointType::Fixed) type = "fixed";
        if (j && j->type != JointType::Fixed) {
            const scenario::JointAxis& a = j->axes[0];
            const bool isLimited =
                a.mode == AxisMode::Limited && (a.lower > -kUnlimited || a.upper < kUnlimited);
            type = j->type == JointType::Slider   ? "prismatic"
                   : j->type == JointType::SixDof ? "planar"
                   : isLimited                    ? "revolute"
                                                  : "continuous";
            inner += "    <axis xyz=\"" + digits(t.isReversed ? -j->axisA : j->axisB) + "\"/>\n";
            if (type == "prismatic" || type == "revolute")
                inner += "    <limit lower=\"" +
                         digits({isLimited ? std::max(a.lower, -kUnlimited) : -kUnlimited}) + "\" upper=\"" +
                         digits({isLimited ? std::min(a.upper, kUnlimited) : kUnlimited}) +
                         "\" effort=\"0\" velocity=\"0\"/>\n";
            if (type != "planar") inner += dynamics(*j);
        }
        return "  <joint name=\"" + (j ? escaped(j->name) : escaped(body(index).name) + "_base") +
               "\" type=\"" + type + "\">\n    " + origin(inverse(parent) * frame(index)) +
               "\n    <parent link=\"" + parentName + "\"/>\n    <child link=\"" + escaped(body(index).name) +
               "\"/>\n" + inner + "  </joint>\n";
    }

    std::string dynamics(const Joint& j) {
        const scenario::JointAxis& a = j.axes[0];
        const std::string what = "the joint '" + j.name + "'";
        if (a.stiffness > 0.0 || a.frequency > 0.0)
            report_.leavesOut("springs", "spring", place_, "URDF has no springs (" + what + ")");
        if (a.hasMotor() && a.motorSpeed != 0.0)
            report_.leavesOut("motors", "motor", place_, "a motor of " + what);
        const double friction = a.motorSpeed == 0.0 ? a.motorMaxForce : 0.0;
        if (!(a.damping > 0.0 || friction > 0.0)) return "";
        return "    <dynamics damping=\"" + digits({a.damping}) + "\" friction=\"" + digits({friction}) +
               "\"/>\n";
    }

    const Scenario& s_;
    Report& report_;
    FilesBeside& beside_;
    Place place_;
    JointTree tree_;
    std::vector<Pose> frames_;
};

}  // namespace

std::string urdfText(const Scenario& scenario, Report& report, FilesBeside& beside) {
    refuseCommon(scenario, report);
    return UrdfWriter(scenario, report, beside).write();
}

}  // namespace rigor::models
