// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/rigor/python/scenario_world.hpp"

#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/native_world.hpp"
#include "adapters/rigor/python/spec_settings.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/python/typed_world.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::adapter {
namespace {

using engine::python::BuiltWorld;
using engine::python::TypedWorld;

std::string jsonOf(const py::handle& value) {
    return py::str(py::module_::import("json").attr("dumps")(value));
}

scenario::LoadedScenario load(const ScenarioSource& source, const py::dict& set) {
    std::vector<std::string> overrides;
    for (const auto& [key, value] : set) overrides.push_back(std::string(py::str(key)) + "=" + jsonOf(value));
    if (const auto* name = std::get_if<std::string>(&source))
        return scenario::loadScenario(scenario::findScenario(*name), overrides);
    return scenario::loadScenarioText(jsonOf(std::get<py::dict>(source)), "scenario", overrides);
}

/// An angular impulse as the space has it.
template <class S>
typename S::Ang angularOf(const Vec3& v) {
    if constexpr (S::dim == 2)
        return static_cast<typename S::Real>(v.z);
    else
        return toEngineVec<S>(v);
}

/// Gives the impulses that are due in the step that begins now, as the runner does (validation/runner/forces.cpp):
/// single-stage integrators get them as a force during the step.
template <class S>
engine::python::BeforeStep<S> schedule(const Scenario& scenario, const std::vector<engine::BodyId>& bodies) {
    if (scenario.events.empty()) return {};
    return [events = scenario.events, bodies](engine::World<S>& world, typename S::Real h) {
        const double now = world.time(), step = static_cast<double>(h), slack = 1e-9 * step;
        const bool isEuler =
            engine::integratorTraits(world.def().integrator).forces == engine::ForceTimes::Start;
        for (const scenario::Event& event : events) {
            const engine::BodyId body = bodies[static_cast<std::size_t>(event.body)];
            const bool due = event.time <= now + slack;
            const bool wasDue = now > 0 && event.time <= now - step + slack;
            if (!due || wasDue || world.constants(body).type != engine::BodyType::Dynamic) continue;
            if (isEuler)
                world.applyForce(body, toEngineVec<S>(event.impulse / step),
                                 angularOf<S>(event.angularImpulse / step));
            else
                world.applyImpulse(body, toEngineVec<S>(event.impulse), angularOf<S>(event.angularImpulse));
        }
    };
}

template <class S>
std::shared_ptr<engine::python::AnyWorld> makeTyped(const Scenario& scenario, double dt,
                                                    const Settings& settings) {
    NativeWorld<S> native = makeNativeWorld<S>(scenario, dt, settings);
    BuiltWorld<S> built{std::move(native.world),
                        native.bodies,
                        native.joints,
                        {},
                        {},
                        {},
                        native.materials,
                        dt,
                        schedule<S>(scenario, native.bodies)};
    for (const scenario::Body& body : scenario.bodies) built.bodyNames.push_back(body.name);
    for (const scenario::Joint& joint : scenario.joints) built.jointNames.push_back(joint.name);
    for (const scenario::Material& material : scenario.materials)
        built.materialNames.push_back(material.name);
    return std::make_shared<TypedWorld<S>>(std::move(built));
}

}  // namespace

std::shared_ptr<engine::python::AnyWorld> makeScenarioWorld(const ScenarioSource& source,
                                                            const std::string& spec, std::optional<double> dt,
                                                            const py::dict& set) {
    const scenario::LoadedScenario loaded = load(source, set);
    const Scenario& scenario = loaded.scenario;
    const Settings settings = settingsOf(spec, loaded.text);
    const double step = dt.value_or(scenario.timeSteps.front());
    const bool single = textSetting(settings, "precision") == "f32";
    if (scenario.dimension == 2)
        return single ? makeTyped<engine::Space2f>(scenario, step, settings)
                      : makeTyped<engine::Space2d>(scenario, step, settings);
    return single ? makeTyped<engine::Space3f>(scenario, step, settings)
                  : makeTyped<engine::Space3d>(scenario, step, settings);
}

}  // namespace rigor::adapter
