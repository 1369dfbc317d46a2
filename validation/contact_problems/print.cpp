// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/contact_problems/solve.hpp"
#include "validation/results/counted.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}
std::string padded(std::string text, std::size_t width, bool right = false) {
    if (text.size() >= width) return text;
    return right ? std::string(width - text.size(), ' ') + text
                 : text + std::string(width - text.size(), ' ');
}

std::string line(const SolveAnswer& answer, const SolveStep& step) {
    const bool stored = answer.solver == "stored";
    std::string text = "  " + padded(answer.solver, 28) + padded(frictionModelName(answer.model), 11);
    text += padded(stored ? "" : std::to_string(step.done) + (step.gaveUp ? "!" : " "), 7, true);
    for (const double value : {step.residual.relative, step.residual.own, step.residual.absolute,
                               step.residual.penetration, step.residual.cone})
        text += "  " + formatted("%8.1e", value);
    text += step.velocityError < 0.0 ? "          " : "  " + formatted("%8.1e", step.velocityError);
    if (!stored) text += formatted("%12.4g", 1e3 * step.seconds);
    return text + "\n";
}

}  // namespace

std::string frictionModelName(const adapter::FrictionModel& model) {
    switch (model.kind) {
        case adapter::FrictionModel::Kind::Cone:
            return "cone";
        case adapter::FrictionModel::Kind::Box:
            return "box";
        case adapter::FrictionModel::Kind::Polygon:
            break;
    }
    return "polygon " + std::to_string(model.corners);
}

std::string solveText(const std::vector<SolvedProblem>& problems, bool allSteps) {
    std::string text;
    for (const SolvedProblem& problem : problems) {
        text += (text.empty() ? "" : "\n") + problem.name + ": " + std::to_string(problem.dimension) + "D, " +
                results::counted(static_cast<std::size_t>(problem.contacts), "contact") +
                (problem.unknowns > 0 ? ", " + std::to_string(problem.unknowns) + " velocities" : "") + "\n";
        if (!problem.description.empty()) text += "  " + problem.description + "\n";
        text += "  " + padded("solver", 28) + padded("friction", 11) +
                " iterat.  residual  own model  absolute"
                "    u_N < 0   |r_T|>mu  |du|/|u|          ms\n";
        for (const SolveAnswer& answer : problem.answers) {
            for (const SolveStep& step : answer.steps)
                if (allSteps || &step == &answer.steps.back()) text += line(answer, step);
            if (answer.outcome != "solved")
                text += "  " + padded(answer.solver, 28) + answer.outcome +
                        (answer.message.empty() ? "" : ": " + answer.message) + "\n";
        }
    }
    return text +
           "\nresidual: |r - P_K(r - (u + mu |u_T| e_N))| / max(|q|, |r|, |u|), on Coulomb's cone for every "
           "solver; own model: that of\nthe friction the solver says it solves for; ! the solver says that "
           "it "
           "gave up; ms: median of solutions from r = 0.\n";
}

json solveJson(const std::vector<SolvedProblem>& problems) {
    json list = json::array();
    for (const SolvedProblem& problem : problems) {
        json answers = json::array();
        for (const SolveAnswer& answer : problem.answers) {
            json steps = json::array();
            for (const SolveStep& s : answer.steps)
                steps.push_back(
                    {{"allowed", s.allowed},
                     {"done", s.done},
                     {"gave_up", s.gaveUp},
                     {"seconds", finiteToJson(s.seconds)},
                     {"runs", s.runs},
                     {"residual", finiteToJson(s.residual.relative)},
                     {"residual_own_model", finiteToJson(s.residual.own)},
                     {"residual_absolute", finiteToJson(s.residual.absolute)},
                     {"penetration_velocity", finiteToJson(s.residual.penetration)},
                     {"cone_violation", finiteToJson(s.residual.cone)},
                     {"velocity_error", s.velocityError < 0 ? json() : finiteToJson(s.velocityError)}});
            answers.push_back({{"solver", answer.solver},
                               {"friction", frictionModelName(answer.model)},
                               {"outcome", answer.outcome},
                               {"message", answer.message},
                               {"steps", std::move(steps)}});
        }
        list.push_back({{"file", problem.file.filename().string()},
                        {"name", problem.name},
                        {"description", problem.description},
                        {"dimension", problem.dimension},
                        {"contacts", problem.contacts},
                        {"velocities", problem.unknowns},
                        {"answers", std::move(answers)}});
    }
    return {{"problems", std::move(list)}};
}

void writeSolveCsv(const std::vector<SolvedProblem>& problems, const std::filesystem::path& file) {
    std::ofstream out(file);
    out << "file;dimension;contacts;solver;friction;outcome;allowed;done;gave_up;residual;residual_own_model;"
           "residual_absolute;penetration_velocity;cone_violation;velocity_error;seconds;runs\n";
    for (const SolvedProblem& problem : problems)
        for (const SolveAnswer& answer : problem.answers) {
            const std::string head = problem.file.filename().string() + ";" +
                                     std::to_string(problem.dimension) + ";" +
                                     std::to_string(problem.contacts) + ";" + answer.solver + ";" +
                                     frictionModelName(answer.model) + ";" + answer.outcome;
            if (answer.steps.empty()) out << head << ";;;;;;;;;;;\n";
            for (const SolveStep& s : answer.steps) {
                out << head << ";" << s.allowed << ";" << s.done << ";" << (s.gaveUp ? 1 : 0);
                for (const double value : {s.residual.relative, s.residual.own, s.residual.absolute,
                                           s.residual.penetration, s.residual.cone})
                    out << ";" << results::finiteText(value);
                out << ";" << (s.velocityError < 0 ? "" : results::finiteText(s.velocityError)) << ";"
                    << results::finiteText(s.seconds) << ";" << s.runs << "\n";
            }
        }
    out.flush();
    if (!out) throw std::runtime_error(file.string() + " cannot be written");
}

}  // namespace rigor::validation
