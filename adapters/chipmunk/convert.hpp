// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conversion between the scenario's vectors and Chipmunk's, and owners of its objects.
#pragma once

#include <chipmunk/chipmunk.h>

#include <memory>

#include "adapters/interface/types.hpp"

namespace rigor::chipmunk {

using adapter::Pose;
using adapter::Vec3;

inline constexpr const char* kTwoDimensions = "chipmunk/cpVect.h, \"Chipmunk's 2D vector type\"";

inline cpVect toChipmunk(const Vec3& v) {
    return cpv(v.x, v.y);
}
inline Vec3 fromChipmunk(const cpVect& v) {
    return {v.x, v.y, 0.0};
}
inline cpTransform toChipmunk(const Pose& pose) {
    return cpTransformRigid(toChipmunk(pose.position), angleAboutZ(pose.orientation));
}

struct Deleter {
    void operator()(cpSpace* space) const { cpSpaceFree(space); }
    void operator()(cpBody* body) const { cpBodyFree(body); }
    void operator()(cpShape* shape) const { cpShapeFree(shape); }
    void operator()(cpConstraint* constraint) const { cpConstraintFree(constraint); }
    void operator()(cpSpatialIndex* index) const { cpSpatialIndexFree(index); }
};
template <class Object>
using Owned = std::unique_ptr<Object, Deleter>;

}  // namespace rigor::chipmunk
