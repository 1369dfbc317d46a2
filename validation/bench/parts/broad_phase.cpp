// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Broad phases by themselves: every box moves, all pairs are to be found. Timed is BroadPhase::run: each
// moved box is passed to the engine in its own numbers, and the engine finds its pairs and leaves them in its
// own form: a list (in-house), a cache of pairs (Bullet), the calls of its callback (ODE, FCL; new pairs
// alone for Box2D, as its world has it). The following is not timed, for any engine: moving the boxes,
// turning them into the engine's numbers, putting pairs in order, tests against the exact boxes. Times are
// means over the updates: trees of fat AABBs do their work in bursts.
#include <cmath>
#include <nlohmann/json.hpp>

#include "adapters/interface/timed.hpp"
#include "validation/bench/parts/engines.hpp"
#include "validation/bench/parts/moving_boxes.hpp"

namespace rigor::validation {
namespace {

using adapter::Pair;
using nlohmann::json;

/// Updates before the clock, and with it at least.
constexpr int kWarmUp = 5;
constexpr std::size_t kLeast = 3;
/// Time of updates after which no further one is begun [s].
constexpr double kTimeLimit = 0.3;
/// Time after which not even one of the minimum number is begun [s]: more rounds, from which intervals are
/// computed, are worth more.
constexpr double kEnough = 1.0;
constexpr const char *kRandom = "random", *kSpatial = "spatial";
/// A case whose first two updates would take longer than this is not begun [s].
constexpr double kLongest = 2.0;

class BroadPhaseBench final : public TimedWork {
  public:
    explicit BroadPhaseBench(const PlannedBench& planned)
        : spec_(adapter::parseSpec(planned.engine)),
          engine_(adapter::loadEngine(spec_)),
          settings_(adapter::resolveSettings(spec_, *engine_)),
          count_(std::llround(planned.size)) {
        timed_ = dynamic_cast<const adapter::TimedBroadPhaseEngine*>(engine_->broadPhase());
        if (timed_ == nullptr)
            throw adapter::Unsupported(spec_.engine + " has no broad phase that can be timed by itself");
        const json parameters = json::parse(planned.parameters);
        dimension_ = parameters.at("dimension");
        seed_ = parameters.at("seed");
        order_ = parameters.at("order") == kSpatial ? BoxOrder::Spatial : BoxOrder::Random;
        const std::string key = timed_->option();
        algorithm_ = key.empty() ? timed_->algorithms().front() : settings_.at(key);
    }

    results::BenchRepetition run(int round) override {
        if (round == 0) refuseEndless();
        MovingBoxes scene(dimension_, count_, order_, seed_);
        const GrownMemory memory;
        const auto phase = create();
        warmUp(*phase, scene);

        const std::size_t most = count_ < 5000 ? 100 : count_ < 50000 ? 30 : 10;
        const bool checkAll = round == 0 && count_ <= 20000;
        CountingStopwatch watch(most);
        Checks checks;
        for (double spent = 0.0; !isEnough(watch.samples().cpu.size(), most, spent);) {
            scene.advance();
            phase->take(scene.boxes());
            watch.time([&] { phase->run(); });
            spent += watch.samples().cpu.back();
            if (checkAll) checks.add(*phase, scene);
        }
        results::BenchRepetition done;
        memory.write(done);
        // Pairs are kept from update to update: one that is missed for a moment may be there at the end.
        if (!checkAll) checks.add(*phase, scene);
        fillTimes(watch, true, done);
        done.counts = {{"boxes", static_cast<double>(count_)},
                       {"pairs", checks.mean(checks.sum.exact)},
                       {"pairs_held", checks.mean(checks.sum.held)}};
        done.quality = {judged("missed_pairs", "1", checks.mean(checks.sum.missed), 0.0),
                        judged("excess_pairs", "1", checks.mean(checks.sum.excess()), std::nullopt)};
        return done;
    }

  private:
    /// Comparison of the engine's pairs with the current boxes, once or after every update.
    struct Checks {
        PairCheck sum;
        int count = 0;
        void add(adapter::TimedBroadPhase& phase, const MovingBoxes& scene) {
            std::vector<Pair> held;
            phase.held(held);
            const PairCheck check = checkPairs(scene.boxes(), std::move(held));
            sum.exact += check.exact;
            sum.held += check.held;
            sum.missed += check.missed;
            ++count;
        }
        double mean(std::size_t total) const { return static_cast<double>(total) / count; }
    };
    static bool isEnough(std::size_t updates, std::size_t most, double spent) {
        return updates >= most || spent > kEnough || (updates >= kLeast && spent > kTimeLimit);
    }
    static void warmUp(adapter::TimedBroadPhase& phase, MovingBoxes& scene) {
        Stopwatch watch;
        double spent = 0.0;
        for (int k = 0; k < kWarmUp && spent <= kTimeLimit; ++k, scene.advance()) {
            phase.take(scene.boxes());
            watch.time([&] { phase.run(); });
            spent += watch.samples().cpu.back();
        }
    }
    std::unique_ptr<adapter::TimedBroadPhase> create() const {
        return timed_->createTimed(algorithm_, dimension_, &settings_);
    }
    /// Building, first update and one of moved boxes, of fewer of them [s].
    double trial(std::size_t boxes) const {
        MovingBoxes scene(dimension_, boxes, order_, seed_);
        const auto phase = create();
        Stopwatch watch;
        watch.time([&] {
            phase->take(scene.boxes());
            phase->run();
            scene.advance();
            phase->take(scene.boxes());
            phase->run();
        });
        return watch.samples().cpu.front();
    }
    /// Predicts the time from the growth between two smaller numbers of boxes. Throws Unsupported if it is
    /// too long.
    void refuseEndless() const {
        if (count_ < 5000) return;
        const double small = trial(count_ / 20), larger = trial(count_ / 10);
        const double power = std::clamp(std::log2(larger / std::max(small, 1e-9)), 1.0, 3.0);
        const double expected = larger * std::pow(10.0, power);
        if (expected > kLongest)
            throw adapter::Unsupported(algorithm_ + ": about " + std::to_string(std::lround(expected)) +
                                       " s for the first two updates of " + std::to_string(count_) +
                                       " boxes, too long to be timed");
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

struct Choices {
    adapter::Capabilities capabilities;
    std::vector<adapter::EngineSpec> specs;
};
std::vector<Choices> choicesOf(const std::vector<PartEngine>& engines) {
    std::vector<Choices> all;
    for (const PartEngine& engine : engines)
        if (engine.description.capabilities.broadPhase)
            all.push_back(
                {engine.description.capabilities, everyChoice(engine, broadPhaseOption(engine.spec))});
    return all;
}
bool couldRun(const adapter::Capabilities& c, int dimension) {
    return std::find(c.dimensions.begin(), c.dimensions.end(), dimension) != c.dimensions.end() ||
           (dimension == 2 && c.planar);
}
/// Numbers of boxes; the effect of their order in memory shows for large numbers.
std::vector<double> sizesOf(const BenchRequest& request, const std::string& order) {
    if (!request.sizes.empty()) return request.sizes;
    if (order == kSpatial) return {1e5};
    return request.full ? std::vector<double>{1e3, 1e4, 1e5} : std::vector<double>{1e4};
}

}  // namespace

std::vector<PlannedBench> planBroadPhases(const BenchRequest& request) {
    std::vector<PlannedBench> all;
    const std::vector<Choices> engines = choicesOf(partEngines(request));
    for (const int dimension : {3, 2})
        for (const char* order : {kRandom, kSpatial}) {
            const std::string name = std::to_string(dimension) + "D, " + order + " order";
            if (!isWanted(request, name, order == kRandom)) continue;
            for (const double size : sizesOf(request, order))
                for (const Choices& engine : engines) {
                    if (!couldRun(engine.capabilities, dimension)) continue;
                    for (const adapter::EngineSpec& spec : engine.specs) {
                        PlannedBench planned;
                        planned.part = "broad_phase";
                        planned.name = name;
                        planned.engine = spec.text();
                        planned.sizeUnit = "boxes";
                        planned.size = size;
                        planned.operation = "update";
                        planned.parameters =
                            json{{"dimension", dimension}, {"order", order}, {"seed", request.seed}}.dump();
                        planned.command = partCommand(planned, request);
                        all.push_back(std::move(planned));
                    }
                }
        }
    return all;
}

std::unique_ptr<TimedWork> makeBroadPhase(const PlannedBench& planned) {
    return std::make_unique<BroadPhaseBench>(planned);
}

}  // namespace rigor::validation
