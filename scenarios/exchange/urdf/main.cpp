// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The reader of URDF files. A robot is a tree of links; the frame of a link is that of the joint above it. Bullet's
// extensions (capsule, spherical joint, contact) and Drake's friction are read besides what liburdfdom knows.
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <console_bridge/console.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/exchange/common/builder.hpp"
#include "scenarios/exchange/common/files.hpp"
#include "scenarios/exchange/common/text.hpp"
#include "scenarios/exchange/common/xml_file.hpp"
#include "scenarios/exchange/geometry/mesh_file.hpp"
#include "scenarios/exchange/urdf/rules.hpp"

namespace rigor::models {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointType;
using scenario::kNone;
using scenario::Pose;
using scenario::Quat;
using scenario::Vec3;
using tinyxml2::XMLElement;

/// The library's messages, which it prints instead of throwing.
class Messages : public console_bridge::OutputHandler {
  public:
    void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first.empty()) first = text;
    }
    std::string first;
};

Vec3 convert(const urdf::Vector3& v) {
    return {v.x, v.y, v.z};
}
Pose convert(const urdf::Pose& p) {
    return {convert(p.position), normalized(Quat{p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z})};
}

/// Contact extensions of a link or collision, and shapes that the library does not know.
struct Extras {
    std::map<std::string, Surface> linkSurface;
    std::map<std::pair<std::string, int>, Surface> collisionSurface;
    std::set<std::pair<std::string, int>> capsules;
    std::set<std::string> spherical;
    std::map<std::string, Place> links, joints;
    bool statesFriction = false, isDrake = false;
};

double valueOf(const XmlFile& file, const XMLElement& parent, const char* child, double usual) {
    const XMLElement* e = parent.FirstChildElement(child);
    if (!e) return usual;
    std::vector<double> v;
    const char* text = e->Attribute("value");
    if (!text || !readNumbers(text, v) || v.size() != 1 || v[0] < 0.0)
        throw Refusal(file.place(*e),
                      std::string("<") + child + "> value: expected a number that is not negative");
    return v[0];
}

class Extensions {
  public:
    Extensions(XmlFile& file, const ReadOptions& options) : file_(file), options_(options) {}

    /// Takes the extensions out of the document, so that the library can read it.
    Extras take() {
        for (XMLElement* e = file_.root()->FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
            link(*e);
        for (XMLElement* e = file_.root()->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint"))
            joint(*e);
        return std::move(extras_);
    }

  private:
    std::string nameOf(const XMLElement& e) const {
        const char* name = e.Attribute("name");
        if (!name || !*name)
            throw Refusal(file_.place(e), std::string("a <") + e.Name() + "> without a name");
        return name;
    }
    template <class Map>
    void remember(Map& places, const XMLElement& e) const {
        if (!places.emplace(nameOf(e), file_.place(e)).second)
            throw Refusal(file_.place(e),
                          std::string("a second <") + e.Name() + "> of the name '" + nameOf(e) + "'");
    }
    Surface usual() const { return {options_.friction, 0.0, 0.0, 0.0, 6, 0, 0}; }

    void link(XMLElement& e) {
        remember(extras_.links, e);
        const std::string name = nameOf(e);
        Surface surface = usual();
        if (XMLElement* contact = e.FirstChildElement("contact")) {
            surface.friction = valueOf(file_, *contact, "lateral_friction", surface.friction);
            surface.rolling = valueOf(file_, *contact, "rolling_friction", 0.0);
            surface.torsional = valueOf(file_, *contact, "spinning_friction", 0.0);
            surface.restitution = valueOf(file_, *contact, "restitution", 0.0);
            extras_.statesFriction = extras_.statesFriction || contact->FirstChildElement("lateral_friction");
            e.DeleteChild(contact);
        }
        extras_.linkSurface[name] = surface;
        int index = 0;
        for (XMLElement* c = e.FirstChildElement("collision"); c;
             c = c->NextSiblingElement("collision"), ++index)
            collision(*c, name, index, surface);
    }
    void collision(XMLElement& e, const std::string& link, int index, Surface surface) {
        if (XMLElement* drake = e.FirstChildElement("drake:proximity_properties")) {
            const double still = valueOf(file_, *drake, "drake:mu_static", -1.0);
            const double sliding = valueOf(file_, *drake, "drake:mu_dynamic", -1.0);
            if (sliding >= 0.0 || still >= 0.0) {
                surface.friction = sliding >= 0.0 ? sliding : still;
                surface.staticFriction = still > surface.friction ? still : 0.0;
                extras_.collisionSurface[{link, index}] = surface;
                extras_.statesFriction = true;
                extras_.isDrake = true;
            }
            e.DeleteChild(drake);
        }
        XMLElement* geometry = e.FirstChildElement("geometry");
        if (XMLElement* capsule = geometry ? geometry->FirstChildElement("capsule") : nullptr) {
            extras_.capsules.insert({link, index});
            capsule->SetName("cylinder");
        }
    }
    void joint(XMLElement& e) {
        remember(extras_.joints, e);
        if (const char* type = e.Attribute("type"); type && std::string_view(type) == "spherical") {
            extras_.spherical.insert(nameOf(e));
            e.SetAttribute("type", "floating");
        }
    }

    XmlFile& file_;
    const ReadOptions& options_;
    Extras extras_;
};

class Robot {
  public:
    Robot(const ReadOptions& options, Report& report, XmlFile& file, Extras extras,
          const urdf::ModelInterface& model)
        : options_(options),
          report_(report),
          file_(file),
          extras_(std::move(extras)),
          model_(model),
          assets_(options.file, options.assets),
          builder_(options, report, "URDF", "liburdfdom") {}

    Answer convertAll() {
        addLink(*model_.getRoot(), {}, kNone, true);
        rules();
        return builder_.finish();
    }

  private:
    Place linkPlace(const std::string& name) const { return extras_.links.at(name); }
    Place jointPlace(const std::string& name) const { return extras_.joints.at(name); }

    void addLink(const urdf::Link& link, const Pose& pose, int above, bool isRoot) {
        const bool hasMass = link.inertial && link.inertial->mass > 0.0;
        const urdf::Joint* joint = link.parent_joint.get();
        const bool isFixed = joint && joint->type == urdf::Joint::FIXED;
        int body = kNone;
        if (isRoot && (link.name == "world" || options_.fixedBase || !hasMass)) {
            if (link.name != "world")
                report_.changed("<link>", linkPlace(link.name),
                                options_.fixedBase ? "the root does not move (--fixed-base)"
                                                   : "the root has no mass: it does not move");
            body = link.collision_array.empty() ? kNone : add(link, pose, BodyType::Static);
        } else if (!isRoot && !hasMass && isFixed && above != kNone) {
            report_.changed("<link>", linkPlace(link.name),
                            "a link without mass is part of the one above it");
            body = above;
        } else if (!isRoot && isFixed && (above == kNone || type(above) == BodyType::Static)) {
            body = link.collision_array.empty() ? kNone : add(link, pose, BodyType::Static);
        } else if (!hasMass) {
            report_.refuse("<link>", linkPlace(link.name), "a link that moves has no mass");
            return;
        } else {
            body = add(link, pose, BodyType::Dynamic);
        }
        if (body != kNone) addCollisions(link, pose, body);
        if (joint && body != kNone && body != above && type(body) == BodyType::Dynamic)
            addJoint(*joint, pose, above != kNone && type(above) == BodyType::Static ? kNone : above, body);
        for (const auto& child : link.child_links)
            addLink(*child, pose * convert(child->parent_joint->parent_to_joint_origin_transform), body,
                    false);
    }

    BodyType type(int body) const { return builder_.scene.bodies[static_cast<std::size_t>(body)].type; }

    int add(const urdf::Link& link, const Pose& pose, BodyType type) {
        Body body;
        body.pose = pose;
        body.type = type;
        if (type == BodyType::Dynamic) {
            const urdf::Inertial& i = *link.inertial;
            scenario::Mat3 tensor;
            const double values[3][3] = {{i.ixx, i.ixy, i.ixz}, {i.ixy, i.iyy, i.iyz}, {i.ixz, i.iyz, i.izz}};
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c) tensor(r, c) = values[r][c];
            const Pose frame = convert(i.origin);
            const scenario::Mat3 turn = toMatrix(frame.orientation);
            body.massProperties = {i.mass, frame.position, turn * tensor * transpose(turn)};
        }
        return builder_.addBody(link.name, body, linkPlace(link.name));
    }

    void addCollisions(const urdf::Link& link, const Pose& pose, int body) {
        const Pose inBody = inverse(builder_.scene.bodies[static_cast<std::size_t>(body)].pose) * pose;
        int index = 0;
        for (const auto& collision : link.collision_array) {
            const std::pair<std::string, int> key{link.name, index++};
            const auto own = extras_.collisionSurface.find(key);
            const Surface& surface =
                own != extras_.collisionSurface.end() ? own->second : extras_.linkSurface.at(link.name);
            const Pose at = inBody * convert(collision->origin);
            if (const auto* ball = dynamic_cast<const urdf::Sphere*>(collision->geometry.get()))
                builder_.addShape(body, scenario::Sphere{ball->radius}, at, surface, 0);
            else if (const auto* box = dynamic_cast<const urdf::Box*>(collision->geometry.get()))
                builder_.addShape(body, scenario::Box{0.5 * convert(box->dim)}, at, surface, 0);
            else if (const auto* round = dynamic_cast<const urdf::Cylinder*>(collision->geometry.get())) {
                if (extras_.capsules.contains(key))
                    builder_.addRoundZ(body, scenario::Capsule{round->radius, 0.5 * round->length}, at,
                                       surface, 0);
                else
                    builder_.addRoundZ(body, scenario::Cylinder{round->radius, 0.5 * round->length}, at,
                                       surface, 0);
            } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(collision->geometry.get())) {
                const Place place = linkPlace(link.name);
                const auto parts = readMesh(assets_.find(mesh->filename, place), convert(mesh->scale), place);
                addMesh(builder_, report_, body, parts, at, surface, 0, options_, place);
            } else {
                report_.refuse("<collision>", linkPlace(link.name),
                               "a collision without a shape that is known");
            }
        }
    }

    void addJoint(const urdf::Joint& joint, const Pose& pose, int a, int b) {
        const Place place = jointPlace(joint.name);
        const Vec3 at = pose.position;
        const double length = norm(convert(joint.axis));
        const bool needsAxis = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
                               joint.type == urdf::Joint::PRISMATIC || joint.type == urdf::Joint::PLANAR;
        if (needsAxis && !(length > 0.0))
            return report_.refuse("<axis>", place, "an axis without a direction");
        const Vec3 axis =
            needsAxis ? rotate(pose.orientation, convert(joint.axis) / length) : Vec3{0.0, 0.0, 1.0};
        if (extras_.spherical.contains(joint.name)) {
            builder_.addJoint(joint.name, JointType::Ball, a, b, at, axis, place);
            return;
        }
        switch (joint.type) {
            case urdf::Joint::REVOLUTE:
            case urdf::Joint::CONTINUOUS:
                return control(joint, builder_.addJoint(joint.name, JointType::Hinge, a, b, at, axis, place));
            case urdf::Joint::PRISMATIC:
                return control(joint,
                               builder_.addJoint(joint.name, JointType::Slider, a, b, at, axis, place));
            case urdf::Joint::FIXED:
                builder_.addJoint(joint.name, JointType::Fixed, a, b, at, axis, place);
                return;
            case urdf::Joint::FLOATING:
                return;
            case urdf::Joint::PLANAR:
                return addPlanar(joint, at, axis, place, a, b);
            default:
                return report_.refuse("<joint> type", place, "a kind of joint that is not known");
        }
    }

    /// Free along two normals of the axis, and about the axis.
    void addPlanar(const urdf::Joint& joint, const Vec3& at, const Vec3& axis, const Place& place, int a,
                   int b) {
        const Vec3 other = std::abs(axis.x) < 0.7 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
        const Vec3 across = cross(axis, other);
        Joint& made =
            builder_.addJoint(joint.name, JointType::SixDof, a, b, at, axis, place, across / norm(across));
        for (auto& coordinate : made.axes) coordinate.mode = AxisMode::Locked;
        for (const std::size_t k : {1u, 2u, 3u}) made.axes[k].mode = AxisMode::Free;
    }

    void control(const urdf::Joint& joint, Joint& made) {
        auto& axis = made.axes[0];
        const bool hasLimits = joint.limits && joint.type != urdf::Joint::CONTINUOUS;
        if (hasLimits && (joint.limits->lower > -kUnlimited || joint.limits->upper < kUnlimited)) {
            axis.mode = AxisMode::Limited;
            if (joint.limits->lower > -kUnlimited) axis.lower = joint.limits->lower;
            if (joint.limits->upper < kUnlimited) axis.upper = joint.limits->upper;
        }
        if (!joint.dynamics) return;
        axis.damping = joint.dynamics->damping;
        if (joint.dynamics->friction > 0.0) {
            axis.motorMaxForce = joint.dynamics->friction;
            report_.changed("<dynamics> friction", jointPlace(joint.name),
                            "a motor of speed 0 and this strength");
        }
    }

    void rules() {
        const Place place{file_.shownName(), 0};
        const bool hasShapes = std::any_of(builder_.scene.bodies.begin(), builder_.scene.bodies.end(),
                                           [](const Body& b) { return !b.shapes.empty(); });
        if (!extras_.statesFriction && hasShapes)
            report_.changed("friction", place,
                            "the file states none: " + digits({options_.friction}) + " (--friction)");
        if (extras_.isDrake)
            builder_.setMixing(harmonic, "Drake's rule, 2 a b / (a + b)");
        else
            builder_.setMixing(product, "Bullet's rule, the product");
        if (options_.selfCollision) return;
        for (Body& body : builder_.scene.bodies)
            for (auto& shape : body.shapes) shape.filter.group = -1;
        if (builder_.scene.bodies.size() > 1 && hasShapes)
            report_.changed("contacts", place,
                            "links of the robot do not collide with each other (--self-collision)");
    }
    static scenario::PairCoefficients harmonic(const Surface& a, const Surface& b) {
        const auto mean = [](double x, double y) { return x + y > 0.0 ? 2.0 * x * y / (x + y) : 0.0; };
        const double sliding = mean(a.friction, b.friction);
        const double still =
            mean(std::max(a.friction, a.staticFriction), std::max(b.friction, b.staticFriction));
        return {sliding, a.restitution * b.restitution, still > sliding ? still : 0.0,
                mean(a.rolling, b.rolling), mean(a.torsional, b.torsional)};
    }

    const ReadOptions& options_;
    Report& report_;
    XmlFile& file_;
    Extras extras_;
    const urdf::ModelInterface& model_;
    AssetFolders assets_;
    SceneBuilder builder_;
};

Answer read(const ReadOptions& options) {
    Report report(options.without);
    XmlFile file(options.file);
    if (std::string_view(file.root()->Name()) != "robot")
        throw Refusal(file.place(*file.root()),
                      std::string("found <") + file.root()->Name() + ">, expected <robot>");
    applyRules(file, urdfRules(), report);
    Extras extras = Extensions(file, options).take();
    if (report.isRefused()) return {"", report};
    static Messages messages;
    console_bridge::useOutputHandler(&messages);
    const auto model = urdf::parseURDF(textOnSameLines(*file.root()));
    if (!model || !model->getRoot())
        throw Refusal({file.shownName(), 0}, "liburdfdom says: " + messages.first);
    return Robot(options, report, file, std::move(extras), *model).convertAll();
}

}  // namespace
}  // namespace rigor::models

int main(int argc, char** argv) {
    return rigor::models::runReader(argc, argv, rigor::models::read);
}
