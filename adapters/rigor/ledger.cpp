// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/rigor/settings.hpp"
#include "engine/solvers/solver.hpp"

namespace rigor::adapter {
namespace {

engine::SolverStyle<engine::Space3d> solverStyle(const std::string& name) {
    using S = engine::Space3d;
    return engine::findAlgorithm(engine::solverTable<S>(), "solver", name).make()->style();
}

}  // namespace

std::vector<LedgerEntry> settingsLedger(const Scenario& scenario, const Settings& settings, bool bounces) {
    std::vector<LedgerEntry> lines;
    const auto text = [&](const char* key) { return textSetting(settings, key); };
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const bool single = text("precision") == "f32";
    add("precision", "f64", text("precision"), single ? Realisation::Approximate : Realisation::Exact,
        single ? "single precision was asked for" : "");
    add("integrator", text("integrator"), text("integrator"));
    if (scenario.dimension == 3) {
        const bool kept = text("rotation") == "lie_midpoint";
        add("gyroscopic_term", "angular momentum kept without torque", text("rotation"),
            kept ? Realisation::Exact : Realisation::Approximate,
            kept ? ""
                 : "angular momentum changes by the order of the scheme, or altogether without the term");
    }
    const engine::SolverStyle<engine::Space3d> style = solverStyle(text("solver"));
    const auto orOwn = [&](const char* key, int own) {
        const int asked = integerSetting(settings, key);
        return std::to_string(asked > 0 ? asked : own);
    };
    std::string solver = text("solver") + ", " + orOwn("substeps", style.substeps) + " sub-steps, " +
                         orOwn("velocity_iterations", style.iterations.value_or(50)) + " iterations";
    if (!style.iterations) solver += ", up to " + text("first_step_iterations") + " in the first step";
    if (!style.ownsCorrection) solver += ", " + text("position_iterations") + " position iterations";
    add("solver", text("solver"), solver);
    add("warm_starting", text("warm_starting"), text("warm_starting"));
    const bool cone = text("friction") == "cone" || scenario.dimension == 2;
    add("friction_law", "coulomb cone, pair coefficient", text("friction"),
        cone ? Realisation::Exact : Realisation::Approximate,
        cone ? "" : "up to sqrt(2) times the friction diagonal to the tangents");
    add("friction_pair", "pair table", "pair table");
    const double threshold = numberSetting(settings, "restitution_threshold");
    const bool late = bounces && threshold > 0;
    add("restitution", "pair coefficient, no threshold",
        "pair coefficient, none below " + text("restitution_threshold") + " m/s",
        late ? Realisation::Approximate : Realisation::Exact, late ? "velocity threshold" : "");
    add("contact_margin", "0",
        "none in the shapes; resting contacts are found within " + text("speculative_distance") +
            " m and may just close the gap; below " + text("gap_slop") + " m it counts as closed",
        Realisation::Approximate,
        "an inelastic impact takes place at the end of the step that would close the gap, up to that far "
        "early");
    const std::string correction = style.ownsCorrection
                                       ? "the solver's own"
                                       : text("position_correction") + ", slop " + text("slop") + " m";
    const bool keeps = !style.ownsCorrection && text("position_correction") == "baumgarte";
    add("position_correction", "no change of velocity", correction,
        keeps ? Realisation::Approximate : Realisation::Exact,
        keeps ? "the velocities that remove overlap stay in the bodies" : "");
    if (!scenario.joints.empty()) {
        const bool curved = text("curved_joints") == "on" && text("integrator") != "explicit_euler";
        add("joints", "rigid",
            curved ? "rigid, solved at the end of the step" : "rigid, linearised at the start",
            Realisation::Exact);
    }
    add("damping", "velocity kept per second", "velocity kept per second, exact over a step");
    const bool sleeps = text("sleeping") != "off";
    add("sleeping", "off",
        sleeps ? text("sleeping") + ", below " + text("sleep_linear_velocity") + " m/s and " +
                     text("sleep_angular_velocity") + " rad/s for " + text("time_to_sleep") + " s"
               : "off",
        sleeps ? Realisation::Approximate : Realisation::Exact, sleeps ? "slow bodies are stopped" : "");
    add("velocity_clamp", "none", "none");
    if (text("fault") != "none")
        add("fault", "none", text("fault"), Realisation::Unsupported, "a deliberate mistake was asked for");
    const std::string ccd = text("continuous_collision");
    const bool speculative = ccd == "speculative";
    const std::string told = ccd == "none" ? "off" : ccd;
    add("continuous_collision", told, told, speculative ? Realisation::Approximate : Realisation::Exact,
        speculative ? "what an impact of a fast body leaves of its step is lost" : "");
    return lines;
}

}  // namespace rigor::adapter
