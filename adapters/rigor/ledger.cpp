// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Meaning of the settings, line by line. The behaviour of an algorithm is read from its traits
// (engine/core/traits.hpp) and from the object that its table makes, never from its name.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/interface/options.hpp"
#include "adapters/rigor/settings.hpp"
#include "engine/ccd/traits.hpp"
#include "engine/faults/fault.hpp"
#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/pipeline/island_method.hpp"
#include "engine/sleeping/sleeping.hpp"
#include "engine/solvers/combine_rules.hpp"
#include "engine/solvers/position_correction.hpp"
#include "engine/solvers/restitution.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::adapter {
namespace {

using engine::ErrorHandling;
using engine::FrictionShape;
using S = engine::Space3d;

template <class Table>
auto made(Table table, const char* family, const std::string& name) {
    return engine::findAlgorithm(table, family, name).make();
}

class Ledger {
  public:
    Ledger(const Scenario& scenario, const Settings& settings, bool bounces, double substep)
        : scenario_(scenario),
          settings_(settings),
          solver_(engine::solverTraits(text("solver"))),
          integrator_(engine::integratorTraits(text("integrator"))),
          correction_(
              made(engine::positionCorrectionTable<S>(), "position_correction", text("position_correction"))),
          bounces_(bounces),
          substep_(substep) {}

    std::vector<LedgerEntry> lines() && {
        addPrecision();
        addMotion();
        addSolver();
        addLargeIslands();
        addFriction();
        addRestitution();
        addContacts();
        addErrors();
        if (!scenario_.joints.empty()) addJoints();
        addRest();
        return std::move(lines_);
    }

  private:
    const std::string& text(const char* key) const { return textSetting(settings_, key); }
    bool isOn(const char* key) const { return text(key) == "on"; }

    /// Exact where there is no reason.
    void add(const char* topic, std::string requested, std::string resolved, std::string reason = "") {
        const Realisation how = reason.empty() ? Realisation::Exact : Realisation::Approximate;
        lines_.push_back({topic, std::move(requested), std::move(resolved), how, std::move(reason)});
    }

    void addPrecision() {
        const bool single = text("precision") == "f32";
        if (single)
            add("precision", "f64", "f32", "single precision was requested");
        else if (solver_.contactsInSingle)
            add("precision", "f64", "f64, contacts in f32",
                "the solver reckons rows and impulses of contacts in single precision");
        else
            add("precision", "f64", "f64");
    }

    void addMotion() {
        add("integrator", text("integrator"), text("integrator"));
        if (scenario_.dimension == 3) {
            const auto scheme = made(engine::rotationTable<S>(), "rotation", text("rotation"));
            const bool own = integrator_.ownsRotation && scheme.gyroscopic;
            const bool kept = own || engine::rotationTraits(text("rotation")).keepsMomentum;
            add("gyroscopic_term", "angular momentum kept without torque",
                own ? "part of the equations that " + text("integrator") + " integrates" : text("rotation"),
                kept ? ""
                     : "angular momentum changes by the order of the scheme, or altogether without the term");
        }
        const bool exact = engine::orientationTraits(text("orientation_update")).exact;
        add("orientation_update", "exact for a constant angular velocity", text("orientation_update"),
            exact ? "" : "turns by 2 atan(h w / 2) instead of h w");
        if (scenario_.forces.empty()) return;
        const engine::ForceTimes times = integrator_.forces;
        add("forces", "functions of time and state",
            times == engine::ForceTimes::Start         ? "evaluated at the start of every step"
            : times == engine::ForceTimes::Middle      ? "evaluated in the middle of every step"
            : times == engine::ForceTimes::StartAndEnd ? "evaluated at the start and the end of every step"
                                                       : "evaluated at the stages of every step");
    }

    std::string orOwn(const char* key, int own) const {
        const int requested = integerSetting(settings_, key);
        return std::to_string(requested > 0 ? requested : own);
    }
    bool leavesErrors() const { return solver_.errors == ErrorHandling::Correction; }

    void addSolver() {
        std::string resolved = text("solver") + ", " + orOwn("substeps", solver_.substeps) + " sub-steps, " +
                               orOwn("velocity_iterations", solver_.iterations.value_or(50)) + " iterations";
        if (!solver_.iterations)
            resolved += ", up to " + text("first_step_iterations") + " in the first step";
        if (leavesErrors()) resolved += ", " + text("position_iterations") + " position iterations";
        add("solver", text("solver"), resolved);
        if (isOn("warm_starting") && !solver_.warmStarts)
            add("warm_starting", "on", "off", "this solver begins every sub-step without impulses");
        else
            add("warm_starting", text("warm_starting"), text("warm_starting"));
    }

    /// Contacts are rigid unless an island may have more than the solver's usual method takes.
    void addLargeIslands() {
        if (solver_.largeIslands.empty()) return;
        const int most = integerSetting(settings_, "island_contacts");
        const std::string other =
            "by " + std::string(solver_.largeIslands) + ", with the settings of preset=fast";
        if (mayTouchMoreThan(most))
            add("large_islands", "solved as small ones",
                "those of more than " + std::to_string(most) + " contacts" +
                    (scenario_.joints.empty() ? " " : ", each with a joint beside it counted twice, ") +
                    other,
                "their contacts are damped springs in single precision that carry loads by overlap, with "
                "friction of "
                "each patch as a whole, and their joints are linearised");
        else
            add("large_islands", "solved as small ones", "none: the bodies cannot have so many contacts");
    }
    /// False if all pairs of shapes together are no more contacts than that, with joints beside them counted twice.
    bool mayTouchMoreThan(int contacts) const {
        std::size_t moving = 0, fixed = 0;
        for (const scenario::Body& body : scenario_.bodies) {
            if (!body.collides) continue;
            for (const scenario::Shape& shape : body.shapes)
                if (std::holds_alternative<scenario::Chain>(shape.geometry) ||
                    std::holds_alternative<scenario::TriangleMesh>(shape.geometry) ||
                    std::holds_alternative<scenario::HeightField>(shape.geometry))
                    return true;  // a contact for each piece
            (body.type == scenario::BodyType::Dynamic ? moving : fixed) += body.shapes.size();
        }
        const std::size_t pairs = moving * (moving - 1) / 2 + moving * fixed;
        return moving > 0 &&
               engine::countedContacts(pairs, scenario_.joints.size()) > static_cast<std::size_t>(contacts);
    }

    void addFriction() {
        const FrictionShape shape = solver_.friction.value_or(engine::frictionShape(text("friction")));
        const std::string requested = "coulomb cone, pair coefficient";
        const bool plane = scenario_.dimension == 2;
        switch (shape) {
            case FrictionShape::None:
                add("friction_law", requested, "none", "friction is off");
                break;
            case FrictionShape::Cone:
                if (solver_.frictionOfPatches && !plane)
                    add("friction_law", requested, "cone, of each patch of contacts as a whole",
                        "the contacts of two shapes have one friction impulse, at the centre of their "
                        "pressure: force and "
                        "torque are approximate where they slide and turn at once");
                else
                    add("friction_law", requested, "cone");
                break;
            case FrictionShape::Box:
                add("friction_law", requested, "pyramid",
                    plane ? "" : "up to sqrt(2) times the friction diagonal to the tangents");
                break;
            case FrictionShape::Polygon:
                add("friction_law", requested, text("pyramid_directions") + " directions inside the cone",
                    plane ? "" : "friction weaker and askew between the directions");
                break;
            case FrictionShape::Line:
                add("friction_law", requested, "along one line",
                    plane ? "" : "opposes the slip that there would be without friction");
                break;
        }
        const std::string rules = text("friction_combine") + ", " + text("restitution_combine");
        const bool table = combinesAsScenarios(settings_);
        add("friction_pair", "pair table",
            table ? "pair table" : "pair table; pairs it does not name: " + rules,
            table ? "" : "another combine rule was requested");
    }

    void addRestitution() {
        const auto law = made(engine::restitutionTable<S>(), "restitution", text("restitution"));
        if (!law->bounces() || law->solvesImpacts())
            add("restitution_law", "newton", text("restitution"), "another law of impact was requested");
        const bool late = bounces_ && numberSetting(settings_, "restitution_threshold") > 0;
        add("restitution", "pair coefficient, no threshold",
            "pair coefficient, none below " + text("restitution_threshold") + " m/s",
            late ? "velocity threshold" : "");
    }

    /// The frequency that springs really have [Hz] (Step::biasRule).
    double springFrequency(const char* key) const {
        return std::min(numberSetting(settings_, key), 0.25 / substep_);
    }
    std::string springs(const char* frequency, const char* dampingRatio) const {
        return "damped springs of " + shown(springFrequency(frequency)) + " Hz, damping ratio " +
               text(dampingRatio);
    }
    bool areSprings() const {
        return solver_.errors == ErrorHandling::Springs || (leavesErrors() && correction_->bias().soft);
    }

    void addContacts() {
        const std::string margin =
            "none in the shapes; resting contacts are found within " + text("speculative_distance") + " m";
        if (integrator_.scheme == engine::FlightScheme::MoreauMidpoint &&
            solver_.contacts == engine::ContactForm::Rows)
            add("contact_margin", "0",
                margin +
                    ", others as far ahead as two shapes may come near each other in a step, up to their "
                    "size, and may just close the gap",
                "an inelastic impact of a body that others hold takes place up to a step early; a body that "
                "passes another nearer than that may be deflected");
        else
            add("contact_margin", "0",
                margin + " and may just close the gap; below " + text("gap_slop") + " m it counts as closed",
                "an inelastic impact takes place at the end of the step that would close the gap, up to that "
                "far early");
        if (areSprings()) {
            const Vec3& g = scenario_.gravity;
            const double omega = 2.0 * std::numbers::pi * springFrequency("contact_frequency");
            const double sag = std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z) / (omega * omega);
            add("contact_model", "rigid", springs("contact_frequency", "contact_damping_ratio"),
                "loads are carried by overlap: " + shown(sag) +
                    " m at one contact under a body's own weight");
        } else {
            add("contact_model", "rigid", "rigid");
        }
        if (numberSetting(settings_, "reuse_distance") > 0)
            add("narrow_phase_calls", "every pair in every step",
                "kept until a pair has moved by " + text("reuse_distance") + " m against each other",
                "depths are off by up to twice that, normals of edges by 0.02 rad");
    }

    /// Adds the method that removes position errors, and whether the velocity that it uses stays in the
    /// bodies.
    void addErrors() {
        const char* requested = "no change of velocity";
        const char* stays = "the velocities that remove overlap stay in the bodies";
        if (leavesErrors()) {
            const auto bias = correction_->bias();
            const bool keeps = (bias.baumgarte > 0 || bias.soft) && correction_->relaxIterations() == 0;
            add("position_correction", requested,
                text("position_correction") + ", slop " + text("slop") + " m", keeps ? stays : "");
        } else if (solver_.errors == ErrorHandling::Springs) {
            const bool relaxes = solver_.relaxIterations > 0;
            add("position_correction", requested,
                std::string("the solver's springs, slop ") + text("slop") + " m" +
                    (relaxes ? ", their velocity relaxed out again" : ""),
                relaxes ? "" : stays);
        } else {
            add("position_correction", requested, "the solver's own: it solves positions");
        }
    }

    void addJoints() {
        const bool curved = isOn("curved_joints");
        const auto scheme = made(engine::integratorTable<S>(), "integrator", text("integrator"));
        if (solver_.errors == ErrorHandling::Positions)
            add("joints", "rigid", "rigid in positions, from which velocities follow",
                "what swings is damped by (w h)^2 / 2 in each sub-step");
        else if (areSprings() && solver_.linearJointBaumgarte && !curved)
            add("joints", "rigid",
                "rigid, linearised at the start of each sub-step; " + shown(*solver_.linearJointBaumgarte) +
                    " of the error is removed in each",
                "a joint that turns leaves its constraint by the second order of the sub-step");
        else if (areSprings())
            add("joints", "rigid", springs("joint_frequency", "joint_damping_ratio"),
                "joints give way under load");
        else if (curved && scheme.movesWithSolvedVelocity)
            add("joints", "rigid", "rigid, solved at the end of the step");
        else
            add("joints", "rigid", "rigid, linearised at the start",
                "a joint that turns leaves its constraint by the second order of the step");
    }

    void addRest() {
        add("damping", "velocity kept per second", "velocity kept per second, exact over a step");
        const bool sleeps = made(engine::sleepingTable<S>(), "sleeping", text("sleeping")).rest != nullptr;
        add("sleeping", "off",
            sleeps ? text("sleeping") + ", below " + text("sleep_linear_velocity") + " m/s and " +
                         text("sleep_angular_velocity") + " rad/s for " + text("time_to_sleep") + " s"
                   : "off",
            sleeps ? "slow bodies are stopped" : "");
        add("velocity_clamp", "none", "none");
        if (made(engine::faultTable<S>(), "fault", text("fault")) != nullptr)
            lines_.push_back({"fault", "none", text("fault"), Realisation::Unsupported,
                              "a deliberate mistake was requested"});
        const auto& ccd = engine::continuousCollisionTraits(text("continuous_collision"));
        const std::string realised = ccd.acts ? text("continuous_collision") : "off";
        add("continuous_collision", realised, realised,
            ccd.losesRest ? "what an impact of a fast body leaves of its step is lost" : "");
    }

    const Scenario& scenario_;
    const Settings& settings_;
    const engine::SolverTraits& solver_;
    const engine::IntegratorTraits& integrator_;
    std::unique_ptr<engine::PositionCorrection<S>> correction_;
    bool bounces_;
    double substep_;
    std::vector<LedgerEntry> lines_;
};

}  // namespace

bool combinesAsScenarios(const Settings& settings) {
    const auto rule = [&](const char* key) {
        return engine::findAlgorithm(engine::combineTable<double>(), key, textSetting(settings, key)).make;
    };
    const auto friction = rule("friction_combine"), restitution = rule("restitution_combine");
    for (const auto& [a, b] : {std::pair{0.2, 0.8}, std::pair{0.7, 0.1}, std::pair{0.3, 0.3}})
        if (std::abs(friction(a, b) - std::sqrt(a * b)) > 1e-12 || restitution(a, b) != std::min(a, b))
            return false;
    return true;
}

std::vector<LedgerEntry> settingsLedger(const Scenario& scenario, const Settings& settings, bool bounces,
                                        double substep) {
    return Ledger(scenario, settings, bounces, substep).lines();
}

}  // namespace rigor::adapter
