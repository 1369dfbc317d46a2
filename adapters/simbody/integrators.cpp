// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/simbody/integrators.hpp"

#include <functional>

namespace rigor::simbody {
namespace {

using System = SimTK::MultibodySystem;
using Made = std::shared_ptr<SimTK::Integrator>;

template <class Kind>
Made make(const System& system, double) {
    return std::make_shared<Kind>(system);
}
Made makeSemiExplicitEuler(const System& system, double dt) {
    return std::make_shared<SimTK::SemiExplicitEulerIntegrator>(system, dt);
}

struct Entry {
    const char* name;
    Made (*make)(const System& system, double dt);
    bool fixed, controlled;  ///< can have steps of one size; can choose their sizes by their errors
};
constexpr Entry kEntries[] = {
    {"runge_kutta_merson", make<SimTK::RungeKuttaMersonIntegrator>, true, true},
    {"runge_kutta_feldberg", make<SimTK::RungeKuttaFeldbergIntegrator>, true, true},
    {"runge_kutta_3", make<SimTK::RungeKutta3Integrator>, true, true},
    {"runge_kutta_2", make<SimTK::RungeKutta2Integrator>, true, true},
    {"verlet", make<SimTK::VerletIntegrator>, true, true},
    {"semi_explicit_euler_2", make<SimTK::SemiExplicitEuler2Integrator>, true, true},
    {"semi_explicit_euler", makeSemiExplicitEuler, true, false},
    {"explicit_euler", make<SimTK::ExplicitEulerIntegrator>, true, true},
    {"cpodes", make<SimTK::CPodesIntegrator>, false, true},
};

}  // namespace

const std::vector<std::string>& integratorNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Entry& entry : kEntries) all.emplace_back(entry.name);
        return all;
    }();
    return names;
}

Made makeIntegrator(const System& system, double dt, const adapter::Settings& settings) {
    const std::string& name = adapter::textSetting(settings, "integrator");
    const bool fixed = adapter::textSetting(settings, "step") == "fixed";
    for (const Entry& entry : kEntries) {
        if (name != entry.name) continue;
        if (!(fixed ? entry.fixed : entry.controlled))
            throw adapter::BadInput("simbody: step: found '" +
                                    std::string(fixed ? "fixed" : "error_controlled") +
                                    "', which the integrator " + name + " does not have");
        Made made = entry.make(system, dt);
        made->setAccuracy(adapter::numberSetting(settings, "accuracy"));
        made->setConstraintTolerance(adapter::numberSetting(settings, "constraint_tolerance"));
        made->setProjectEveryStep(adapter::textSetting(settings, "projection") == "every_step");
        made->setAllowInterpolation(false);
        if (fixed && entry.controlled) made->setFixedStepSize(dt);
        return made;
    }
    throw adapter::BadInput("simbody: integrator: found '" + name + "'");
}

}  // namespace rigor::simbody
