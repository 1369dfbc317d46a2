// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "validation/runner/child.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {

InstanceProcess::InstanceProcess(const std::filesystem::path& binary, std::size_t memoryLimitMiB) {
    auto [channel, childEnd] = makeChannel();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) {
        close(childEnd);
        throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    }
    // A library that prints more than is read loses the rest, and is not held up.
    output_ = ends[0];
    try {
        pid_ = startProgram({binary.string(), "__instance", std::to_string(childEnd)}, ends[1],
                            memoryLimitMiB, {childEnd});
    } catch (...) {
        close(childEnd);
        close(ends[0]);
        close(ends[1]);
        throw;
    }
    close(childEnd);
    close(ends[1]);
    channel_ = std::make_unique<Channel>(std::move(channel));
}

InstanceProcess::~InstanceProcess() {
    kill();
    if (!ended_) (void)collect(true);
    close(output_);
}

void InstanceProcess::kill() {
    const std::lock_guard lock(killing_);
    if (pid_ > 0) ::kill(-pid_, SIGKILL);
}

/// Waits for the end of the child and says how it was.
std::string InstanceProcess::collect(bool killed) {
    int status = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (true) {
        const pid_t ended = waitpid(pid_, &status, WNOHANG);
        if (ended == pid_ || (ended < 0 && errno != EINTR)) break;
        // It may have closed its socket and go on for itself.
        if (!killed && std::chrono::steady_clock::now() > deadline) {
            kill();
            killed = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    {
        const std::lock_guard lock(killing_);
        ::kill(-pid_, SIGKILL);  // whatever it may have started
        pid_ = -1;
    }
    drainOutput(output_, tail_);
    if (WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory) return "out of memory";
    std::string ending = endingOf(status);
    if (const std::string line = lastLine(tail_); !line.empty()) ending += ": " + line;
    return ending;
}

InstanceProcess::Answer InstanceProcess::end(Answer::Kind kind, double seconds) {
    const bool late = kind == Answer::Kind::TimedOut;
    if (late) kill();
    const std::string ending = collect(late);
    char text[64];
    std::snprintf(text, sizeof text, "no response within %g s", seconds);
    ended_ = {kind, {}, "", late ? text : ending};
    return *ended_;
}

InstanceProcess::Answer InstanceProcess::send(const nlohmann::json& request, double seconds) {
    if (ended_) return *ended_;
    Packet question;
    question.header = request;
    const auto deadline =
        Channel::Clock::now() + std::chrono::duration_cast<Channel::Clock::duration>(
                                    std::chrono::duration<double>(seconds * timeLimitFactor()));
    if (!channel_->send(question)) return end(Answer::Kind::Crashed, seconds);
    Answer answer;
    const Channel::Received received = channel_->receive(answer.packet, deadline);
    drainOutput(output_, tail_);
    if (received == Channel::Received::End) return end(Answer::Kind::Crashed, seconds);
    if (received == Channel::Received::Timeout) return end(Answer::Kind::TimedOut, seconds);
    if (answer.packet.header.contains("error")) {
        answer.kind = Answer::Kind::Refused;
        answer.error = answer.packet.header["error"]["kind"];
        answer.message = answer.packet.header["error"]["message"];
    }
    return answer;
}

}  // namespace rigor::validation
