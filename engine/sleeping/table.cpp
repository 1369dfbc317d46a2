// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/sleeping/sleeping.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    SleepingScheme<S> factory();
#include "engine/sleeping/sleepings.def"
#undef ALGORITHM

template <class S>
std::span<const AlgorithmEntry<SleepingFactory<S>>> sleepingTable() {
    static constexpr AlgorithmEntry<SleepingFactory<S>> table[] = {
#define ALGORITHM(name, factory, summary) {#name, &factory<S>, summary},
#include "engine/sleeping/sleepings.def"
#undef ALGORITHM
    };
    return table;
}
template std::span<const AlgorithmEntry<SleepingFactory<Space2f>>> sleepingTable();
template std::span<const AlgorithmEntry<SleepingFactory<Space2d>>> sleepingTable();
template std::span<const AlgorithmEntry<SleepingFactory<Space3f>>> sleepingTable();
template std::span<const AlgorithmEntry<SleepingFactory<Space3d>>> sleepingTable();

}  // namespace rigor::engine
