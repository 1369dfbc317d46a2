// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A row of bodies with gaps between them: impacts happen one pair at a time, each by Newton's law. With equal
// masses and e = 1 as many leave as arrive; unequal ones repeat pairwise impacts until they all separate.
// (All at once, with zero gaps, another solution is possible; that is why gaps must be positive.)
// Source: Newton 1687; Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008.
// Assumes: see line_collisions.hpp; no gravity but a common fall.
// Quantities: velocity_<ball> along the line, once the last impact is over.
#include <cmath>

#include "validation/references/impacts/line_collisions.hpp"

namespace rigor::validation {
namespace {

class NewtonsCradle : public Reference {
  public:
    NewtonsCradle(const Scenario& scenario, const std::vector<int>& balls)
        : scenario_(scenario), line_(scenario, balls, true) {
        require(!line_.impacts().empty() && line_.impacts().front().time <= scenario.duration,
                "no two bodies meet within the duration");
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const int i : line_.bodies())
            if (scenario_.bodies[i].type == scenario::BodyType::Dynamic) result.push_back(i);
        return result;
    }
    double validUntil() const override { return line_.validUntil(); }
    PartialState exact(int body, double t) const override { return line_.exact(body, t); }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (!line_.isOver()) return result;
        double fastest = 0.0;
        for (const int i : bodies()) fastest = std::max(fastest, std::abs(line_.velocityBefore(i)));
        for (const int i : bodies()) {
            const double after = line_.velocityAfter(i);
            Quantity q{"velocity_" + scenario_.bodies[i].name, "m/s", after, after, fastest, {}};
            q.measure = [d = line_.direction(), g = line_.gravity(),
                         i](const Trajectory& run) -> std::optional<double> {
                const std::size_t end = run.frames() - 1;
                return dot(d, run.state(end, i).velocity - run.times[end] * g);
            };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    const Scenario& scenario_;
    LineCollisions line_;
};

}  // namespace

std::unique_ptr<Reference> makeNewtonsCradle(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"balls"});
    return std::make_unique<NewtonsCradle>(scenario, parts.dynamicBodies("balls"));
}

}  // namespace rigor::validation
