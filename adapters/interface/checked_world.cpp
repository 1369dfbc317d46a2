// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/checked_world.hpp"

#include <new>

#include "adapters/interface/engine_failure.hpp"
#include "adapters/interface/state_setting.hpp"
#include "scenarios/model/printable.hpp"

namespace rigor::adapter {
namespace {

using scenario::boundedText;

/// Throws the exception on that is being handled, its text bounded.
[[noreturn]] void throwBounded() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const Unsupported& error) {
        throw Unsupported(boundedText(error.what()), error.refusal(), boundedText(error.lacking()),
                          boundedText(error.documentation()));
    } catch (const BadInput& error) {
        throw BadInput(boundedText(error.what()));
    } catch (const EngineFailure& error) {
        throw EngineFailure(error.kind(), boundedText(error.what()));
    } catch (const std::logic_error& error) {
        throw std::invalid_argument(boundedText(error.what()));
    } catch (const std::exception& error) {
        throw EngineFailure(EngineFailure::Kind::Threw, boundedText(error.what()));
    }
}

[[noreturn]] void refuse(const std::string& message) {
    throw EngineFailure(EngineFailure::Kind::Answer, message);
}

/// "contact 3 names body 7, expected 0 to 1"
void checkIndex(const std::string& of, const char* what, int found, std::size_t count) {
    if (found >= 0 && static_cast<std::size_t>(found) < count) return;
    const std::string most = count == 0 ? "none" : "0 to " + std::to_string(count - 1);
    refuse(of + " names " + what + " " + std::to_string(found) + ", expected " + most);
}

/// Points of 2D contacts at z = 0: a solid of a 3D engine touches anywhere along its depth.
void flatten(std::vector<ContactPoint>& contacts) {
    for (ContactPoint& contact : contacts) contact.pointA.z = contact.pointB.z = 0.0;
}

class CheckedWorld : public World {
  protected:
    template <class Work>
    auto call(const char* name, Work work) const {
        struct Restore {
            const CheckedWorld& of;
            const char* name;
            ~Restore() { of.restoreEnvironment(name); }
        };
        const Restore restore{*this, name};
        try {
            return work();
        } catch (...) {
            throwBounded();
        }
    }

  public:
    CheckedWorld(std::unique_ptr<World> world, const Scenario& scenario, const FloatEnvironment& before,
                 std::string found)
        : world_(std::move(world)),
          materials_(scenario.materials.size()),
          planar_(scenario.dimension == 2),
          environment_(before),
          changes_(std::move(found)) {
        for (const auto& body : scenario.bodies) shapes_.push_back(body.shapes.size());
    }

    void applyForce(int body, const Vec3& force, const Vec3& torque) override {
        call("applyForce", [&] { world_->applyForce(body, force, torque); });
    }
    bool evaluatesForces() const override { return world_->evaluatesForces(); }
    bool applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) override {
        return call("applyImpulse", [&] { return world_->applyImpulse(body, impulse, angularImpulse); });
    }
    void step() override {
        call("step", [&] { world_->step(); });
    }
    void readStates(std::span<BodyState> states) const override {
        call("readStates", [&] { world_->readStates(states); });
    }
    void readContacts(std::vector<ContactPoint>& contacts) const override {
        call("readContacts", [&] { world_->readContacts(contacts); });
        if (planar_) flatten(contacts);
        for (std::size_t i = 0; i < contacts.size(); ++i) checkContact(contacts[i], i);
    }
    ContactInstant contactInstant() const override { return world_->contactInstant(); }
    ReadBack readBack() const override {
        ReadBack back = call("readBack", [&] { return world_->readBack(); });
        const std::size_t most = materials_ * materials_;
        if (back.pairs.size() > most)
            refuse("the read-back has " + std::to_string(back.pairs.size()) +
                   " pairs of materials, expected at most " + std::to_string(most));
        for (const PairReadBack& pair : back.pairs)
            for (const int material : {pair.materialA, pair.materialB})
                checkIndex("a pair of the read-back", "material", material, materials_);
        return back;
    }
    std::vector<LedgerEntry> ledger() const override;
    StepCounters counters() const override {
        StepCounters counters = call("counters", [&] { return world_->counters(); });
        if (counters.phaseSeconds.size() > kMostPhases)
            refuse("a step has " + std::to_string(counters.phaseSeconds.size()) +
                   " phases, expected at most " + std::to_string(kMostPhases));
        return counters;
    }
    Scheme scheme() const override { return world_->scheme(); }
    bool jointHolds(int joint) const override {
        return call("jointHolds", [&] { return world_->jointHolds(joint); });
    }
    bool isAsleep(int body) const override {
        return call("isAsleep", [&] { return world_->isAsleep(body); });
    }
    StagedWorld* staged() override { return world_->staged(); }
    Snapshots* snapshots() override { return world_->snapshots(); }

  protected:
    World& world() const { return *world_; }

  private:
    void restoreEnvironment(const char* name) const {
        const std::string found = environment_.restore();
        if (!found.empty() && changes_.empty()) changes_ = found + " after " + name + "()";
    }

    void checkContact(const ContactPoint& c, std::size_t index) const {
        const auto checkSide = [&](int body, int shape) {
            const std::string of = "contact " + std::to_string(index) + " of a step";
            checkIndex(of, "body", body, shapes_.size());
            checkIndex(of, "shape", shape, std::max<std::size_t>(1, shapes_[body]));
        };
        checkSide(c.bodyA, c.shapeA);
        checkSide(c.bodyB, c.shapeB);
    }

    std::unique_ptr<World> world_;
    std::size_t materials_;
    bool planar_;
    std::vector<std::size_t> shapes_;  ///< number of shapes of each body
    FloatEnvironment environment_;     ///< environment of the harness
    mutable std::string changes_;      ///< first change of it by the module
};

std::vector<LedgerEntry> CheckedWorld::ledger() const {
    std::vector<LedgerEntry> lines = call("ledger", [&] { return world_->ledger(); });
    if (lines.size() > kMostLedgerLines)
        refuse("the parity ledger has " + std::to_string(lines.size()) + " lines, expected at most " +
               std::to_string(kMostLedgerLines));
    std::size_t bytes = 0;
    for (LedgerEntry& line : lines)
        for (std::string* text : {&line.topic, &line.requested, &line.resolved, &line.reason}) {
            *text = boundedText(*text);
            bytes += text->size();
        }
    if (bytes > kMostLedgerBytes)
        refuse("the parity ledger has " + std::to_string(bytes) + " bytes, expected at most " +
               std::to_string(kMostLedgerBytes));
    if (!changes_.empty())
        lines.push_back({"floating_point_environment", "as the harness has it", changes_,
                         Realisation::Approximate,
                         "the module changes how numbers are rounded; this is undone after every call"});
    return lines;
}

class CheckedSettableWorld final : public CheckedWorld, public StateSetting {
  public:
    using CheckedWorld::CheckedWorld;
    void setStates(std::span<const BodyState> states) override {
        call("setStates", [&] { setter().setStates(states); });
    }
    const char* warmStart() const override { return setter().warmStart(); }

  private:
    StateSetting& setter() const { return dynamic_cast<StateSetting&>(world()); }
};

std::unique_ptr<World> builtWorld(const DynamicsEngine& engine, const Scenario& scenario, double dt,
                                  const Settings& settings) {
    try {
        return engine.build(scenario, dt, settings);
    } catch (...) {
        throwBounded();
    }
}

}  // namespace

std::unique_ptr<World> buildChecked(const DynamicsEngine& engine, const Scenario& scenario, double dt,
                                    const Settings& settings, const FloatEnvironment& before,
                                    const std::string& found) {
    std::string changes = found;
    std::unique_ptr<World> world;
    {
        const KeepFloatEnvironment keep;
        world = builtWorld(engine, scenario, dt, settings);
        const std::string byBuild = before.restore();
        if (changes.empty() && !byBuild.empty()) changes = byBuild + " after build()";
    }
    if (dynamic_cast<StateSetting*>(world.get()) != nullptr)
        return std::make_unique<CheckedSettableWorld>(std::move(world), scenario, before, changes);
    return std::make_unique<CheckedWorld>(std::move(world), scenario, before, changes);
}

CollisionAnswer collideChecked(const CollisionEngine& engine, const CollisionQuery& query) {
    const KeepFloatEnvironment keep;
    try {
        CollisionAnswer answer = engine.collide(query);
        if (query.dimension != 2) return answer;
        flatten(answer.contacts);
        for (auto* witness : {&answer.witnessA, &answer.witnessB})
            if (*witness) (*witness)->z = 0.0;
        return answer;
    } catch (...) {
        throwBounded();
    }
}

}  // namespace rigor::adapter
