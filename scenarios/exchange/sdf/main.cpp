// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The reader of SDF files: models of a world, or one model, with their nested models. Names of bodies are those of the
// models and the link, with points between.
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <sdf/sdf.hh>

#include "scenarios/exchange/common/builder.hpp"
#include "scenarios/exchange/common/files.hpp"
#include "scenarios/exchange/common/text.hpp"
#include "scenarios/exchange/geometry/mesh_file.hpp"
#include "scenarios/exchange/sdf/rules.hpp"

namespace rigor::models {
namespace {

using scenario::AxisMode;
using scenario::Body;
using scenario::BodyType;
using scenario::Joint;
using scenario::JointType;
using scenario::kNone;
using scenario::Pose;
using scenario::Vec3;
using tinyxml2::XMLElement;

constexpr double kUsualDensity = 1000.0;  ///< default of the format for inertia from shapes [kg/m^3]
constexpr double kUsualThreshold = 1e5;   ///< default of the format for bounces [m/s]

Vec3 convert(const ignition::math::Vector3d& v) {
    return {v.X(), v.Y(), v.Z()};
}
Pose convert(const ignition::math::Pose3d& p) {
    return {convert(p.Pos()), normalized(scenario::Quat{p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()})};
}

/// Things newer than the library: inertia that is left to the reader, by the line of the link, densities by that of the
/// collision, and the collisions that are cones.
struct Newer {
    std::map<int, double> links, densities;
    std::set<int> cones;
};

Newer takeNewer(XmlFile& file) {
    Newer found;
    const auto densityOf = [&](XMLElement& e) {
        XMLElement* density = e.FirstChildElement("density");
        if (!density) return -1.0;
        std::vector<double> v;
        const char* text = density->GetText();
        if (!text || !readNumbers(text, v) || v.size() != 1 || !(v[0] > 0.0))
            throw Refusal(file.place(*density), "<density>: expected a positive number");
        e.DeleteChild(density);
        return v[0];
    };
    const std::function<void(XMLElement&)> look = [&](XMLElement& e) {
        for (XMLElement* c = e.FirstChildElement(); c; c = c->NextSiblingElement()) look(*c);
        if (std::string_view(e.Name()) == "collision") {
            if (const double density = densityOf(e); density > 0.0) found.densities[e.GetLineNum()] = density;
            XMLElement* geometry = e.FirstChildElement("geometry");
            if (XMLElement* cone = geometry ? geometry->FirstChildElement("cone") : nullptr) {
                found.cones.insert(e.GetLineNum());
                cone->SetName("cylinder");
            }
        }
        XMLElement* inertial =
            std::string_view(e.Name()) == "link" ? e.FirstChildElement("inertial") : nullptr;
        if (!inertial) return;
        const double density = densityOf(*inertial);
        const char* given = inertial->Attribute("auto");
        if (!given) return;
        if (std::string_view(given) == "true" || std::string_view(given) == "1")
            found.links[e.GetLineNum()] = density > 0.0 ? density : kUsualDensity;
        inertial->DeleteAttribute("auto");
    };
    look(*file.root());
    return found;
}

class World {
  public:
    World(const ReadOptions& options, Report& report, XmlFile& file, Newer newer)
        : options_(options),
          report_(report),
          file_(file),
          newer_(std::move(newer)),
          assets_(options.file, options.assets),
          builder_(options, report, "SDF", std::string("libsdformat ") + SDF_VERSION_FULL) {
        builder_.scene.gravity = {0.0, 0.0, -9.8};
    }

    Answer convertAll(const sdf::Root& root) {
        if (root.WorldCount() > 1) throw Refusal({file_.shownName(), 0}, "more than one world");
        if (const sdf::World* world = root.WorldByIndex(0)) {
            builder_.scene.gravity = convert(world->Gravity());
            if (world->PhysicsDefault()) builder_.setTimeStep(world->PhysicsDefault()->MaxStepSize());
            for (uint64_t i = 0; i < world->ModelCount(); ++i) topModel(*world->ModelByIndex(i));
        } else if (root.Model()) {
            topModel(*root.Model());
        } else {
            throw Refusal({file_.shownName(), 0}, "neither a world nor a model");
        }
        builder_.setMixing(smaller, "Gazebo's rule, the smaller value of each");
        builder_.setContacts([this](int a, int b) {
            return (masks_[static_cast<std::size_t>(a)] & masks_[static_cast<std::size_t>(b)]) != 0;
        });
        return builder_.finish();
    }

  private:
    Place placeOf(const sdf::ElementPtr& element) const {
        std::string shown = file_.shownName();
        if (element && !element->FilePath().empty() && element->FilePath().front() != '<')
            shown = std::filesystem::path(element->FilePath()).filename().string();
        return {shown, element && element->LineNumber() ? *element->LineNumber() : 0};
    }
    Pose resolve(const sdf::SemanticPose& semantic, const std::string& to, const Place& place) const {
        ignition::math::Pose3d pose;
        const sdf::Errors errors = semantic.Resolve(pose, to);
        if (!errors.empty()) throw Refusal(place, "libsdformat says: " + errors.front().Message());
        return convert(pose);
    }

    void topModel(const sdf::Model& m) {
        --group_;
        selfCollision_.reset();
        const bool inWorld = m.SemanticPose().Resolve(scratch_, "").empty();
        model(m, inWorld ? convert(scratch_) : convert(m.RawPose()), "", m.Static());
    }

    void model(const sdf::Model& m, const Pose& pose, const std::string& path, bool isStatic) {
        const std::string name = path.empty() ? m.Name() : path + "::" + m.Name();
        const bool still = isStatic || m.Static();
        for (uint64_t i = 0; i < m.LinkCount(); ++i) link(*m.LinkByIndex(i), m, pose, name, still);
        for (uint64_t i = 0; i < m.ModelCount(); ++i) {
            const sdf::Model& inner = *m.ModelByIndex(i);
            model(inner, pose * resolve(inner.SemanticPose(), "__model__", placeOf(inner.Element())), name,
                  still);
        }
        for (uint64_t i = 0; i < m.JointCount(); ++i) joint(*m.JointByIndex(i), pose, name);
    }

    /// "a::b" as a name that a scenario takes: "a.b".
    static std::string withPoints(const std::string& name) {
        return std::regex_replace(name, std::regex("::"), ".");
    }
    static bool flag(const sdf::ElementPtr& element, const char* key, bool usual) {
        return element && element->HasElement(key) ? element->Get<bool>(key) : usual;
    }

    void link(const sdf::Link& l, const sdf::Model& m, const Pose& modelPose, const std::string& path,
              bool isStatic) {
        const Place place = placeOf(l.Element());
        Body body;
        body.pose = modelPose * resolve(l.SemanticPose(), "__model__", place);
        if (flag(l.Element(), "kinematic", false)) body.type = BodyType::Kinematic;
        if (isStatic) body.type = BodyType::Static;
        const auto inertial = l.Inertial();
        if (body.type == BodyType::Dynamic) {
            const auto moments = inertial.Moi();
            scenario::Mat3 tensor;
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 3; ++c)
                    tensor(static_cast<int>(r), static_cast<int>(c)) = moments(r, c);
            body.massProperties = {inertial.MassMatrix().Mass(), convert(inertial.Pose().Pos()), tensor};
        }
        if (!flag(l.Element(), "gravity", true)) body.gravityScale = 0.0;
        const std::string name = path + "::" + l.Name();
        const int index = builder_.addBody(withPoints(name), body, place);
        bodies_[name] = index;
        for (uint64_t i = 0; i < l.CollisionCount(); ++i) collision(*l.CollisionByIndex(i), index);
        const auto computed = newer_.links.find(place.line);
        if (computed != newer_.links.end() && body.type == BodyType::Dynamic)
            setInertia(l, index, computed->second, place);
        groups(flag(l.Element(), "self_collide", m.SelfCollide()), index, place);
    }

    /// Links of one model collide only if both say so; here all of a model must agree.
    void groups(bool collides, int index, const Place& place) {
        if (selfCollision_ && *selfCollision_ != collides)
            report_.leavesOut("self_collide", "<self_collide>", place,
                              "links of one model that differ in it");
        selfCollision_ = collides;
        if (collides) return;
        for (auto& shape : builder_.scene.bodies[static_cast<std::size_t>(index)].shapes)
            shape.filter.group = group_;
    }

    void setInertia(const sdf::Link& l, int index, double density, const Place& place) {
        Body& body = builder_.scene.bodies[static_cast<std::size_t>(index)];
        std::vector<scenario::Material> materials;
        std::vector<scenario::Shape> shapes = body.shapes;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const int line = i < l.CollisionCount() ? placeOf(l.CollisionByIndex(i)->Element()).line : 0;
            const auto own = newer_.densities.find(line);
            scenario::Material material;
            material.density = own != newer_.densities.end() ? own->second : density;
            materials.push_back(material);
            shapes[i].material = static_cast<int>(i);
        }
        if (shapes.empty())
            return report_.refuse("<inertial> auto", place, "a link without shapes to take mass from");
        body.massProperties = scenario::massPropertiesFromShapes(shapes, materials, 3);
        report_.changed("<inertial> auto", place,
                        "mass and inertia were computed from the densities of the shapes");
    }

    static double number(const sdf::ElementPtr& parent, const char* key, double usual) {
        return parent && parent->HasElement(key) ? parent->Get<double>(key) : usual;
    }
    static sdf::ElementPtr child(const sdf::ElementPtr& parent, const char* key) {
        return parent && parent->HasElement(key) ? parent->GetElement(key) : nullptr;
    }

    Surface surface(const sdf::Collision& c, const Place& place) {
        const sdf::ElementPtr element = child(c.Element(), "surface");
        const sdf::ElementPtr ode = child(child(element, "friction"), "ode");
        const double mu = number(ode, "mu", 1.0), mu2 = number(ode, "mu2", 1.0);
        if (mu != mu2)
            report_.leavesOut("anisotropic_friction", "<mu2>", place,
                              "friction that depends on the direction (mu " + digits({mu}) + ", mu2 " +
                                  digits({mu2}) + (ode->HasElement("mu2") ? "" : " by default") +
                                  "); without it mu holds for all");
        const sdf::ElementPtr bounce = child(element, "bounce");
        double restitution = number(bounce, "restitution_coefficient", 0.0);
        if (restitution > 0.0 && number(bounce, "threshold", kUsualThreshold) > 0.0 &&
            report_.leavesOut(
                "restitution_threshold", "<bounce>", place,
                "restitution above a threshold of the speed alone; without it restitution always holds"))
            restitution = number(bounce, "restitution_coefficient", 0.0);
        return {mu, restitution, 0.0, 0.0, 6, 0, 0};
    }

    int maskOf(const sdf::Collision& c) {
        const sdf::Surface* surface = c.Surface();
        const unsigned mask = surface && surface->Contact() ? surface->Contact()->CollideBitmask() : 0xFFFFu;
        for (std::size_t i = 0; i < masks_.size(); ++i)
            if (masks_[i] == mask) return static_cast<int>(i);
        masks_.push_back(mask);
        return static_cast<int>(masks_.size()) - 1;
    }

    void collision(const sdf::Collision& c, int body) {
        const Place place = placeOf(c.Element());
        const Pose pose = resolve(c.SemanticPose(), "", place);
        const Surface law = surface(c, place);
        const int kind = maskOf(c);
        const sdf::Geometry& g = *c.Geom();
        switch (g.Type()) {
            case sdf::GeometryType::EMPTY:
                return;
            case sdf::GeometryType::BOX:
                return builder_.addShape(body, scenario::Box{0.5 * convert(g.BoxShape()->Size())}, pose, law,
                                         kind);
            case sdf::GeometryType::SPHERE:
                return builder_.addShape(body, scenario::Sphere{g.SphereShape()->Radius()}, pose, law, kind);
            case sdf::GeometryType::CYLINDER:
                if (newer_.cones.contains(place.line))
                    return builder_.addRoundZ(
                        body, scenario::Cone{g.CylinderShape()->Radius(), 0.5 * g.CylinderShape()->Length()},
                        pose, law, kind);
                return builder_.addRoundZ(
                    body, scenario::Cylinder{g.CylinderShape()->Radius(), 0.5 * g.CylinderShape()->Length()},
                    pose, law, kind);
            case sdf::GeometryType::CAPSULE:
                return builder_.addRoundZ(
                    body, scenario::Capsule{g.CapsuleShape()->Radius(), 0.5 * g.CapsuleShape()->Length()},
                    pose, law, kind);
            case sdf::GeometryType::ELLIPSOID:
                return builder_.addShape(body, scenario::Ellipsoid{convert(g.EllipsoidShape()->Radii())},
                                         pose, law, kind);
            case sdf::GeometryType::PLANE:
                return plane(convert(g.PlaneShape()->Normal()), body, pose, law, kind, place);
            case sdf::GeometryType::MESH: {
                const auto file = assets_.find(g.MeshShape()->Uri(), place);
                return addMesh(builder_, report_, body,
                               readMesh(file, convert(g.MeshShape()->Scale()), place), pose, law, kind,
                               options_, place);
            }
            default:
                report_.refuse("<geometry>", place, "a kind of shape that is not read");
        }
    }

    void plane(const Vec3& normal, int body, const Pose& pose, const Surface& law, int kind,
               const Place& place) {
        if (builder_.scene.bodies[static_cast<std::size_t>(body)].type != BodyType::Static)
            return report_.refuse("<plane>", place, "a plane on a body that moves");
        report_.changed("<plane>", place, "a half-space: a plane collides beyond its size, as in Gazebo");
        builder_.addShape(body, scenario::HalfSpace{normal, 0.0}, pose, law, kind);
    }

    /// The body that a joint is attached to: the world where it does not move.
    std::optional<int> endOf(const std::string& name, const std::string& path, const Place& place) {
        if (name == "world") return kNone;
        const auto found = bodies_.find(path + "::" + name);
        if (found == bodies_.end()) {
            report_.refuse("<joint>", place, "no link '" + name + "'");
            return std::nullopt;
        }
        const bool isStatic =
            builder_.scene.bodies[static_cast<std::size_t>(found->second)].type == BodyType::Static;
        return isStatic ? kNone : found->second;
    }

    void joint(const sdf::Joint& j, const Pose& modelPose, const std::string& path) {
        const Place place = placeOf(j.Element());
        std::string parent, childName;
        if (!j.ResolveParentLink(parent).empty()) parent = j.ParentLinkName();
        if (!j.ResolveChildLink(childName).empty()) childName = j.ChildLinkName();
        const auto one = endOf(parent, path, place), two = endOf(childName, path, place);
        if (!one || !two) return;
        if (*two == kNone && *one == kNone)
            return report_.noPhysics("<joint>", place, "it connects bodies that do not move");
        const int a = *two == kNone ? kNone : *one, b = *two == kNone ? *one : *two;
        const Pose frame = modelPose * resolve(j.SemanticPose(), "__model__", place);
        const double sign = *two == kNone ? -1.0 : 1.0;
        const Vec3 first = sign * axisOf(j, 0, modelPose, place),
                   second = sign * axisOf(j, 1, modelPose, place);
        const auto add = [&](JointType type, const Vec3& axis,
                             const Vec3& normal = {1.0, 0.0, 0.0}) -> Joint& {
            return builder_.addJoint(withPoints(path + "::" + j.Name()), type, a, b, frame.position, axis,
                                     place, normal);
        };
        switch (j.Type()) {
            case sdf::JointType::REVOLUTE:
            case sdf::JointType::CONTINUOUS:
                return control(j.Axis(0), add(JointType::Hinge, first).axes[0], AxisMode::Usual, place);
            case sdf::JointType::PRISMATIC:
                return control(j.Axis(0), add(JointType::Slider, first).axes[0], AxisMode::Usual, place);
            case sdf::JointType::BALL:
                add(JointType::Ball, {0.0, 0.0, 1.0});
                return;
            case sdf::JointType::FIXED:
                add(JointType::Fixed, {0.0, 0.0, 1.0});
                return;
            case sdf::JointType::REVOLUTE2:
                report_.changed("<joint> type", place,
                                "revolute2, two hinges one after the other, is a universal joint");
                [[fallthrough]];
            case sdf::JointType::UNIVERSAL: {
                if (std::abs(dot(first, second)) > 1e-9)
                    return report_.refuse("<joint>", place,
                                          "a universal joint whose axes are not at right angles");
                if (sign < 0.0)
                    return report_.refuse("<joint>", place, "a universal joint whose child does not move");
                Joint& made = add(JointType::SixDof, second, first);
                for (auto& axis : made.axes) axis.mode = AxisMode::Locked;
                control(j.Axis(0), made.axes[4], AxisMode::Free, place);
                return control(j.Axis(1), made.axes[3], AxisMode::Free, place);
            }
            case sdf::JointType::GEARBOX:
                report_.leavesOut("gearbox", "<joint> type", place, "a gearbox has no counterpart");
                return;
            case sdf::JointType::SCREW:
                report_.leavesOut("screw", "<joint> type", place, "a screw has no counterpart");
                return;
            default:
                report_.refuse("<joint> type", place, "a kind of joint that is not read");
        }
    }

    /// Direction of an axis in the world; the format's default, z of the joint, where the joint states none.
    Vec3 axisOf(const sdf::Joint& j, unsigned index, const Pose& modelPose, const Place& place) {
        const sdf::JointAxis* axis = j.Axis(index);
        if (!axis)
            return rotate((modelPose * resolve(j.SemanticPose(), "__model__", place)).orientation,
                          {0.0, 0.0, 1.0});
        ignition::math::Vector3d direction;
        const sdf::Errors errors = axis->ResolveXyz(direction, "__model__");
        if (!errors.empty()) throw Refusal(place, "libsdformat says: " + errors.front().Message());
        return rotate(modelPose.orientation, convert(direction.Normalized()));
    }

    void control(const sdf::JointAxis* given, scenario::JointAxis& to, AxisMode free, const Place& place) {
        to.mode = free;
        if (!given) return;
        const sdf::JointAxis& axis = *given;
        const bool below = axis.Lower() > -kUnlimited, above = axis.Upper() < kUnlimited;
        if (below || above) {
            to.mode = AxisMode::Limited;
            if (below) to.lower = axis.Lower();
            if (above) to.upper = axis.Upper();
        }
        to.damping = axis.Damping();
        to.stiffness = axis.SpringStiffness();
        if (to.stiffness > 0.0) to.target = axis.SpringReference();
        if (axis.Friction() > 0.0) {
            to.motorMaxForce = axis.Friction();
            report_.changed("<dynamics> friction", place, "a motor of speed 0 and this strength");
        }
    }

    const ReadOptions& options_;
    Report& report_;
    XmlFile& file_;
    Newer newer_;
    AssetFolders assets_;
    SceneBuilder builder_;
    std::map<std::string, int> bodies_;
    std::vector<unsigned> masks_;
    std::optional<bool> selfCollision_;
    ignition::math::Pose3d scratch_;
    int group_ = 0;
};

/// Removes the plugins that are the simulator itself: its step, its messages and sensors.
void removeSystems(XmlFile& file, XMLElement& parent, Report& report) {
    static const std::regex own(
        "(lib)?(gz|ignition)-(sim|gazebo)[0-9]*-(physics|user-commands|scene-broadcaster|sensors|"
        "contact|imu|forcetorque|altimeter|magnetometer|air-pressure)-system(\\.so)?");
    for (XMLElement* child = parent.FirstChildElement(); child;) {
        XMLElement* next = child->NextSiblingElement();
        removeSystems(file, *child, report);
        const char* name =
            std::string_view(child->Name()) == "plugin" ? child->Attribute("filename") : nullptr;
        if (name && std::regex_match(name, own)) {
            report.noPhysics("<plugin>", file.place(*child), "a part of the simulator itself");
            parent.DeleteChild(child);
        }
        child = next;
    }
}

/// An included model that is not there can be left out by its name: lights are often such models.
void checkIncludes(XmlFile& file, XMLElement& parent, const AssetFolders& assets, Report& report) {
    for (XMLElement* child = parent.FirstChildElement(); child;) {
        XMLElement* next = child->NextSiblingElement();
        checkIncludes(file, *child, assets, report);
        const XMLElement* uri =
            std::string_view(child->Name()) == "include" ? child->FirstChildElement("uri") : nullptr;
        if (uri && uri->GetText()) {
            const std::string text = uri->GetText();
            try {
                (void)assets.find(text, file.place(*uri));
            } catch (const Refusal& refusal) {
                report.leavesOut(text.substr(text.rfind('/') + 1), "<include>", file.place(*uri),
                                 refusal.what());
                parent.DeleteChild(child);
            }
        }
        child = next;
    }
}

/// Newer files are read as version 1.9, since every element of theirs has been judged by the rules.
void lowerVersion(XmlFile& file, Report& report) {
    const char* version = file.root()->Attribute("version");
    int major = 0, minor = 0;
    if (!version || std::sscanf(version, "%d.%d", &major, &minor) != 2)
        throw Refusal(file.place(*file.root()), "<sdf> states no version");
    if (major == 1 && minor <= 9) return;
    report.changed("<sdf> version", file.place(*file.root()), std::string(version) + " is read as 1.9");
    file.root()->SetAttribute("version", "1.9");
}

Answer read(const ReadOptions& options) {
    Report report(options.without);
    XmlFile file(options.file);
    if (std::string_view(file.root()->Name()) != "sdf")
        throw Refusal(file.place(*file.root()),
                      std::string("found <") + file.root()->Name() + ">, expected <sdf>");
    const AssetFolders assets(options.file, options.assets);
    removeSystems(file, *file.root(), report);
    checkIncludes(file, *file.root(), assets, report);
    applyRules(file, sdfRules(), report);
    lowerVersion(file, report);
    Newer newer = takeNewer(file);
    sdf::Console::Instance()->SetQuiet(true);
    std::vector<std::filesystem::path> included;
    std::vector<std::string> notFound;
    sdf::ParserConfig config;
    config.SetFindCallback([&](const std::string& uri) -> std::string {
        try {
            const auto found = assets.find(uri, {file.shownName(), 0});
            included.push_back(std::filesystem::is_directory(found) ? found / "model.sdf" : found);
            return found.string();
        } catch (const Refusal& refusal) {
            notFound.emplace_back(refusal.what());
            return "";
        }
    });
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(textOnSameLines(*file.root()), config);
    for (const std::string& text : notFound) report.refuse("<include>", {file.shownName(), 0}, text);
    if (notFound.empty() && !errors.empty())
        report.refuse("file", {file.shownName(), errors.front().LineNumber().value_or(0)},
                      "libsdformat says: " + errors.front().Message());
    for (const auto& one : included) {
        XmlFile other(
            one,
            std::filesystem::relative(one, std::filesystem::absolute(options.file).parent_path()).string());
        applyRules(other, sdfRules(), report);
    }
    if (report.isRefused()) return {"", report};
    return World(options, report, file, std::move(newer)).convertAll(root);
}

}  // namespace
}  // namespace rigor::models

int main(int argc, char** argv) {
    return rigor::models::runReader(argc, argv, rigor::models::read);
}
