// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Every body is always awake: nothing at rest is changed, as accuracy asks for.
#include "engine/sleeping/sleeping.hpp"

namespace rigor::engine {

template <class S>
SleepingScheme<S> sleepingOff() {
    return {};
}
template SleepingScheme<Space2f> sleepingOff<Space2f>();
template SleepingScheme<Space2d> sleepingOff<Space2d>();
template SleepingScheme<Space3f> sleepingOff<Space3f>();
template SleepingScheme<Space3d> sleepingOff<Space3d>();

}  // namespace rigor::engine
