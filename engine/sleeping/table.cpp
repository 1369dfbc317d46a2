// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/sleeping/sleeping.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    SleepingScheme<S> factory();
#include "engine/sleeping/sleepings.def"

template <class S>
std::span<const AlgorithmEntry<SleepingFactory<S>>> sleepingTable() {
    static constexpr AlgorithmEntry<SleepingFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/sleeping/sleepings.def"
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) template std::span<const AlgorithmEntry<SleepingFactory<S>>> sleepingTable();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
