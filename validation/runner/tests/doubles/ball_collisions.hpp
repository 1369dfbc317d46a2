// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Collision queries between balls, and a ball and a half-space, in closed form; faulty auditors are this one
// with one fault each.
#pragma once

#include <memory>

#include "adapters/interface/engine.hpp"
#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {

class BallCollisions : public CollisionEngine {
  public:
    CollisionAnswer collide(const CollisionQuery& query) const override {
        const auto* a = std::get_if<scenario::Sphere>(query.a.geometry);
        const auto* b = std::get_if<scenario::Sphere>(query.b.geometry);
        const auto* plane = std::get_if<scenario::HalfSpace>(query.a.geometry);
        if (b == nullptr || (a == nullptr && plane == nullptr))
            throw Unsupported("only balls and half-spaces");
        ContactPoint c;
        c.bodyA = 0;
        c.bodyB = 1;
        const Vec3 center = query.b.pose.position;
        if (plane != nullptr) {
            c.normal = rotate(query.a.pose.orientation, plane->normal);
            const double distance = dot(c.normal, center - query.a.pose.position) - plane->offset;
            c.depth = b->radius - distance;
            c.pointA = center - distance * c.normal;
        } else {
            const Vec3 span = center - query.a.pose.position;
            c.normal = span / norm(span);
            c.depth = a->radius + b->radius - norm(span);
            c.pointA = query.a.pose.position + a->radius * c.normal;
        }
        c.pointB = center - b->radius * c.normal;
        return answer(c);
    }

  protected:
    virtual CollisionAnswer answer(const ContactPoint& truth) const {
        CollisionAnswer out;
        out.overlap = truth.depth > 0.0;
        if (out.overlap) out.contacts = {truth};
        return out;
    }
};

template <class Collisions>
class AuditorDouble : public Engine {
  public:
    EngineInfo info() const override { return doubleInfo(); }
    Capabilities capabilities() const override {
        Capabilities c = doubleCapabilities();
        c.collision = true;
        return c;
    }
    std::vector<Option> options() const override { return {}; }
    const CollisionEngine* collision() const override { return &collisions_; }

  private:
    Collisions collisions_;
};

template <class Collisions>
std::unique_ptr<Engine> makeAuditor() {
    return std::make_unique<AuditorDouble<Collisions>>();
}

}  // namespace rigor::doubles
