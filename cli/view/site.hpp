// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Interface from requests to responses, without HTTP.
#pragma once

#include <map>
#include <string>

namespace rigor::view {

struct Request {
    std::string method;  ///< "GET" or "POST"
    std::string path;    ///< decoded, begins with '/'
    std::map<std::string, std::string> query;
    std::string body;

    /// A number of the query. Throws std::invalid_argument for what is none or out of range.
    double number(const std::string& key, double otherwise, double min, double max) const;
};

struct Reply {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body;
};
Reply json(const std::string& text);
Reply problem(int status, const std::string& message);  ///< response {"error": message}
Reply notFound();

class Site {
  public:
    virtual ~Site() = default;
    /// Called from any thread. An exception becomes a 400 (std::invalid_argument) or a 500.
    virtual Reply answer(const Request& request) = 0;
    /// Sent with every response.
    virtual std::string contentSecurityPolicy() const = 0;
    /// Ends the requests that wait for a response.
    virtual void close() {}
};

}  // namespace rigor::view
