// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Torque-free top: a free body whose rotation is the point. Attitude in full for any inertia tensor and any
// initial orientation; gravity only moves the centre of mass.
// Source: Landau and Lifshitz, Mechanics, 1976, section 37; Ashbaugh, Chicone, Cushman 1991 (the flip).
// Quantities: symmetric top: precession_rate; asymmetric: flip_time_1.. (zero of the angular velocity about
// the intermediate axis) and period. Measured by cubic interpolation between frames, error O(dt^4).
#include <cmath>

#include "validation/references/flight/rotation.hpp"

namespace rigor::validation {
namespace {

constexpr int kMaxFlips = 4;

class TorqueFreeTop : public Reference {
  public:
    TorqueFreeTop(const Scenario& scenario, int index)
        : scenario_(scenario),
          index_(index),
          body_(scenario.bodies[index]),
          gravity_(gravityOn(scenario, index)),
          rotation_(body_, scenario.dimension, runEnd(scenario)) {
        requireUndisturbed(scenario, index);
    }
    std::vector<int> bodies() const override { return {index_}; }
    double validUntil() const override { return rotation_.validUntil(); }

    PartialState exact(int, double t) const override {
        const Attitude attitude = rotation_.at(t);
        const Vec3 com = centerOfMass(body_) + t * body_.velocity + (0.5 * t * t) * gravity_;
        return stateOf(body_, com, attitude.orientation, body_.velocity + t * gravity_,
                       attitude.angularVelocity);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (rotation_.kind() == TorqueFreeMotion::Kind::Symmetric) addPrecession(result);
        if (rotation_.kind() == TorqueFreeMotion::Kind::Asymmetric) addFlips(result);
        return result;
    }

  private:
    void addPrecession(std::vector<Quantity>& result) const {
        const Vec3 z = unit(rotation_.angularMomentum()), x = perpendicular(z), y = cross(z, x);
        const Vec3 axis = rotation_.symmetryAxis();
        Quantity q{"precession_rate", "rad/s", rotation_.precessionRate(), std::nullopt, 0.0, {}};
        q.measure = [=, index = index_](const Trajectory& run) -> std::optional<double> {
            const auto azimuth = [&](std::size_t k) {
                const Vec3 a = rotate(run.state(k, index).orientation, axis);
                return std::atan2(dot(a, y), dot(a, x));
            };
            if (run.frames() < 2) return std::nullopt;
            double sum = 0.0;
            for (std::size_t k = 1; k < run.frames(); ++k)
                sum += std::remainder(azimuth(k) - azimuth(k - 1), 2.0 * static_cast<double>(numerics::kPi));
            return sum / (run.times.back() - run.times.front());
        };
        result.push_back(std::move(q));
    }

    void addFlips(std::vector<Quantity>& result) const {
        const Vec3 axis = rotation_.intermediateAxis();
        const double half = 0.5 * rotation_.period();
        for (int flip = 0; flip < kMaxFlips; ++flip) {
            const double time = rotation_.firstFlip() + flip * half;
            if (time > scenario_.duration) break;
            Quantity q{"flip_time_" + std::to_string(flip + 1), "s", time, std::nullopt, 0.0, {}};
            q.measure = [=, index = index_](const Trajectory& run) {
                return flipTime(run, index, axis, flip);
            };
            result.push_back(std::move(q));
        }
        if (rotation_.firstFlip() + 2.0 * half <= scenario_.duration) {
            Quantity q{"period", "s", 2.0 * half, std::nullopt, 0.0, {}};
            q.measure = [=, index = index_](const Trajectory& run) -> std::optional<double> {
                const auto first = flipTime(run, index, axis, 0), third = flipTime(run, index, axis, 2);
                if (!first || !third) return std::nullopt;
                return *third - *first;
            };
            result.push_back(std::move(q));
        }
    }

    /// Time of sign change number `flip` of the angular velocity about the body axis.
    static std::optional<double> flipTime(const Trajectory& run, int index, Vec3 axis, int flip) {
        const auto rate = [&](std::size_t k) {
            const auto& s = run.state(k, index);
            return dot(rotateInverse(s.orientation, s.angularVelocity), axis);
        };
        const std::size_t frames = run.frames();
        int seen = 0;
        for (std::size_t k = 0; k + 1 < frames; ++k) {
            if (!(rate(k) * rate(k + 1) < 0.0) && !(rate(k + 1) == 0.0 && rate(k) != 0.0)) continue;
            if (seen++ != flip) continue;
            const double sign = rate(k) < 0.0 ? 1.0 : -1.0;
            const auto slope = [&](std::size_t i) {
                const std::size_t a = i > 0 ? i - 1 : 0, b = i + 1 < frames ? i + 1 : i;
                return sign * (rate(b) - rate(a)) / (run.times[b] - run.times[a]);
            };
            return upwardCrossing(
                run, k, [&](std::size_t i) { return sign * rate(i); }, slope);
        }
        return std::nullopt;
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    Vec3 gravity_;
    TorqueFreeMotion rotation_;
};

}  // namespace

std::unique_ptr<Reference> makeTorqueFreeTop(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body"});
    return std::make_unique<TorqueFreeTop>(scenario, parts.dynamicBody("body"));
}

}  // namespace rigor::validation
