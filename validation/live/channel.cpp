// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/channel.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace rigor::validation {

Channel::~Channel() {
    if (file_ >= 0) close(file_);
}
Channel::Channel(Channel&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
Channel& Channel::operator=(Channel&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
}

bool Channel::send(const Packet& packet) {
    const std::string bytes = packet.encode();
    const std::uint64_t length = bytes.size();
    std::string all(reinterpret_cast<const char*>(&length), sizeof length);
    all += bytes;
    for (std::size_t sent = 0; sent < all.size();) {
        const ssize_t n = ::send(file_, all.data() + sent, all.size() - sent, MSG_NOSIGNAL);
        if (n > 0)
            sent += n;
        else if (errno != EINTR)
            return false;
    }
    return true;
}

Channel::Received Channel::read(char* bytes, std::size_t count, std::optional<Clock::time_point> deadline) {
    for (std::size_t got = 0; got < count;) {
        if (deadline) {
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(*deadline - Clock::now());
            pollfd waiting{file_, POLLIN, 0};
            const int ready = poll(&waiting, 1, std::max<long>(0, left.count()));
            if (ready == 0) return Received::Timeout;
            if (ready < 0 && errno == EINTR) continue;
        }
        const ssize_t n = recv(file_, bytes + got, count - got, 0);
        if (n > 0)
            got += n;
        else if (n == 0 || errno != EINTR)
            return Received::End;
    }
    return Received::Packet;
}

Channel::Received Channel::receive(Packet& packet, std::optional<Clock::time_point> deadline) {
    std::uint64_t length = 0;
    if (const auto got = read(reinterpret_cast<char*>(&length), sizeof length, deadline);
        got != Received::Packet)
        return got;
    if (length > kMostBytes) throw std::runtime_error("packet: too large");
    std::string bytes(length, '\0');
    if (const auto got = read(bytes.data(), bytes.size(), deadline); got != Received::Packet) return got;
    packet = Packet::decode(bytes);
    return Received::Packet;
}

Channel::Received Channel::receive(Packet& packet, Clock::time_point deadline) {
    return receive(packet, std::optional(deadline));
}

std::optional<Packet> Channel::receive() {
    Packet packet;
    if (receive(packet, std::optional<Clock::time_point>{}) != Received::Packet) return std::nullopt;
    return packet;
}

std::pair<Channel, int> makeChannel() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::runtime_error(std::string("socketpair: ") + std::strerror(errno));
    return {Channel(ends[0]), ends[1]};
}

}  // namespace rigor::validation
