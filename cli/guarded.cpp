// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/guarded.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "adapters/interface/engine_failure.hpp"
#include "adapters/interface/types.hpp"
#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/results/files.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::cli {

namespace {

constexpr rlim_t kMemoryMiB = 4096;  ///< as of a case of `validate`

/// The child dies with this program, leaves no core dump and has the memory limit of a case.
void limitChild(pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kInternal);
    const struct rlimit none {};
    setrlimit(RLIMIT_CORE, &none);
    // The hard limit stays: a guest's own process may need addresses that it does not use.
    struct rlimit memory {};
    getrlimit(RLIMIT_AS, &memory);
    memory.rlim_cur = std::min<rlim_t>(kMemoryMiB << 20, memory.rlim_max);
    if (!validation::isSanitized()) setrlimit(RLIMIT_AS, &memory);
}

int saysOverTime(const std::string& scenario) {
    std::fprintf(stderr, "rigor: %s: no end within its time limit; --set time_limit=SECONDS gives it more\n",
                 scenario.c_str());
    return kCrashed;
}

/// A pipe that is full waits for its reader, and so does who writes to it.
bool isRead(int file) {
    pollfd output{file, POLLOUT, 0};
    return poll(&output, 1, 0) != 0;
}

/// The limit that a child has set itself by limitTime.
std::optional<validation::TimeLimit> limitOf(pid_t child) {
    struct rlimit own {
    }, limit{};
    getrlimit(RLIMIT_CPU, &own);
    if (prlimit(child, RLIMIT_CPU, nullptr, &limit) != 0 || limit.rlim_cur == own.rlim_cur)
        return std::nullopt;
    return validation::TimeLimit(static_cast<double>(limit.rlim_cur));
}

/// Waits for the end of a child, and gives its status. Empty if its time was over, and it was killed. No time counts in
/// which its output was not read, or in which this process was stopped.
std::optional<int> endOf(pid_t child) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kLook{250};
    constexpr double kMostBetween = 1.0;  ///< [s]; this process was stopped, or had no turn, if it is more
    const auto handle = static_cast<int>(
        syscall(SYS_pidfd_open, child, 0));  // Without one the end is noticed a moment later.
    std::optional<validation::TimeLimit> limit;
    double elapsed = 0.0;
    bool isOver = false;
    for (auto last = Clock::now();;) {
        pollfd end{handle, POLLIN, 0};
        poll(&end, 1, static_cast<int>(kLook.count()));
        int status = 0;
        if (waitpid(child, &status, WNOHANG) == child) {
            if (handle >= 0) close(handle);
            return isOver ? std::nullopt : std::optional(status);
        }
        const auto now = Clock::now();
        const double gap = std::chrono::duration<double>(now - std::exchange(last, now)).count();
        if (!isRead(STDOUT_FILENO) || !isRead(STDERR_FILENO)) continue;
        elapsed += limit ? std::min(gap, kMostBetween) : 0.0;
        if (!limit) limit = limitOf(child);
        if (limit && !isOver && limit->isOver(elapsed, validation::processorTimeOf(child))) {
            isOver = true;
            kill(child, SIGKILL);
        }
    }
}

/// Ends of a child about which its signal says enough; empty for a crash.
std::optional<int> knownEnding(int signal, const std::string& scenario,
                               const validation::ReferenceLimits& limits) {
    if (signal == SIGINT) return kInterrupted;
    if (signal == SIGPIPE) return 128 + SIGPIPE;  // the reader of the output has closed the pipe
    if (signal == SIGALRM) {
        const auto why = validation::referenceFailure(true, SIGALRM, limits);
        std::fprintf(stderr, "rigor: %s: %s\n", scenario.c_str(), why.text().c_str());
        return kNoReference;
    }
    if (signal == SIGXCPU) return saysOverTime(scenario);
    if (signal == SIGKILL || signal == SIGTERM || signal == SIGHUP) {
        std::fprintf(stderr, "rigor: %s: killed from outside: %s\n", scenario.c_str(), strsignal(signal));
        return kEnvironment;
    }
    return std::nullopt;
}

}  // namespace

void limitTime(double seconds) {
    const auto whole = static_cast<rlim_t>(std::ceil(seconds * validation::timeLimitFactor()));
    const struct rlimit limit { whole, whole + 1 };
    setrlimit(RLIMIT_CPU, &limit);
}

int runGuarded(const std::string& engine, const std::string& scenario,
               const validation::ReferenceLimits& limits, const std::function<int()>& work) {
    std::fflush(nullptr);
    int finished[2];  // the child writes a byte when it got to its end: a library may call exit()
    if (pipe(finished) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    const pid_t self = getpid(), child = fork();
    if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
    if (child == 0) {
        int code = kInternal;
        limitChild(self);
        try {
            code = work();
        } catch (const scenario::LoadError& error) {
            printProblems(error, false);
            code = kBadInput;
        } catch (const adapter::Unsupported& error) {
            say(std::string("unsupported: ") + error.what());
            code = kUnsupported;
        } catch (const adapter::EngineFailure& error) {
            say(engine + " failed in " + scenario + ": " + error.what());
            code = kCrashed;
        } catch (const std::logic_error& error) {
            say(error.what());
            code = kBadInput;
        } catch (const adapter::BadInput& error) {
            say(error.what());
            code = kBadInput;
        } catch (const results::EnvironmentError& error) {
            say(error.what());
            code = kEnvironment;
        } catch (const std::exception& error) {
            say(std::string("internal error: ") + error.what());
        }
        code = withOutputWritten(code);
        std::fflush(nullptr);
        const bool reported = write(finished[1], "x", 1) == 1;
        _exit(reported ? code : kInternal);
    }
    close(finished[1]);
    const std::optional<int> end = endOf(child);
    char byte = 0;
    const bool reachedEnd = end && read(finished[0], &byte, 1) == 1;
    close(finished[0]);
    if (!end) return saysOverTime(scenario);
    const int status = *end;
    if (WIFEXITED(status) && reachedEnd) return WEXITSTATUS(status);
    if (WIFEXITED(status)) {
        std::fprintf(stderr, "rigor: %s crashed in %s: it ended the process with exit code %d\n",
                     engine.c_str(), scenario.c_str(), WEXITSTATUS(status));
        return kCrashed;
    }
    const int signal = WTERMSIG(status);
    if (const auto code = knownEnding(signal, scenario, limits)) return *code;
    std::fprintf(stderr, "rigor: %s crashed in %s: %s\n", engine.c_str(), scenario.c_str(),
                 strsignal(signal));
    return kCrashed;
}

}  // namespace rigor::cli
