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
template const Fault<Space2f>* faultNone<Space2f>();
template const Fault<Space2d>* faultNone<Space2d>();
template const Fault<Space3f>* faultNone<Space3f>();
template const Fault<Space3d>* faultNone<Space3d>();

}  // namespace rigor::engine
