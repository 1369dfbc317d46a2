// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Child processes with limits, a few at a time, from one thread. Each child leads its own process group, has
// no core dump and no input, and dies with this process, however this process ends.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace rigor::validation {

struct ProcessLimits {
    /// Wall time; then the group is killed, but not as long as the child works and has had less processor
    /// time than that: on a busy machine a child gets a part of the clock alone. The limit is at most
    /// kMostWaiting times as long.
    double seconds = 60.0;
    std::size_t memoryMiB =
        0;  ///< address space; 0: none. It is not set in sanitizer builds, which reserve terabytes.
};

inline constexpr double kMostWaiting = 20.0;

struct ProcessResult {
    bool timedOut = false;
    int status = 0;          ///< status as of waitpid
    std::string outputTail;  ///< last few KiB of stdout and stderr together
    double wallSeconds = 0.0, cpuSeconds = 0.0;
    std::int64_t peakMemoryKiB = 0;

    bool exitedWith(int code) const;
    /// "SIGSEGV (Segmentation fault)", "exit code 3".
    std::string ending() const;
};

struct ProcessTask {
    std::vector<std::string> arguments;  ///< the first is the program's file
    ProcessLimits limits;
    std::string name;                                ///< name for the progress line
    std::function<void(const ProcessResult&)> done;  ///< called at the end; may add tasks
};

class ProcessPool {
  public:
    explicit ProcessPool(int slots) : slots_(slots) {}
    ~ProcessPool();
    ProcessPool(const ProcessPool&) = delete;
    ProcessPool& operator=(const ProcessPool&) = delete;

    void add(ProcessTask task) { waiting_.push_back(std::move(task)); }
    /// Adds a task before all waiting ones.
    void addNext(ProcessTask task) { waiting_.push_front(std::move(task)); }

    /// Runs until nothing is left (true), or until `interrupted` (false; all children are dead then).
    /// `onStart` is called when a child was started. Throws std::runtime_error when none can be started.
    bool run(const std::atomic<bool>& interrupted, const std::function<void(const std::string&)>& onStart);

  private:
    using Clock = std::chrono::steady_clock;
    struct Running {
        ProcessTask task;
        pid_t pid = -1;
        int output = -1;
        Clock::time_point started, deadline;
        double cpuSeen = 0.0;        ///< processor time when it was last checked after the deadline [s]
        Clock::time_point workedAt;  ///< time at which that had grown
        ProcessResult result;
    };
    void start(ProcessTask task);
    void waitForEvents();
    bool collect(Running& child);
    static bool isOverTime(Running& child);
    void killAll();

    int slots_;
    std::deque<ProcessTask> waiting_;
    std::deque<Running> running_;
};

/// Factor on time limits: sanitizer builds are that much slower.
double timeLimitFactor();

}  // namespace rigor::validation
