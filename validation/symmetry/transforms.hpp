// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The entries of symmetries.def, and functions common to their files.
#pragma once

#include "validation/symmetry/symmetry.hpp"

namespace rigor::validation {

#define SYMMETRY(name, title, rerun, formula, obstacle, apply) \
    std::string obstacle(const scenario::Scenario&);           \
    Transformed apply(const scenario::Scenario&, const Trajectory*);
#include "validation/symmetry/symmetries.def"
#undef SYMMETRY

/// The same physics under no name of its own: without reference, bounds, deviations, requested metrics.
scenario::Scenario bare(const scenario::Scenario& scenario);

/// The trajectory with every state and contact mapped; contacts keep their bodies.
Trajectory mapped(const Trajectory& trajectory,
                  const std::function<BodyState(const BodyState&, double time)>& state,
                  const std::function<ContactPoint(const ContactPoint&, double time)>& contact);

/// Bodies back in the order of before: body i of the result is body place[i] of `trajectory`. Others are
/// dropped, with their contacts.
Trajectory reordered(const Trajectory& trajectory, const std::vector<int>& place);

/// Throws std::invalid_argument with the obstacle, if there is one.
void require(const std::string& obstacle);

}  // namespace rigor::validation
