// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The child process of an instance, seen from its parent: one request, one response, a deadline for each.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "validation/live/channel.hpp"

namespace rigor::validation {

class InstanceProcess {
  public:
    /// Starts `binary __instance`. The child dies with the thread that calls this. Throws std::runtime_error.
    InstanceProcess(const std::filesystem::path& binary, std::size_t memoryLimitMiB);
    ~InstanceProcess();
    InstanceProcess(const InstanceProcess&) = delete;
    InstanceProcess& operator=(const InstanceProcess&) = delete;

    struct Answer {
        enum class Kind { Done, Refused, Crashed, TimedOut };
        Kind kind = Kind::Done;
        Packet packet;
        std::string error;    ///< Refused: "unsupported", "bad_input", "error"
        std::string message;  ///< reason if it is not Done
    };
    /// Sends a request and waits for the response, at most `seconds`. Once the child has crashed or timed out
    /// it is gone, and every response reports that.
    Answer send(const nlohmann::json& request, double seconds);

    /// Ends the child, whatever it does; from any thread.
    void kill();

  private:
    Answer end(Answer::Kind kind, double seconds);
    std::string collect(bool killed);

    std::atomic<pid_t> pid_{-1};
    int output_ = -1;
    std::mutex killing_;  ///< a pid that has been waited for may belong to another process
    std::unique_ptr<Channel> channel_;
    std::string tail_;
    std::optional<Answer> ended_;
};

}  // namespace rigor::validation
