// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Authorisation of requests. The server listens on the loopback interface, which every program and every page
// of every browser on this machine can reach. A request is allowed if all of these hold:
//     Host            is 127.0.0.1:PORT or localhost:PORT; otherwise a foreign name that resolves to this
//                     address (DNS rebinding) would be accepted
//     token           of the printed URL: valid once, and exchanged for a session cookie (HttpOnly,
//                     SameSite=Strict)
//     cookie          is present in every other request
//     Origin          is this server and the content is JSON, for requests that change something
//     Sec-Fetch-Site  where a browser sends it, does not name another site (other ports of this host are the
//                     same site for cookies, but not for this server)
#pragma once

#include <mutex>
#include <string>

namespace rigor::view {

/// The parts of a request that the decision depends on; "" where a header is absent.
struct Credentials {
    std::string method, path, host, origin, cookie, contentType, fetchSite;
    std::string token;  ///< token of the query
    int hosts = 1;      ///< number of Host headers
};

struct Decision {
    enum class Kind { Allow, StartSession, Refuse } kind = Kind::Refuse;
    int status = 403;       ///< Refuse
    std::string reason;     ///< Refuse
    std::string setCookie;  ///< StartSession: the Set-Cookie of a redirection to "/"
};

class AuthGuard {
  public:
    /// Draws token and session from the system's random numbers. Throws std::runtime_error.
    explicit AuthGuard(int port);

    std::string token() const;
    /// Draws both again: the old link and the old cookie are good for nothing.
    void renew();
    Decision judge(const Credentials& credentials);

  private:
    bool isOurHost(const std::string& host) const;
    bool hasCookie(const std::string& header) const;

    std::string port_, cookieName_;
    mutable std::mutex mutex_;  ///< guards all below
    std::string token_, session_;
    bool spent_ = false;
};

}  // namespace rigor::view
