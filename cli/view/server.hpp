// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A site on 127.0.0.1, behind an authorisation guard.
#pragma once

#include <memory>
#include <string>

#include "cli/view/gate.hpp"
#include "cli/view/site.hpp"

namespace rigor::view {

class Server {
  public:
    /// Listens on `port` of 127.0.0.1 alone; 0: any that is free. Throws std::runtime_error. The site has to
    /// live longer.
    Server(Site& site, int port, const GateLimits& limits = {});
    /// Stops; responses that are under way have two seconds.
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    int port() const;
    /// The link that lets one browser in, once.
    std::string url() const;
    /// Makes a new link, and ends the session of the browser that came by the old one.
    void renew();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rigor::view
