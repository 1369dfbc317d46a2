// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A block slides down a wedge that is free to slide on a smooth floor. With n the normal of the wedge's face
// (towards the block), d the downhill direction, e the floor's direction, c = e.n, A the wedge's acceleration
// along e, N and F = mu N the contact forces:
//   M A = e.(-N n + mu N d),  m a = m g + N n - mu N d,  a.n = A e.n,
// which for a slope alpha gives A = m g cos (sin - mu cos)/(M + m sin (sin - mu cos)), N = m (g cos - A sin);
// nothing moves where tan(alpha) <= mu. Horizontal momentum is conserved.
// Source: Landau and Lifshitz, Mechanics, 1976, ch. 1; Goldstein, Poole, Safko 2002, ch. 1, exercises.
// Assumes: both at rest at the start; the block's flat side on a face of the wedge; gravity along the floor's
// normal; the floor without friction; neither tips: the pressures fall inside their areas. Valid until the
// block's pressure leaves the face. Quantity: wedge_acceleration.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

std::vector<Vec3> cornersOf(const Scenario& scenario, int index) {
    const Body& body = scenario.bodies[index];
    require(body.shapes.size() == 1, bodyTitle(scenario, index) + " has more than one shape");
    const Pose pose = body.pose * body.shapes[0].pose;
    std::vector<Vec3> corners;
    if (const auto* hull = std::get_if<scenario::ConvexHull>(&body.shapes[0].geometry)) {
        for (const Vec3 v : hull->vertices) corners.push_back(pose * v);
    } else if (const auto* box = std::get_if<scenario::Box>(&body.shapes[0].geometry)) {
        const Vec3 h = box->halfExtents;
        for (const double x : {-h.x, h.x})
            for (const double y : {-h.y, h.y})
                for (const double z : {-h.z, h.z}) corners.push_back(pose * Vec3{x, y, z});
    } else {
        violated(bodyTitle(scenario, index) + " is neither a box nor a polyhedron");
    }
    return corners;
}

class WedgeBlock : public Reference {
  public:
    WedgeBlock(const Scenario& scenario, int wedge, int block, int floor)
        : scenario_(scenario),
          wedge_(wedge),
          block_(block),
          plane_(planeOf(scenario, floor, centerOfMass(at(wedge)))) {
        for (const int i : {wedge, block}) {
            requireUndisturbed(scenario, i);
            requireStill(scenario, i);
        }
        requireContact(scenario, wedge, floor);
        requireContact(scenario, wedge, block);
        const Vec3 g = gravityOn(scenario, block), up = plane_.normal;
        require(g != Vec3{} && norm(g + norm(g) * up) <= 1e-9 * norm(g) && gravityOn(scenario, wedge) == g,
                "gravity is not along the normal of the floor");
        const auto underneath = pairCoefficients(scenario, at(wedge).shapes[0].material, plane_.material);
        require(holdingFriction(underneath) == 0.0, "the floor under the wedge is not smooth");
        wedgeCorners_ = cornersOf(scenario, wedge);
        findFace();
        const auto pair =
            pairCoefficients(scenario, at(block).shapes[0].material, at(wedge).shapes[0].material);
        const double mu = pair.friction;
        const double c = dot(normal_, up), s = std::sqrt(std::max(0.0, 1 - c * c)),
                     m = at(block).massProperties.mass, M = at(wedge).massProperties.mass, pull = norm(g);
        require(c > 0.0 && s > 1e-9, "the face of the wedge is not a slope");
        if (s <= holdingFriction(pair) * c) {
            pushBlock_ = -m * g;
        } else {
            const double A = m * pull * c * (s - mu * c) / (M + m * s * (s - mu * c)),
                         N = m * (pull * c - A * s);
            // The wedge moves away from where the block goes: against the flat part of the normal.
            const Vec3 flat = unit(normal_ - c * up);
            wedgeAcceleration_ = -A * flat;
            pushBlock_ = N * normal_ - (mu * N) * downhill_;
            blockAcceleration_ = g + pushBlock_ / m;
        }
        checkTipping();
    }
    std::vector<int> bodies() const override { return {wedge_, block_}; }
    double validUntil() const override { return validUntil_; }
    PartialState exact(int body, double t) const override {
        const Vec3 a = body == wedge_ ? wedgeAcceleration_ : blockAcceleration_;
        return stateOf(at(body), centerOfMass(at(body)) + (0.5 * t * t) * a, at(body).pose.orientation, t * a,
                       {});
    }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        if (!adapter::isEuler(scheme)) return std::nullopt;
        // Constant accelerations: velocities are exact, positions off by a dt t/2.
        const double t = step * dt, shift = scheme == adapter::Scheme::SymplecticEuler ? dt : -dt;
        const Vec3 a = body == wedge_ ? wedgeAcceleration_ : blockAcceleration_;
        return stateOf(at(body), centerOfMass(at(body)) + (0.5 * t * (t + shift)) * a,
                       at(body).pose.orientation, t * a, {});
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        const double when = 0.5 * std::min(scenario_.duration, validUntil_);
        const Vec3 direction =
            wedgeAcceleration_ == Vec3{} ? perpendicular(plane_.normal) : unit(wedgeAcceleration_);
        Quantity q{"wedge_acceleration",
                   "m/s^2",
                   norm(wedgeAcceleration_),
                   norm(wedgeAcceleration_),
                   norm(gravityOn(scenario_, wedge_)),
                   {}};
        q.measure = [this, when, direction](const Trajectory& run) -> std::optional<double> {
            const auto frame = lastFrameBefore(run, when);
            if (!frame) return std::nullopt;
            return dot(direction, run.state(*frame, wedge_).velocity) / run.times[*frame];
        };
        return {q};
    }

  private:
    const Body& at(int i) const { return scenario_.bodies[i]; }

    /// The face of the wedge that supports a side of the block.
    void findFace() {
        const std::vector<Vec3> block = cornersOf(scenario_, block_);
        const double size = sizeOf(at(block_)), near = 1e-5 * size;
        const std::size_t least = scenario_.dimension == 2 ? 2 : 3;
        for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            for (const double side : {-1.0, 1.0}) {
                if (scenario_.dimension == 2 && axis.z != 0.0) continue;
                const Vec3 n =
                    side * rotate(at(block_).pose.orientation * at(block_).shapes[0].pose.orientation, axis);
                double top = -1e300, bottom = 1e300;
                for (const Vec3 v : wedgeCorners_) top = std::max(top, dot(n, v));
                for (const Vec3 v : block) bottom = std::min(bottom, dot(n, v));
                if (std::abs(bottom - top) > 10 * near) continue;
                std::vector<Vec3> face, base;
                for (const Vec3 v : wedgeCorners_)
                    if (dot(n, v) > top - near) face.push_back(v);
                for (const Vec3 v : block)
                    if (dot(n, v) < bottom + near) base.push_back(v);
                if (face.size() < least || base.size() < least) continue;
                normal_ = n;
                face_ = face;
                base_ = base;
                const Vec3 up = plane_.normal;
                downhill_ = unit(dot(n, up) * n - up);
                return;
            }
        violated(bodyTitle(scenario_, block_) + " does not lie flat on a face of " +
                 bodyTitle(scenario_, wedge_));
    }

    void checkTipping() {
        // The block's push goes through its centre of mass: the pressure is where that line intersects the
        // face.
        const Vec3 com = centerOfMass(at(block_));
        const double depth = dot(normal_, com - base_.front());
        const Vec3 pressure = com - (depth / dot(normal_, pushBlock_)) * pushBlock_;
        require(supportMargin(base_, pressure, normal_, scenario_.dimension) > 0.0,
                bodyTitle(scenario_, block_) + " tips");
        require(supportMargin(face_, pressure, normal_, scenario_.dimension) > 0.0,
                bodyTitle(scenario_, block_) + " stands beyond the face of the wedge");
        // Valid while the pressure stays on the face, seen from the wedge.
        const Vec3 relative = blockAcceleration_ - wedgeAcceleration_;
        const auto inside = [&](double t) {
            return supportMargin(face_, pressure + (0.5 * t * t) * relative, normal_, scenario_.dimension) >
                   0.0;
        };
        const Vec3 up = plane_.normal;
        double support = 1e300;
        for (const Vec3 v : wedgeCorners_) support = std::min(support, plane_.height(v));
        std::vector<Vec3> sole;
        for (const Vec3 v : wedgeCorners_)
            if (plane_.height(v) < support + 1e-5 * sizeOf(at(wedge_))) sole.push_back(v);
        const auto stands = [&](double t) {
            // Moments on the wedge about its centre of mass: floor force at x, block's push, no turning.
            const Vec3 center = centerOfMass(at(wedge_)) + (0.5 * t * t) * wedgeAcceleration_;
            const Vec3 point = pressure + (0.5 * t * t) * blockAcceleration_;
            const double M = at(wedge_).massProperties.mass;
            const Vec3 load = pushBlock_ - M * gravityOn(scenario_, wedge_);  // floor's force: up part only
            const double floor = dot(up, load);
            // (x - center) x floor up = (point - center) x push, along the floor.
            const Vec3 moment = cross(point - center, pushBlock_);
            const Vec3 arm = cross(up, moment) / floor;
            const Vec3 x = center + (arm - dot(up, arm) * up);
            std::vector<Vec3> moved;
            for (const Vec3 v : sole) moved.push_back(v + (0.5 * t * t) * wedgeAcceleration_);
            return supportMargin(moved, x, up, scenario_.dimension) > 0.0;
        };
        require(stands(0.0), bodyTitle(scenario_, wedge_) + " tips");
        for (int k = 1; k <= 400; ++k) {
            const double t = scenario_.duration * k / 400;
            if (inside(t) && stands(t)) continue;
            validUntil_ = scenario_.duration * (k - 1) / 400;
            return;
        }
    }

    const Scenario& scenario_;
    int wedge_, block_;
    Plane plane_;
    std::vector<Vec3> wedgeCorners_, face_, base_;
    Vec3 normal_, downhill_, wedgeAcceleration_, blockAcceleration_, pushBlock_;
    double validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeWedgeBlock(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"wedge", "block", "floor"});
    const int wedge = parts.dynamicBody("wedge");
    return std::make_unique<WedgeBlock>(scenario, wedge, parts.dynamicBody("block", {wedge}),
                                        parts.support("floor", wedge));
}

}  // namespace rigor::validation
