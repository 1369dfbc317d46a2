// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/gate.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace rigor::view {
namespace {

using std::chrono::milliseconds;
constexpr const char* kAddress = "127.0.0.1";
constexpr const char* kEndOfHead = "\r\n\r\n";
constexpr milliseconds kGoodbye{1000};  ///< time for a client to read its response and close
constexpr milliseconds kGrace{2000};    ///< time for requests that are under way when the server ends

int listenOn(int port) {
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    inet_pton(AF_INET, kAddress, &address.sin_addr);
    if (file >= 0 && bind(file, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
        listen(file, SOMAXCONN) == 0)
        return file;
    const std::string why = std::strerror(errno);
    if (file >= 0) close(file);
    throw std::runtime_error("cannot listen on " + std::string(kAddress) + " port " + std::to_string(port) +
                             ": " + why);
}

int portOf(int file) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(file, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
}

bool hasHead(const Connection& connection) {
    return connection.received.find(kEndOfHead) != std::string::npos;
}

}  // namespace

Connection::~Connection() {
    if (socket >= 0) close(socket);
}

// A port that another process listens on is refused: there is no SO_REUSEPORT. One that has just been left is not taken
// again either, without SO_REUSEADDR: no server should get the requests that were meant for another.
Gate::Gate(int port, const GateLimits& limits)
    : limits_(limits), listener_(listenOn(port)), wakeUp_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    port_ = portOf(listener_);
}

Gate::~Gate() {
    stop();
    close(listener_);
    close(wakeUp_);
}

void Gate::start(Serve serve) {
    serve_ = std::move(serve);
    for (std::size_t i = 0; i < limits_.threads; ++i) workers_.emplace_back([this] { work(); });
    thread_ = std::thread([this] { run(); });
}

void Gate::stop() {
    {
        std::unique_lock lock(mutex_);
        if (stopping_) return;
        stopping_ = true;
        wake();
        changed_.notify_all();
        changed_.wait_for(lock, kGrace, [this] { return active_.empty(); });
        for (const int file : active_) shutdown(file, SHUT_RDWR);
    }
    if (thread_.joinable()) thread_.join();
    for (std::thread& worker : workers_) worker.join();
}

void Gate::wake() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = write(wakeUp_, &one, sizeof one);
}

/// Milliseconds as poll() takes them; -1: none waits.
int Gate::untilNextDeadline() const {
    if (waiting_.empty()) return -1;
    const auto next = std::min_element(waiting_.begin(), waiting_.end(), [](const Held& a, const Held& b) {
                          return a->deadline < b->deadline;
                      })->get();
    const auto left = std::chrono::ceil<milliseconds>(next->deadline - GateClock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 60000));
}

void Gate::run() {
    for (;;) {
        {
            const std::lock_guard lock(mutex_);
            if (stopping_) return;
        }
        takeReturned();
        std::vector<pollfd> files{{listener_, POLLIN, 0}, {wakeUp_, POLLIN, 0}};
        for (const Held& connection : waiting_) files.push_back({connection->socket, POLLIN, 0});
        if (poll(files.data(), files.size(), untilNextDeadline()) < 0 && errno != EINTR) return;
        std::uint64_t count = 0;
        if (files[1].revents != 0) [[maybe_unused]]
            const ssize_t taken = read(wakeUp_, &count, sizeof count);
        for (std::size_t i = 2; i < files.size(); ++i)
            if (files[i].revents != 0) receive(waiting_[i - 2]);
        const auto now = GateClock::now();
        std::erase_if(waiting_, [&](const Held& c) { return c == nullptr || c->deadline <= now; });
        if (files[0].revents != 0) accept();
    }
}

/// Closes the oldest connection that has not shown the token, if there are as many as there may be.
void Gate::makeRoom() {
    const auto isStranger = [](const Held& c) { return !c->known; };
    const auto count = std::count_if(waiting_.begin(), waiting_.end(), isStranger);
    if (static_cast<std::size_t>(count) < limits_.strangers) return;
    waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(), isStranger));
}

void Gate::accept() {
    for (;;) {
        const int file = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
        if (file < 0) {
            const bool isFull = errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM;
            if (isFull) std::this_thread::sleep_for(milliseconds(20));  // some client is about to close
            return;
        }
        const int yes = 1;
        setsockopt(file, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        makeRoom();
        waiting_.push_back(std::make_unique<Connection>(file, GateClock::now() + limits_.head));
    }
}

/// Leaves null in the place of a connection that has been closed or handed on.
void Gate::receive(Held& connection) {
    char bytes[4096];
    for (;;) {
        const ssize_t n = recv(connection->socket, bytes, sizeof bytes, 0);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
        if (n <= 0) {
            connection.reset();
            return;
        }
        if (connection->closing) continue;
        connection->received.append(bytes, static_cast<std::size_t>(n));
        if (hasHead(*connection)) {
            dispatchOrHold(std::move(connection));
            return;
        }
        if (connection->received.size() > limits_.headBytes) {
            connection.reset();
            return;
        }
    }
}

/// Hands a connection with a complete head to a worker, others to those that wait.
void Gate::dispatchOrHold(Held connection) {
    if (connection->closing || !hasHead(*connection)) {
        waiting_.push_back(std::move(connection));
        return;
    }
    const std::lock_guard lock(mutex_);
    ready_.push_back(std::move(connection));
    changed_.notify_one();
}

void Gate::takeReturned() {
    std::deque<Held> returned;
    {
        const std::lock_guard lock(mutex_);
        returned.swap(returned_);
    }
    for (Held& connection : returned) dispatchOrHold(std::move(connection));
}

void Gate::work() {
    for (;;) {
        Held connection;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return stopping_ || !ready_.empty(); });
            if (stopping_) return;
            connection = std::move(ready_.front());
            ready_.pop_front();
            active_.insert(connection->socket);
        }
        handle(std::move(connection));
    }
}

void Gate::handle(Held connection) {
    const int file = connection->socket;
    connection->deadline = GateClock::now() + limits_.request;
    const bool stays = serve_(*connection);
    connection->deadline = GateClock::now() + (connection->known ? limits_.idle : limits_.head);
    if (!stays) {
        // A socket that is closed with bytes unread takes the response with it: the client is to close first.
        shutdown(file, SHUT_WR);
        connection->closing = true;
        connection->deadline = GateClock::now() + kGoodbye;
    }
    const std::lock_guard lock(mutex_);
    active_.erase(file);
    returned_.push_back(std::move(connection));
    changed_.notify_all();
    wake();
}

}  // namespace rigor::view
