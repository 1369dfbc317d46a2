// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios as MJCF. Joints span a tree of bodies; those that close a loop are equalities, distance joints with limits
// or springs are tendons. Every filter of contacts is a bit of its own, and surfaces whose pair does not follow
// MuJoCo's rule (the larger value) are explicit pairs.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scenarios/exchange/common/builder.hpp"
#include "scenarios/exchange/write/coordinates.hpp"
#include "scenarios/exchange/write/write.hpp"

namespace rigor::models {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;
using scenario::kNone;
using scenario::PairCoefficients;
using scenario::Pose;
using scenario::Quat;
using scenario::Scenario;
using scenario::Shape;
using scenario::Vec3;

constexpr std::size_t kMostFilters = 31;   ///< bits of contype
constexpr std::size_t kMostPairs = 20000;  ///< explicit pairs of shapes
constexpr double kConsistent = 1e-9;       ///< [m/s, rad/s] velocities that joints allow

/// True for joints that can connect a body to the one above it.
bool isEdge(const Scenario& s, const Joint& j) {
    return coordinatesOf(s, j, false).has_value();
}

class MjcfWriter {
  public:
    MjcfWriter(const Scenario& s, Report& report, FilesBeside& beside)
        : s_(s), report_(report), beside_(beside), place_{s.name, 0} {
        std::vector<bool> edges;
        for (const Joint& j : s.joints) edges.push_back(isEdge(s, j));
        tree_ = treeOf(s, edges);
    }

    std::string write() {
        collectFilters();
        chooseParentFilter();
        body_ = bodies(kNone, 1);
        std::string out = "<mujoco model=\"" + escaped(s_.name) + "\">\n";
        out += "  <compiler angle=\"radian\" autolimits=\"true\"/>\n";
        out += "  <option timestep=\"" + digits({s_.timeSteps.front()}) + "\" gravity=\"" +
               digits(s_.gravity) + "\">\n";
        if (!filtersParents_) out += "    <flag filterparent=\"disable\"/>\n";
        out += "  </option>\n";
        if (!assets_.empty()) out += "  <asset>\n" + assets_ + "  </asset>\n";
        out += "  <worldbody>\n" + sites(kNone, "    ") + body_ + "  </worldbody>\n";
        const std::string contact = contacts();
        if (!contact.empty()) out += "  <contact>\n" + contact + "  </contact>\n";
        if (!equalities_.empty()) out += "  <equality>\n" + equalities_ + "  </equality>\n";
        if (!tendons_.empty()) out += "  <tendon>\n" + tendons_ + "  </tendon>\n";
        return out + keyframe() + "</mujoco>\n";
    }

    void loops() {
        for (const int index : tree_.loops) loop(s_.joints[static_cast<std::size_t>(index)]);
    }

  private:
    const Body& body(int index) const { return s_.bodies[static_cast<std::size_t>(index)]; }
    Pose poseOf(int index) const { return index == kNone ? Pose{} : body(index).pose; }
    std::string nameOf(int index) const { return index == kNone ? "world" : escaped(body(index).name); }

    // ------------------------------------------------------------------------------------------ bodies
    std::string bodies(int parent, int depth) {
        std::string out;
        const std::string indent(static_cast<std::size_t>(2 + 2 * depth), ' ');
        for (const int index : tree_.order) {
            const TreeJoint& t = tree_.above[static_cast<std::size_t>(index)];
            if (parentOf(t) != parent) continue;
            const Pose pose = inverse(poseOf(parent)) * body(index).pose;
            out += indent + "<body name=\"" + nameOf(index) + "\" pos=\"" + digits(pose.position) +
                   "\" quat=\"" + digits(pose.orientation) + "\"" +
                   (isMocap(index) ? " mocap=\"true\"" : "") + ">\n";
            out += inertial(index, indent + "  ") + joint(index, indent + "  ");
            for (std::size_t k = 0; k < body(index).shapes.size(); ++k) out += geom(index, k, indent + "  ");
            out += sites(index, indent + "  ") + bodies(index, depth + 1) + indent + "</body>\n";
        }
        return out;
    }
    static int parentOf(const TreeJoint& t) { return t.joint == kNone ? kNone : t.parent; }

    bool isMocap(int index) {
        const Body& b = body(index);
        if (b.type != BodyType::Kinematic) return false;
        if (norm(b.velocity) > 0.0 || norm(b.angularVelocity) > 0.0)
            report_.leavesOut("kinematic_motion", "kinematic", place_,
                              "the given motion of '" + b.name + "'");
        return true;
    }

    std::string inertial(int index, const std::string& indent) {
        const Body& b = body(index);
        if (b.type != BodyType::Dynamic) return "";
        const Principal p = principalOf(b.massProperties.inertia);
        return indent + "<inertial pos=\"" + digits(b.massProperties.centerOfMass) + "\" quat=\"" +
               digits(p.axes) + "\" mass=\"" + digits({b.massProperties.mass}) + "\" diaginertia=\"" +
               digits(p.moments) + "\"/>\n";
    }

    // ------------------------------------------------------------------------------------------ joints
    std::string joint(int index, const std::string& indent) {
        if (body(index).type != BodyType::Dynamic) return "";
        const TreeJoint& t = tree_.above[static_cast<std::size_t>(index)];
        if (t.joint == kNone) return indent + "<freejoint/>\n";
        const Joint& j = s_.joints[static_cast<std::size_t>(t.joint)];
        const Vec3 anchor = t.isReversed ? j.anchorA : j.anchorB;
        static constexpr const char* kTypes[] = {"slide", "hinge", "ball"};
        std::string out;
        for (const Coordinate& c : coordinates(index)) {
            out += indent + "<joint name=\"" + escaped(j.name) + c.suffix + "\" type=\"" + kTypes[c.kind] +
                   "\" pos=\"" + digits(anchor) + "\"";
            if (c.kind != Coordinate::Ball) out += " axis=\"" + digits(c.axis) + "\"";
            out += control(j, c) + "/>\n";
        }
        return out;
    }

    /// Coordinates of the joint above a body.
    std::vector<Coordinate> coordinates(int index) {
        const TreeJoint& t = tree_.above[static_cast<std::size_t>(index)];
        const Joint& j = s_.joints[static_cast<std::size_t>(t.joint)];
        const auto found = coordinatesOf(s_, j, t.isReversed);
        if (!found)
            report_.leavesOut("six_dof_joints", "joints", place_,
                              "the joint '" + j.name + "', a six_dof whose first body hangs on the second");
        return found.value_or(std::vector<Coordinate>{});
    }

    std::string control(const Joint& j, const Coordinate& c) {
        const JointAxis& a = c.control;
        const std::string what = "the joint '" + j.name + "'";
        if (c.kind == Coordinate::Ball && (a.mode == AxisMode::Limited || a.hasSpring())) {
            report_.leavesOut("ball_limits", "axes", place_, "a limit or spring of the swing of " + what);
            return "";
        }
        std::string out;
        if (a.mode == AxisMode::Limited)
            out += " range=\"" + digits({std::max(a.lower, -1e10), std::min(a.upper, 1e10)}) + "\"";
        if (a.frequency > 0.0)
            report_.leavesOut("frequency_springs", "spring", place_,
                              "a spring given by a frequency, of " + what);
        if (a.stiffness > 0.0)
            out += " stiffness=\"" + digits({a.stiffness}) + "\" springref=\"" + digits({a.target}) + "\"";
        if (a.damping > 0.0) out += " damping=\"" + digits({a.damping}) + "\"";
        if (a.hasMotor() && a.motorSpeed != 0.0)
            report_.leavesOut("motors", "motor", place_, "a motor of " + what);
        else if (a.hasMotor())
            out += " frictionloss=\"" + digits({a.motorMaxForce}) + "\"";
        return out;
    }

    void loop(const Joint& j) {
        const std::string names = "body1=\"" + nameOf(j.bodyB) + "\"" +
                                  (j.bodyA == kNone ? "" : " body2=\"" + nameOf(j.bodyA) + "\"");
        if (j.type == JointType::Ball && j.axes[0].mode == AxisMode::Usual && !j.axes[0].hasSpring())
            equalities_ += "    <connect name=\"" + escaped(j.name) + "\" " + names + " anchor=\"" +
                           digits(j.anchorB) + "\"/>\n";
        else if (j.type == JointType::Fixed)
            equalities_ += "    <weld name=\"" + escaped(j.name) + "\" " + names + "/>\n";
        else if (j.type == JointType::Distance)
            tendon(j);
        else
            report_.leavesOut(std::string(jointName(j.type)) + "_joints", "joints", place_,
                              std::string("the joint '") + j.name + "', a " + jointName(j.type) +
                                  (isEdge(s_, j) ? " that closes a loop" : " of these coordinates"));
    }

    void tendon(const Joint& j) {
        const JointAxis& a = j.axes[0];
        const bool isRod = a.mode == AxisMode::Usual || a.mode == AxisMode::Locked;
        if ((isRod && !a.hasSpring()) || a.frequency > 0.0 || a.hasMotor()) {
            report_.leavesOut("rods", "joints", place_, "the rod '" + j.name + "' has no exact counterpart");
            return;
        }
        const std::string name = escaped(j.name);
        sites_[j.bodyA] += "<site name=\"" + name + "_a\" pos=\"" + digits(j.anchorA) + "\"/>\n";
        sites_[j.bodyB] += "<site name=\"" + name + "_b\" pos=\"" + digits(j.anchorB) + "\"/>\n";
        tendons_ += "    <spatial name=\"" + name + "\"";
        if (a.mode == AxisMode::Limited)
            tendons_ += " range=\"" + digits({std::max(a.lower, 0.0), std::min(a.upper, 1e10)}) + "\"";
        if (a.hasSpring())
            tendons_ += " stiffness=\"" + digits({a.stiffness}) + "\" damping=\"" + digits({a.damping}) +
                        "\" springlength=\"" + digits({a.target}) + "\"";
        tendons_ += ">\n      <site site=\"" + name + "_a\"/>\n      <site site=\"" + name +
                    "_b\"/>\n    </spatial>\n";
    }

    std::string sites(int index, const std::string& indent) const {
        const auto found = sites_.find(index);
        if (found == sites_.end()) return "";
        std::string out = indent;
        for (std::size_t i = 0; i < found->second.size(); ++i) {
            out += found->second[i];
            if (found->second[i] == '\n' && i + 1 < found->second.size()) out += indent;
        }
        return out;
    }

    // ------------------------------------------------------------------------------------------ shapes
    std::string geom(int index, std::size_t number, const std::string& indent) {
        const Shape& shape = body(index).shapes[number];
        Pose pose = shape.pose;
        std::string kind;
        const auto sized = [](const char* type, std::initializer_list<double> size) {
            return std::string(" type=\"") + type + "\" size=\"" + digits(size) + "\"";
        };
        if (const auto* g = std::get_if<scenario::Sphere>(&shape.geometry))
            kind = sized("sphere", {g->radius});
        if (const auto* g = std::get_if<scenario::Box>(&shape.geometry))
            kind = sized("box", {g->halfExtents.x, g->halfExtents.y, g->halfExtents.z});
        if (const auto* g = std::get_if<scenario::Ellipsoid>(&shape.geometry))
            kind = sized("ellipsoid", {g->halfAxes.x, g->halfAxes.y, g->halfAxes.z});
        if (const auto* g = std::get_if<scenario::Capsule>(&shape.geometry)) {
            kind = sized("capsule", {g->radius, g->halfLength});
            pose = pose * inverse(SceneBuilder::fromZ());
        }
        if (const auto* g = std::get_if<scenario::Cylinder>(&shape.geometry)) {
            kind = sized("cylinder", {g->radius, g->halfLength});
            pose = pose * inverse(SceneBuilder::fromZ());
        }
        if (const auto* g = std::get_if<scenario::HalfSpace>(&shape.geometry)) {
            kind = sized("plane", {0.0, 0.0, 1.0});
            pose = pose * Pose{g->offset * g->normal, turnOfZ(g->normal)};
        }
        if (const auto* g = std::get_if<scenario::ConvexHull>(&shape.geometry)) {
            const std::string name = geomName(index, number) + "_mesh";
            assets_ += "    <mesh name=\"" + name + "\" vertex=\"";
            for (const Vec3& v : g->vertices) assets_ += (&v == g->vertices.data() ? "" : "  ") + digits(v);
            assets_ += "\"/>\n";
            kind = " type=\"mesh\" mesh=\"" + name + "\"";
            report_.changed("hull", place_, "MuJoCo keeps the corners of hulls in single precision");
        }
        if (const auto* g = std::get_if<scenario::HeightField>(&shape.geometry)) {
            kind = " type=\"hfield\" hfield=\"" + heightField(*g, geomName(index, number), pose) + "\"";
            report_.changed("height_field", place_,
                            "heights are in files beside the model, in single precision");
        }
        if (kind.empty()) {
            const bool isMesh = std::holds_alternative<scenario::TriangleMesh>(shape.geometry);
            report_.leavesOut(std::string(geometryName(shape.geometry, 3)) + "_shapes", "shapes", place_,
                              std::string("a ") + geometryName(shape.geometry, 3) + " of '" +
                                  body(index).name + "'" +
                                  (isMesh ? ": MuJoCo collides a mesh as its convex hull" : ""));
            return "";
        }
        return indent + "<geom name=\"" + geomName(index, number) + "\"" + kind + " pos=\"" +
               digits(pose.position) + "\" quat=\"" + digits(pose.orientation) + "\"" + surface(shape) +
               filter(index, shape) + "/>\n";
    }
    /// Puts the heights into a file and moves `pose` to the model's frame, whose z is up and 0 at the lowest height.
    std::string heightField(const scenario::HeightField& field, const std::string& geom, Pose& pose) {
        const auto [low, high] = std::minmax_element(field.heights.begin(), field.heights.end());
        const double lowest = *low, range = *high > lowest ? *high - lowest : 1.0;
        const std::string name = geom + "_heights", file = besideName(s_, name) + ".bin";
        beside_[file] = heightBytes(field, lowest, range);
        assets_ += "    <hfield name=\"" + name + "\" file=\"" + file + "\" size=\"" +
                   digits({0.5 * field.spacingZ * (field.rows - 1),
                           0.5 * field.spacingX * (field.columns - 1), range, field.thickness}) +
                   "\"/>\n";
        pose = pose * Pose{{0.0, lowest, 0.0}, {0.5, -0.5, -0.5, -0.5}};
        return name;
    }
    static Quat turnOfZ(const Vec3& n) {
        const Vec3 axis = cross({0.0, 0.0, 1.0}, n);
        const double sine = norm(axis);
        if (sine < 1e-12) return n.z > 0.0 ? Quat{} : Quat{0.0, 1.0, 0.0, 0.0};
        return scenario::fromAxisAngle(axis / sine, std::atan2(sine, n.z));
    }
    std::string geomName(int index, std::size_t number) const {
        return nameOf(index) + "_" + std::to_string(number);
    }

    static int dimensionOf(const PairCoefficients& c) {
        if (c.rollingFriction > 0.0) return 6;
        if (c.torsionalFriction > 0.0) return 4;
        return c.friction > 0.0 ? 3 : 1;
    }
    PairCoefficients own(const Shape& shape) const {
        return pairCoefficients(s_, shape.material, shape.material);
    }
    std::string surface(const Shape& shape) {
        const PairCoefficients c = own(shape);
        return " condim=\"" + std::to_string(dimensionOf(c)) + "\" friction=\"" +
               digits({c.friction, c.torsionalFriction, c.rollingFriction}) + "\"";
    }

    // ------------------------------------------------------------------------------------------ contacts
    /// Filters of the scene, each with a bit: a shape's contype is its bit, its conaffinity the bits it touches.
    struct Filter {
        scenario::ContactFilter filter;
        bool collides;
        bool operator==(const Filter&) const = default;
    };
    void collectFilters() {
        for (const Body& b : s_.bodies)
            for (const Shape& shape : b.shapes)
                if (const Filter f{shape.filter, b.collides};
                    std::find(filters_.begin(), filters_.end(), f) == filters_.end())
                    filters_.push_back(f);
        if (filters_.size() > kMostFilters)
            report_.leavesOut("contact_filters", "layers", place_, "more than 31 filters of contacts");
    }
    static bool mayMeet(const Filter& a, const Filter& b) {
        return a.collides && b.collides && mayTouch(a.filter, b.filter);
    }
    std::string filter(int index, const Shape& shape) const {
        const Filter f{shape.filter, body(index).collides};
        if (filters_.size() > kMostFilters || (filters_.size() == 1 && mayMeet(f, f))) return "";
        int type = 0, affinity = 0;
        for (std::size_t k = 0; k < filters_.size(); ++k) {
            if (filters_[k] == f) type = 1 << k;
            if (mayMeet(f, filters_[k])) affinity |= 1 << k;
        }
        if (affinity == 0) type = 0;
        return " contype=\"" + std::to_string(type) + "\" conaffinity=\"" + std::to_string(affinity) + "\"";
    }

    bool isStatic(int index) const { return index == kNone || body(index).type == BodyType::Static; }
    /// The topmost body that an index is rigidly part of.
    int weldOf(int index) const {
        while (index != kNone) {
            const TreeJoint& t = tree_.above[static_cast<std::size_t>(index)];
            if (t.joint == kNone || s_.joints[static_cast<std::size_t>(t.joint)].type != JointType::Fixed)
                break;
            index = t.parent;
        }
        return isStatic(index) ? kNone : index;
    }
    /// MuJoCo never collides a body with the one above it, and those welded together.
    bool isApartByTree(int a, int b) const {
        const int weldA = weldOf(a), weldB = weldOf(b);
        if (weldA == weldB) return weldA != kNone;
        const auto above = [&](int weld) {
            if (weld == kNone) return kNone;
            return weldOf(parentOf(tree_.above[static_cast<std::size_t>(weld)]));
        };
        return (weldA != kNone && above(weldB) == weldA) || (weldB != kNone && above(weldA) == weldB);
    }
    void chooseParentFilter() {
        filtersParents_ = true;
        const int n = static_cast<int>(s_.bodies.size());
        for (int a = 0; a < n; ++a)
            for (int b = a + 1; b < n; ++b)
                if (!isStatic(a) && !isStatic(b) && mayCollide(s_, a, b) && isApartByTree(a, b)) {
                    filtersParents_ = false;
                    if (weldOf(a) == weldOf(b))
                        report_.leavesOut("welded_contacts", "fixed", place_,
                                          "contacts between '" + body(a).name + "' and '" + body(b).name +
                                              "', which are rigidly connected");
                }
    }

    std::string contacts() {
        std::string out;
        std::set<std::pair<int, int>> excluded;
        for (const Joint& j : s_.joints) {
            if (j.collideConnected || j.bodyA == kNone) continue;
            if (filtersParents_ && isApartByTree(j.bodyA, j.bodyB)) continue;
            if (excluded.insert(std::minmax(j.bodyA, j.bodyB)).second)
                out += "    <exclude body1=\"" + nameOf(j.bodyA) + "\" body2=\"" + nameOf(j.bodyB) + "\"/>\n";
        }
        return out + pairs();
    }

    /// Explicit pairs of shapes whose law is not MuJoCo's.
    std::string pairs() {
        std::string out;
        std::size_t count = 0;
        const int n = static_cast<int>(s_.bodies.size());
        for (int a = 0; a < n; ++a)
            for (int b = a + 1; b < n; ++b) {
                if (!mayCollide(s_, a, b)) continue;
                for (std::size_t k = 0; k < body(a).shapes.size(); ++k)
                    for (std::size_t l = 0; l < body(b).shapes.size(); ++l) {
                        const std::string text = pair(a, k, b, l);
                        count += text.empty() ? 0 : 1;
                        if (count <= kMostPairs) out += text;
                    }
            }
        if (count > kMostPairs)
            throw Refusal(place_,
                          "more than 20000 pairs of shapes whose friction is not the larger of the two");
        return out;
    }
    std::string pair(int a, std::size_t k, int b, std::size_t l) {
        const Shape &one = body(a).shapes[k], &two = body(b).shapes[l];
        if (!scenario::mayTouch(one, two)) return "";
        const PairCoefficients law = pairCoefficients(s_, one.material, two.material);
        if (law.restitution > 0.0)
            report_.leavesOut("restitution", "restitution", place_,
                              "MuJoCo has no coefficient of restitution");
        if (law.staticFriction > law.friction)
            report_.leavesOut("static_friction", "static_friction", place_,
                              "MuJoCo has one coefficient of friction");
        const PairCoefficients p = own(one), q = own(two);
        const bool same = law.friction == std::max(p.friction, q.friction) &&
                          law.torsionalFriction == std::max(p.torsionalFriction, q.torsionalFriction) &&
                          law.rollingFriction == std::max(p.rollingFriction, q.rollingFriction);
        if (same) return "";
        return "    <pair geom1=\"" + geomName(a, k) + "\" geom2=\"" + geomName(b, l) + "\" condim=\"" +
               std::to_string(dimensionOf(law)) + "\" friction=\"" +
               digits({law.friction, law.friction, law.torsionalFriction, law.rollingFriction,
                       law.rollingFriction}) +
               "\"/>\n";
    }

    // ------------------------------------------------------------------------------------------ velocities
    Vec3 velocityAt(int index, const Vec3& point) const {
        if (index == kNone) return {};
        const Body& b = body(index);
        return b.velocity + cross(b.angularVelocity, point - b.pose * b.massProperties.centerOfMass);
    }
    Vec3 spinOf(int index) const { return index == kNone ? Vec3{} : body(index).angularVelocity; }

    std::string keyframe() {
        const bool rests = std::none_of(s_.bodies.begin(), s_.bodies.end(), [](const Body& b) {
            return b.type == BodyType::Dynamic && (norm(b.velocity) > 0.0 || norm(b.angularVelocity) > 0.0);
        });
        if (rests) return "";
        std::string positions, velocities;
        inTreeOrder(kNone, positions, velocities);
        report_.changed("velocity", place_, "velocities are the keyframe 'start'");
        return "  <keyframe>\n    <key name=\"start\" qpos=\"" + positions + "\" qvel=\"" + velocities +
               "\"/>\n  </keyframe>\n";
    }
    void inTreeOrder(int parent, std::string& q, std::string& v) {
        const auto add = [](std::string& to, const std::string& text) {
            to += (to.empty() ? "" : " ") + text;
        };
        for (const int index : tree_.order) {
            const TreeJoint& t = tree_.above[static_cast<std::size_t>(index)];
            if (parentOf(t) != parent) continue;
            const Body& b = body(index);
            if (b.type == BodyType::Dynamic && t.joint == kNone) {
                add(q, digits(b.pose.position) + " " + digits(b.pose.orientation));
                add(v, digits(velocityAt(index, b.pose.position)) + " " +
                           digits(rotateInverse(b.pose.orientation, b.angularVelocity)));
            } else if (b.type == BodyType::Dynamic) {
                const Joint& j = s_.joints[static_cast<std::size_t>(t.joint)];
                const Vec3 anchor = b.pose * (t.isReversed ? j.anchorA : j.anchorB);
                Vec3 spin = spinOf(index) - spinOf(parent),
                     slide = velocityAt(index, anchor) - velocityAt(parent, anchor);
                for (const Coordinate& c : coordinates(index)) {
                    if (c.kind == Coordinate::Ball) {
                        add(q, "1 0 0 0");
                        add(v, digits(rotateInverse(b.pose.orientation, spin)));
                        spin = {};
                        continue;
                    }
                    const Vec3 axis = rotate(b.pose.orientation, c.axis);
                    Vec3& along = c.kind == Coordinate::Turn ? spin : slide;
                    add(q, "0");
                    add(v, digits({dot(along, axis)}));
                    along = along - dot(along, axis) * axis;
                }
                if (norm(spin) > kConsistent || norm(slide) > kConsistent)
                    report_.leavesOut(
                        "velocities", "velocity", place_,
                        "a velocity of '" + b.name + "' that the joint '" + j.name + "' does not allow");
            }
            inTreeOrder(index, q, v);
        }
    }

    const Scenario& s_;
    Report& report_;
    FilesBeside& beside_;
    Place place_;
    JointTree tree_;
    std::vector<Filter> filters_;
    bool filtersParents_ = true;
    std::map<int, std::string> sites_;
    std::string assets_, body_, equalities_, tendons_;
};

}  // namespace

std::string mjcfText(const Scenario& scenario, Report& report, FilesBeside& beside) {
    refuseCommon(scenario, report);
    MjcfWriter writer(scenario, report, beside);
    writer.loops();
    return writer.write();
}

}  // namespace rigor::models
