// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Properties of the world as ODE has them.
#include "adapters/ode/convert.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {

adapter::ReadBack OdeWorld::readBack() const {
    adapter::ReadBack all;
    dVector3 worldGravity;
    dWorldGetGravity(world_, worldGravity);
    for (std::size_t i = 0; i < records_.size(); ++i) {
        const BodyRecord& record = *records_[i];
        adapter::BodyReadBack body;
        body.state = stateOf(i);
        body.centerOfMass = record.com;
        if (record.body != nullptr && !record.geoms.empty()) {
            // The place of the first shape relative to the centre of mass gives the centre of mass in the
            // body.
            const Geom& geom = *record.geoms.front();
            const scenario::Pose& shape = scenario_.bodies[i].shapes.front().pose;
            const Vec3 offset = fromOde(dGeomGetOffsetPosition(geom.id()));
            body.centerOfMass = shape * geom.frame().position - offset;
        }
        if (record.dynamic) {
            dMass mass;
            dBodyGetMass(record.body, &mass);
            body.mass = mass.mass;
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    if (!planar_ || (r == 2 && c == 2)) body.inertia(r, c) = mass.I[4 * r + c];
            body.gravity = dBodyGetGravityMode(record.body) != 0 ? fromOde(worldGravity) : record.gravity;
        }
        all.bodies.push_back(body);
    }
    // Coefficients live in each contact alone; this is the function that every contact gets them from.
    for (const auto& example : pairs_.examples()) {
        const dSurfaceParameters surface = surfaceFor(
            pairs_.coefficients(example.materialA, example.materialB), bounceThreshold_, contactCfm_);
        all.pairs.push_back({example.materialA, example.materialB, surface.mu,
                             (surface.mode & dContactBounce) != 0 ? surface.bounce : 0.0});
    }
    return all;
}

}  // namespace rigor::ode
