// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Child processes with limits, a few at a time, from one thread. Each child leads its own process group, has
// no core dump and no input, and dies with this process, however this process ends. What it started dies with it.
//
// Two ends of a child say nothing about its work. If the environment failed (no space, no permission, no file
// handles: kExitEnvironment), run() throws. A child that was killed from outside is started again, up to
// kMostStarts times.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "validation/runner/fork_server.hpp"
#include "validation/runner/kept_guests.hpp"
#include "validation/runner/time_limit.hpp"

namespace rigor::validation {

struct ProcessLimits {
    /// Time of a child (TimeLimit); then the group is killed.
    double seconds = 60.0;
    std::size_t memoryMiB =
        0;  ///< address space; 0: none. It is not set in sanitizer builds, which reserve terabytes.
};

inline constexpr int kMostStarts = 3;

struct ProcessResult {
    bool timedOut = false;
    int status = 0;          ///< status as of waitpid
    std::string outputTail;  ///< last few KiB of stdout and stderr together
    double wallSeconds = 0.0, cpuSeconds = 0.0;
    std::int64_t peakMemoryKiB = 0;
    /// Not empty if every attempt was killed from outside: then nothing is known of the work.
    std::string disturbance;
    bool hadLentGuest = false;  ///< its engine was a guest that had served others before, or may

    bool exitedWith(int code) const;
    /// "SIGSEGV (Segmentation fault)", "exit code 3".
    std::string ending() const;
};

struct ProcessTask {
    /// The first is the program's file. None: nothing is run, `done` is called when it is the task's turn.
    std::vector<std::string> arguments;
    ProcessLimits limits;
    std::string name;                                ///< name for the progress line
    std::function<void(const ProcessResult&)> done;  ///< called at the end; may add tasks
    /// True if `done` takes a result with a disturbance; otherwise run() throws.
    bool mayBeDisturbed = false;
    int starts = 0;       ///< number of times that it was started
    int outOfMemory = 0;  ///< number of these that ended while the system killed a process for want of memory
    std::function<void()> begin{};  ///< called before every start: writes what the child reads
    std::string
        guest{};  ///< engine that it uses, which is lent to it if it is a guest that is kept; "": none
    /// It may be forked from a process that has loaded this module (kNoModule: none), instead of being started. Then
    /// the first of the arguments is this program.
    std::optional<std::filesystem::path> module{};
};

class ProcessPool {
  public:
    explicit ProcessPool(int slots);
    ~ProcessPool();
    ProcessPool(const ProcessPool&) = delete;
    ProcessPool& operator=(const ProcessPool&) = delete;

    /// Keeps guests for the tasks that name one. `memoryMiB`: limit of a guest's memory; 0: none.
    void keepGuests(std::size_t memoryMiB) { guests_ = std::make_unique<KeptGuests>(memoryMiB); }

    void add(ProcessTask task) { waiting_.push_back(std::move(task)); }
    /// Adds a task before all waiting ones.
    void addNext(ProcessTask task) { waiting_.push_front(std::move(task)); }

    /// Runs until nothing is left (true), or until `interrupted` (false; all children are dead then).
    /// `onStart` is called when a child was started. Throws results::EnvironmentError when none can be started, and
    /// when the environment of a child failed; all children are dead then.
    bool run(const std::atomic<bool>& interrupted, const std::function<void(const std::string&)>& onStart);

  private:
    using Clock = std::chrono::steady_clock;
    struct Running {
        ProcessTask task;
        pid_t pid = -1;
        int output = -1;
        Clock::time_point started, deadline;
        TimeLimit limit{0.0};
        std::int64_t memoryKills = 0;  ///< number of kills by the system before its start
        ProcessResult result;
        std::optional<KeptGuests::Loan> loan;
    };
    void start(ProcessTask task);
    pid_t startChild(const ProcessTask& task, int output, const std::optional<KeptGuests::Loan>& loan);
    void waitForEvents();
    bool collect(Running& child);
    static bool isOverTime(Running& child);
    void returnGuest(Running& child, bool isClean);
    void settle(Running ended);
    void runAll(const std::atomic<bool>& interrupted, const std::function<void(const std::string&)>& onStart);
    void killAll();

    int slots_;
    std::deque<ProcessTask> waiting_;
    std::deque<Running> running_;
    std::unique_ptr<KeptGuests> guests_;
    ForkServers servers_;
};

/// Processor time of a process and its threads so far [s]; negative where it is not known.
double processorTimeOf(pid_t pid);

/// Factor on time limits: sanitizer builds are that much slower.
double timeLimitFactor();

}  // namespace rigor::validation
