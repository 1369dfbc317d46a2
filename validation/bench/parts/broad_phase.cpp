// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Broad phases by themselves: every box moves, all pairs are wanted. Timed is BroadPhase::run: the engine is
// told of each moved box, in its own numbers, and finds its pairs, which it leaves in its own form: a list
// (in-house), a cache of pairs (Bullet), what its callback was told (ODE, FCL; new pairs alone for Box2D, as
// its world has it). Not timed, for anybody: moving the boxes, turning them into the engine's numbers,
// putting pairs in order, tests against the exact boxes. Times are means over the updates: trees of enlarged
// boxes do their work in bursts.
#include <cmath>
#include <nlohmann/json.hpp>

#include "adapters/interface/timed.hpp"
#include "validation/bench/parts/engines.hpp"
#include "validation/bench/parts/moving_boxes.hpp"

namespace rigor::validation {
namespace {

using adapter::Pair;
using nlohmann::json;

constexpr int kWarmUp = 5;
/// One update that would take longer than this is not begun [s].
constexpr double kLongest = 10.0;

class BroadPhaseBench final : public BenchCase {
  public:
    explicit BroadPhaseBench(const PlannedBench& planned)
        : spec_(adapter::parseSpec(planned.engine)),
          engine_(adapter::loadEngine(spec_)),
          settings_(adapter::resolveSettings(spec_, *engine_)),
          count_(static_cast<std::size_t>(std::llround(planned.size))) {
        timed_ = dynamic_cast<const adapter::TimedBroadPhaseEngine*>(engine_->broadPhase());
        if (timed_ == nullptr)
            throw adapter::Unsupported(spec_.engine + " has no broad phase that can be timed by itself");
        const json parameters = json::parse(planned.parameters);
        dimension_ = parameters.at("dimension"), seed_ = parameters.at("seed");
        order_ = parameters.at("order") == "spatial" ? BoxOrder::Spatial : BoxOrder::Random;
        const std::string key = timed_->option();
        algorithm_ = key.empty() ? timed_->algorithms().front() : settings_.at(key);
    }

    results::BenchRepetition run(int round) override {
        refuseEndless();
        MovingBoxes scene(dimension_, count_, order_, seed_);
        const auto phase = create();
        std::vector<Pair> held;
        for (int k = 0; k < kWarmUp; ++k, scene.advance()) phase->take(scene.boxes()), phase->run();
        phase->held(held);
        const int updates = count_ < 5000 ? 100 : count_ < 50000 ? 30 : 10;
        Stopwatch watch;
        watch.reserve(static_cast<std::size_t>(updates));
        PairCheck sum;
        int checks = 0;
        for (int k = 0; k < updates; ++k) {
            scene.advance();
            phase->take(scene.boxes());
            watch.time([&] { phase->run(); });
            // Pairs are kept from update to update: one that is missed for a moment may be there at the end.
            if (k + 1 < updates && (round > 0 || count_ > 20000)) continue;
            phase->held(held);
            const PairCheck check = checkPairs(scene.boxes(), held);
            sum.exact += check.exact, sum.held += check.held, sum.missed += check.missed;
            ++checks;
        }
        results::BenchRepetition done;
        fillTimes(watch.samples(), true, done);
        const auto per = [&](std::size_t total) {
            return static_cast<double>(total) / static_cast<double>(checks);
        };
        done.counts = {
            {"boxes", static_cast<double>(count_)}, {"pairs", per(sum.exact)}, {"pairs_held", per(sum.held)}};
        done.quality = {judged("missed_pairs", "1", per(sum.missed), 0.0),
                        judged("excess_pairs", "1", per(sum.excess()), std::nullopt)};
        return done;
    }

  private:
    std::unique_ptr<adapter::TimedBroadPhase> create() const {
        return timed_->createTimed(algorithm_, dimension_, &settings_);
    }
    /// Building and first update of fewer boxes [s].
    double trial(std::size_t boxes) const {
        const MovingBoxes scene(dimension_, boxes, order_, seed_);
        const auto phase = create();
        Stopwatch watch;
        watch.time([&] { phase->take(scene.boxes()), phase->run(); });
        return watch.samples().cpu.front();
    }
    /// From the growth between two smaller numbers of boxes. Throws Unsupported.
    void refuseEndless() const {
        if (count_ < 5000) return;
        const double small = trial(count_ / 20), larger = trial(count_ / 10);
        const double power = std::clamp(std::log2(larger / std::max(small, 1e-9)), 1.0, 3.0);
        const double expected = larger * std::pow(10.0, power);
        if (expected > kLongest)
            throw adapter::Unsupported(algorithm_ + ": about " + std::to_string(std::lround(expected)) +
                                       " s until the first pairs of " + std::to_string(count_) +
                                       " boxes are found, too long to be timed");
    }

    adapter::EngineSpec spec_;
    adapter::LoadedEngine engine_;
    adapter::Settings settings_;
    const adapter::TimedBroadPhaseEngine* timed_ = nullptr;
    std::size_t count_;
    int dimension_ = 3;
    std::uint64_t seed_ = 1;
    BoxOrder order_ = BoxOrder::Random;
    std::string algorithm_;
};

}  // namespace

std::vector<PlannedBench> planBroadPhases(const BenchRequest& request) {
    std::vector<PlannedBench> all;
    const std::vector<PartEngine> engines = partEngines(request);
    const std::vector<double> sizes =
        request.sizes.empty() ? std::vector<double>{1e3, 1e4, 1e5} : request.sizes;
    for (const int dimension : {3, 2})
        for (const char* order : {"random", "spatial"})
            for (const double size : sizes)
                for (const PartEngine& engine : engines) {
                    const adapter::Capabilities& c = engine.description.capabilities;
                    const bool native =
                        std::find(c.dimensions.begin(), c.dimensions.end(), dimension) != c.dimensions.end();
                    const std::string name = std::to_string(dimension) + "D, " + order + " order";
                    if (!c.broadPhase || !(native || (dimension == 2 && c.planar)) ||
                        !isWanted(request, name))
                        continue;
                    for (const adapter::EngineSpec& spec :
                         everyChoice(engine, broadPhaseOption(engine.spec))) {
                        PlannedBench planned;
                        planned.part = "broad_phase", planned.name = name, planned.engine = spec.text();
                        planned.sizeUnit = "boxes", planned.size = size, planned.operation = "update";
                        planned.parameters =
                            json{{"dimension", dimension}, {"order", order}, {"seed", request.seed}}.dump();
                        planned.command = partCommand(planned, true);
                        all.push_back(std::move(planned));
                    }
                }
    return all;
}

std::unique_ptr<BenchCase> makeBroadPhase(const PlannedBench& planned) {
    return std::make_unique<BroadPhaseBench>(planned);
}

}  // namespace rigor::validation
