// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// TypedWorld: rays, moved shapes, overlaps, the nearest shape. Part of typed_world.cpp.
#pragma once

#include "engine/python/typed_world.hpp"
#include "engine/python/world_reading-inl.hpp"

namespace rigor::engine::python {

template <class S>
WorldQueries<S>& TypedWorld<S>::queries() {
    if (!queries_)
        queries_.emplace(world_);
    else if (queriesStale_)
        queries_->update();
    queriesStale_ = false;
    return *queries_;
}

/// The row of a hit with a fraction, on a way of the given translation; without one its distance is its own.
template <class S>
template <class Found>
typename TypedWorld<S>::Hit TypedWorld<S>::hitOf(const Found& found, const typename S::Vec& way) const {
    Hit hit{};
    hit.body = number(found.body);
    hit.shape = number(found.shape);
    hit.piece = found.piece == 0xffffffffu ? -1 : static_cast<std::int32_t>(found.piece);
    if constexpr (requires { found.fraction; }) {
        hit.fraction = static_cast<double>(found.fraction);
        hit.distance = hit.fraction * static_cast<double>(way.norm());
    }
    if constexpr (requires { found.distance; }) hit.distance = static_cast<double>(found.distance);
    if constexpr (requires { found.onShape; })
        copyVec(found.onShape, hit.point);
    else if constexpr (requires { found.point; })
        copyVec(found.point, hit.point);
    if constexpr (requires { found.normal; }) copyVec(found.normal, hit.normal);
    if constexpr (requires { found.startsInside; }) hit.inside = found.startsInside;
    if constexpr (requires { found.startsTouching; }) hit.inside = found.startsTouching;
    if constexpr (requires { found.onShape; }) hit.inside = found.distance < 0;
    return hit;
}

template <class Hit>
py::object oneRow(const Hit& hit) {
    py::array_t<Hit> rows(1);
    rows.mutable_data()[0] = hit;
    return rows[py::int_(0)];
}

template <class S>
py::array TypedWorld<S>::castRays(const Numbers& origins, const Numbers& translations) {
    const Turn turn(taken_);
    const auto from = toPoints<S>(origins, "origins");
    const auto way = toPoints<S>(translations, "translations");
    if (from.size() != way.size() && way.size() != 1)
        throw EngineError("array", "translations: expected as many as origins, or one");
    py::array_t<Hit> rows(static_cast<py::ssize_t>(from.size()));
    Hit* row = rows.mutable_data();
    const WorldQueries<S>& world = queries();
    const py::gil_scoped_release released;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const auto& along = way[way.size() == 1 ? 0 : i];
        const auto found = world.castRay(from[i], along);
        row[i] = Hit{};
        row[i].body = row[i].shape = row[i].piece = -1;
        row[i].fraction = row[i].distance = std::numeric_limits<double>::infinity();
        if (found) row[i] = hitOf(*found, along);
    }
    return rows;
}

template <class S>
py::object TypedWorld<S>::castRay(const Numbers& origin, const Numbers& translation) {
    const Turn turn(taken_);
    const auto way = toVec<S>(translation, "translation");
    const auto found = queries().castRay(toVec<S>(origin, "origin"), way);
    return found ? oneRow(hitOf(*found, way)) : py::none();
}

template <class S>
py::object TypedWorld<S>::castShape(const ShapeArgs& shape, const Numbers& position,
                                    const Numbers& translation, const MaybeNumbers& orientation) {
    const Turn turn(taken_);
    const auto way = toVec<S>(translation, "translation");
    const auto found = queries().castShape(toShape<S>(shape), toPose<S>(position, orientation), way);
    return found ? oneRow(hitOf(*found, way)) : py::none();
}

template <class S>
py::array TypedWorld<S>::overlapping(const ShapeArgs& shape, const Numbers& position,
                                     const MaybeNumbers& orientation) {
    const Turn turn(taken_);
    const auto found = queries().overlapping(toShape<S>(shape), toPose<S>(position, orientation));
    py::array_t<std::int32_t> rows({static_cast<py::ssize_t>(found.size()), py::ssize_t{2}});
    for (std::size_t i = 0; i < found.size(); ++i) {
        rows.mutable_at(i, 0) = number(found[i].body);
        rows.mutable_at(i, 1) = number(found[i].shape);
    }
    return rows;
}

template <class S>
py::object TypedWorld<S>::nearest(const Numbers& point, double most) {
    const Turn turn(taken_);
    const auto found = queries().nearest(toVec<S>(point, "point"), static_cast<R>(most));
    return found ? oneRow(hitOf(*found, S::Vec::Zero())) : py::none();
}

}  // namespace rigor::engine::python
