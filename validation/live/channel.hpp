// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Packets over a socket between a program and its child: each with its length before it.
#pragma once

#include <chrono>
#include <optional>

#include "validation/live/packet.hpp"

namespace rigor::validation {

/// One end; owned.
class Channel {
  public:
    explicit Channel(int file) : file_(file) {}
    ~Channel();
    Channel(Channel&& other) noexcept;
    Channel& operator=(Channel&& other) noexcept;

    using Clock = std::chrono::steady_clock;
    enum class Received { Packet, End, Timeout };

    /// False: the other end is gone.
    bool send(const Packet& packet);
    /// Waits for a whole packet until `deadline`. Throws std::runtime_error for what is none, or too large.
    Received receive(Packet& packet, Clock::time_point deadline);
    /// Waits for ever; nothing at the end of the stream.
    std::optional<Packet> receive();

    static constexpr std::size_t kMostBytes = std::size_t{1} << 30;

  private:
    Received read(char* bytes, std::size_t count, std::optional<Clock::time_point> deadline);
    Received receive(Packet& packet, std::optional<Clock::time_point> deadline);
    int file_;
};

/// Two connected ends, as files that are closed on exec: [0] for this process, [1] for the child. Throws
/// std::runtime_error.
std::pair<Channel, int> makeChannel();

}  // namespace rigor::validation
