// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The end of a process's time. On a busy machine a process gets a part of the clock alone, so that a limit of wall time
// would be a limit of other people's work.
#pragma once

namespace rigor::validation {

/// A limit of `seconds` of wall time, which a process that works may exceed until it has had as much processor time: it
/// is over for one that has had it, for one that is blocked, and after kMostWaiting times the limit.
class TimeLimit {
  public:
    static constexpr double kMostWaiting = 20.0;
    /// A process that has done nothing for so long [s] is blocked: on a busy machine it would have had its turn.
    static constexpr double kBlocked = 2.0;

    explicit TimeLimit(double seconds) : seconds_(seconds), workedAt_(seconds) {}

    /// `elapsed`: wall time since its start [s]; `cpu`: its processor time so far [s], negative where it is not known.
    bool isOver(double elapsed, double cpu);

  private:
    double seconds_;
    double cpuSeen_ = 0.0;  ///< processor time when it was last checked after the limit
    double workedAt_;       ///< time at which that had grown
};

}  // namespace rigor::validation
