// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Names of columns, taken apart.
#pragma once

#include <string>

#include "validation/studies/study.hpp"

namespace rigor::validation {

/// The column of the time from which two runs differ; version 0.1 called it onset.
inline constexpr const char* kDivergenceTime = "divergence_time";
inline constexpr const char* kOldDivergenceTime = "onset";

struct Column {
    enum class Kind {
        OfCase,      ///< value of the row's own case: metric, quantity.NAME, time.PHASE
        Order,       ///< order.METRIC
        Symmetry,    ///< symmetry.NAME, symmetry.NAME.angle, .frames, .from, .divergence_time
        Divergence,  ///< divergence_time, growth, split of two runs: of the members, or growth:VARIANT
        Ensemble,    ///< ensemble.METRIC, ensemble.METRIC.low, .high, .p:VARIANT
    };
    Kind kind = Kind::OfCase;
    std::string name;     ///< metric, symmetry, or divergence_time, growth, split
    std::string aspect;   ///< "angle", "low", "p", ...; "" the value itself
    std::string variant;  ///< compared with; "" none
};
Column columnOf(const std::string& text);

/// Throws std::invalid_argument for a column that no case of the part can fill.
void checkColumn(const scenario::StudyPart& part, const std::string& column);

/// Replaces "*" by all symmetries and gives each its column. Throws std::invalid_argument for unknown names.
void nameSymmetries(scenario::StudyPart& part);

}  // namespace rigor::validation
