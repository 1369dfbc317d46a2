// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every body is always awake: nothing at rest is changed, as accuracy requires.
#include "engine/sleeping/sleeping.hpp"

namespace rigor::engine {

template <class S>
SleepingScheme<S> sleepingOff() {
    return {};
}
#define RIGOR_INSTANTIATE(S) template SleepingScheme<S> sleepingOff<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
