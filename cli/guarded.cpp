// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/guarded.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>

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
    if (signal == SIGXCPU) {
        std::fprintf(stderr,
                     "rigor: %s: no end within its time limit; --set time_limit=SECONDS gives it more\n",
                     scenario.c_str());
        return kCrashed;
    }
    if (signal == SIGKILL || signal == SIGTERM || signal == SIGHUP) {
        std::fprintf(stderr, "rigor: %s: killed from outside: %s\n", scenario.c_str(), strsignal(signal));
        return kEnvironment;
    }
    return std::nullopt;
}

}  // namespace

void limitProcessorTime(double seconds) {
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
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    char byte = 0;
    const bool reachedEnd = read(finished[0], &byte, 1) == 1;
    close(finished[0]);
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
