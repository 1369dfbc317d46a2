// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/sensors.hpp"

#include <algorithm>
#include <tuple>

#include "engine/narrowphase/shape_overlap.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {
namespace {

constexpr std::size_t kSensorGrain =
    16;  ///< least number of shapes or pairs for a task: some microseconds of work

auto keyOf(ShapeId id) {
    return std::tuple(id.index, id.generation);
}
auto keyOf(const SensorOverlap& overlap) {
    return std::tuple_cat(keyOf(overlap.sensor), keyOf(overlap.shape));
}
bool before(const SensorOverlap& a, const SensorOverlap& b) {
    return keyOf(a) < keyOf(b);
}

template <class S>
void append(EventKind kind, const SensorOverlap& overlap, std::vector<Event<S>>& events) {
    Event<S>& event = events.emplace_back();
    event.kind = kind;
    event.bodyA = overlap.sensorBody;
    event.shapeA = overlap.sensor;
    event.bodyB = overlap.body;
    event.shapeB = overlap.shape;
}

/// The overlap of two shapes of which one at least is convex and no half-space.
template <class S>
bool shapesOverlap(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb) {
    const bool convexA = !isComposite<S>(a) && !std::holds_alternative<HalfSpace<S>>(a);
    return (convexA ? findOverlap<S>(a, Xa, b, Xb) : findOverlap<S>(b, Xb, a, Xa)).has_value();
}

}  // namespace

template <class S>
void Sensors<S>::findSensors(const ShapeSet<S>& shapes) {
    stale_ = false;
    any_ = false;
    isSensor_.resize(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        isSensor_[i] = shapes[i].sensor;
        any_ = any_ || shapes[i].sensor;
    }
    if (any_ && !hasBroadPhase_) {
        broadPhase_ = findAlgorithm(broadPhaseTable<S>(), "broad_phase", "wide_tree").make();
        hasBroadPhase_ = true;
    }
    if (hasBroadPhase_) broadPhase_->reset();
}

template <class S>
void Sensors<S>::find(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter,
                      const BodyArrays<S>& bodies, const Tasks& tasks) {
    found_.clear();
    if (!any_) return;
    poses_.resize(shapes.size());
    boxes_.resize(shapes.size());
    tasks.forEach(shapes.size(), kSensorGrain, [&](std::size_t i) {
        poses_[i] = compose<S>(bodies.pose[shapes[i].body], shapes[i].local);
        boxes_[i] = boundingBox<S>(shapes[i].shape, poses_[i]);
    });
    broadPhase_->update(boxes_, isSensor_, pairs_, tasks);
    overlap_.resize(pairs_.size());
    tasks.forEach(pairs_.size(), kSensorGrain, [&](std::size_t k) {
        const std::uint32_t a = pairs_[k].a, b = pairs_[k].b;
        const bool finds =
            filter.mayFind(bodies, shapes[a], shapes[b]) || filter.mayFind(bodies, shapes[b], shapes[a]);
        overlap_[k] = finds && shapesOverlap<S>(shapes[a].shape, poses_[a], shapes[b].shape, poses_[b]);
    });
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        if (!overlap_[k]) continue;
        const ShapeRecord<S>&a = shapes[pairs_[k].a], &b = shapes[pairs_[k].b];
        const ShapeRecord<S>&sensor = a.sensor ? a : b, &other = a.sensor ? b : a;
        found_.push_back({bodies.id[sensor.body], sensor.id, bodies.id[other.body], other.id});
    }
    std::sort(found_.begin(), found_.end(), before);
}

template <class S>
void Sensors<S>::update(const ShapeSet<S>& shapes, const CollisionFilter<S>& filter,
                        const BodyArrays<S>& bodies, std::vector<Event<S>>& events, const Tasks& tasks) {
    if (stale_) findSensors(shapes);
    if (!any_ && overlaps_.empty()) return;
    find(shapes, filter, bodies, tasks);
    auto old = overlaps_.begin();
    for (const SensorOverlap& now : found_) {
        for (; old != overlaps_.end() && before(*old, now); ++old)
            append(EventKind::SensorEnds, *old, events);
        if (old != overlaps_.end() && !before(now, *old))
            ++old;
        else
            append(EventKind::SensorBegins, now, events);
    }
    for (; old != overlaps_.end(); ++old) append(EventKind::SensorEnds, *old, events);
    std::swap(overlaps_, found_);
}

template <class S>
std::span<const SensorOverlap> Sensors<S>::overlapsOf(ShapeId sensor) const {
    const auto first = std::partition_point(overlaps_.begin(), overlaps_.end(), [&](const SensorOverlap& o) {
        return keyOf(o.sensor) < keyOf(sensor);
    });
    const auto last =
        std::find_if(first, overlaps_.end(), [&](const SensorOverlap& o) { return !(o.sensor == sensor); });
    return {first, last};
}

RIGOR_INSTANTIATE_CLASS(Sensors)

}  // namespace rigor::engine
