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
#define RIGOR_INSTANTIATE(S) template std::span<const AlgorithmEntry<FaultOf<S>>> faultTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
