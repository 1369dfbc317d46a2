// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/position_correction.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<PositionCorrection<S>> factory();
#include "engine/solvers/position_corrections.def"
#undef ALGORITHM

template <class S>
std::span<const AlgorithmEntry<PositionCorrectionFactory<S>>> positionCorrectionTable() {
    static constexpr AlgorithmEntry<PositionCorrectionFactory<S>> table[] = {
#define ALGORITHM(name, factory, summary) {#name, &factory<S>, summary},
#include "engine/solvers/position_corrections.def"
#undef ALGORITHM
    };
    return table;
}
template std::span<const AlgorithmEntry<PositionCorrectionFactory<Space2f>>>
positionCorrectionTable<Space2f>();
template std::span<const AlgorithmEntry<PositionCorrectionFactory<Space2d>>>
positionCorrectionTable<Space2d>();
template std::span<const AlgorithmEntry<PositionCorrectionFactory<Space3f>>>
positionCorrectionTable<Space3f>();
template std::span<const AlgorithmEntry<PositionCorrectionFactory<Space3d>>>
positionCorrectionTable<Space3d>();

}  // namespace rigor::engine
