// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The kernels are compiled once for every instruction set (hwy/foreach_target.h includes this file again).
#include "engine/integrators/motion_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/integrators/motion_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/integrators/motion_kernels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace rigor::engine::HWY_NAMESPACE {

#define RIGOR_MOVE(S)                                                                                       \
    void move##S(const BodyBlock* blocks, std::size_t count, Pose<S>* poses, const Velocity<S>* velocities, \
                 S::Real h) {                                                                               \
        moveAll(blocks, count, poses, velocities, h);                                                       \
    }
#define RIGOR_TUMBLE(S)                                                                     \
    void predict##S(TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses,      \
                    Velocity<S>* velocities, S::Real h) {                                   \
        predictAll(blocks, count, poses, velocities, h);                                    \
    }                                                                                       \
    void finish##S(const TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses, \
                   Velocity<S>* velocities) {                                               \
        finishAll(blocks, count, poses, velocities);                                        \
    }
RIGOR_FOR_ALL_SPACES(RIGOR_MOVE)
RIGOR_TUMBLE(Space3f)
RIGOR_TUMBLE(Space3d)
#undef RIGOR_MOVE
#undef RIGOR_TUMBLE

}  // namespace rigor::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rigor::engine {

#define RIGOR_MOVE(S)                                                              \
    HWY_EXPORT(move##S);                                                           \
    template <>                                                                    \
    void moveBodies<S>(const BodyBlock* blocks, std::size_t count, Pose<S>* poses, \
                       const Velocity<S>* velocities, S::Real h) {                 \
        HWY_DYNAMIC_DISPATCH(move##S)(blocks, count, poses, velocities, h);        \
    }
#define RIGOR_TUMBLE(S)                                                                             \
    HWY_EXPORT(predict##S);                                                                         \
    HWY_EXPORT(finish##S);                                                                          \
    template <>                                                                                     \
    void predictTumbling<S>(TumblingBlock<S> * blocks, std::size_t count, const Pose<S>* poses,     \
                            Velocity<S>* velocities, S::Real h) {                                   \
        HWY_DYNAMIC_DISPATCH(predict##S)(blocks, count, poses, velocities, h);                      \
    }                                                                                               \
    template <>                                                                                     \
    void finishTumbling<S>(const TumblingBlock<S>* blocks, std::size_t count, const Pose<S>* poses, \
                           Velocity<S>* velocities) {                                               \
        HWY_DYNAMIC_DISPATCH(finish##S)(blocks, count, poses, velocities);                          \
    }
RIGOR_FOR_ALL_SPACES(RIGOR_MOVE)
RIGOR_TUMBLE(Space3f)
RIGOR_TUMBLE(Space3d)
#undef RIGOR_MOVE
#undef RIGOR_TUMBLE

}  // namespace rigor::engine
#endif
