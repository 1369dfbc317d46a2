// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A connection as the HTTP library reads and writes it: every call ends by the deadline of the request.
#pragma once

#include <httplib.h>

#include "cli/view/gate.hpp"

namespace rigor::view {

class RequestStream final : public httplib::Stream {
  public:
    explicit RequestStream(Connection& connection) : connection_(connection) {}
    /// Removes the bytes that were read from those that the connection has received.
    ~RequestStream() override { connection_.received.erase(0, used_); }

    bool is_readable() const override;
    bool is_writable() const override;
    ssize_t read(char* to, size_t size) override;
    ssize_t write(const char* from, size_t size) override;
    void get_remote_ip_and_port(std::string& ip, int& port) const override;
    void get_local_ip_and_port(std::string& ip, int& port) const override;
    socket_t socket() const override { return connection_.socket; }
    /// True if a call has met the deadline or the end of the connection. The HTTP library goes on after that.
    bool hasEnded() const { return ended_; }

  private:
    bool waitFor(short event) const;

    Connection& connection_;
    std::size_t used_ = 0;
    bool ended_ = false;
};

}  // namespace rigor::view
