// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// No mistake: no object, no hook is called.
#include "engine/faults/fault.hpp"

namespace rigor::engine {

template <class S>
const Fault<S>* faultNone() {
    return nullptr;
}
#define RIGOR_INSTANTIATE(S) template const Fault<S>* faultNone<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
