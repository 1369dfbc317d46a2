// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies that act on nothing but each other: the common centre of mass moves on x0 + V t whatever they do;
// smooth balls never change their spin. No trajectory is compared: the collisions of a cloud are chaotic.
// Momentum and energy themselves are metrics of their own. Source: Newton 1687, corollary IV; Landau and
// Lifshitz, Mechanics, 1976, sections 7-9. Assumes: no fixed body, no force from outside, no gravity; no
// damping or event. Quantities: center_off_line, the distance of the common centre of mass from its line at
// the end, against the way that the bodies themselves went; spin_change, the largest change of a ball's spin
// where nothing has friction and all are balls, against the fastest speed over the smallest radius.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

class IsolatedSystem : public Reference {
  public:
    explicit IsolatedSystem(const Scenario& scenario) : scenario_(scenario) {
        smooth_ = true;
        for (int i = 0; i < static_cast<int>(scenario.bodies.size()); ++i) {
            const Body& body = at(i);
            require(body.type == scenario::BodyType::Dynamic, bodyTitle(scenario, i) + " is not free");
            requireUndisturbed(scenario, i, {.joints = true, .springs = true});
            require(gravityOn(scenario, i) == Vec3{}, "gravity acts on " + bodyTitle(scenario, i));
            mass_ += body.massProperties.mass;
            momentum_ += body.massProperties.mass * body.velocity;
            start_ += body.massProperties.mass * centerOfMass(body);
            fastest_ = std::max(fastest_, norm(body.velocity));
            smallest_ = std::min(smallest_, sizeOf(body));
            smooth_ = smooth_ && body.shapes.size() == 1 &&
                      std::holds_alternative<scenario::Sphere>(body.shapes[0].geometry) &&
                      norm(body.shapes[0].pose.position - body.massProperties.centerOfMass) == 0.0;
            for (const auto& shape : body.shapes)
                for (int j = 0; j < i; ++j)
                    for (const auto& other : at(j).shapes)
                        smooth_ = smooth_ && holdingFriction(pairCoefficients(scenario, shape.material,
                                                                              other.material)) == 0.0;
        }
        for (const auto& joint : scenario.joints)
            require(joint.bodyA != scenario::kNone && joint.bodyB != scenario::kNone,
                    "joint '" + joint.name + "' leads to the fixed world");
        for (const auto& force : scenario.forces)
            if (const auto* spring = std::get_if<scenario::SpringForce>(&force))
                require(spring->bodyA != scenario::kNone, "a spring leads to the fixed world");
        require(scenario.bodies.size() >= 2, "a system needs two bodies");
        require(fastest_ > 0.0, "nothing moves");
        smooth_ = smooth_ && scenario.joints.empty() && scenario.forces.empty();
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        Quantity off{"center_off_line", "m", 0.0, {}, fastest_ * scenario_.duration, {}};
        off.measure = [this](const Trajectory& run) -> std::optional<double> {
            const std::size_t end = run.frames() - 1;
            const double t = run.times[end];
            Vec3 sum;
            for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i)
                sum += at(i).massProperties.mass * centerOfMass(at(i), run.state(end, i));
            const Vec3 line = (start_ + t * momentum_) / mass_;
            return norm(sum / mass_ - line);
        };
        result.push_back(std::move(off));
        if (!smooth_) return result;
        Quantity spin{"spin_change", "rad/s", 0.0, 0.0, fastest_ / smallest_, {}};
        spin.measure = [this](const Trajectory& run) -> std::optional<double> {
            double most = 0.0;
            for (int i = 0; i < static_cast<int>(scenario_.bodies.size()); ++i)
                most = std::max(most,
                                norm(run.state(run.frames() - 1, i).angularVelocity - at(i).angularVelocity));
            return most;
        };
        result.push_back(std::move(spin));
        return result;
    }

  private:
    const Body& at(int i) const { return scenario_.bodies[i]; }

    const Scenario& scenario_;
    double mass_ = 0.0, fastest_ = 0.0, smallest_ = 1e300;
    Vec3 momentum_, start_;
    bool smooth_ = false;
};

}  // namespace

std::unique_ptr<Reference> makeIsolatedSystem(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {});
    return std::make_unique<IsolatedSystem>(scenario);
}

}  // namespace rigor::validation
