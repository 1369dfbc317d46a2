// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/builder.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "scenarios/exchange/common/files.hpp"
#include "scenarios/exchange/common/text.hpp"
#include "scenarios/json/problem.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"

namespace rigor::models {

using scenario::BodyType;
using scenario::kNone;
using scenario::PairCoefficients;
using scenario::Pose;
using scenario::Vec3;

namespace {

constexpr std::size_t kLongestName = 64;
constexpr double kMostFriction = 1e6;  ///< largest coefficient that a scenario takes
constexpr double kUsualTimeStep = 1.0 / 240.0;

std::string cleaned(const std::string& text, const std::string& empty) {
    std::string name;
    for (const char c : text)
        name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' ? c : '_';
    if (name.empty()) name = empty;
    return name.substr(0, kLongestName);
}

Pose poseOf(const scenario::Scenario& scene, int body) {
    return body == kNone ? Pose{} : scene.bodies[static_cast<std::size_t>(body)].pose;
}

}  // namespace

PairCoefficients smaller(const Surface& a, const Surface& b) {
    return {std::min(a.friction, b.friction), std::min(a.restitution, b.restitution), 0.0,
            std::min(a.rolling, b.rolling), std::min(a.torsional, b.torsional)};
}

PairCoefficients product(const Surface& a, const Surface& b) {
    return {a.friction * b.friction, a.restitution * b.restitution, 0.0, a.rolling * b.rolling,
            a.torsional * b.torsional};
}

SceneBuilder::SceneBuilder(const ReadOptions& options, Report& report, const std::string& format,
                           const std::string& reader)
    : options_(options), report_(report), format_(format), reader_(reader) {
    scene.gravity = {0.0, 0.0, -9.81};
}

std::string SceneBuilder::nameFor(const std::string& wanted, std::map<std::string, int>& taken,
                                  const Place& place) {
    const std::string clean = cleaned(wanted, "unnamed");
    std::string name = clean == "world" ? "world_body" : clean;
    while (taken.contains(name)) {
        const std::string end = "_" + std::to_string(++taken[clean]);
        name = clean.substr(0, kLongestName - end.size()) + end;
    }
    taken.emplace(name, 1);
    if (name != wanted && !wanted.empty())
        report_.changed("name", place, "'" + wanted + "' is called '" + name + "'");
    return name;
}

int SceneBuilder::addBody(const std::string& name, scenario::Body body, const Place& place) {
    body.name = nameFor(name, bodyNames_, place);
    scene.bodies.push_back(std::move(body));
    bodyPlaces.push_back(place);
    return static_cast<int>(scene.bodies.size()) - 1;
}

int SceneBuilder::material(const Surface& surface) {
    const auto found = std::find(surfaces_.begin(), surfaces_.end(), surface);
    if (found != surfaces_.end()) return static_cast<int>(found - surfaces_.begin());
    surfaces_.push_back(surface);
    return static_cast<int>(surfaces_.size()) - 1;
}

void SceneBuilder::addShape(int body, scenario::Geometry geometry, const Pose& pose, const Surface& surface,
                            int contactClass) {
    auto& shapes = scene.bodies[static_cast<std::size_t>(body)].shapes;
    scenario::Shape shape{std::move(geometry), pose, material(surface), {}, {}};
    if (contactClass < 0) shape.filter.collidesWith = 0;
    shapes.push_back(std::move(shape));
    if (contactClass >= 0) classes_.push_back({body, static_cast<int>(shapes.size()) - 1, contactClass});
}

scenario::Joint& SceneBuilder::addJoint(const std::string& name, scenario::JointType type, int a, int b,
                                        const Vec3& anchor, const Vec3& axis, const Place& place,
                                        const Vec3& normal) {
    scenario::Joint joint;
    joint.name = nameFor(name, jointNames_, place);
    joint.type = type;
    joint.bodyA = a;
    joint.bodyB = b;
    const Pose poseA = poseOf(scene, a), poseB = poseOf(scene, b);
    joint.anchorA = inverse(poseA) * anchor;
    joint.anchorB = inverse(poseB) * anchor;
    joint.axisA = rotateInverse(poseA.orientation, axis);
    joint.axisB = rotateInverse(poseB.orientation, axis);
    joint.normalA = rotateInverse(poseA.orientation, normal);
    scene.joints.push_back(joint);
    jointPlaces.push_back(place);
    return scene.joints.back();
}

void SceneBuilder::setMixing(std::function<PairCoefficients(const Surface&, const Surface&)> law,
                             const std::string& inWords) {
    mixing_ = std::move(law);
    mixingText_ = inWords;
}

void SceneBuilder::setPair(int ownA, int ownB, const PairCoefficients& law) {
    pairs_[std::minmax(ownA, ownB)] = law;
}

void SceneBuilder::writeMaterials() {
    const auto limited = [&](double value) {
        if (value <= kMostFriction) return value;
        report_.changed("friction", {format_, 0}, "coefficients above 1e6 are 1e6");
        return kMostFriction;
    };
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        const Surface& s = surfaces_[i];
        scenario::Material m;
        m.name = surfaces_.size() == 1 ? "surface" : "surface_" + std::to_string(i + 1);
        m.friction = s.contactDimension > 1 ? limited(s.friction) : 0.0;
        m.restitution = s.restitution;
        if (s.staticFriction > s.friction) m.staticFriction = limited(s.staticFriction);
        m.rollingFriction = s.contactDimension > 4 ? limited(s.rolling) : 0.0;
        m.torsionalFriction = s.contactDimension > 3 ? limited(s.torsional) : 0.0;
        m.density = options_.density;
        scene.materials.push_back(m);
    }
    if (!mixing_) return;
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
        for (std::size_t j = i; j < surfaces_.size(); ++j) {
            const auto own = pairs_.find(std::minmax(surfaces_[i].own, surfaces_[j].own));
            const bool given = surfaces_[i].own != 0 && own != pairs_.end();
            const PairCoefficients law = given ? own->second : mixing_(surfaces_[i], surfaces_[j]);
            const scenario::Material& m = scene.materials[i];
            const bool same = law.friction == m.friction && law.restitution == m.restitution &&
                              law.rollingFriction == m.rollingFriction &&
                              law.torsionalFriction == m.torsionalFriction &&
                              law.staticFriction == m.staticFriction;
            if (i == j && same) continue;
            scene.pairs.push_back({static_cast<int>(i), static_cast<int>(j), limited(law.friction),
                                   law.restitution, law.staticFriction, limited(law.rollingFriction),
                                   limited(law.torsionalFriction)});
        }
    if (!scene.pairs.empty())
        report_.changed("friction", {options_.file.filename().string(), 0},
                        mixingText_ + ": written out as " + std::to_string(scene.pairs.size()) +
                            (scene.pairs.size() == 1 ? " pair" : " pairs"));
}

void SceneBuilder::writeLayers() {
    if (!mayTouch_ || classes_.empty()) return;
    // Classes that touch the same classes are one layer; each layer is the bit of its first class.
    std::vector<int> kinds;
    for (const ShapeClass& c : classes_)
        if (std::find(kinds.begin(), kinds.end(), c.kind) == kinds.end()) kinds.push_back(c.kind);
    const auto alike = [&](int a, int b) {
        return std::all_of(kinds.begin(), kinds.end(),
                           [&](int c) { return mayTouch_(a, c) == mayTouch_(b, c); }) &&
               mayTouch_(a, b) == mayTouch_(a, a);
    };
    std::vector<int> layers;  // the first class of each
    std::map<int, int> layerOf;
    for (const int kind : kinds) {
        const auto same = std::find_if(layers.begin(), layers.end(), [&](int l) { return alike(l, kind); });
        layerOf[kind] = static_cast<int>(same - layers.begin());
        if (same == layers.end()) layers.push_back(kind);
    }
    if (layers.size() > static_cast<std::size_t>(scenario::kMaxLayers)) {
        report_.leavesOut("contact_filters", "contact filters", {options_.file.filename().string(), 0},
                          std::to_string(layers.size()) + " layers would be needed, a scenario has up to 16");
        return;
    }
    if (layers.size() == 1 && mayTouch_(layers[0], layers[0])) return;
    scene.layers = {scenario::kDefaultLayer};
    for (std::size_t i = 1; i < layers.size(); ++i) scene.layers.push_back("layer_" + std::to_string(i));
    for (const ShapeClass& c : classes_) {
        auto& filter =
            scene.bodies[static_cast<std::size_t>(c.body)].shapes[static_cast<std::size_t>(c.shape)].filter;
        const int own = layerOf[c.kind];
        filter.layers = 1u << own;
        bool all = true;
        std::uint32_t bits = 0;
        for (std::size_t l = 0; l < layers.size(); ++l) {
            const bool touch = mayTouch_(c.kind, layers[l]);
            all = all && touch;
            if (touch) bits |= 1u << l;
        }
        filter.collidesWith = all ? scenario::kAllLayers : bits;
    }
    if (scene.layers.size() == 1) scene.layers.clear();
}

void SceneBuilder::addFloor() {
    if (!options_.hasFloor) return;
    scenario::Body floor;
    floor.type = BodyType::Static;
    const Vec3 up = scene.gravity.y < 0.0 ? Vec3{0.0, 1.0, 0.0} : Vec3{0.0, 0.0, 1.0};
    floor.pose.position = options_.floor * up;
    const int index = addBody("floor", floor, {"--floor", 0});
    addShape(index, scenario::HalfSpace{up, 0.0}, {}, {options_.friction, 0.0}, 0);
    report_.changed("floor", {"--floor", 0}, "a static half-space was added");
}

void SceneBuilder::header() {
    const std::string file = options_.file.filename().string();
    const std::string folder = std::filesystem::absolute(options_.file).parent_path().filename().string();
    scene.name = cleaned(options_.name.empty() ? options_.file.stem().string() : options_.name, "model");
    scene.title = options_.file.stem().string() + ", imported from " + format_;
    scene.description = "Made by rigor import from " + folder + "/" + file + " (" + format_ + ", read by " +
                        reader_ + "). The axes are the model's.";
    const Licence found = findLicence(options_.file);
    std::string licence = options_.licence;
    if (licence.empty() && !found.file.empty())
        licence = found.name.empty() ? "see " + found.file : found.name + " (" + found.file + ")";
    if (licence.empty()) {
        licence = "not known";
        report_.changed("licence", {file, 0},
                        "no licence was found beside the model; --licence TEXT states it");
    }
    scene.source = folder + "/" + file + "; licence: " + licence;
    scene.tags = {"imported"};
    scene.duration = options_.duration;
    scene.timeSteps = {options_.timeStep > 0.0 ? options_.timeStep
                       : timeStep_ > 0.0       ? timeStep_
                                               : kUsualTimeStep};
}

Answer SceneBuilder::finish() {
    addFloor();
    header();
    writeMaterials();
    writeLayers();
    const auto moving = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                      [](const auto& b) { return b.type == BodyType::Dynamic; });
    const std::string file = options_.file.filename().string();
    if (moving == 0)
        report_.refuse("model", {file, 0}, "no body of it can move: there is nothing to simulate");
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].type == BodyType::Dynamic) scene.observed.push_back(static_cast<int>(i));
    Answer answer{"", report_};
    if (report_.isRefused()) return answer;
    const std::string text = tidied(scenario::scenarioText(scene));
    try {
        (void)scenario::loadScenarioText(text, scene.name + ".json");
        answer.scenario = text;
    } catch (const scenario::LoadError& error) {
        for (const scenario::Problem& p : error.problems()) {
            Place place{file, 0};
            std::string what = p.pointer;
            const auto placeOf = [&](const std::string& kind, const std::vector<Place>& places,
                                     const auto& parts) {
                const std::string start = "/" + kind + "/";
                std::size_t index = 0;
                if (!p.pointer.starts_with(start)) return;
                const char* begin = p.pointer.data() + start.size();
                const char* end = std::from_chars(begin, p.pointer.data() + p.pointer.size(), index).ptr;
                if (index >= places.size()) return;
                place = places[index];
                what = "'" + parts[index].name + "'" + end;
            };
            placeOf("bodies", bodyPlaces, scene.bodies);
            placeOf("joints", jointPlaces, scene.joints);
            answer.report.refuse(what, place, "found " + p.found + ", expected " + p.expected);
        }
    }
    return answer;
}

}  // namespace rigor::models
