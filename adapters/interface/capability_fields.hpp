// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Capabilities, field by field: the one list behind everything that writes or reads them.
#pragma once

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// Calls `visit(name, field)` for every field of (const) Capabilities, in their order; names are snake_case.
/// A field that is missing here does not compile: the binding needs all of them.
template <class C, class Visit>
void forEachCapability(C& capabilities, Visit&& visit) {
    auto& [dynamics, collision, broadPhase, dimensions, planar, shapes, joints, contactImpulses,
           signedDistance, queryOptions, kinematicBodies, damping, gravityScale, centerOfMassOffset,
           contactSolvers, staticFriction, rollingFriction, torsionalFriction, surfaceVelocity,
           contactFilters, shapeFilters, libraryLacks] = capabilities;
    visit("dynamics", dynamics);
    visit("collision", collision);
    visit("broad_phase", broadPhase);
    visit("dimensions", dimensions);
    visit("planar", planar);
    visit("shapes", shapes);
    visit("joints", joints);
    visit("contact_impulses", contactImpulses);
    visit("signed_distance", signedDistance);
    visit("query_options", queryOptions);
    visit("kinematic_bodies", kinematicBodies);
    visit("damping", damping);
    visit("gravity_scale", gravityScale);
    visit("center_of_mass_offset", centerOfMassOffset);
    visit("contact_solvers", contactSolvers);
    visit("static_friction", staticFriction);
    visit("rolling_friction", rollingFriction);
    visit("torsional_friction", torsionalFriction);
    visit("surface_velocity", surfaceVelocity);
    visit("contact_filters", contactFilters);
    visit("shape_filters", shapeFilters);
    visit("library_lacks", libraryLacks);
}

/// Capabilities as an object of a JSON library like nlohmann's, one key for each field.
template <class Json>
Json capabilitiesToJson(const Capabilities& capabilities) {
    Json json = Json::object();
    forEachCapability(capabilities, [&](const char* name, const auto& field) { json[name] = field; });
    return json;
}
template <class Json>
Capabilities capabilitiesFromJson(const Json& json) {
    Capabilities capabilities;
    forEachCapability(capabilities, [&](const char* name, auto& field) { json.at(name).get_to(field); });
    return capabilities;
}

}  // namespace rigor::adapter
