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
        const std::string& rotation = text("rotation");
        const bool rk4 = text("integrator") == "rk4" && rotation != "none";
        const bool kept = rk4 || rotation == "lie_midpoint" || rotation == "moser_veselov";
        add("gyroscopic_term", "angular momentum kept without torque",
            rk4 ? "part of the equations that rk4 integrates" : rotation,
            kept ? Realisation::Exact : Realisation::Approximate,
            kept ? ""
                 : "angular momentum changes by the order of the scheme, or altogether without the term");
    }
    add("orientation_update", "exponential_map", text("orientation_update"),
        text("orientation_update") == "exponential_map" ? Realisation::Exact : Realisation::Approximate,
        text("orientation_update") == "exponential_map" ? "" : "turns by 2 atan(h w / 2) instead of h w");
    if (!scenario.forces.empty())
        add("forces", "functions of time and state",
            text("integrator") == "rk4"               ? "evaluated at the four stages of every step"
            : text("integrator") == "velocity_verlet" ? "evaluated at the start and the end of every step"
                                                      : "evaluated at the start of every step");
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
    // Some solvers have a friction law of their own.
    std::string law = text("friction");
    if (text("solver") == "nsgs") law = "cone";
    if (text("solver") == "dantzig") law = "pyramid";
    if (text("solver") == "lemke") law = text("pyramid_directions") + " directions inside the cone";
    const bool cone = law == "cone" || scenario.dimension == 2;
    std::string reason = law == "pyramid" ? "up to sqrt(2) times the friction diagonal to the tangents"
                                          : "friction weaker and askew between the directions";
    if (law == "none") reason = "friction is off";
    add("friction_law", "coulomb cone, pair coefficient", law,
        cone ? Realisation::Exact : Realisation::Approximate, cone ? "" : reason);
    const std::string rules = text("friction_combine") + ", " + text("restitution_combine");
    const bool table = rules == "geometric_mean, min";
    add("friction_pair", "pair table", table ? "pair table" : "pair table; pairs it does not name: " + rules,
        table ? Realisation::Exact : Realisation::Approximate,
        table ? "" : "another combine rule was asked for");
    if (text("restitution") != "newton")
        add("restitution_law", "newton", text("restitution"), Realisation::Approximate,
            "another law of impact was asked for");
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
    if (numberSetting(settings, "reuse_distance") > 0)
        add("narrow_phase_calls", "every pair in every step",
            "kept until a pair has moved by " + text("reuse_distance") + " m against each other",
            Realisation::Approximate, "depths are off by up to twice that, normals of edges by 0.02 rad");
    const std::string correction = style.ownsCorrection
                                       ? "the solver's own"
                                       : text("position_correction") + ", slop " + text("slop") + " m";
    const bool keeps = !style.ownsCorrection && text("position_correction") == "baumgarte";
    add("position_correction", "no change of velocity", correction,
        keeps ? Realisation::Approximate : Realisation::Exact,
        keeps ? "the velocities that remove overlap stay in the bodies" : "");
    if (!scenario.joints.empty()) {
        const bool curved = text("curved_joints") == "on" && text("integrator") == "symplectic_euler";
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
