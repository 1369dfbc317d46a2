// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/conformance/kit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>

#include "adapters/interface/presets.hpp"

namespace rigor::conformance {
namespace {

std::optional<adapter::LoadedEngine>& loaded() {
    static std::optional<adapter::LoadedEngine> engine;
    return engine;
}
adapter::EngineSpec& spec() {
    static adapter::EngineSpec value;
    return value;
}
bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> precisions() {
    for (const auto& option : engine().options())
        if (option.key == "precision") return option.values;
    return {engine().info().precision};
}

}  // namespace

void useEngine(const std::string& text) {
    spec() = adapter::parseSpec(text);
    loaded().emplace(adapter::loadEngine(spec()));
}
const adapter::Engine& engine() {
    return **loaded();
}
const adapter::EngineSpec& engineSpec() {
    return spec();
}

std::vector<Arena> dynamicsArenas() {
    std::vector<Arena> arenas;
    const auto capabilities = engine().capabilities();
    if (!capabilities.dynamics) return arenas;
    for (const auto& precision : precisions())
        for (const std::string& preset : adapter::presetNames(adapter::ownPresets(engine())))
            for (const int dimension : queryDimensions()) arenas.push_back({preset, dimension, precision});
    return arenas;
}

std::vector<int> queryDimensions() {
    auto dimensions = engine().capabilities().dimensions;
    if (engine().capabilities().planar) dimensions.push_back(2);
    std::sort(dimensions.begin(), dimensions.end());
    dimensions.erase(std::unique(dimensions.begin(), dimensions.end()), dimensions.end());
    return dimensions;
}

std::ostream& operator<<(std::ostream& out, const Arena& arena) {
    return out << arena.preset << ' ' << arena.dimension << "D " << arena.precision;
}

std::string arenaName(const testing::TestParamInfo<Arena>& info) {
    return info.param.preset + "_" + std::to_string(info.param.dimension) + "d_" + info.param.precision;
}

std::string dimensionName(const testing::TestParamInfo<int>& info) {
    return std::to_string(info.param) + "d";
}

bool DynamicsTest::hasShape(const std::string& name) const {
    return contains(engine().capabilities().shapes, name);
}
bool DynamicsTest::hasJoint(const std::string& name) const {
    return contains(engine().capabilities().joints, name);
}

Scenario DynamicsTest::scene(double friction, double restitution) const {
    Scenario s;
    s.name = "conformance";
    s.dimension = arena().dimension;
    s.gravity = {};
    s.duration = 2.0;
    s.materials.push_back({"stuff", friction, restitution, 1000.0});
    return s;
}

Geometry DynamicsTest::block(const Vec3& half) const {
    return scenario::Box{flat(half)};
}

int DynamicsTest::addBody(Scenario& s, const Geometry& geometry, const Vec3& position, double mass,
                          const Vec3& moments) const {
    Body body;
    body.name = "body" + std::to_string(s.bodies.size());
    body.pose.position = position;
    body.shapes.push_back({geometry, {}, 0});
    body.collides = hasShape(geometryName(geometry, s.dimension));
    body.massProperties = {mass, {}, Mat3::diagonal(moments.x, moments.y, moments.z)};
    if (is2d()) body.massProperties.inertia = Mat3::diagonal(0.0, 0.0, moments.z);
    s.bodies.push_back(body);
    return static_cast<int>(s.bodies.size()) - 1;
}

int DynamicsTest::addStatic(Scenario& s, const Geometry& geometry, const Vec3& position,
                            Quat orientation) const {
    Body body;
    body.name = "static" + std::to_string(s.bodies.size());
    body.type = BodyType::Static;
    body.pose = {position, orientation};
    body.shapes.push_back({geometry, {}, 0});
    s.bodies.push_back(body);
    return static_cast<int>(s.bodies.size()) - 1;
}

std::unique_ptr<adapter::World> DynamicsTest::build(const Scenario& s, double dt) const {
    return buildIn(engine(), s, dt);
}

std::unique_ptr<adapter::World> DynamicsTest::buildIn(const adapter::Engine& of, const Scenario& s,
                                                      double dt) const {
    auto with = engineSpec();
    with.options["preset"] = arena().preset;
    with.options["precision"] = arena().precision;
    return of.dynamics()->build(s, dt, adapter::resolveSettings(with, of));
}

Vec3 boxMoments(double mass, const Vec3& h) {
    return {mass / 3.0 * (h.y * h.y + h.z * h.z), mass / 3.0 * (h.x * h.x + h.z * h.z),
            mass / 3.0 * (h.x * h.x + h.y * h.y)};
}

BodyState stateOf(const adapter::World& world, const Scenario& s, int body) {
    std::vector<BodyState> states(s.bodies.size());
    world.readStates(states);
    return states[body];
}

std::vector<ContactPoint> contactsOf(const adapter::World& world) {
    std::vector<ContactPoint> contacts;
    world.readContacts(contacts);
    return contacts;
}

void run(adapter::World& world, int steps) {
    for (int i = 0; i < steps; ++i) world.step();
}

double angleBetween(const Quat& a, const Quat& b) {
    const Quat d = conjugate(a) * b;
    return 2.0 * std::atan2(norm(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}

}  // namespace rigor::conformance
