// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<PositionCorrection<S>> factory();
#include "engine/solvers/position_corrections.def"

template <class S>
std::span<const AlgorithmEntry<PositionCorrectionFactory<S>>> positionCorrectionTable() {
    static constexpr AlgorithmEntry<PositionCorrectionFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/solvers/position_corrections.def"
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) \
    template std::span<const AlgorithmEntry<PositionCorrectionFactory<S>>> positionCorrectionTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
