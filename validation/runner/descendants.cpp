// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/descendants.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

namespace rigor::validation {
namespace {

constexpr int kDigits = 10;  ///< digits of the largest process id there can be

void setDigits(char* digits, pid_t process) {
    for (int i = kDigits; i-- > 0; process /= 10) digits[i] = static_cast<char>('0' + process % 10);
}

/// Children of this process, zombies included; each thread has a list of its own.
std::vector<pid_t> ownChildren() {
    std::vector<pid_t> children;
    std::ifstream in("/proc/self/task/" + std::to_string(gettid()) + "/children");
    for (pid_t pid = 0; in >> pid;) children.push_back(pid);
    if (gettid() == getpid()) return children;
    std::ifstream main("/proc/self/task/" + std::to_string(getpid()) + "/children");
    for (pid_t pid = 0; main >> pid;) children.push_back(pid);
    return children;
}

bool descendsFrom(pid_t process, const std::string& mark) {
    std::ifstream in("/proc/" + std::to_string(process) + "/environ", std::ios::binary);
    const std::string entry = std::string(kAncestorVariable) + "=" + mark;
    // A process may end while it is read: that ends getline, where an iterator would throw.
    for (std::string variable; std::getline(in, variable, '\0');)
        if (variable == entry) return true;
    return false;
}

}  // namespace

std::string ancestorMark(pid_t parent, pid_t child) {
    std::string mark(2 * kDigits + 1, '-');
    setDigits(mark.data(), parent);
    setMarkedChild(mark.data(), child);
    return mark;
}

void setMarkedChild(char* mark, pid_t child) {
    setDigits(mark + kDigits + 1, child);
}

void adoptOrphans() {
    prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void killDescendants(pid_t child) {
    // Members of its process group, which is killed already, become children of this process with the end of their
    // parent.
    int status = 0;
    while (waitpid(-child, &status, 0) > 0) {
    }
    const std::string mark = ancestorMark(getpid(), child);
    // The children of a process that is killed here become children of this one: until there are no more.
    for (bool found = true; found;) {
        found = false;
        for (const pid_t process : ownChildren()) {
            if (!descendsFrom(process, mark)) continue;
            found = true;
            kill(process, SIGKILL);
            waitpid(process, &status, 0);
        }
    }
}

}  // namespace rigor::validation
