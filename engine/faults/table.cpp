// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/faults/fault.hpp"

namespace rigor::engine {

#define ALGORITHM(name, function, summary) \
    template <class S>                     \
    const Fault<S>* function();
#include "engine/faults/faults.def"

template <class S>
std::span<const AlgorithmEntry<FaultOf<S>>> faultTable() {
    static constexpr AlgorithmEntry<FaultOf<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/faults/faults.def"
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) template std::span<const AlgorithmEntry<FaultOf<S>>> faultTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
