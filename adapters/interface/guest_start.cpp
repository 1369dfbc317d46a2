// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/guest_start.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace rigor::adapter {
namespace {

constexpr const char* kLentVariable = "RIGOR_LENT_GUEST";

struct Ends {
    int read = -1, write = -1;
};

Ends makePipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    return {ends[0], ends[1]};
}

/// A socket, because a write to one whose reader is gone can do without a signal.
Ends makeInput() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::runtime_error(std::string("socketpair: ") + std::strerror(errno));
    return {ends[0], ends[1]};
}

struct Start {
    std::vector<char*> argv;
    const char* folder = nullptr;
    int input = -1, output = -1, log = -1;
    pid_t parent = -1;
    bool ownGroup = false, freeAddresses = false;
    std::size_t memoryMiB = 0;
};

void limitAddresses(const Start& start) {
    struct rlimit limit {};
    getrlimit(RLIMIT_AS, &limit);
    if (start.freeAddresses)
        limit.rlim_cur = limit.rlim_max;
    else if (start.memoryMiB > 0)
        limit.rlim_cur = std::min<rlim_t>(start.memoryMiB << 20, limit.rlim_max);
    setrlimit(RLIMIT_AS, &limit);
}

/// Runs between fork and exec, with calls only that are safe there. A guest of one case stays in this process's
/// group, which is killed as a whole at the end of the case.
[[noreturn]] void becomeGuest(const Start& start) {
    if (start.ownGroup) setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != start.parent) _exit(127);  // it died before prctl took effect
    dup2(start.input, STDIN_FILENO);
    dup2(start.output, STDOUT_FILENO);
    dup2(start.log, STDERR_FILENO);
    limitAddresses(start);
    if (chdir(start.folder) == 0) execvp(start.argv[0], start.argv.data());
    const char* message = std::strerror(errno);
    (void)!write(STDERR_FILENO, message, std::strlen(message));
    _exit(127);
}

}  // namespace

GuestProcess startGuest(const GuestManifest& manifest, const std::optional<KeptStart>& kept) {
    Start start;
    std::vector<std::string> words = manifest.command;
    for (std::string& word : words) start.argv.push_back(word.data());
    start.argv.push_back(nullptr);
    start.folder = manifest.folder.c_str();
    start.parent = getpid();
    start.ownGroup = kept.has_value();
    start.freeAddresses = manifest.memory == GuestMemory::Resident;
    start.memoryMiB = kept ? kept->memoryMiB : 0;
    const Ends in = makeInput(), out = makePipe(), err = makePipe();
    start.input = in.read;
    start.output = out.write;
    start.log = err.write;
    GuestProcess guest;
    guest.pid = fork();
    if (guest.pid == 0) becomeGuest(start);
    const int failure = errno;
    for (const int end : {in.read, out.write, err.write}) close(end);
    guest.input = in.write;
    guest.output = out.read;
    guest.log = err.read;
    for (const int file : {guest.input, guest.output, guest.log}) fcntl(file, F_SETFL, O_NONBLOCK);
    if (guest.pid >= 0) return guest;
    closeStreams(guest);
    throw std::runtime_error(std::string("fork: ") + std::strerror(failure));
}

void closeStreams(GuestProcess& guest) {
    for (int* file : {&guest.input, &guest.output, &guest.log}) {
        if (*file >= 0) close(*file);
        *file = -1;
    }
}

std::string lentGuestVariable(const std::string& name, const LentGuest& guest) {
    const GuestProcess& p = guest.process;
    std::ostringstream text;
    text << kLentVariable << '=' << name << ' ' << p.pid << ' ' << p.input << ' ' << p.output << ' ' << p.log
         << ' ' << guest.worldsBefore;
    return text.str();
}

std::optional<LentGuest> takeLentGuest(const std::string& name) {
    const char* variable = std::getenv(kLentVariable);
    if (variable == nullptr) return std::nullopt;
    std::istringstream text(variable);
    std::string lent;
    LentGuest guest;
    GuestProcess& p = guest.process;
    if (!(text >> lent >> p.pid >> p.input >> p.output >> p.log >> guest.worldsBefore) || lent != name)
        return std::nullopt;
    unsetenv(kLentVariable);
    // Children of this process do not get them.
    for (const int file : {p.input, p.output, p.log}) fcntl(file, F_SETFD, FD_CLOEXEC);
    return guest;
}

}  // namespace rigor::adapter
