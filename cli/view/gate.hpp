// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The connections of the server. Every process of this machine can connect, so that nothing may depend on how a client
// behaves that has not shown the token: one thread waits for the heads of all requests, and a request gets a thread of its
// own when its head is complete. A client that sends a byte a second costs a file handle, for a few seconds.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_set>
#include <vector>

namespace rigor::view {

struct GateLimits {
    std::chrono::milliseconds head{
        5000};  ///< time from the connection, or its last response, to a complete head
    std::chrono::milliseconds idle{15000};     ///< the same for a client that has shown the token
    std::chrono::milliseconds request{45000};  ///< a request from its head to the end of its response
    std::size_t strangers =
        64;  ///< connections that have not shown the token; beyond it the oldest is closed
    std::size_t headBytes = 32 << 10;
    std::size_t threads = 16;  ///< requests at a time; each that waits for frames takes one
};

using GateClock = std::chrono::steady_clock;

struct Connection {
    int socket = -1;
    std::string received;  ///< bytes that no request has used yet
    bool known = false;    ///< its last request was allowed
    bool closing = false;  ///< the response has been sent; the client closes
    GateClock::time_point deadline;

    Connection(int s, GateClock::time_point end) : socket(s), deadline(end) {}
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
};

class Gate {
  public:
    /// Answers the request whose head `received` begins with, by the deadline of the connection, and sets `known`. True:
    /// the connection may stay open. Called from several threads.
    using Serve = std::function<bool(Connection&)>;

    /// Listens on `port` of 127.0.0.1 alone; 0: any that is free. Throws std::runtime_error.
    Gate(int port, const GateLimits& limits);
    /// Ends: requests under way have two seconds.
    ~Gate();
    int port() const { return port_; }
    void start(Serve serve);
    void stop();

  private:
    using Held = std::unique_ptr<Connection>;

    void run();
    void accept();
    void makeRoom();
    void takeReturned();
    void receive(Held& connection);
    void dispatchOrHold(Held connection);
    void work();
    void handle(Held connection);
    void wake() const;
    int untilNextDeadline() const;

    GateLimits limits_;
    Serve serve_;
    int port_ = 0, listener_ = -1, wakeUp_ = -1;
    std::vector<Held> waiting_;  ///< connections by age, which only thread_ uses

    std::mutex mutex_;  ///< guards all below
    std::condition_variable changed_;
    std::deque<Held> ready_, returned_;
    std::unordered_set<int> active_;  ///< sockets of requests under way
    bool stopping_ = false;

    std::thread thread_;
    std::vector<std::thread> workers_;
};

}  // namespace rigor::view
