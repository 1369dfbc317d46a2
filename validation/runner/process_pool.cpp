// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/process_pool.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>

#include "validation/results/files.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/descendants.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

double seconds(const timeval& t) {
    return t.tv_sec + 1e-6 * t.tv_usec;
}

/// Number of processes that the system has killed for want of memory; 0 if it does not count them.
std::int64_t memoryKillsOfSystem() {
    std::ifstream in("/proc/vmstat");
    std::string key;
    for (std::int64_t value = 0; in >> key >> value;)
        if (key == "oom_kill") return value;
    return 0;
}

/// Signals by which people, batch systems and the system itself end a process; an engine's fault raises others.
bool isFromOutside(int status) {
    if (!WIFSIGNALED(status)) return false;
    const int signal = WTERMSIG(status);
    return signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP ||
           signal == SIGQUIT;
}

/// The message of a child whose environment failed; "" for any other end.
std::string environmentFailure(const ProcessResult& result) {
    // The loader of the system ends a program so whose libraries it cannot load.
    constexpr int kExitLoader = 127;
    constexpr const char* kLoaderMessage = "error while loading shared libraries: ";
    const bool isLoader = result.exitedWith(kExitLoader);
    if (!isLoader && !result.exitedWith(kExitEnvironment)) return "";
    const std::string mark = isLoader ? kLoaderMessage : kEnvironmentMark;
    const auto at = result.outputTail.rfind(mark);
    if (at == std::string::npos) return "";
    const auto from = at + (isLoader ? 0 : mark.size());
    return result.outputTail.substr(from, result.outputTail.find('\n', from) - from);
}

}  // namespace

double processorTimeOf(pid_t pid) {
    clockid_t clock = 0;
    timespec t{};
    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &t) != 0) return -1.0;
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

double timeLimitFactor() {
    return isSanitized() ? 10.0 : 1.0;
}

bool ProcessResult::exitedWith(int code) const {
    return WIFEXITED(status) && WEXITSTATUS(status) == code;
}

std::string ProcessResult::ending() const {
    return endingOf(status);
}

ProcessPool::ProcessPool(int slots) : slots_(slots) {
    adoptOrphans();
}

ProcessPool::~ProcessPool() {
    killAll();
}

pid_t ProcessPool::startChild(const ProcessTask& task, int output,
                              const std::optional<KeptGuests::Loan>& loan) {
    if (loan) {
        const adapter::GuestProcess& guest = loan->guest.process;
        return startProgram(task.arguments, output, task.limits.memoryMiB,
                            {guest.input, guest.output, guest.log},
                            adapter::lentGuestVariable(loan->name, loan->guest));
    }
    if (task.module)
        if (const auto pid = servers_.start(*task.module, task.arguments, output, task.limits.memoryMiB))
            return *pid;
    return startProgram(task.arguments, output, task.limits.memoryMiB);
}

void ProcessPool::start(ProcessTask task) {
    if (task.begin) task.begin();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw results::EnvironmentError("pipe: " + results::errorText(errno));
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    pid_t pid = -1;
    std::optional<KeptGuests::Loan> loan;
    if (guests_ && !task.guest.empty()) loan = guests_->lend(task.guest);
    try {
        pid = startChild(task, ends[1], loan);
    } catch (...) {
        if (loan) guests_->takeBack(*std::move(loan), false);
        close(ends[0]);
        close(ends[1]);
        throw;
    }
    close(ends[1]);
    const auto now = Clock::now();
    const double limit = task.limits.seconds * timeLimitFactor();
    Running& child = running_.emplace_back();
    child.task = std::move(task);
    ++child.task.starts;
    child.memoryKills = memoryKillsOfSystem();
    child.pid = pid;
    child.output = ends[0];
    child.started = now;
    child.deadline = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
    child.limit = TimeLimit(limit);
    child.result.hadLentGuest = loan.has_value();
    child.loan = std::move(loan);
}

void ProcessPool::returnGuest(Running& child, bool isClean) {
    if (!child.loan) return;
    child.result.cpuSeconds += guests_->takeBack(*std::move(child.loan), isClean);
    child.loan.reset();
}

void ProcessPool::waitForEvents() {
    std::vector<pollfd> files;
    int milliseconds = 50;
    const auto now = Clock::now();
    for (const Running& child : running_) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(child.deadline - now).count();
        // A child beyond its time is checked every other millisecond: it may have had its processor time by
        // then.
        milliseconds = static_cast<int>(std::clamp<std::int64_t>(left, 2, milliseconds));
        if (child.output >= 0)
            files.push_back({child.output, POLLIN, 0});
        else
            milliseconds = 1;  // its output has ended: it is about to end itself
    }
    poll(files.data(), files.size(), milliseconds);
}

bool ProcessPool::isOverTime(Running& child) {
    double cpu = processorTimeOf(child.pid);
    if (cpu >= 0.0 && child.loan) cpu += KeptGuests::used(*child.loan);
    return child.limit.isOver(std::chrono::duration<double>(Clock::now() - child.started).count(), cpu);
}

/// True when the child has ended and its result is complete.
bool ProcessPool::collect(Running& child) {
    ProcessResult& result = child.result;
    if (child.output >= 0 && !drainOutput(child.output, result.outputTail)) {
        close(child.output);
        child.output = -1;
    }
    struct rusage usage {};
    const pid_t ended = wait4(child.pid, &result.status, WNOHANG, &usage);
    if (ended == 0) {
        if (!result.timedOut && isOverTime(child)) {
            result.timedOut = true;
            kill(-child.pid, SIGKILL);
        }
        return false;
    }
    kill(-child.pid, SIGKILL);  // whatever it may have started
    killDescendants(child.pid);
    if (child.output >= 0) {
        drainOutput(child.output, result.outputTail);
        close(child.output);
    }
    if (result.outputTail.size() > kOutputTailBytes)
        result.outputTail.erase(0, result.outputTail.size() - kOutputTailBytes);
    result.wallSeconds = std::chrono::duration<double>(Clock::now() - child.started).count();
    result.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.peakMemoryKiB = usage.ru_maxrss;
    returnGuest(child, !result.timedOut && result.exitedWith(0));
    return true;
}

void ProcessPool::killAll() {
    for (Running& child : running_) {
        kill(-child.pid, SIGKILL);
        kill(child.pid, SIGKILL);
        int status = 0;
        while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
        }
        killDescendants(child.pid);
        if (child.output >= 0) close(child.output);
        returnGuest(child, false);
    }
    running_.clear();
}

/// Hands over what a child gave, or starts it again.
void ProcessPool::settle(Running ended) {
    ProcessTask& task = ended.task;
    ProcessResult& result = ended.result;
    if (const std::string failure = environmentFailure(result); !failure.empty())
        throw results::EnvironmentError(failure);
    if (!result.timedOut && isFromOutside(result.status)) {
        if (memoryKillsOfSystem() > ended.memoryKills) ++task.outOfMemory;
        if (task.starts < kMostStarts) return addNext(std::move(task));
        // The system was short of memory each time: then the work itself needs too much of it.
        if (task.outOfMemory < kMostStarts)
            result.disturbance = task.name + ": killed from outside " + std::to_string(kMostStarts) +
                                 " times, the last time by " + result.ending();
    }
    if (!result.disturbance.empty() && !task.mayBeDisturbed)
        throw results::EnvironmentError(result.disturbance);
    task.done(result);
}

void ProcessPool::runAll(const std::atomic<bool>& interrupted,
                         const std::function<void(const std::string&)>& onStart) {
    while (!interrupted && (!waiting_.empty() || !running_.empty())) {
        while (!interrupted && !waiting_.empty() &&
               running_.size() < static_cast<std::size_t>(std::max(1, slots_))) {
            ProcessTask task = std::move(waiting_.front());
            waiting_.pop_front();
            if (task.arguments.empty()) {
                task.done({});
                continue;
            }
            const std::string name = task.name;
            start(std::move(task));
            onStart(name);
        }
        if (running_.empty()) continue;
        waitForEvents();
        for (std::size_t i = 0; i < running_.size();) {
            if (!collect(running_[i])) {
                ++i;
                continue;
            }
            Running ended = std::move(running_[i]);
            running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
            settle(std::move(ended));
        }
    }
}

bool ProcessPool::run(const std::atomic<bool>& interrupted,
                      const std::function<void(const std::string&)>& onStart) {
    try {
        runAll(interrupted, onStart);
    } catch (...) {
        killAll();
        throw;
    }
    if (!interrupted) return true;
    killAll();
    return false;
}

}  // namespace rigor::validation
