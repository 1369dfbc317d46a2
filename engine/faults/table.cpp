// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/faults/fault.hpp"

namespace rigor::engine {

#define ALGORITHM(name, function, summary) \
    template <class S>                     \
    const Fault<S>* function();
#include "engine/faults/faults.def"
#undef ALGORITHM

template <class S>
std::span<const AlgorithmEntry<FaultOf<S>>> faultTable() {
    static constexpr AlgorithmEntry<FaultOf<S>> table[] = {
#define ALGORITHM(name, function, summary) {#name, &function<S>, summary},
#include "engine/faults/faults.def"
#undef ALGORITHM
    };
    return table;
}
template std::span<const AlgorithmEntry<FaultOf<Space2f>>> faultTable<Space2f>();
template std::span<const AlgorithmEntry<FaultOf<Space2d>>> faultTable<Space2d>();
template std::span<const AlgorithmEntry<FaultOf<Space3f>>> faultTable<Space3f>();
template std::span<const AlgorithmEntry<FaultOf<Space3d>>> faultTable<Space3d>();

}  // namespace rigor::engine
