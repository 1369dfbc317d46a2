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

#include "adapters/interface/prepared_engine.hpp"
#include "cli/command.hpp"
#include "cli/guarded.hpp"
#include "cli/numbers.hpp"
#include "cli/view/scene_lines.hpp"
#include "engine/embedding/svg_lines.hpp"
#include "reports/plots/drawing.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/scenario_settings.hpp"
#include "validation/runner/stepper.hpp"

namespace rigor::cli {
namespace {

constexpr const char* kShow = "--show";

struct DrawArguments {
    std::string scenario, engine = validation::kInHouseEngine, timeStep, out = "-",
                          show = "outline,contact,normal,joint";
    std::vector<std::string> overrides;
    double at = 0.0, turn = 34.0, lift = 20.0;
    int width = 800;
};

/// Scene to be drawn, and the scenario that it refers to.
struct Drawn {
    scenario::Scenario scenario;
    Scene scene;
};

std::unique_ptr<Drawn> runTo(const DrawArguments& a) {
    const auto loaded = loadWithReference(a.scenario, a.overrides, validation::ReferenceLimits{});
    auto drawn = std::make_unique<Drawn>();
    drawn->scenario = loaded.scenario;
    const scenario::Scenario& scenario = drawn->scenario;
    Scene& scene = drawn->scene;
    scene.scenario = &scenario;
    limitTime(1.5 * scenario.timeLimit);
    const double dt = a.timeStep.empty() ? scenario.timeSteps.front() : parseTimeStep(a.timeStep);
    if (!(a.at >= 0.0) || a.at > scenario.duration + 0.5 * dt)
        throw std::invalid_argument("--at: found " + std::to_string(a.at) + ", expected 0 .. " +
                                    std::to_string(scenario.duration) +
                                    " s, the scenario's duration (--set duration=S for more)");
    const adapter::EngineSpec spec =
        validation::withScenarioSettings(adapter::parseSpec(a.engine), loaded.text);
    const adapter::PreparedEngine engine = adapter::prepareEngine(spec, scenario, dt);
    const auto world = engine.build(scenario, dt);
    validation::Stepper stepper(scenario, dt, *world);
    const auto steps = static_cast<std::size_t>(std::lround(a.at / dt));
    while (stepper.steps() < steps) {
        stepper.begin();
        world->step();
        stepper.end();
    }
    if (const std::string problem = stepper.nonFinite(); !problem.empty()) throw std::runtime_error(problem);
    scene.states.assign(stepper.states().begin(), stepper.states().end());
    world->readContacts(scene.contacts);
    for (std::size_t j = 0; j < scenario.joints.size(); ++j) scene.jointHolds.push_back(world->jointHolds(j));
    if (const adapter::StagedWorld* staged = world->staged(); staged != nullptr && steps > 0) {
        scene.boxes = staged->boxes();
        scene.islands = staged->islands();
    }
    scene.time = stepper.time();
    return drawn;
}

template <class S>
engine::SvgLines<S> pictureOf(const Scene& scene, const DrawArguments& a) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    engine::DebugOptions<S> options = optionsFor<S>(kindsOf(a.show, kShow));
    fitLengths<S>(scene, options);
    engine::SvgLines<S> picture({kDegree * a.turn, kDegree * a.lift});
    // The frame is that of what moves, and of its contacts and joints.
    drawScene<S>(scene, options, picture, [&picture](bool moves) { picture.keepInFrame(moves); });
    return picture;
}

report::Drawing drawingOf(const engine::Picture& picture) {
    report::Drawing drawing{static_cast<double>(picture.width), picture.height, {}};
    for (const engine::Picture::Mark& mark : picture.marks) {
        const std::string colour = engine::debugColour(mark.kind);
        if (mark.isPoint)
            drawing.add(report::DrawnCircle{mark.x0, mark.y0, engine::kPicturePointRadius, colour});
        else
            drawing.add(report::DrawnLine{mark.x0, mark.y0, mark.x1, mark.y1, {colour}});
    }
    return drawing;
}

void requireKnownEnding(const std::string& file) {
    if (file == "-") return;
    for (const char* ending : {".svg", ".png", ".pdf"})
        if (file.ends_with(ending)) return;
    throw std::invalid_argument("--out: found '" + file +
                                "', expected a name that ends in .svg, .png or .pdf, or '-'");
}

/// The bytes of the file of a known ending; SVG for standard output.
template <class S>
std::string fileOf(const Scene& scene, const DrawArguments& a) {
    const engine::SvgLines<S> lines = pictureOf<S>(scene, a);
    if (a.out.ends_with(".png")) return report::pngOf(drawingOf(lines.picture(a.width)));
    if (a.out.ends_with(".pdf")) return report::pdfOf(drawingOf(lines.picture(a.width)));
    return lines.text(a.width);
}

int drawHere(const DrawArguments& a) {
    (void)kindsOf(a.show, kShow);
    requireKnownEnding(a.out);
    const std::unique_ptr<Drawn> drawn = runTo(a);
    const Scene& scene = drawn->scene;
    const std::string picture = drawn->scenario.dimension == 2 ? fileOf<engine::Space2d>(scene, a)
                                                               : fileOf<engine::Space3d>(scene, a);
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
        "draw", "Draw a scenario at a time, as an engine has it, as an SVG, PNG or PDF picture");
    offerNames(command->add_option("SCENARIO", a->scenario, "Name or file")->required(), kScenarioNames);
    offerNames(command->add_option("-e,--engine", a->engine, "Engine spec (default: rigor)"), kEngineNames);
    command->add_option("--at", a->at, "Time [s]; the step nearest to it is drawn (default 0)");
    command->add_option("--dt", a->timeStep,
                        "Time step in seconds (0.004 or 1/240); default: the scenario's first");
    command->add_option("--set", a->overrides, "Override a scenario value: KEY=VALUE")
        ->allow_extra_args(false);
    command->add_option(
        "-o,--out", a->out,
        "File; its name ends in .svg, .png or .pdf; '-' (default) for SVG on standard output");
    command->add_option(
        "--show", a->show,
        "Some of outline, box, contact, normal, impulse, velocity, joint, island, with commas between "
        "(default: outline,contact,normal,joint); the longest impulse and velocity are a tenth "
        "of the scene");
    command->add_option("--width", a->width, "Width of the picture in pixels (default 800)")
        ->check(between(50, 20000));
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
