// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An engine whose broad phase and narrow phase can be timed by themselves, and are right or wrong by choice:
//   broad_phase   brute_force; forgetful: the last pair is missing; generous: all pairs
//   narrow_phase  balls, in closed form; deep: a centimetre too deep; blind: no contacts; excited: contacts
//                 where there are none
#include <algorithm>
#include <stdexcept>

#include "adapters/interface/options.hpp"
#include "adapters/interface/timed.hpp"
#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {

class CarelessBoxes final : public TimedBroadPhase {
  public:
    explicit CarelessBoxes(std::string how) : how_(std::move(how)) {}
    void take(std::span<const Aabb> boxes) override { boxes_.assign(boxes.begin(), boxes.end()); }
    void run() override {
        found_.clear();
        for (int a = 0; a < static_cast<int>(boxes_.size()); ++a)
            for (int b = a + 1; b < static_cast<int>(boxes_.size()); ++b)
                if (how_ == "generous" || overlap(boxes_[a], boxes_[b])) found_.push_back({a, b});
        if (how_ == "forgetful" && !found_.empty()) found_.pop_back();
    }
    void held(std::vector<Pair>& pairs) override { pairs = found_; }

  private:
    std::string how_;
    std::vector<Aabb> boxes_;
    std::vector<Pair> found_;
};

class CarelessBroadPhase final : public TimedBroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"brute_force", "forgetful", "generous"}; }
    std::string option() const override { return "broad_phase"; }
    std::unique_ptr<TimedBroadPhase> createTimed(const std::string& algorithm, int,
                                                 const Settings*) const override {
        return std::make_unique<CarelessBoxes>(algorithm);
    }
};

class CarelessBatch final : public CollisionBatch {
  public:
    explicit CarelessBatch(std::span<const CollisionQuery> queries)
        : queries_(queries.begin(), queries.end()) {}
    std::size_t run() override {
        std::size_t all = 0;
        for (std::size_t i = 0; i < queries_.size(); ++i) all += contacts(i).size();
        return all;
    }
    std::vector<ContactPoint> contacts(std::size_t i) override {
        const std::string& how = queries_[i].algorithm;
        auto found = balls_.collide(queries_[i]).contacts;
        if (how == "blind") found.clear();
        if (how == "excited") {
            found.resize(1);
            found[0].depth = 0.01;
        }
        if (how == "deep")
            for (ContactPoint& c : found) c.depth += 0.01;
        return found;
    }

  private:
    BallCollisions balls_;
    std::vector<CollisionQuery> queries_;
};

class CarelessCollisions final : public TimedCollisionEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"balls", "blind", "deep", "excited"}; }
    CollisionAnswer collide(const CollisionQuery& query) const override { return balls_.collide(query); }
    std::unique_ptr<CollisionBatch> batch(std::span<const CollisionQuery> queries) const override {
        return std::make_unique<CarelessBatch>(queries);
    }

  private:
    BallCollisions balls_;
};

class Careless final : public Engine {
  public:
    EngineInfo info() const override { return doubleInfo(); }
    Capabilities capabilities() const override {
        Capabilities c = doubleCapabilities();
        c.broadPhase = c.collision = true;
        return c;
    }
    std::vector<Option> options() const override {
        return {
            choice("broad_phase", broadPhase_.algorithms(), "brute_force", "brute_force", "right or wrong"),
            choice("narrow_phase", collisions_.algorithms(), "balls", "balls", "right or wrong")};
    }
    const BroadPhaseEngine* broadPhase() const override { return &broadPhase_; }
    const CollisionEngine* collision() const override { return &collisions_; }

  private:
    CarelessBroadPhase broadPhase_;
    CarelessCollisions collisions_;
};

std::unique_ptr<Engine> makeCareless() {
    return std::make_unique<Careless>();
}

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeCareless)
