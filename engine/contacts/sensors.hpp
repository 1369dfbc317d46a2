// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sensors: shapes that report what overlaps them and push nothing. What is in a sensor is found at the end of each
// step, where the bodies are then, awake or asleep:
//
//     boxes of all shapes -> broad phase, pairs with a sensor -> filter -> overlap of the two shapes
//
// A sensor finds shapes of other bodies that are no sensors and that its filter lets it collide with; dynamic,
// kinematic and, unless it is static itself, static ones. Overlaps are sorted by sensor, then by shape.
//
// Cost, in a world with sensors alone: O(shapes) per step, and an exact test for each pair of boxes. Limit: a shape
// that passes through a sensor within one step is not found.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/contacts/collision_filter.hpp"
#include "engine/contacts/contact_events.hpp"
#include "engine/contacts/shape_set.hpp"
#include "engine/core/clone_ptr.hpp"

namespace rigor::engine {

/// A shape that overlaps or touches a sensor.
struct SensorOverlap {
    BodyId sensorBody;
    ShapeId sensor;
    BodyId body;
    ShapeId shape;
};

template <class S>
class Sensors {
  public:
    /// Finds what is in the sensors now, and appends an event for each overlap that has begun or ended, in their order.
    void update(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter, const BodyArrays<S>& bodies,
                std::vector<Event<S>>& events, const Tasks& tasks);
    /// Must be called after shapes were added or removed.
    void shapesChanged() { stale_ = true; }

    /// Overlaps of all sensors at the end of the last step.
    const std::vector<SensorOverlap>& overlaps() const { return overlaps_; }
    std::vector<SensorOverlap>& overlaps() { return overlaps_; }
    std::span<const SensorOverlap> overlapsOf(ShapeId sensor) const;

  private:
    void findSensors(const ShapeSet<S>& shapes);
    void find(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter, const BodyArrays<S>& bodies,
              const Tasks& tasks);

    std::vector<SensorOverlap> overlaps_;
    bool stale_ = true;  ///< shapes have changed since the last update
    bool any_ = false;   ///< there are sensors
    // --- scratch
    ClonePtr<BroadPhase<S>> broadPhase_;  ///< null until there is a sensor
    bool hasBroadPhase_ = false;
    std::vector<std::uint8_t> isSensor_, overlap_;
    std::vector<Pose<S>> poses_;
    std::vector<Aabb<S>> boxes_;
    std::vector<ProxyPair> pairs_;
    std::vector<SensorOverlap> found_;
};

}  // namespace rigor::engine
