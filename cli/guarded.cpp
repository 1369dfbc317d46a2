// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/guarded.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>

#include "adapters/interface/types.hpp"
#include "cli/command.hpp"
#include "scenarios/loader/loader.hpp"

namespace rigor::cli {

int runGuarded(const std::string& engine, const std::string& scenario,
               const validation::ReferenceLimits& limits, const std::function<int()>& work) {
    std::fflush(nullptr);
    int finished[2];  // the child writes a byte when it got to its end: a library may call exit()
    if (pipe(finished) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
    if (child == 0) {
        int code = kInternal;
        try {
            code = work();
        } catch (const scenario::LoadError& error) {
            printProblems(error, false);
            code = kBadInput;
        } catch (const adapter::Unsupported& error) {
            std::fprintf(stderr, "rigor: unsupported: %s\n", error.what());
            code = kUnsupported;
        } catch (const std::logic_error& error) {
            std::fprintf(stderr, "rigor: %s\n", error.what());
            code = kBadInput;
        } catch (const adapter::BadInput& error) {
            std::fprintf(stderr, "rigor: %s\n", error.what());
            code = kBadInput;
        } catch (const std::exception& error) {
            std::fprintf(stderr, "rigor: internal error: %s\n", error.what());
        }
        std::cout.flush();
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
    if (signal == SIGINT) return kInterrupted;
    if (signal == SIGALRM) {
        const auto why = validation::referenceFailure(true, status, limits);
        std::fprintf(stderr, "rigor: %s: %s\n", scenario.c_str(), why.text().c_str());
        return kNoReference;
    }
    if (signal == SIGPIPE) return 128 + SIGPIPE;  // the reader of the output has closed the pipe
    std::fprintf(stderr, "rigor: %s crashed in %s: %s\n", engine.c_str(), scenario.c_str(),
                 strsignal(signal));
    return kCrashed;
}

}  // namespace rigor::cli
