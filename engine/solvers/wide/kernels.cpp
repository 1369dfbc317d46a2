// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The kernels are compiled once for every instruction set (hwy/foreach_target.h includes this file again).
#include "engine/solvers/wide/kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solvers/wide/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/solvers/wide/distribute-inl.hpp"
#include "engine/solvers/wide/prepare-inl.hpp"
#include "engine/solvers/wide/solve-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

#define RIGOR_KERNELS(S)                                                          \
    void prepare##S(const PatchRange<S>& range, const PatchInertia<S>* inertia) { \
        prepareAll(range, inertia);                                               \
    }                                                                             \
    void warmStart##S(const PatchRange<S>& range) {                               \
        warmStartAll(range);                                                      \
    }                                                                             \
    void solve##S(const PatchRange<S>& range, const PatchPass& pass) {            \
        solveAll(range, pass);                                                    \
    }                                                                             \
    void bounces##S(const PatchRange<S>& range, const PatchPass& pass) {          \
        prepareAllBounces(range, pass);                                           \
    }                                                                             \
    void distribute##S(const PatchRange<S>& range) {                              \
        distributeAll(range);                                                     \
    }
RIGOR_KERNELS(Space2f)
RIGOR_KERNELS(Space3f)
#undef RIGOR_KERNELS
const char* targetName() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigor::engine {

#define RIGOR_DISPATCH(S)                                                                \
    HWY_EXPORT(prepare##S);                                                              \
    HWY_EXPORT(warmStart##S);                                                            \
    HWY_EXPORT(solve##S);                                                                \
    HWY_EXPORT(bounces##S);                                                              \
    HWY_EXPORT(distribute##S);                                                           \
    template <>                                                                          \
    void preparePatches<S>(const PatchRange<S>& range, const PatchInertia<S>* inertia) { \
        HWY_DYNAMIC_DISPATCH(prepare##S)(range, inertia);                                \
    }                                                                                    \
    template <>                                                                          \
    void warmStartPatches<S>(const PatchRange<S>& range) {                               \
        HWY_DYNAMIC_DISPATCH(warmStart##S)(range);                                       \
    }                                                                                    \
    template <>                                                                          \
    void solvePatches<S>(const PatchRange<S>& range, const PatchPass& pass) {            \
        HWY_DYNAMIC_DISPATCH(solve##S)(range, pass);                                     \
    }                                                                                    \
    template <>                                                                          \
    void prepareBounces<S>(const PatchRange<S>& range, const PatchPass& pass) {          \
        HWY_DYNAMIC_DISPATCH(bounces##S)(range, pass);                                   \
    }                                                                                    \
    template <>                                                                          \
    void distributeFriction<S>(const PatchRange<S>& range) {                             \
        HWY_DYNAMIC_DISPATCH(distribute##S)(range);                                      \
    }
RIGOR_DISPATCH(Space2f)
RIGOR_DISPATCH(Space3f)
#undef RIGOR_DISPATCH

HWY_EXPORT(targetName);
const char* simdTarget() {
    return HWY_DYNAMIC_DISPATCH(targetName)();
}

}  // namespace rigor::engine
#endif
