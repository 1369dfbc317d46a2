// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/process.hpp"

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>

namespace rigor::guest {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kLogTail = 2000;  ///< bytes of the log that a message may quote
/// Bytes of the log that are passed on in the time of one answer: a guest that writes without end fills no disk.
constexpr std::size_t kLogPerAnswer = 64 << 10;
constexpr auto kMemoryCheck = std::chrono::milliseconds(100);
constexpr auto kGrace = std::chrono::milliseconds(300);  ///< time to end by itself, once its input has ended

/// Processor time of a process so far [s]; negative where it is not known.
double processorTime(pid_t pid) {
    clockid_t clock = 0;
    timespec t{};
    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &t) != 0) return -1.0;
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The limit of time on an answer. On a busy machine it is extended as long as the guest works and has had less processor
/// time than the limit.
class AnswerLimit {
  public:
    AnswerLimit(pid_t pid, double seconds)
        : pid_(pid),
          seconds_(seconds),
          cpuAtStart_(processorTime(pid)),
          start_(Clock::now()),
          workedAt_(start_ +
                    std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

    bool isOver() {
        const auto now = Clock::now();
        const double waited = std::chrono::duration<double>(now - start_).count();
        if (waited < seconds_) return false;
        const double used = processorTime(pid_) - cpuAtStart_;
        if (cpuAtStart_ < 0.0 || used < 0.0 || used >= seconds_ || waited >= kMostWaiting * seconds_)
            return true;
        if (used > cpuSeen_ + 1e-3) {
            cpuSeen_ = used;
            workedAt_ = now;
        }
        return now - workedAt_ >= kBlocked;
    }

  private:
    static constexpr double kMostWaiting = 20.0;
    /// A guest that has done nothing for so long is blocked: on a busy machine it would have had its turn.
    static constexpr auto kBlocked = std::chrono::seconds(2);
    pid_t pid_;
    double seconds_, cpuAtStart_, cpuSeen_ = 0.0;
    Clock::time_point start_, workedAt_;
};

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
    if (manifest.memory == adapter::GuestMemory::Resident) mostResidentKiB_ = addressLimitKiB();
    const auto lent = adapter::takeLentGuest(manifest.name);
    isLent_ = lent.has_value();
    if (isLent_) worldsBefore_ = lent->worldsBefore;
    guest_ = isLent_ ? lent->process : adapter::startGuest(manifest);
}

Process::~Process() {
    if (!isLent_ && guest_.pid > 0) waitForEnd();
    // A guest that was lent goes on, for the next case.
    if (!isLent_) kill();
    adapter::closeStreams(guest_);
}

void Process::waitForEnd() {
    closeFile(guest_.input);
    for (const auto end = Clock::now() + kGrace; Clock::now() < end; usleep(2000)) {
        readLog();
        siginfo_t ended{};
        waitid(P_PID, static_cast<id_t>(guest_.pid), &ended, WEXITED | WNOHANG | WNOWAIT);
        if (ended.si_pid == guest_.pid) break;
    }
}

void Process::kill() {
    if (guest_.pid <= 0) return;
    ::kill(guest_.pid, SIGKILL);
    // Its parent is another process where it was lent, and has not let go of its number.
    while (!isLent_ && waitpid(guest_.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    guest_.pid = -1;
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
        if (isLent_ || waitpid(guest_.pid, &status, WNOHANG) != guest_.pid) continue;
        guest_.pid = -1;
        const std::string cut =
            reader_.pending() == 0
                ? ""
                : " within a frame, of which " + std::to_string(reader_.pending()) + " bytes came";
        fail(Kind::Died, "ended" + cut + " (" + endingOf(status) + ")");
    }
    fail(Kind::Died, "closed its output");
}

void Process::waitForEvents(bool wantsToWrite, int milliseconds) {
    pollfd files[] = {
        {guest_.output, POLLIN, 0}, {guest_.log, POLLIN, 0}, {wantsToWrite ? guest_.input : -1, POLLOUT, 0}};
    poll(files, 3, milliseconds);
}

void Process::writeSome(const std::string& bytes, std::size_t& sent) {
    while (sent < bytes.size()) {
        const ssize_t n = send(guest_.input, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno != EAGAIN)
            sent = bytes.size();  // it no longer reads: its end is seen at its output
        if (n < 0) return;
        sent += static_cast<std::size_t>(n);
    }
}

bool Process::readSome() {
    char buffer[65536];
    const ssize_t n = read(guest_.output, buffer, sizeof buffer);
    if (n > 0) reader_.append(buffer, static_cast<std::size_t>(n));
    return n != 0 && (n > 0 || errno == EAGAIN || errno == EINTR);
}

/// Passes so much of a piece of the log on to this process's own as may still be passed on, and says once where it ends.
void Process::passOn(const char* text, std::size_t size) {
    if (passedOn_ > kLogPerAnswer) return;
    const std::size_t passed = std::min(size, kLogPerAnswer - passedOn_);
    (void)!write(STDERR_FILENO, text, passed);
    passedOn_ += size;
    if (passed == size) return;
    const std::string cut = "\n[guest '" + name_ + "': its log goes on, but no more than " +
                            std::to_string(kLogPerAnswer >> 10) +
                            " KiB are passed on in the time of one answer]\n";
    (void)!write(STDERR_FILENO, cut.data(), cut.size());
}

/// Reads one piece of the log.
void Process::readLog() {
    char buffer[65536];
    if (guest_.log < 0) return;
    const ssize_t n = read(guest_.log, buffer, sizeof buffer);
    if (n == 0) closeFile(guest_.log);
    if (n <= 0) return;
    passOn(buffer, static_cast<std::size_t>(n));
    logTail_.append(buffer, static_cast<std::size_t>(n));
    if (logTail_.size() > kLogTail) logTail_.erase(0, logTail_.size() - kLogTail);
}

void Process::checkMemory() {
    const auto now = Clock::now();
    if (mostResidentKiB_ == 0 || now < memoryCheckAt_) return;
    memoryCheckAt_ = now + kMemoryCheck;
    if (const std::size_t has = residentKiB(guest_.pid); has > mostResidentKiB_)
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
    if (guest_.pid <= 0)
        throw adapter::EngineFailure(Kind::Died, "guest '" + name_ + "': it has ended before");
    const std::string bytes = encode(request);
    std::size_t sent = 0;
    passedOn_ = 0;
    writeSome(bytes, sent);
    AnswerLimit limit(guest_.pid, seconds);
    for (;;) {
        checkMemory();
        if (auto frame = nextFrame()) return *std::move(frame);
        waitForEvents(sent < bytes.size(), static_cast<int>(kMemoryCheck.count()));
        writeSome(bytes, sent);
        readLog();
        if (!readSome()) failEnded();
        if (limit.isOver()) fail(Kind::Silent, "no answer within " + shownSeconds(seconds));
    }
}

}  // namespace rigor::guest
