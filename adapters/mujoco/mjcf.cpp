// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/mujoco/mjcf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/mujoco/coordinates.hpp"
#include "adapters/mujoco/geoms.hpp"

namespace rigor::mujoco {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;

std::string poseText(const Pose& pose) {
    return attribute("pos", exact(pose.position)) + attribute("quat", exact(pose.orientation));
}
class ModelWriter {
  public:
    ModelWriter(const adapter::Scenario& scenario, const adapter::PairTable& pairs, bool planar, double dt,
                const ModelSettings& settings, Model& model)
        : scenario_(scenario),
          pairs_(pairs),
          planar_(planar),
          dt_(dt),
          settings_(settings),
          model_(model),
          coordinates_(scenario, planar, settings, model) {}

    std::string text() {
        model_.common = commonSurface();
        std::string world;
        for (const int body : model_.forest.order)
            if (model_.forest.links[body].parent == kNone) writeBody(body, world);
        world += planes_;
        writeTendons(world);
        writeLoops();
        std::string pairs = explicitPairs();
        return "<mujoco>" + head() + "<asset>" + assets_ + "</asset><worldbody>" + world +
               "</worldbody><contact>" + pairs + "</contact><tendon>" + tendons_ + "</tendon><equality>" +
               equalities_ + "</equality><actuator>" + coordinates_.actuators() + "</actuator></mujoco>";
    }

  private:
    std::string head() const {
        const std::string options =
            attribute("timestep", exact(dt_)) + attribute("gravity", exact(scenario_.gravity)) +
            attribute("integrator", settings_.integrator) + attribute("cone", settings_.cone) +
            attribute("solver", settings_.solver) + attribute("jacobian", settings_.jacobian) +
            attribute("iterations", std::to_string(settings_.iterations)) +
            attribute("tolerance", exact(settings_.tolerance)) +
            attribute("impratio", exact(settings_.impratio)) +
            attribute("noslip_iterations", std::to_string(settings_.noslipIterations));
        const std::string flags = std::string("<flag filterparent=\"disable\"") +
                                  (settings_.warmStart ? "" : " warmstart=\"disable\"") +
                                  (settings_.safeReference ? "" : " refsafe=\"disable\"") + "/>";
        const Surface& s = model_.common;
        return "<compiler angle=\"radian\" coordinate=\"local\" inertiafromgeom=\"false\"/><option" +
               options + ">" + flags + "</option><size nuserdata=\"1\"/><default><geom" +
               attribute("condim", std::to_string(s.dimension())) +
               attribute("friction", exact(s.friction) + " " + exact(s.torsional) + " " + exact(s.rolling)) +
               softnessText(s.softness(settings_.softness, settings_.bounceFrequency)) + "/><equality" +
               softnessText(settings_.rigid) + "/></default>";
    }

    Surface surface(int materialA, int materialB) const {
        Surface s = surfaceOf(pairs_.coefficients(materialA, materialB));
        if (!settings_.restitution) s.restitution = 0.0;
        return s;
    }

    /// The surface of the most pairs of shapes, which all geoms have; pairs of another one are named.
    Surface commonSurface() const {
        std::vector<double> shapesOf(scenario_.materials.size());
        for (const Body& body : scenario_.bodies)
            for (const auto& shape : body.shapes) shapesOf[shape.material] += 1.0;
        std::vector<std::pair<Surface, double>> found;
        for (const auto& example : pairs_.examples()) {
            const Surface s = surface(example.materialA, example.materialB);
            const double count = shapesOf[example.materialA] * shapesOf[example.materialB];
            const auto same =
                std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == s; });
            if (same == found.end())
                found.emplace_back(s, count);
            else
                same->second += count;
        }
        const auto most = std::max_element(found.begin(), found.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        return most == found.end() ? Surface{} : most->first;
    }

    std::string explicitPairs() {
        std::string text;
        const int count = static_cast<int>(scenario_.bodies.size());
        bool uniform = true;
        for (const auto& example : pairs_.examples())
            uniform = uniform && surface(example.materialA, example.materialB) == model_.common;
        if (uniform) return text;
        for (int a = 0; a < count; ++a)
            for (int b = a + 1; b < count; ++b) {
                if (!pairs_.mayCollide(a, b)) continue;
                const auto &shapesA = scenario_.bodies[a].shapes, &shapesB = scenario_.bodies[b].shapes;
                for (std::size_t i = 0; i < shapesA.size(); ++i)
                    for (std::size_t j = 0; j < shapesB.size(); ++j) {
                        const Surface s = surface(shapesA[i].material, shapesB[j].material);
                        if (s == model_.common || !pairs_.shapesMayTouch(a, i, b, j)) continue;
                        text += pairText(geomName(a, i), geomName(b, j), s);
                        ++model_.explicitPairs;
                    }
            }
        return text;
    }
    std::string pairText(const std::string& a, const std::string& b, const Surface& s) const {
        const std::string slide = exact(s.friction), roll = exact(s.rolling);
        return "<pair" + attribute("geom1", a) + attribute("geom2", b) +
               attribute("condim", std::to_string(s.dimension())) +
               attribute("friction",
                         slide + " " + slide + " " + exact(s.torsional) + " " + roll + " " + roll) +
               softnessText(s.softness(settings_.softness, settings_.bounceFrequency)) + "/>";
    }

    void writeBody(int index, std::string& out) {
        const Body& body = scenario_.bodies[index];
        const Link& link = model_.forest.links[index];
        out += "<body" + attribute("name", bodyName(index)) + poseText(link.rest) + ">";
        if (!link.fixed) {
            const bool dynamic = body.type == BodyType::Dynamic;
            const double mass = dynamic ? body.massProperties.mass : kKinematicMass;
            // The compiler refuses moments of no solid; the true ones are written into the model.
            const double moment =
                dynamic ? std::max({link.moments.x, link.moments.y, link.moments.z}) : kKinematicMass;
            out += "<inertial pos=\"0 0 0\"" + attribute("mass", exact(mass)) +
                   attribute("diaginertia", exact(Vec3{moment, moment, moment})) + "/>";
            if (link.joint == kNone)
                writeFree(link, out);
            else
                out += coordinates_.text(link);
        }
        if (body.collides)
            for (std::size_t i = 0; i < body.shapes.size(); ++i) {
                // Two bodies with planes overflow MuJoCo's broad phase; planes of the world do not.
                const bool plane = std::holds_alternative<scenario::HalfSpace>(body.shapes[i].geometry);
                writeGeom(index, static_cast<int>(i), plane ? link.rest : Pose{}, plane ? planes_ : out);
            }
        for (std::size_t j = 0; j < scenario_.joints.size(); ++j) {
            const Joint& joint = scenario_.joints[j];
            if (!hasTendon(joint)) continue;
            const Ends ends = endsOf(joint);
            if (joint.bodyA == index) writeSite(jointTag(j, "_a"), inverse(link.frame) * ends.a, out);
            if (joint.bodyB == index) writeSite(jointTag(j, "_b"), inverse(link.frame) * ends.b, out);
        }
        for (const int child : link.children) writeBody(child, out);
        out += "</body>";
    }
    static bool hasTendon(const Joint& joint) {
        return joint.type == JointType::Distance || swingLimit(joint) < std::numbers::pi;
    }
    /// Ends of a joint's tendon in the frames of its bodies.
    struct Ends {
        Vec3 a, b;
    };
    static Ends endsOf(const Joint& joint) {
        if (joint.type == JointType::Distance) return {joint.anchorA, joint.anchorB};
        return {joint.anchorA + joint.axisA, joint.anchorB + joint.axisB};
    }
    static void writeSite(const std::string& name, const Vec3& at, std::string& out) {
        out += "<site" + attribute("name", name) + attribute("pos", exact(at)) + "/>";
    }

    /// In a plane the coordinates are those of the world: the axes of slides stand in the turned frame.
    void writeFree(const Link& link, std::string& out) const {
        if (!planar_) {
            out += "<freejoint/>";
            return;
        }
        const Pose& rest = link.rest;
        const Vec3 x = rotateInverse(rest.orientation, {1, 0, 0}),
                   y = rotateInverse(rest.orientation, {0, 1, 0});
        out += "<joint type=\"slide\"" + attribute("axis", exact(x)) +
               attribute("ref", exact(rest.position.x)) + "/><joint type=\"slide\"" +
               attribute("axis", exact(y)) + attribute("ref", exact(rest.position.y)) +
               "/><joint type=\"hinge\" axis=\"0 0 1\"" +
               attribute("ref", exact(angleAboutZ(rest.orientation))) + "/>";
    }

    /// `place` is the pose of the body's frame in that of the element that the geom is written into.
    void writeGeom(int body, int shape, const Pose& place, std::string& out) {
        const auto& source = scenario_.bodies[body].shapes[shape];
        const GeomText geom = geomText(source.geometry, geomName(body, shape));
        const Pose pose = place * inverse(model_.forest.links[body].frame) * source.pose * geom.frame;
        out += "<geom" + attribute("name", geomName(body, shape)) + " " + geom.attributes + poseText(pose) +
               "/>";
        assets_ += geom.asset;
    }

    /// A distance joint is a straight tendon between two sites: a rod holds its length, a rope bounds it. So is the
    /// bound of a swing: two points a metre from the anchor, along the axes of A and B, are 2 sin(swing / 2) apart.
    void writeTendons(std::string& world) {
        for (std::size_t j = 0; j < scenario_.joints.size(); ++j) {
            const Joint& joint = scenario_.joints[j];
            if (!hasTendon(joint)) continue;
            if (joint.bodyA == kNone) writeSite(jointTag(j, "_a"), endsOf(joint).a, world);
            tendons_ += "<spatial" + attribute("name", jointTag(j));
            if (joint.type == JointType::Distance)
                writeDistance(static_cast<int>(j));
            else
                tendons_ += bounds(0.0, 2.0 * std::sin(0.5 * swingLimit(joint)), settings_.softness);
            tendons_ += "><site" + attribute("site", jointTag(j, "_a")) + "/><site" +
                        attribute("site", jointTag(j, "_b")) + "/></spatial>";
        }
    }
    static std::string bounds(double lower, double upper, const Softness& softness) {
        return " limited=\"true\"" + attribute("range", exact(lower) + " " + exact(upper)) +
               softnessText(softness, "solreflimit", "solimplimit");
    }
    void writeDistance(int index) {
        const Joint& joint = scenario_.joints[index];
        const JointAxis& axis = joint.axes[0];
        const bool rod = axis.mode != AxisMode::Limited && axis.mode != AxisMode::Free;
        if (canBreak(joint) && !rod)
            throw adapter::notInLibrary("mujoco", "a distance that breaks and is no rod", kEqualities,
                                        "joint '" + joint.name + "'");
        if (axis.mode == AxisMode::Limited)
            tendons_ += bounds(std::max(axis.lower, 0.0), std::min(axis.upper, 1e6), settings_.rigid);
        if (axis.hasSpring())
            tendons_ += attribute("stiffness", exact(axis.stiffness)) +
                        attribute("damping", exact(axis.damping)) +
                        attribute("springlength", exact(std::max(axis.target, 0.0)));
        coordinates_.addMotor(index, attribute("tendon", jointTag(index)), axis);
        if (!rod) return;
        const auto poseOf = [&](int body) { return body == kNone ? Pose{} : scenario_.bodies[body].pose; };
        const double now = norm(poseOf(joint.bodyB) * joint.anchorB - poseOf(joint.bodyA) * joint.anchorA);
        addEquality(index, "tendon",
                    attribute("tendon1", jointTag(index)) +
                        attribute("polycoef", exact(joint.length - now) + " 0 0 0 0"));
    }
    /// The text's order of equalities is the model's.
    void addEquality(int joint, const char* kind, const std::string& attributes) {
        model_.equalities[joint].push_back(model_.equalityCount++);
        equalities_ += std::string("<") + kind + attributes + "/>";
    }

    void writeLoops() {
        for (const int j : model_.forest.loops) {
            const Joint& joint = scenario_.joints[j];
            if (!canCloseLoop(joint))
                throw adapter::notInLibrary("mujoco",
                                            std::string("joint '") + jointName(joint.type) +
                                                "' with more than its kind that " +
                                                (canBreak(joint) ? "breaks" : "closes a loop"),
                                            kEqualities, "joint '" + joint.name + "'");
            // body1 is one of the model's, body2 the world where it is left out.
            const bool ofB = joint.bodyB != kNone;
            const int one = ofB ? joint.bodyB : joint.bodyA, two = ofB ? joint.bodyA : kNone;
            const Link& link = model_.forest.links[one];
            const Vec3 anchor = inverse(link.frame) * (ofB ? joint.anchorB : joint.anchorA);
            const Vec3 along = rotateInverse(link.frame.orientation, ofB ? joint.axisB : joint.axisA);
            const std::string ends =
                attribute("body1", bodyName(one)) + (two == kNone ? "" : attribute("body2", bodyName(two)));
            if (joint.type == JointType::Fixed) {
                addEquality(j, "weld", ends + attribute("anchor", exact(weldPoint(joint, two))));
                continue;
            }
            addEquality(j, "connect", ends + attribute("anchor", exact(anchor)));
            // A second point of the axis takes the two turns away that a ball has more.
            if (joint.type == JointType::Hinge && !planar_)
                addEquality(j, "connect", ends + attribute("anchor", exact(anchor + kConnectArm * along)));
        }
    }
    /// The anchor in MuJoCo's frame of the second body of a weld, or in the world.
    Vec3 weldPoint(const Joint& joint, int second) const {
        if (second != kNone) return inverse(model_.forest.links[second].frame) * joint.anchorA;
        return joint.bodyB == kNone ? scenario_.bodies[joint.bodyA].pose * joint.anchorA : joint.anchorA;
    }

    const adapter::Scenario& scenario_;
    const adapter::PairTable& pairs_;
    bool planar_;
    double dt_;
    const ModelSettings& settings_;
    Model& model_;
    CoordinateWriter coordinates_;
    std::string assets_, planes_, tendons_, equalities_;
};

}  // namespace

std::string bodyName(int body) {
    return "b" + std::to_string(body);
}
std::string geomName(int body, int shape) {
    return "g" + std::to_string(body) + "_" + std::to_string(shape);
}
std::string jointTag(int joint, const char* what) {
    return "j" + std::to_string(joint) + what;
}

std::string mjcfOf(const adapter::Scenario& scenario, const adapter::PairTable& pairs, bool planar, double dt,
                   const ModelSettings& settings, Model& model) {
    return ModelWriter(scenario, pairs, planar, dt, settings, model).text();
}

}  // namespace rigor::mujoco
