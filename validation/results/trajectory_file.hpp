// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One HDF5 file per case: /time, /bodies/<name>/{position,orientation,velocity,angular_velocity},
// /reference/<name>/{...}, /series/<name>/<subject> ("_" for the whole scene), /contacts/...; every dataset
// has a `unit` attribute. README.md has the whole list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rigor::results {

/// Row-major samples x columns.
struct Channel {
    std::string unit;
    int columns = 0;
    std::vector<double> values;
};

struct BodyChannels {
    std::string name;
    Channel position, orientation, velocity,
        angularVelocity;  ///< 3 [m], 4 [1] w x y z, 3 [m/s], 3 [rad/s]; empty: none
};

struct SeriesChannel {
    std::string name, subject;
    Channel channel;  ///< one column
};

/// A contact belongs to the poses of the frame at `time`, at which its step began or ended (contactsAtStepEnd).
struct ContactSample {
    double time = 0.0;
    int bodyA = 0, bodyB = 0, shapeA = 0, shapeB = 0;
    double pointA[3] = {}, pointB[3] = {}, normal[3] = {};
    double depth = 0.0;
    double normalImpulse = 0.0;  ///< NaN if the engine does not report it
    double frictionImpulse[3] = {};
};

struct TrajectoryFile {
    std::string scenario, spec, caseId;
    double dt = 0.0;
    int stride = 1;         ///< steps between frames
    int contactStride = 1;  ///< frames between those whose contacts are stored: frame 0 and every n-th
    std::vector<double> times;
    std::vector<BodyChannels> bodies;  ///< all bodies, in scenario order
    std::vector<BodyChannels>
        reference;  ///< exact states of the bodies that the reference knows; NaN where unknown
    std::vector<SeriesChannel> series;
    std::vector<ContactSample> contacts;  ///< contacts in time order
    /// False for a file of before format 3: its contacts stand at the frame after their step, and what poses
    /// they belong to is not known.
    bool contactInstantsKnown = true;
    /// False: contacts stand at the frame at which their step began; true: at which it ended.
    bool contactsAtStepEnd = false;
};

/// Throws std::runtime_error if a body lacks a channel. Those that a file has fit its frames: reading checks that.
void requireStates(const TrajectoryFile& file);

/// True if the contacts of the step that begins, or ends, at this frame are stored; the last frame begins none, and the
/// first one ends none.
bool contactsStored(const TrajectoryFile& file, std::size_t frame);

/// Replaces `file` at once: it is the old one or the whole new one, never a part. A line with a checksum follows the
/// HDF5 content (files.hpp: sealed). Data read from an older format without instants of contacts are written in that
/// format again. Throws EnvironmentError for what the disk refuses, otherwise std::runtime_error.
void writeTrajectory(const std::filesystem::path& file, const TrajectoryFile& data);
/// Throws EnvironmentError naming the file when it is missing, damaged, or no trajectory. The checksum is compared
/// before the content is interpreted; a file without one is first tried in a child. `withContacts` false leaves
/// contacts empty.
TrajectoryFile readTrajectory(const std::filesystem::path& file, bool withContacts = true);
/// The HDF5 content of a trajectory file, without its seal. The library may crash on bytes that it has not written.
/// Throws std::runtime_error where its parts do not fit together.
TrajectoryFile parseTrajectory(const std::string& bytes, bool withContacts = true);
/// Reason why a trajectory is not to be trusted (missing, damaged, unreadable), naming the file; "" if it is whole.
std::string trajectoryProblem(const std::filesystem::path& file);

}  // namespace rigor::results
