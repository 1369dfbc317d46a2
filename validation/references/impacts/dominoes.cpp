// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The first of a row of dominoes falls until it touches the second: about a stuck edge with R from the edge
// to the centre of mass and delta its turn from balance, delta'' = p^2 sin(delta), p^2 = m g R/I; slipping,
// as planar_motion.hpp follows it. The touch is at the turn at which its upper corner has crossed the gap,
// asin(s/h) of a thin one. The wave that follows depends on the law of many impacts and is not given: the
// solution ends at the touch. Source: Routh, Dynamics of a System of Rigid Bodies, 1905; Stronge and Shu,
// Proc. R. Soc. A 418 (1988) 155. Assumes: what planar_contact assumes of the first; the second a box at rest
// with a face across the way. Quantity: touch_time.
#include <cmath>

#include "validation/references/planar/planar_motion.hpp"

namespace rigor::validation {
namespace {

class Dominoes : public Reference {
  public:
    Dominoes(const Scenario& scenario, std::vector<int> bodies, int floor)
        : scenario_(scenario),
          bodies_(std::move(bodies)),
          frame_(scenario, bodies_.at(0), floor),
          motion_(frame_.setup(), frame_.start(), scenario.duration, runEnd(scenario)) {
        for (std::size_t i = 1; i < bodies_.size(); ++i) requireStill(scenario, bodies_[i]);
        findFace(floor);
        const auto crossed = [&](double t) {
            const auto lifted = *frame_.lift(motion_.at(t)).position;
            const Quat q = *frame_.lift(motion_.at(t)).orientation;
            double most = -1e300;
            for (const Vec3 corner : corners_) most = std::max(most, dot(way_, lifted + rotate(q, corner)));
            return most - face_;
        };
        require(crossed(0.0) < 0.0, "the first domino touches the second at the start");
        const double end = std::min(runEnd(scenario), motion_.validUntil());
        const int samples = 4000;
        for (int k = 1; k <= samples && time_ > 1e299; ++k) {
            if (crossed(end * k / samples) < 0.0) continue;
            double low = end * (k - 1) / samples, high = end * k / samples;
            for (int n = 0; n < 100; ++n) {
                const double middle = 0.5 * (low + high);
                (crossed(middle) < 0.0 ? low : high) = middle;
            }
            time_ = high;
        }
        require(time_ < scenario.duration, "the first domino does not reach the second");
        for (const auto& event : motion_.events())
            require(event.time >= time_ || event.kind != PlanarMotion::EventKind::Impact,
                    "the first domino hits the floor before the second");
        turn_ = motion_.at(time_).angle - motion_.at(0).angle;
    }
    std::vector<int> bodies() const override { return bodies_; }
    double validUntil() const override { return time_; }

    PartialState exact(int body, double t) const override {
        if (body == bodies_.front()) return frame_.lift(motion_.at(std::min(t, time_)));
        const Body& b = scenario_.bodies[body];
        return stateOf(b, centerOfMass(b), b.pose.orientation, {}, {});
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        Quantity q{"touch_time", "s", time_, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) {
            const double sign = turn_ < 0 ? -1.0 : 1.0;
            const auto start = frame_.start().angle;
            const auto read = [&](std::size_t k) { return frame_.read(run.state(k, bodies_.front())); };
            return upwardCrossing(
                run, 0,
                [&](std::size_t k) { return static_cast<double>(sign * (read(k).angle - start - turn_)); },
                [&](std::size_t k) { return static_cast<double>(sign * read(k).rate); });
        };
        return {q};
    }

  private:
    /// The face of the second box that faces the first, and the corners of the first.
    void findFace(int floor) {
        const Body &first = scenario_.bodies[bodies_[0]], &second = scenario_.bodies[bodies_[1]];
        const auto *a = std::get_if<scenario::Box>(&first.shapes.at(0).geometry),
                   *b = std::get_if<scenario::Box>(&second.shapes.at(0).geometry);
        require(a && b && first.shapes.size() == 1 && second.shapes.size() == 1,
                "the dominoes are not boxes");
        requireContact(scenario_, bodies_[0], bodies_[1]);
        const Vec3 n = planeOf(scenario_, floor, centerOfMass(second)).normal;
        const Vec3 to = second.pose.position - first.pose.position;
        way_ = unit(to - dot(to, n) * n);
        const Pose pose = second.pose * second.shapes[0].pose;
        const Vec3 h = b->halfExtents, local = rotateInverse(pose.orientation, way_);
        const double reach = std::abs(local.x) * h.x + std::abs(local.y) * h.y + std::abs(local.z) * h.z;
        const double most = std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)});
        require(most > 1 - 1e-9, "the second domino does not face the first");
        face_ = dot(way_, pose.position) - reach;
        const double depth = scenario_.dimension == 3 ? a->halfExtents.z : 0.0;
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                for (const double z : {-1.0, 1.0})
                    corners_.push_back(first.shapes[0].pose *
                                       Vec3{x * a->halfExtents.x, y * a->halfExtents.y, z * depth});
    }

    const Scenario& scenario_;
    std::vector<int> bodies_;
    PlanarFrame frame_;
    PlanarMotion motion_;
    std::vector<Vec3> corners_;  ///< corners of the first, body frame
    Vec3 way_;
    double face_ = 0.0, time_ = 1e300;
    PlanarMotion::Real turn_ = 0;
};

}  // namespace

std::unique_ptr<Reference> makeDominoes(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies", "floor"});
    const std::vector<int> bodies = parts.dynamicBodies("bodies");
    require(bodies.size() >= 2, "a row of dominoes needs two");
    return std::make_unique<Dominoes>(scenario, bodies, parts.support("floor", bodies.front()));
}

}  // namespace rigor::validation
