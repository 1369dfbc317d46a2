// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact solvers on contact problems: time until the contact law holds to a stated residual. The residual is
// the relative natural map of the law that the solver says it solves (contact_problems/residual.hpp: a
// pyramid where it has one), so that what is timed is its convergence. How many iterations that takes is
// found first, among fixed numbers; then solutions with so many are timed, each from r = 0, without setting
// up.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "validation/bench/parts/contact_scenes.hpp"
#include "validation/bench/parts/engines.hpp"
#include "validation/contact_problems/residual.hpp"
#include "validation/contact_problems/solve.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

constexpr int kIterationCounts[] = {1,  2,   3,   4,   5,   7,   10,  14,  20,   28,   40,  56,
                                    80, 113, 160, 226, 320, 453, 640, 905, 1280, 1810, 2560};
constexpr double kSearchTime = 2.0;  ///< time after which no larger number of iterations is tried [s]
constexpr double kSolveTime = 1.0;   ///< time after which no further solution is timed [s]
constexpr const char *kTargets[] = {"1e-3", "1e-6", "1e-9"}, *kUsualTarget = kTargets[1];

class ContactSolverBench final : public TimedWork {
  public:
    explicit ContactSolverBench(const PlannedBench& planned) {
        const json parameters = json::parse(planned.parameters);
        target_ = std::stod(parameters.at("residual").get<std::string>());
        problem_ = makeContactScene(parameters.at("scene"), parameters.at("seed"));
        const adapter::EngineSpec spec = adapter::parseSpec(planned.engine);
        engine_.emplace(adapter::loadEngine(spec));
        if ((*engine_)->contactSolvers() == nullptr)
            throw adapter::Unsupported(spec.engine + " has no solvers for contact problems");
        solve_ =
            (*engine_)->contactSolvers()->take(problem_.problem, adapter::resolveSettings(spec, **engine_));
    }

    results::BenchRepetition run(int) override {
        const int iterations = climb();
        adapter::ContactSolution found;
        constexpr std::size_t least = 3, most = 200;
        CountingStopwatch watch(most);
        double spent = 0.0;
        const auto isEnough = [&](std::size_t solved) {
            return solved >= most || spent > kSolveTime || (solved >= least && spent >= 0.05);
        };
        while (!isEnough(watch.samples().cpu.size())) {
            watch.time([&] { found = solve_->run(iterations, 0.0); });
            spent += watch.samples().cpu.back();
        }
        const ContactResidual residual = contactResidual(problem_.problem, found.r, solve_->friction());
        results::BenchRepetition done;
        fillTimes(watch, false, done);
        done.counts = {{"contacts", static_cast<double>(problem_.problem.contacts())},
                       {"iterations", static_cast<double>(found.iterations)}};
        done.quality = {judged("residual", "1", residual.own, target_),
                        judged("cone_residual", "1", residual.relative, std::nullopt)};
        return done;
    }

  private:
    /// The first number of iterations that is good enough, or the best there is.
    int climb() {
        Stopwatch watch;
        int best = kIterationCounts[0];
        double least = 1e300, spent = 0.0;
        for (const int iterations : kIterationCounts) {
            adapter::ContactSolution found;
            watch.time([&] { found = solve_->run(iterations, 0.0); });
            const double residual = contactResidual(problem_.problem, found.r, solve_->friction()).own;
            if (residual < least) {
                best = iterations;
                least = residual;
            }
            spent += watch.samples().wall.back();
            // Ended by itself: more would be the same.
            if (least <= target_ || spent > kSearchTime || found.iterations < iterations) break;
        }
        return best;
    }

    double target_ = 0.0;
    ExportedProblem problem_;
    std::optional<adapter::LoadedEngine> engine_;
    std::unique_ptr<adapter::ContactSolve> solve_;
};

}  // namespace

std::vector<PlannedBench> planContactSolvers(const BenchRequest& request) {
    std::vector<adapter::EngineSpec> requested;
    for (const std::string& text : request.engines) {
        const adapter::EngineSpec spec = adapter::parseSpec(text);
        if (describeEngine(spec.engine, request.binary).capabilities.contactSolvers)
            requested.push_back(spec);
    }
    if (requested.empty() && !request.engines.empty()) return {};
    const std::vector<adapter::EngineSpec> specs = contactSolverSpecs(requested, request.binary);
    std::vector<PlannedBench> all;
    for (const std::string& scene : contactScenes())
        for (const char* residual : kTargets) {
            const std::string name = scene + " to " + residual;
            const bool usual = residual == kUsualTarget;
            if (!isWanted(request, name, usual) && !isWanted(request, scene, usual)) continue;
            for (const adapter::EngineSpec& spec : specs) {
                PlannedBench planned;
                planned.part = "contact_solver";
                planned.name = name;
                planned.engine = spec.text();
                planned.operation = "solution";
                planned.parameters =
                    json{{"scene", scene}, {"residual", residual}, {"seed", request.seed}}.dump();
                planned.command = partCommand(planned, request);
                all.push_back(std::move(planned));
            }
        }
    return all;
}

std::unique_ptr<TimedWork> makeContactSolver(const PlannedBench& planned) {
    return std::make_unique<ContactSolverBench>(planned);
}

}  // namespace rigor::validation
