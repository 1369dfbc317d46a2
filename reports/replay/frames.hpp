// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames of one trajectory as compact arrays.
#pragma once

#include <cstddef>
#include <vector>

#include "reports/encoding/json.hpp"
#include "reports/replay/codec.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::report {

/// Amount of a trajectory that is kept.
struct Thinning {
    std::size_t frames;   ///< evenly spaced ones, at most; marked ones come on top
    int positionBits;     ///< quantum: scene length / 2^this
    int orientationBits;  ///< quantum: 1 / 2^this
    bool velocities;      ///< stored or not
    std::size_t
        contactEvery;  ///< contacts of every n-th kept frame, and of marked ones; 0: of marked ones alone
};

/// Arrays in the order in which they are written, and what the reader must know of them.
struct EncodedFrames {
    Bytes steps, position, orientation, velocity, angularVelocity;
    Bytes contactCounts, contactIds, contactNumbers;
    Json meta;

    std::size_t size() const {
        return steps.size() + position.size() + orientation.size() + velocity.size() +
               angularVelocity.size() + contactCounts.size() + contactIds.size() + contactNumbers.size();
    }
};

/// Evenly spaced indices of 0..frames-1, multiples of `multiple` where that leaves enough, with the first,
/// the last and the marked ones; ascending.
std::vector<std::size_t> keptFrames(std::size_t frames, std::size_t atMost, std::size_t multiple,
                                    const std::vector<std::size_t>& marked);

/// Frames `kept` of the trajectory's bodies (`ofReference`: of its reference instead, without contacts).
/// `length`: sceneLength(). Body indices are those of file.bodies.
EncodedFrames encodeFrames(const results::TrajectoryFile& file, bool ofReference, double length,
                           const std::vector<std::size_t>& kept, const std::vector<std::size_t>& marked,
                           const Thinning& thinning);

}  // namespace rigor::report
