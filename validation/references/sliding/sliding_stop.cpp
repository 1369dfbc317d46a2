// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A block slides to rest on a level floor: d = v^2/(2 mu g), t = v/(mu g), straight in any direction.
// Scheme-exact: v(n+1) = v(n) - mu g h until zero, x by the new (symplectic) or old (explicit) velocity.
// Source: Coulomb 1785; Goldstein, Poole, Safko 2002, chapter 1.
// Assumes: level floor (gravity along its normal), no tipping; see sliding.hpp.
// Quantities: stop_distance, stop_time (extrapolated from the last sliding frames; exact for constant
// deceleration).
#include "validation/references/sliding/sliding.hpp"

namespace rigor::validation {
namespace {

class SlidingStop : public Reference {
  public:
    SlidingStop(const Scenario& scenario, int body, int floor) : sliding_(scenario, body, floor) {
        require(sliding_.pull() == 0.0, "gravity is not along the normal of the floor: use incline_slide");
    }
    std::vector<int> bodies() const override { return {sliding_.index()}; }
    PartialState exact(int, double t) const override { return sliding_.exact(t); }
    std::optional<PartialState> schemeExact(int, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        return sliding_.schemeExact(step, dt, scheme);
    }
    std::vector<Quantity> quantities(double dt, adapter::Scheme scheme) const override {
        std::vector<Quantity> result;
        sliding_.addStopQuantities(result, "", dt, scheme);
        return result;
    }

  private:
    SlidingBody sliding_;
};

}  // namespace

std::unique_ptr<Reference> makeSlidingStop(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body", "on"});
    const int body = parts.dynamicBody("body");
    return std::make_unique<SlidingStop>(scenario, body, parts.support("on", body));
}

}  // namespace rigor::validation
