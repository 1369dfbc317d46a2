// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The remote engine: whatever guest a manifest names, as an engine like any other.
#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

#include "adapters/guest/description.hpp"
#include "adapters/guest/scenario_json.hpp"
#include "adapters/guest/world.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/joint_springs.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/replay.hpp"

namespace rigor::guest {
namespace {

using namespace adapter;

class GuestEngine final : public EngineWithPresets, public DynamicsEngine, public CollisionEngine {
  public:
    explicit GuestEngine(const GuestManifest& manifest)
        : connection_(std::make_shared<Connection>(manifest)),
          description_(sayHello(*connection_)),
          worlds_(connection_->worldsBefore()) {}

    EngineInfo info() const override { return description_.info; }
    Capabilities capabilities() const override { return description_.capabilities; }
    std::vector<Option> options() const override { return description_.options; }
    std::vector<Preset> presets() const override { return description_.presets; }
    const DynamicsEngine* dynamics() const override {
        return description_.capabilities.dynamics ? this : nullptr;
    }
    const CollisionEngine* collision() const override {
        return description_.capabilities.collision ? this : nullptr;
    }

    std::unique_ptr<World> build(const Scenario& scenario, double dt,
                                 const Settings& settings) const override {
        checkScenarioInput(scenario, dt);
        checkSupported(scenario, description_.capabilities, description_.info.name);
        auto world = buildOnce(scenario, dt, settings);
        if (world->snapshots() != nullptr || dynamic_cast<StateSetting*>(world.get()) == nullptr)
            return world;
        // Snapshots by replay begin with the world that is there already.
        const auto first = std::make_shared<std::unique_ptr<World>>(std::move(world));
        return std::make_unique<ReplayWorld>([this, first, scenario, dt, settings] {
            return *first ? std::exchange(*first, nullptr) : buildOnce(scenario, dt, settings);
        });
    }

    CollisionAnswer collide(const CollisionQuery& query) const override {
        checkQueryInput(query);
        requireDimension(query.dimension);
        for (const PosedShape* side : {&query.a, &query.b}) requireShape(*side, query.dimension);
        Frame frame;
        frame.header["dimension"] = query.dimension;
        frame.header["max_contacts"] = query.maxContacts;
        frame.header["a"] = posedJson(query.a, query.dimension);
        frame.header["b"] = posedJson(query.b, query.dimension);
        const Frame answer = connection_->call("collide", std::move(frame));
        return connection_->take("collide", [&] { return answerOf(answer); });
    }

  private:
    std::unique_ptr<World> buildOnce(const Scenario& scenario, double dt, const Settings& settings) const {
        const bool planar = !hasDimension(scenario.dimension);
        const Scenario sent = withStiffness(scenario);
        Frame request;
        request.header["dt"] = dt;
        request.header["settings"] = settings;
        request.header["scenario"] = scenarioJson(planar ? planarLift(sent) : sent, planar);
        return buildWorld(connection_, ++worlds_, scenario, std::move(request));
    }

    bool hasDimension(int dimension) const {
        const auto& dimensions = description_.capabilities.dimensions;
        return std::find(dimensions.begin(), dimensions.end(), dimension) != dimensions.end();
    }

    /// A planar engine takes shapes of 2D as they are.
    void requireDimension(int dimension) const {
        const auto& [name, lacks] = std::tie(description_.info.name, description_.capabilities.libraryLacks);
        if (hasDimension(dimension) || (dimension == 2 && description_.capabilities.planar)) return;
        const std::string key = std::to_string(dimension) + "D", what = "shapes in " + key;
        const auto documented = lacks.find(key);
        if (documented == lacks.end()) throw notInAdapter(name, what);
        throw notInLibrary(name, what, documented->second);
    }

    void requireShape(const PosedShape& side, int dimension) const {
        const std::string name = geometryName(*side.geometry, dimension);
        const auto& shapes = description_.capabilities.shapes;
        if (std::find(shapes.begin(), shapes.end(), name) == shapes.end())
            throw notInAdapter(description_.info.name, "shape '" + name + "'");
    }

    static Json posedJson(const PosedShape& side, int dimension) {
        Json json = geometryJson(*side.geometry, dimension);
        json["position"] = toJson(side.pose.position);
        json["orientation"] = toJson(side.pose.orientation);
        return json;
    }

    static CollisionAnswer answerOf(const Frame& answer) {
        CollisionAnswer found;
        found.overlap = answer.header.at("overlap").get<bool>();
        found.contacts = contactsOf(answer.table("contacts", kContactColumns), 2);
        if (const auto distance = answer.header.find("signed_distance"); distance != answer.header.end()) {
            found.signedDistance = distance->get<double>();
            const Table witnesses = answer.table("witnesses", 3);
            if (witnesses.rows != 2) throw BadFrame("expected two witness points");
            found.witnessA = Vec3{witnesses(0, 0), witnesses(0, 1), witnesses(0, 2)};
            found.witnessB = Vec3{witnesses(1, 0), witnesses(1, 1), witnesses(1, 2)};
        }
        return found;
    }

    std::shared_ptr<Connection> connection_;
    Description description_;
    mutable std::atomic<std::int64_t> worlds_;  ///< number of the last world
};

std::unique_ptr<Engine> openGuest(const GuestManifest& manifest) {
    return std::make_unique<GuestEngine>(manifest);
}

}  // namespace
}  // namespace rigor::guest

extern "C" __attribute__((visibility("default"))) const rigor::adapter::GuestHost* rigorGuestHost() {
    static const rigor::adapter::GuestHost host{rigor::adapter::kAdapterAbi, rigor::guest::openGuest};
    return &host;
}
