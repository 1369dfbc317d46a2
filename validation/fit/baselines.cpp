// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/fit/baselines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/fit/search.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/runner/simulate.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

/// A run in which `body` moves as given and all others stay.
Trajectory runOf(const Scenario& s, double dt, int body, const std::function<BodyState(double)>& motion) {
    Trajectory run;
    run.dt = dt;
    run.bodyCount = s.bodies.size();
    for (std::size_t k = 0; k <= stepCount(s, dt); ++k) {
        run.times.push_back(k * dt);
        run.contacts.emplace_back();
        for (std::size_t i = 0; i < s.bodies.size(); ++i)
            run.states.push_back(
                static_cast<int>(i) == body
                    ? motion(run.times.back())
                    : BodyState{s.bodies[i].pose.position, s.bodies[i].pose.orientation, {}, {}});
    }
    return run;
}

/// The floor under a recorded box.
struct Slide {
    int body = kNone;
    Vec3 normal;
    double landing = 0.0;  ///< time at which its centre is half a width above the floor [s]
    double friction = 0.0, gravity = 0.0;
    Vec3 start, velocity, along;  ///< along: unit, of the tangential velocity
    double fallen = 0.0, speed = 0.0;

    Vec3 at(double t) const {
        const double flown = std::min(t, landing), slid = std::max(0.0, t - landing);
        const double stop = friction * gravity > 0.0 ? speed / (friction * gravity) : 1e300;
        const double u = std::min(slid, stop);
        const double way = speed * flown + speed * u - 0.5 * friction * gravity * u * u;
        const double height = dot(normal, velocity) * flown - 0.5 * gravity * flown * flown;
        return start + way * along + height * normal;
    }
};

std::optional<Slide> slideOf(const Scenario& s, const Reference& reference) {
    const std::vector<int> recorded = reference.bodies();
    if (recorded.size() != 1 || s.dimension != 3) return std::nullopt;
    const Body& cube = s.bodies[recorded[0]];
    const auto* box = cube.shapes.size() == 1 ? std::get_if<Box>(&cube.shapes[0].geometry) : nullptr;
    if (box == nullptr) return std::nullopt;
    const double half = std::min({box->halfExtents.x, box->halfExtents.y, box->halfExtents.z});
    for (const Body& floor : s.bodies) {
        const auto* solid =
            floor.shapes.size() == 1 ? std::get_if<HalfSpace>(&floor.shapes[0].geometry) : nullptr;
        if (floor.type != BodyType::Static || solid == nullptr) continue;
        const Pose pose = floor.pose * floor.shapes[0].pose;
        Slide slide{recorded[0],
                    rotate(pose.orientation, solid->normal),
                    0,
                    0,
                    0,
                    cube.pose.position,
                    cube.velocity,
                    {},
                    0,
                    0};
        slide.gravity = -dot(s.gravity, slide.normal);
        if (!(slide.gravity > 0.0) || norm(s.gravity + slide.gravity * slide.normal) > 1e-9 * slide.gravity)
            continue;
        slide.friction = pairCoefficients(s, cube.shapes[0].material, floor.shapes[0].material).friction;
        const double drop =
            std::max(0.0, dot(slide.normal, slide.start - pose.position) - solid->offset - half);
        const double up = dot(slide.normal, cube.velocity);
        slide.landing = (up + std::sqrt(up * up + 2.0 * slide.gravity * drop)) / slide.gravity;
        const Vec3 tangential = cube.velocity - up * slide.normal;
        slide.speed = norm(tangential);
        slide.along = slide.speed > 0.0 ? tangential / slide.speed : Vec3{};
        return slide;
    }
    return std::nullopt;
}

enum class Kind { Frozen, Slide, SlideToFinalAttitude };

/// One value per metric; empty where the scenario is not of the kind.
std::vector<double> predict(Kind kind, const Scenario& s, double dt,
                            const std::vector<std::string>& metrics) {
    const auto reference = makeReference(s);
    if (!reference) return {};
    Trajectory run = runOf(s, dt, kNone, {});
    if (kind != Kind::Frozen) {
        const auto slide = slideOf(s, *reference);
        if (!slide) return {};
        Quat attitude = s.bodies[slide->body].pose.orientation;
        if (kind == Kind::SlideToFinalAttitude) {
            const auto end = reference->measured(slide->body, s.duration);
            if (!end || !end->orientation) return {};
            attitude = *end->orientation;
        }
        run = runOf(s, dt, slide->body, [&](double t) { return BodyState{slide->at(t), attitude, {}, {}}; });
    }
    std::vector<double> values;
    for (const std::string& name : metrics) {
        const auto rows = findMetric(name)->evaluate({s, run, reference.get(), adapter::Scheme::Unknown});
        values.push_back(rows.empty() ? std::numeric_limits<double>::quiet_NaN() : rows.front().value);
    }
    return values;
}

}  // namespace

std::vector<Baseline> baselines(const FitTask& task) {
    const struct {
        Kind kind;
        const char *name, *title;
    } kinds[] = {{Kind::Frozen, "frozen", "stays as it starts"},
                 {Kind::Slide, "slide", "flies and slides without turning"},
                 {Kind::SlideToFinalAttitude, "slide_to_final_attitude",
                  "flies and slides in the attitude in which the recording ends"}};
    std::vector<Baseline> all;
    for (const auto& one : kinds) {
        Baseline baseline{one.name, one.title, {}};
        for (const bool train : {true, false}) {
            std::vector<Losses> losses(task.metrics.size());
            bool applies = true;
            for (const auto& loaded : train ? task.train : task.test) {
                const Scenario& s = loaded.scenario;
                const auto values =
                    predict(one.kind, s, task.dt > 0.0 ? task.dt : s.timeSteps.front(), task.metrics);
                applies = applies && !values.empty() &&
                          std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
                if (!applies) break;
                for (std::size_t m = 0; m < values.size(); ++m) losses[m].push_back(values[m]);
            }
            for (std::size_t m = 0; applies && m < losses.size(); ++m)
                baseline.scores.push_back(
                    {train ? "train" : "test", "unfitted", task.metrics[m], scoreOf(losses[m], task.seed)});
        }
        if (!baseline.scores.empty()) all.push_back(std::move(baseline));
    }
    return all;
}

}  // namespace rigor::validation
