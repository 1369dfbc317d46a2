// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A picture of a scenario at a time, as any engine has it: shapes at its states, the contacts and impulses that
// it reports, drawn by the lines and the picture of the in-house engine (engine/embedding).
#include <CLI/CLI.hpp>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <set>

#include "adapters/interface/prepared_engine.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "cli/command.hpp"
#include "cli/guarded.hpp"
#include "cli/png_picture.hpp"
#include "engine/embedding/svg_lines.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/model/nearest.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/scenario_settings.hpp"
#include "validation/runner/stepper.hpp"

namespace rigor::cli {
namespace {

using engine::DebugKind;

struct DrawArguments {
    std::string scenario, engine = validation::kInHouseEngine, timeStep, out = "-",
                          show = "outline,contact,normal,joint";
    std::vector<std::string> overrides;
    double at = 0.0, turn = 34.0, lift = 20.0;
    int width = 800;
};

/// A scene at one time, as an engine reports it.
struct Scene {
    scenario::Scenario scenario;
    std::vector<adapter::BodyState> states;
    std::vector<adapter::ContactPoint> contacts;
    double time = 0.0;  ///< time of the step nearest to the requested one [s]
};

std::set<DebugKind> kindsOf(const std::string& list) {
    static constexpr DebugKind kKinds[] = {DebugKind::Outline, DebugKind::Contact,  DebugKind::Normal,
                                           DebugKind::Impulse, DebugKind::Velocity, DebugKind::Joint};
    std::set<DebugKind> kinds;
    std::vector<std::string> names;
    for (const DebugKind kind : kKinds) names.push_back(engine::debugKindName(kind));
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string name = list.substr(begin, end - begin);
        bool known = false;
        for (const DebugKind kind : kKinds)
            if (name == engine::debugKindName(kind)) known = kinds.insert(kind).second || true;
        if (!known)
            throw std::invalid_argument("--show: found '" + name + "', expected some of outline, contact, " +
                                        "normal, impulse, velocity, joint, with commas between" +
                                        scenario::didYouMean(name, names));
        begin = end + 1;
    }
    return kinds;
}

Scene runTo(const DrawArguments& a) {
    const auto loaded = loadWithReference(a.scenario, a.overrides, validation::ReferenceLimits{});
    Scene scene;
    scene.scenario = loaded.scenario;
    const double dt = a.timeStep.empty() ? scene.scenario.timeSteps.front() : parseTimeStep(a.timeStep);
    if (!(a.at >= 0.0) || a.at > scene.scenario.duration + 0.5 * dt)
        throw std::invalid_argument("--at: found " + std::to_string(a.at) + ", expected 0 .. " +
                                    std::to_string(scene.scenario.duration) +
                                    " s, the scenario's duration (--set duration=S for more)");
    const adapter::EngineSpec spec =
        validation::withScenarioSettings(adapter::parseSpec(a.engine), loaded.text);
    const adapter::PreparedEngine engine = adapter::prepareEngine(spec, scene.scenario, dt);
    const auto world = engine.build(scene.scenario, dt);
    validation::Stepper stepper(scene.scenario, dt, *world);
    const auto steps = static_cast<std::size_t>(std::lround(a.at / dt));
    while (stepper.steps() < steps) {
        stepper.begin();
        world->step();
        stepper.end();
    }
    if (const std::string problem = stepper.nonFinite(); !problem.empty()) throw std::runtime_error(problem);
    scene.states.assign(stepper.states().begin(), stepper.states().end());
    world->readContacts(scene.contacts);
    scene.time = stepper.time();
    return scene;
}

/// The lines of a scene; 2D and 3D alike.
template <class S>
class SceneLines {
  public:
    using Vec = typename S::Vec;
    SceneLines(const Scene& scene, const std::set<DebugKind>& kinds, engine::SvgLines<S>& sink)
        : scene_(scene), sink_(sink) {
        options_.outlines = kinds.contains(DebugKind::Outline);
        options_.contacts = kinds.contains(DebugKind::Contact);
        options_.normals = kinds.contains(DebugKind::Normal);
        options_.impulses = kinds.contains(DebugKind::Impulse);
        options_.velocities = kinds.contains(DebugKind::Velocity);
        options_.joints = kinds.contains(DebugKind::Joint);
        setLengths();
    }

    /// The frame is that of what moves, and of its contacts and joints.
    void draw() {
        for (std::size_t i = 0; i < scene_.scenario.bodies.size(); ++i) {
            sink_.keepInFrame(scene_.scenario.bodies[i].type != scenario::BodyType::Static);
            drawBody(static_cast<int>(i));
        }
        sink_.keepInFrame(true);
        for (const adapter::ContactPoint& contact : scene_.contacts) drawContact(contact);
        if (options_.joints)
            for (const scenario::Joint& joint : scene_.scenario.joints) {
                drawAnchor(joint.bodyA, joint.anchorA);
                drawAnchor(joint.bodyB, joint.anchorB);
            }
    }

  private:
    static engine::BodyId idOf(int body) { return {static_cast<std::uint32_t>(body + 1), 0}; }
    engine::Pose<S> poseOf(int body) const {
        const adapter::BodyState& state = scene_.states[static_cast<std::size_t>(body)];
        return adapter::toEnginePose<S>({state.position, state.orientation});
    }
    Vec centerOf(int body) const {
        const scenario::Body& b = scene_.scenario.bodies[static_cast<std::size_t>(body)];
        return engine::toWorld<S>(poseOf(body), adapter::toEngineVec<S>(b.massProperties.centerOfMass));
    }

    /// Arrows in proportion to the scene: the longest is a tenth of it.
    void setLengths() {
        Vec low = Vec::Constant(1e300), high = Vec::Constant(-1e300);
        double fastest = 0.0, hardest = 0.0;
        for (std::size_t i = 0; i < scene_.scenario.bodies.size(); ++i) {
            const scenario::Body& body = scene_.scenario.bodies[i];
            if (body.type == scenario::BodyType::Static) continue;
            fastest = std::max(fastest, adapter::toEngineVec<S>(scene_.states[i].velocity).norm());
            for (const scenario::Shape& shape : body.shapes) {
                const engine::Aabb<S> box = engine::boundingBox<S>(
                    adapter::toEngineShape<S>(shape.geometry),
                    engine::compose<S>(poseOf(static_cast<int>(i)), adapter::toEnginePose<S>(shape.pose)));
                low = low.cwiseMin(box.min);
                high = high.cwiseMax(box.max);
            }
        }
        for (const adapter::ContactPoint& c : scene_.contacts)
            hardest = std::max(
                hardest, std::hypot(c.normalImpulse, adapter::toEngineVec<S>(c.frictionImpulse).norm()));
        const double length = 0.1 * ((high.array() >= low.array()).all() ? (high - low).norm() : 1.0);
        options_.normalLength = 0.4 * length;
        if (fastest > 0.0) options_.velocityScale = length / fastest;
        if (hardest > 0.0) options_.impulseScale = length / hardest;
    }

    void drawBody(int body) {
        const scenario::Body& b = scene_.scenario.bodies[static_cast<std::size_t>(body)];
        if (options_.outlines)
            for (const scenario::Shape& shape : b.shapes)
                engine::drawShape<S>(adapter::toEngineShape<S>(shape.geometry),
                                     engine::compose<S>(poseOf(body), adapter::toEnginePose<S>(shape.pose)),
                                     idOf(body), options_, sink_);
        engine::drawVelocity<S>(
            centerOf(body), adapter::toEngineVec<S>(scene_.states[static_cast<std::size_t>(body)].velocity),
            idOf(body), options_, sink_);
    }
    void drawContact(const adapter::ContactPoint& c) {
        const Vec at = 0.5 * (adapter::toEngineVec<S>(c.pointA) + adapter::toEngineVec<S>(c.pointB));
        const Vec normal = adapter::toEngineVec<S>(c.normal);
        const Vec impulse = c.hasImpulse
                                ? Vec(c.normalImpulse * normal + adapter::toEngineVec<S>(c.frictionImpulse))
                                : Vec(Vec::Zero());
        engine::drawContact<S>(at, normal, impulse, idOf(c.bodyB), options_, sink_);
    }
    void drawAnchor(int body, const scenario::Vec3& anchor) {
        const Vec local = adapter::toEngineVec<S>(anchor);
        if (body == scenario::kNone) return sink_.point(local, DebugKind::Joint, {});
        sink_.line(centerOf(body), engine::toWorld<S>(poseOf(body), local), DebugKind::Joint, idOf(body));
    }

    const Scene& scene_;
    engine::SvgLines<S>& sink_;
    engine::DebugOptions<S> options_;
};

template <class S>
engine::SvgLines<S> pictureOf(const Scene& scene, const DrawArguments& a) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const std::set<DebugKind> kinds = kindsOf(a.show);
    engine::SvgLines<S> picture({kDegree * a.turn, kDegree * a.lift});
    SceneLines<S>(scene, kinds, picture).draw();
    return picture;
}

/// The bytes of the file: PNG if its name ends so, else SVG.
template <class S>
std::string fileOf(const Scene& scene, const DrawArguments& a) {
    const engine::SvgLines<S> lines = pictureOf<S>(scene, a);
    return a.out.ends_with(".png") ? pngOf(lines.picture(a.width)) : lines.text(a.width);
}

int drawHere(const DrawArguments& a) {
    (void)kindsOf(a.show);
    const Scene scene = runTo(a);
    const std::string picture =
        scene.scenario.dimension == 2 ? fileOf<engine::Space2d>(scene, a) : fileOf<engine::Space3d>(scene, a);
    if (a.out == "-") {
        std::cout << picture;
        return kOk;
    }
    std::ofstream file(a.out, std::ios::binary);
    if (!(file << picture) || !file.flush())
        throw std::invalid_argument("--out: cannot write '" + a.out + "': " + std::strerror(errno));
    std::fprintf(stderr, "%s at %.6g s, %zu contact points: %s\n", a.scenario.c_str(), scene.time,
                 scene.contacts.size(), a.out.c_str());
    return kOk;
}

}  // namespace

void addDraw(CLI::App& app, Action& action) {
    auto a = std::make_shared<DrawArguments>();
    auto* command = app.add_subcommand(
        "draw", "Draw a scenario at a time, as an engine has it, as an SVG or PNG picture");
    offerNames(command->add_option("SCENARIO", a->scenario, "Name or file")->required(), kScenarioNames);
    offerNames(command->add_option("-e,--engine", a->engine, "Engine spec (default: rigor)"), kEngineNames);
    command->add_option("--at", a->at, "Time [s]; the step nearest to it is drawn (default 0)");
    command->add_option("--dt", a->timeStep,
                        "Time step in seconds (0.004 or 1/240); default: the scenario's first");
    command->add_option("--set", a->overrides, "Override a scenario value: KEY=VALUE")
        ->allow_extra_args(false);
    command->add_option("-o,--out", a->out,
                        "File, a PNG if its name ends in .png, else SVG; '-' (default) for standard output");
    command->add_option(
        "--show", a->show,
        "Some of outline, contact, normal, impulse, velocity, joint, with commas between "
        "(default: outline,contact,normal,joint); the longest impulse and velocity are a tenth "
        "of the scene");
    command->add_option("--width", a->width, "Width of the picture in pixels (default 800)")
        ->check(CLI::Range(50, 20000));
    command->add_option("--turn", a->turn, "3D: direction of view about y [degrees] (default 34)");
    command->add_option("--lift", a->lift, "3D: its height above the horizon [degrees] (default 20)");
    command->callback([a, &action] {
        action = [a] {
            return runGuarded(a->engine, a->scenario, validation::ReferenceLimits{},
                              [a] { return drawHere(*a); });
        };
    });
}

}  // namespace rigor::cli
