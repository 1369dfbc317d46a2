// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/parts/contact_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "scenarios/generators/generator.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/contact_problems/export_step.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using scenario::Vec3;

constexpr double kStep = 1.0 / 60.0;  ///< [s]
constexpr double kPitch = 1.05;       ///< distance of neighbours in a layer [m]

struct Block {
    Vec3 center;
    double mass = 1000.0;  ///< [kg]; every block is a cube of 1 m (2D: square)
    Vec3 velocity, spin;
};
struct Blocks {
    int dimension = 3;
    std::vector<Block> blocks;
};

Blocks stack(int count, double topMass, double mass) {
    Blocks made;
    for (int i = 0; i < count; ++i)
        made.blocks.push_back({{0, i + 0.5, 0}, i + 1 == count ? topMass : mass, {}, {}});
    return made;
}

Blocks pyramid(int base, int dimension) {
    Blocks made{dimension, {}};
    for (int layer = 0; layer < base; ++layer)
        for (int i = 0; i < base - layer; ++i)
            for (int k = 0; k < (dimension == 2 ? 1 : base - layer); ++k)
                made.blocks.push_back({{kPitch * (i + 0.5 * layer), layer + 0.5,
                                        dimension == 2 ? 0.0 : kPitch * (k + 0.5 * layer)},
                                       1000.0,
                                       {},
                                       {}});
    return made;
}

Blocks struck(Blocks blocks, std::uint64_t seed) {
    scenario::PortableRandom random(seed);
    const auto one = [&] { return random.between(-1.0, 1.0); };
    for (Block& block : blocks.blocks) {
        const double x = one(), y = one(), z = one();
        block.velocity = {x, y, blocks.dimension == 2 ? 0.0 : z};
        const double wx = one(), wy = one(), wz = one();
        block.spin = blocks.dimension == 2 ? Vec3{0, 0, wz} : Vec3{wx, wy, wz};
    }
    return blocks;
}

/// Scenario as of a file: body 0 is the floor.
scenario::Scenario scenarioOf(const Blocks& blocks, const std::string& name) {
    const auto vector = [&](const Vec3& v) {
        return blocks.dimension == 2 ? json{v.x, v.y} : json{v.x, v.y, v.z};
    };
    const char* solid = "half_space";
    json bodies = json::array();
    bodies.push_back(
        {{"name", "floor"},
         {"type", "static"},
         {"shapes", {{{blocks.dimension == 2 ? "half_plane" : solid, {{"normal", vector({0, 1, 0})}}}}}}});
    for (std::size_t i = 0; i < blocks.blocks.size(); ++i) {
        const Block& b = blocks.blocks[i];
        json body{{"name", "block_" + std::to_string(i)},
                  {"mass", b.mass},
                  {"position", vector(b.center)},
                  {"velocity", vector(b.velocity)},
                  {"shapes", {{{"box", {{"half_extents", vector({0.5, 0.5, 0.5})}}}}}}};
        body["angular_velocity"] = blocks.dimension == 2 ? json(b.spin.z) : vector(b.spin);
        bodies.push_back(std::move(body));
    }
    const json text{{"rigor", 1},
                    {"name", name},
                    {"title", "blocks"},
                    {"dimension", blocks.dimension},
                    {"isolates", {"solver"}},
                    {"source", "none"},
                    {"gravity", vector({0, -9.81, 0})},
                    {"duration", 1.0},
                    {"dt", {kStep}},
                    {"materials", {{"stone", {{"friction", 0.5}, {"restitution", 0.0}}}}},
                    {"bodies", bodies},
                    {"metrics", {"penetration_max"}}};
    return scenario::loadScenarioText(text.dump(), name).scenario;
}

void addFace(const Vec3& low, const Vec3& high, int dimension, int bodyA, int bodyB,
             std::vector<adapter::ContactPoint>& contacts) {
    for (const double x : {low.x, high.x})
        for (const double z : {low.z, high.z}) {
            if (dimension == 2 && z > low.z) continue;
            adapter::ContactPoint contact;
            contact.bodyA = bodyA;
            contact.bodyB = bodyB;
            contact.pointA = contact.pointB = {x, low.y, dimension == 2 ? 0.0 : z};
            contact.normal = {0, 1, 0};
            contacts.push_back(contact);
        }
}

std::vector<adapter::ContactPoint> contactsOf(const Blocks& blocks) {
    std::vector<adapter::ContactPoint> contacts;
    const auto& all = blocks.blocks;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Vec3 &c = all[i].center, h{0.5, 0.5, 0.5};
        const int body = static_cast<int>(i) + 1;
        if (std::abs(c.y - 0.5) < 1e-9)
            addFace(c - h, c + Vec3{0.5, -0.5, 0.5}, blocks.dimension, 0, body, contacts);
        for (std::size_t k = 0; k < i; ++k) {
            const Vec3& under = all[k].center;
            if (std::abs(c.y - under.y - 1.0) > 1e-9) continue;
            const Vec3 low{std::max(c.x, under.x) - 0.5, c.y - 0.5, std::max(c.z, under.z) - 0.5};
            const Vec3 high{std::min(c.x, under.x) + 0.5, c.y - 0.5, std::min(c.z, under.z) + 0.5};
            if (high.x > low.x && high.z > low.z)
                addFace(low, high, blocks.dimension, static_cast<int>(k) + 1, body, contacts);
        }
    }
    return contacts;
}

Blocks blocksOf(const std::string& name, std::uint64_t seed) {
    if (name == "stack_10") return stack(10, 1000.0, 1000.0);
    if (name == "pyramid_14") return pyramid(3, 3);
    if (name == "heavy_on_light") return stack(5, 100.0, 1.0);
    if (name == "struck_pyramid") return struck(pyramid(3, 3), seed);
    if (name == "wall_28") return pyramid(7, 2);
    throw std::invalid_argument("contact scene '" + name + "'");
}

}  // namespace

const std::vector<std::string>& contactScenes() {
    static const std::vector<std::string> names{"stack_10", "pyramid_14", "heavy_on_light", "struck_pyramid",
                                                "wall_28"};
    return names;
}

ExportedProblem makeContactScene(const std::string& name, std::uint64_t seed) {
    const Blocks blocks = blocksOf(name, seed);
    const scenario::Scenario scene = scenarioOf(blocks, name);
    RecordedStep step;
    step.dt = kStep;
    for (const scenario::Body& body : scene.bodies)
        step.before.push_back(
            {body.pose.position, body.pose.orientation, body.velocity, body.angularVelocity});
    step.after = step.before;
    step.contacts = contactsOf(blocks);
    step.loads.resize(scene.bodies.size());
    ExportedProblem problem = exportStep(scene, step);
    problem.title = name;
    problem.storedR.clear();
    problem.storedU.clear();
    problem.storedV.clear();
    return problem;
}

}  // namespace rigor::validation
