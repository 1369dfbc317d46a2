// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Narrow phases by themselves: a thousand pairs of one kind, queried one after the other, each as at its
// first contact. Shapes are built and poses converted before (adapter::CollisionBatch), contacts stay in the
// engine's own form. The cost of the batch itself is that of the engine "interface", which reads the poses
// and returns no contacts. The depths are those of the exact oracle or the timing does not count.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "adapters/interface/timed.hpp"
#include "validation/bench/parts/engines.hpp"
#include "validation/bench/parts/posed_pairs.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

constexpr std::size_t kPairs = 1000;
/// Number of pairs that the oracle judges in every repetition; in round 0 it judges all pairs.
constexpr std::size_t kJudged = 100;
/// Bounds of a timing that counts: of the depth, two percent of the 0.05 m that overlapping pairs are moved
/// in by; wrong results, one pair in a hundred.
constexpr double kMeanDepthError = 1e-3, kWrongShare = 0.01;
/// Overlaps below this may be missed by single precision without being wrong [m].
constexpr double kNoDepth = 1e-4;

class Baseline final : public adapter::CollisionBatch {
  public:
    explicit Baseline(std::span<const adapter::CollisionQuery> queries) {
        for (const auto& query : queries) pairs_.push_back({query.a.pose, query.b.pose});
    }
    std::size_t run() override {
        std::size_t apart = 0;
        for (const auto& pair : pairs_) apart += query_(pair);
        return apart;
    }
    std::vector<adapter::ContactPoint> contacts(std::size_t) override { return {}; }

  private:
    struct Poses {
        scenario::Pose a, b;
    };
    static std::size_t far(const Poses& poses) { return poses.b.position.x - poses.a.position.x > 1e9; }
    std::vector<Poses> pairs_;
    std::size_t (*volatile query_)(const Poses&) = far;  ///< not inlined, like any engine's function
};

struct Judgement {
    double meanError = 0.0, largestError = 0.0, wrongShare = 0.0;
};
Judgement judgeDepths(adapter::CollisionBatch& batch, const std::vector<double>& depths) {
    Judgement judgement;
    std::size_t compared = 0, wrong = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        std::optional<double> depth;
        for (const adapter::ContactPoint& c : batch.contacts(i))
            depth = std::max(depth.value_or(c.depth), c.depth);
        const bool found = depth && *depth > 0.0;
        if ((found && depths[i] < -kNoDepth) || (!found && depths[i] > kNoDepth)) ++wrong;
        if (!found || depths[i] <= 0.0) continue;
        const double error = std::abs(*depth - depths[i]);
        judgement.largestError = std::max(judgement.largestError, error);
        judgement.meanError += error;
        ++compared;
    }
    if (compared > 0) judgement.meanError /= compared;
    judgement.wrongShare =
        static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(1, depths.size()));
    return judgement;
}

class NarrowPhaseBench final : public TimedWork {
  public:
    explicit NarrowPhaseBench(const PlannedBench& planned) {
        const json parameters = json::parse(planned.parameters);
        for (const PairKind& kind : pairKinds())
            if (kind.name() == parameters.at("kind")) kind_ = kind;
        seed_ = parameters.at("seed");
        isBaseline_ = planned.engine == kInterface;
        if (isBaseline_) return;
        const adapter::EngineSpec spec = adapter::parseSpec(planned.engine);
        engine_.emplace(adapter::loadEngine(spec));
        settings_ = adapter::resolveSettings(spec, **engine_);
        timed_ = dynamic_cast<const adapter::TimedCollisionEngine*>((*engine_)->collision());
        if (timed_ == nullptr)
            throw adapter::Unsupported(spec.engine + " has no narrow phase that can be timed by itself");
    }

    results::BenchRepetition run(int round) override {
        PosedPairs pairs = makePosedPairs(kind_, kPairs, round == 0 ? kPairs : kJudged, seed_);
        const auto batch = makeBatch(pairs);
        std::size_t contacts = batch->run();
        constexpr std::size_t least = 5, most = 500;
        CountingStopwatch watch(most);
        double spent = 0.0;
        while (watch.samples().cpu.size() < least || (spent < 0.05 && watch.samples().cpu.size() < most)) {
            watch.time([&] { contacts = batch->run(); }, static_cast<double>(kPairs));
            spent += watch.samples().cpu.back() * static_cast<double>(kPairs);
        }
        results::BenchRepetition done;
        fillTimes(watch, false, done);
        done.counts = {{"pairs", static_cast<double>(kPairs)},
                       {"contacts_per_pair", static_cast<double>(contacts) / static_cast<double>(kPairs)}};
        if (isBaseline_) return done;
        const Judgement judgement = judgeDepths(*batch, pairs.depths);
        done.quality = {judged("mean_depth_error", "m", judgement.meanError, kMeanDepthError),
                        judged("largest_depth_error", "m", judgement.largestError, std::nullopt),
                        judged("wrong_answers", "1", judgement.wrongShare, kWrongShare)};
        return done;
    }

  private:
    std::unique_ptr<adapter::CollisionBatch> makeBatch(PosedPairs& pairs) const {
        if (isBaseline_) return std::make_unique<Baseline>(pairs.queries);
        const auto algorithm = settings_.find("narrow_phase");
        for (adapter::CollisionQuery& query : pairs.queries) {
            query.settings = &settings_;
            if (algorithm != settings_.end() && !timed_->algorithms().empty())
                query.algorithm = algorithm->second;
        }
        return timed_->batch(pairs.queries);
    }

    PairKind kind_;
    std::uint64_t seed_ = 1;
    bool isBaseline_ = false;
    std::optional<adapter::LoadedEngine> engine_;
    adapter::Settings settings_;
    const adapter::TimedCollisionEngine* timed_ = nullptr;
};

/// The engines whose own dimension it is: shapes lifted into space would be timed as something else.
bool takesPart(const PartEngine& engine, int dimension) {
    const adapter::Capabilities& c = engine.description.capabilities;
    return c.collision &&
           std::find(c.dimensions.begin(), c.dimensions.end(), dimension) != c.dimensions.end();
}

}  // namespace

std::vector<PlannedBench> planNarrowPhases(const BenchRequest& request) {
    std::vector<PlannedBench> all;
    std::vector<PartEngine> engines = partEngines(request);
    for (PartEngine& engine : engines)  // margins around and inside shapes are settings
        if (!request.preset.empty()) engine.spec.options.emplace("preset", request.preset);
    for (const PairKind& kind : pairKinds()) {
        if (!isWanted(request, kind.name(), kind.closeness != Closeness::Apart)) continue;
        std::vector<std::string> names;
        for (const PartEngine& engine : engines)
            if (takesPart(engine, kind.dimension)) names.push_back(engine.spec.text());
        if (names.empty()) continue;
        names.push_back(kInterface);  // last: ratios are to the first
        for (const std::string& engine : names) {
            PlannedBench planned;
            planned.part = "narrow_phase";
            planned.name = kind.name();
            planned.engine = engine;
            planned.operation = "pair";
            planned.parameters = json{{"kind", kind.name()}, {"seed", request.seed}}.dump();
            planned.command = partCommand(planned, request);
            all.push_back(std::move(planned));
        }
    }
    return all;
}

std::unique_ptr<TimedWork> makeNarrowPhase(const PlannedBench& planned) {
    return std::make_unique<NarrowPhaseBench>(planned);
}

}  // namespace rigor::validation
