// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A block on an incline: sticks iff tan(alpha) <= mu when at rest; slides with g (sin -+ mu cos) along the
// slope; launched across the slope its path curves downhill (planar_slide.hpp). Level floors are the limit.
// Scheme-exact: v(n+1) = v(n) + h g_t reduced by mu g_n h towards zero (implicit isotropic friction).
// Source: Coulomb 1785; Whittaker, Analytical Dynamics, 1937.
// Assumes: no tipping; see sliding.hpp.
// Quantities: displacement (from the start, in the last frame), final_speed, and stop_distance, stop_time
// where it stops.
#include <cmath>

#include "validation/references/sliding/sliding.hpp"

namespace rigor::validation {
namespace {

class InclineSlide : public Reference {
  public:
    InclineSlide(const Scenario& scenario, int body, int floor)
        : duration_(scenario.duration), sliding_(scenario, body, floor) {}
    std::vector<int> bodies() const override { return {sliding_.index()}; }
    PartialState exact(int, double t) const override { return sliding_.exact(t); }
    std::optional<PartialState> schemeExact(int, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        return sliding_.schemeExact(step, dt, scheme);
    }
    std::vector<Quantity> quantities(double dt, adapter::Scheme scheme) const override {
        std::vector<Quantity> result;
        // If the block sticks from the start, errors are measured against the fall without friction.
        const auto end = sliding_.slide().at(duration_);
        const double scale = 0.5 * sliding_.pull() * duration_ * duration_ + sliding_.speed() * duration_;
        if (scale == 0.0) return result;
        Quantity moved{"displacement", "m", norm(end.displacement), {}, 0.0, {}};
        if (moved.exact == 0.0) moved.scale = scale;
        moved.measure = [this](const Trajectory& run) -> std::optional<double> {
            return sliding_.distance(run, run.frames() - 1);
        };
        result.push_back(std::move(moved));
        Quantity speed{"final_speed", "m/s", norm(end.velocity), {}, scale / duration_, {}};
        speed.measure = [index = sliding_.index()](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index).velocity);
        };
        result.push_back(std::move(speed));
        sliding_.addStopQuantities(result, "", dt, scheme);
        return result;
    }

  private:
    double duration_;
    SlidingBody sliding_;
};

}  // namespace

std::unique_ptr<Reference> makeInclineSlide(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "on"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<InclineSlide>(scenario, body, parts.support("on", body));
}

}  // namespace rigor::validation
