// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/start_program.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

#include "validation/results/files.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/descendants.hpp"

namespace rigor::validation {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

/// The environment of a child, whose process id is known only after the fork.
class ChildEnvironment {
  public:
    explicit ChildEnvironment(const std::string& variable)
        : variable_(variable), name_(std::string(kAncestorVariable) + "=") {
        mark_ = name_ + ancestorMark(getpid(), 0);
        for (char** entry = environ; *entry != nullptr; ++entry)
            if (!std::string_view(*entry).starts_with(name_)) entries_.push_back(*entry);
        if (!variable_.empty()) entries_.push_back(variable_.data());
        entries_.push_back(mark_.data());
        entries_.push_back(nullptr);
    }
    /// Safe between fork and exec.
    char* const* of(pid_t self) {
        setMarkedChild(mark_.data() + name_.size(), self);
        return entries_.data();
    }

  private:
    std::string variable_, name_, mark_;
    std::vector<char*> entries_;
};

/// Runs between fork and exec, with calls only that are safe there.
[[noreturn]] void becomeProgram(char* const* argv, ChildEnvironment& environment, int output, pid_t parent,
                                std::size_t memoryMiB, const std::vector<int>& keepOpen) {
    settleChild(parent, memoryMiB);
    const int null = open("/dev/null", O_RDONLY);
    if (null >= 0) dup2(null, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    for (const int file : keepOpen) fcntl(file, F_SETFD, 0);
    execve(argv[0], argv, environment.of(getpid()));
    const int code = errno;
    const char* const message[] = {kEnvironmentMark, argv[0], ": cannot be run: ", strerrordesc_np(code),
                                   "\n"};
    for (const char* text : message)
        if (text != nullptr) (void)!write(STDERR_FILENO, text, std::strlen(text));
    _exit(kExitEnvironment);
}

}  // namespace

bool isSanitized() {
    return kSanitized;
}

void settleChild(pid_t parent, std::size_t memoryMiB) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kExitEnvironment);  // it died before prctl took effect
    struct rlimit none {};
    setrlimit(RLIMIT_CORE, &none);
    if (memoryMiB > 0) {
        // The hard limit stays: an engine's own process may need addresses that it does not use.
        struct rlimit limit {};
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = std::min<rlim_t>(memoryMiB << 20, limit.rlim_max);
        setrlimit(RLIMIT_AS, &limit);
    }
}

pid_t startProgram(const std::vector<std::string>& arguments, int output, std::size_t memoryMiB,
                   const std::vector<int>& keepOpen, const std::string& variable) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const pid_t self = getpid();
    ChildEnvironment environment(variable);
    const std::size_t memory = kSanitized ? 0 : memoryMiB;
    const pid_t pid = fork();
    if (pid == 0) becomeProgram(argv.data(), environment, output, self, memory, keepOpen);
    if (pid < 0) throw results::EnvironmentError("fork: " + results::errorText(errno));
    setpgid(pid, pid);  // called in parent and child, whichever comes first
    return pid;
}

bool drainOutput(int file, std::string& tail) {
    char buffer[4096];
    for (;;) {
        const ssize_t n = read(file, buffer, sizeof buffer);
        if (n > 0) {
            tail.append(buffer, static_cast<std::size_t>(n));
            if (tail.size() > 2 * kOutputTailBytes) tail.erase(0, tail.size() - kOutputTailBytes);
        } else if (n == 0) {
            return false;
        } else if (errno != EINTR) {
            return true;
        }
    }
}

std::string lastLine(const std::string& output) {
    const auto end = output.find_last_not_of(" \n\r");
    if (end == std::string::npos) return "";
    const auto newline = output.rfind('\n', end);
    const auto begin = newline == std::string::npos ? 0 : newline + 1;
    return output.substr(begin, end - begin + 1);
}

std::string endingOf(int status) {
    if (!WIFSIGNALED(status)) return "exit code " + std::to_string(WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    const char* name = sigabbrev_np(signal);
    return std::string("SIG") + (name != nullptr ? name : std::to_string(signal).c_str()) + " (" +
           strsignal(signal) + ")";
}

}  // namespace rigor::validation
