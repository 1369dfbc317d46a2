// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>

namespace rigor::guest {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kLogTail = 2000;  ///< bytes of the log that a message may quote
constexpr auto kMemoryCheck = std::chrono::milliseconds(100);
constexpr auto kGrace = std::chrono::milliseconds(300);  ///< time to end by itself, once its input has ended

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
    bool freeAddresses = false;
};

/// Runs between fork and exec, with calls only that are safe there. The guest stays in this process's group, which
/// is killed as a whole at the end of a case.
[[noreturn]] void becomeGuest(const Start& start) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != start.parent) _exit(127);  // it died before prctl took effect
    dup2(start.input, STDIN_FILENO);
    dup2(start.output, STDOUT_FILENO);
    dup2(start.log, STDERR_FILENO);
    if (start.freeAddresses) {
        struct rlimit limit {};
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_AS, &limit);
    }
    if (chdir(start.folder) == 0) execvp(start.argv[0], start.argv.data());
    const char* message = std::strerror(errno);
    (void)!write(STDERR_FILENO, message, std::strlen(message));
    _exit(127);
}

/// The limit of this process's addresses [KiB], which is a case's limit of memory; 0: none.
std::size_t addressLimitKiB() {
    struct rlimit limit {};
    getrlimit(RLIMIT_AS, &limit);
    return limit.rlim_cur == RLIM_INFINITY ? 0 : limit.rlim_cur >> 10;
}

std::size_t residentKiB(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
    std::size_t size = 0, resident = 0;
    file >> size >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / 1024;
}

void closeFile(int& file) {
    if (file >= 0) close(file);
    file = -1;
}

std::string shownSeconds(double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + " s";
}

std::string endingOf(int status) {
    if (!WIFSIGNALED(status)) return "exit code " + std::to_string(WEXITSTATUS(status));
    const char* name = sigabbrev_np(WTERMSIG(status));
    return std::string("SIG") + (name == nullptr ? std::to_string(WTERMSIG(status)) : name);
}

}  // namespace

Process::Process(const adapter::GuestManifest& manifest) : name_(manifest.name) {
    Start start;
    std::vector<std::string> words = manifest.command;
    for (std::string& word : words) start.argv.push_back(word.data());
    start.argv.push_back(nullptr);
    start.folder = manifest.folder.c_str();
    start.parent = getpid();
    start.freeAddresses = manifest.memory == adapter::GuestMemory::Resident;
    if (start.freeAddresses) mostResidentKiB_ = addressLimitKiB();
    const Ends in = makeInput(), out = makePipe(), err = makePipe();
    start.input = in.read;
    start.output = out.write;
    start.log = err.write;
    pid_ = fork();
    if (pid_ == 0) becomeGuest(start);
    close(in.read);
    close(out.write);
    close(err.write);
    input_ = in.write;
    output_ = out.read;
    log_ = err.read;
    for (const int file : {input_, output_, log_}) fcntl(file, F_SETFL, O_NONBLOCK);
    if (pid_ < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
}

Process::~Process() {
    if (pid_ > 0) {
        closeFile(input_);
        for (const auto end = Clock::now() + kGrace; Clock::now() < end;) {
            readLog();
            siginfo_t ended{};
            waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
            if (ended.si_pid == pid_) break;
            usleep(2000);
        }
    }
    kill();
    closeFile(input_);
    closeFile(output_);
    closeFile(log_);
}

void Process::kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
}

void Process::fail(Kind kind, const std::string& what) {
    readLog();
    kill();
    std::string said = logTail_.substr(0, logTail_.find_last_not_of(" \n\r") + 1);
    if (const auto start = said.size() > 400 ? said.size() - 400 : 0; start > 0)
        said = "..." + said.substr(start);
    std::replace(said.begin(), said.end(), '\n', ' ');
    throw adapter::EngineFailure(
        kind, "guest '" + name_ + "': " + what + (said.empty() ? "" : "; its log: " + said));
}

void Process::failEnded() {
    int status = 0;
    // Its output has ended: it ends, too, or has closed it and goes on.
    for (const auto end = Clock::now() + kGrace; Clock::now() < end; usleep(2000)) {
        if (waitpid(pid_, &status, WNOHANG) != pid_) continue;
        pid_ = -1;
        const std::string cut =
            reader_.pending() == 0
                ? ""
                : " within a frame, of which " + std::to_string(reader_.pending()) + " bytes came";
        fail(Kind::Died, "ended" + cut + " (" + endingOf(status) + ")");
    }
    fail(Kind::Died, "closed its output");
}

void Process::waitForEvents(bool wantsToWrite, int milliseconds) {
    pollfd files[] = {{output_, POLLIN, 0}, {log_, POLLIN, 0}, {wantsToWrite ? input_ : -1, POLLOUT, 0}};
    poll(files, 3, milliseconds);
}

void Process::writeSome(const std::string& bytes, std::size_t& sent) {
    while (sent < bytes.size()) {
        const ssize_t n = send(input_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno != EAGAIN)
            sent = bytes.size();  // it no longer reads: its end is seen at its output
        if (n < 0) return;
        sent += static_cast<std::size_t>(n);
    }
}

bool Process::readSome() {
    char buffer[65536];
    const ssize_t n = read(output_, buffer, sizeof buffer);
    if (n > 0) reader_.append(buffer, static_cast<std::size_t>(n));
    return n != 0 && (n > 0 || errno == EAGAIN || errno == EINTR);
}

/// Passes the log on to this process's own, a bounded piece at a time.
void Process::readLog() {
    char buffer[65536];
    if (log_ < 0) return;
    const ssize_t n = read(log_, buffer, sizeof buffer);
    if (n == 0) closeFile(log_);
    if (n <= 0) return;
    (void)!write(STDERR_FILENO, buffer, static_cast<std::size_t>(n));
    logTail_.append(buffer, static_cast<std::size_t>(n));
    if (logTail_.size() > kLogTail) logTail_.erase(0, logTail_.size() - kLogTail);
}

void Process::checkMemory() {
    const auto now = Clock::now();
    if (mostResidentKiB_ == 0 || now < memoryCheckAt_) return;
    memoryCheckAt_ = now + kMemoryCheck;
    if (const std::size_t has = residentKiB(pid_); has > mostResidentKiB_)
        fail(Kind::Memory, "has " + std::to_string(has >> 10) + " MiB in memory, it may have " +
                               std::to_string(mostResidentKiB_ >> 10));
}

std::optional<Frame> Process::nextFrame() {
    try {
        return reader_.next();
    } catch (const BadFrame& error) {
        fail(Kind::Protocol, error.what());
    }
}

Frame Process::exchange(const Frame& request, double seconds) {
    if (pid_ <= 0) throw adapter::EngineFailure(Kind::Died, "guest '" + name_ + "': it has ended before");
    const std::string bytes = encode(request);
    std::size_t sent = 0;
    writeSome(bytes, sent);
    const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
        checkMemory();
        if (auto frame = nextFrame()) return *std::move(frame);
        waitForEvents(sent < bytes.size(), static_cast<int>(kMemoryCheck.count()));
        writeSome(bytes, sent);
        readLog();
        if (!readSome()) failEnded();
        if (Clock::now() >= deadline) fail(Kind::Silent, "no answer within " + shownSeconds(seconds));
    }
}

}  // namespace rigor::guest
