// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The Flexible Collision Library: collision queries and broad phases, no dynamics.
#include <fcl/config.h>

#include "adapters/fcl/broadphase.hpp"
#include "adapters/fcl/collision.hpp"
#include "adapters/fcl/shapes.hpp"
#include "adapters/interface/options.hpp"

namespace rigor::fcl_adapter {
namespace {

class FclEngine final : public adapter::Engine {
  public:
    adapter::EngineInfo info() const override {
        return {"fcl", FCL_VERSION, "f64", "Flexible Collision Library",
                "libccd solver, asserts on" + std::string(FCL_HAVE_SSE ? ", SSE" : ", no SSE")};
    }
    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.collision = c.broadPhase = true;
        c.dimensions = {3};
        c.planar = true;
        c.shapes = {"sphere",  "box",        "capsule",   "cylinder",      "cone",
                    "hull",    "half_space", "ellipsoid", "triangle_mesh", "circle",
                    "polygon", "half_plane", "segment",   "chain"};
        c.signedDistance = true;
        c.libraryLacks = {
            {"height_field", kNoHeightField},
            {"dynamics", "README: \"FCL is a library for performing three types of proximity queries\""}};
        return c;
    }
    std::vector<adapter::Option> options() const override {
        return {adapter::choice("broad_phase", broadPhase_.algorithms(), "dynamic_aabb_tree",
                                "dynamic_aabb_tree", "manager of moving boxes, by itself"),
                adapter::choice("narrow_phase", collision_.algorithms(), "libccd", "libccd",
                                "libccd with EPA for depths of polytopes, fcl::collide with libccd alone, or "
                                "with FCL's own solver")};
    }
    const adapter::CollisionEngine* collision() const override { return &collision_; }
    const adapter::BroadPhaseEngine* broadPhase() const override { return &broadPhase_; }

  private:
    FclCollisionEngine collision_;
    FclBroadPhaseEngine broadPhase_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    return std::make_unique<FclEngine>();
}

}  // namespace
}  // namespace rigor::fcl_adapter

RIGOR_ADAPTER_MODULE(rigor::fcl_adapter::createEngine)
