// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/trial.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>

#include "validation/results/files.hpp"

namespace rigor::results {
namespace {

constexpr unsigned kSeconds = 60;                  ///< largest files of this project take less than one
constexpr rlim_t kMemory = std::size_t{16} << 30;  ///< [bytes] sizes in a damaged file may be any number

[[noreturn]] void tryHere(const std::function<void()>& work, int report) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const struct rlimit none {};
    setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const struct rlimit memory { kMemory, kMemory };
    setrlimit(RLIMIT_AS, &memory);
#endif
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGALRM}) std::signal(signal, SIG_DFL);
    alarm(kSeconds);
    std::string message = "+";
    try {
        work();
    } catch (const std::exception& error) {
        message = std::string("-") + error.what();
    }
    const char* next = message.data();
    for (std::size_t left = message.size(); left > 0;) {
        const ssize_t n = write(report, next, left);
        if (n < 0 && errno != EINTR) break;
        if (n <= 0) continue;
        next += n;
        left -= static_cast<std::size_t>(n);
    }
    _exit(0);
}

std::string received(int report) {
    std::string message;
    char buffer[1024];
    for (;;) {
        const ssize_t n = read(report, buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return message;
        message.append(buffer, static_cast<std::size_t>(n));
    }
}

}  // namespace

std::string failureInChild(const std::function<void()>& work) {
    int ends[2];
    if (pipe(ends) != 0) throw EnvironmentError(std::string("pipe: ") + errorText(errno));
    const pid_t child = fork();
    if (child < 0) {
        const int code = errno;
        close(ends[0]);
        close(ends[1]);
        throw EnvironmentError("fork: " + errorText(code));
    }
    if (child == 0) tryHere(work, ends[1]);
    close(ends[1]);
    const std::string message = received(ends[0]);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (message.starts_with('+')) return "";
    if (message.starts_with('-')) return message.substr(1);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return "reading it does not end";
    const char* how = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "it ended the process";
    return std::string("reading it crashes the library: ") + how;
}

}  // namespace rigor::results
