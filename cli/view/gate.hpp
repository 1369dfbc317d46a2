// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Who is let in. The server listens on the loopback interface, which every program and every page of every
// browser on this machine can reach. So:
//     Host      has to be 127.0.0.1:PORT or localhost:PORT, or a foreign name that was made to point here
//               (DNS rebinding) would be as good as ours
//     token     of the printed URL, good once: it is exchanged for a session cookie (HttpOnly,
//     SameSite=Strict) cookie    everything else needs it Origin    of what changes something has to be ours,
//     and its content JSON; what a browser says to come
//               from another site is refused (Sec-Fetch-Site; other ports of this host are the same site for
//               cookies, not for us)
#pragma once

#include <mutex>
#include <string>

namespace rigor::view {

/// What of a request is looked at; "" where a header is absent.
struct Knock {
    std::string method, path, host, origin, cookie, contentType, fetchSite;
    std::string token;  ///< of the query
    int hosts = 1;      ///< number of Host headers
};

struct Decision {
    enum class Kind { Enter, Welcome, Refuse } kind = Kind::Refuse;
    int status = 403;       ///< Refuse
    std::string reason;     ///< Refuse
    std::string setCookie;  ///< Welcome: the Set-Cookie of a redirection to "/"
};

class Gate {
  public:
    /// Draws token and session from the system's random numbers. Throws std::runtime_error.
    explicit Gate(int port);

    const std::string& token() const { return token_; }
    Decision judge(const Knock& knock);

  private:
    bool isOurHost(const std::string& host) const;
    bool hasCookie(const std::string& header) const;

    std::string port_, token_, session_, cookieName_;
    std::mutex spending_;
    bool spent_ = false;
};

}  // namespace rigor::view
