// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/request_stream.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace rigor::view {
namespace {

bool isTransient(int error) {
    return error == EINTR || error == EAGAIN || error == EWOULDBLOCK;
}

}  // namespace

/// True when the socket is ready, false at the deadline.
bool RequestStream::waitFor(short event) const {
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(connection_.deadline - GateClock::now());
        if (left.count() <= 0) return false;
        pollfd file{connection_.socket, event, 0};
        const int ready = poll(&file, 1, static_cast<int>(std::min<std::int64_t>(left.count(), 60000)));
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) return false;
    }
}

bool RequestStream::is_readable() const {
    return used_ < connection_.received.size() || waitFor(POLLIN);
}

bool RequestStream::is_writable() const {
    return waitFor(POLLOUT);
}

ssize_t RequestStream::read(char* to, size_t size) {
    if (used_ < connection_.received.size()) {
        const std::size_t count = std::min(size, connection_.received.size() - used_);
        std::memcpy(to, connection_.received.data() + used_, count);
        used_ += count;
        return static_cast<ssize_t>(count);
    }
    while (waitFor(POLLIN)) {
        const ssize_t n = recv(connection_.socket, to, size, 0);
        if (n > 0) return n;
        if (n == 0 || !isTransient(errno)) break;
    }
    ended_ = true;
    return -1;
}

/// Writes all of it: the library does not try again.
ssize_t RequestStream::write(const char* from, size_t size) {
    std::size_t done = 0;
    while (done < size && waitFor(POLLOUT)) {
        const ssize_t n = send(connection_.socket, from + done, size - done, MSG_NOSIGNAL);
        if (n > 0) done += static_cast<std::size_t>(n);
        if (n < 0 && !isTransient(errno)) break;
    }
    ended_ = ended_ || done < size;
    return done < size ? -1 : static_cast<ssize_t>(size);
}

void RequestStream::get_remote_ip_and_port(std::string& ip, int& port) const {
    ip.clear();
    port = 0;
}

void RequestStream::get_local_ip_and_port(std::string& ip, int& port) const {
    ip.clear();
    port = 0;
}

}  // namespace rigor::view
