// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/server.hpp"

#include <httplib.h>

#include <stdexcept>

#include "cli/view/auth_guard.hpp"
#include "cli/view/gate.hpp"
#include "cli/view/request_stream.hpp"

namespace rigor::view {
namespace {

constexpr std::size_t kMostBody = 4 << 20;

Credentials credentialsOf(const httplib::Request& request) {
    Credentials credentials;
    credentials.method = request.method;
    credentials.path = request.path;
    credentials.host = request.get_header_value("Host");
    credentials.origin = request.get_header_value("Origin");
    credentials.cookie = request.get_header_value("Cookie");
    credentials.contentType = request.get_header_value("Content-Type");
    credentials.fetchSite = request.get_header_value("Sec-Fetch-Site");
    credentials.token = request.get_param_value("token");
    credentials.hosts = request.get_header_value_count("Host");
    return credentials;
}

Request requestOf(const httplib::Request& received) {
    Request request{received.method == "POST" ? "POST" : "GET", received.path, {}, received.body};
    for (const auto& [key, value] : received.params) request.query.emplace(key, value);
    return request;
}

/// The HTTP library without its sockets and threads.
class Http final : public httplib::Server {
  public:
    /// Reads one request and answers it. True: the connection may stay open.
    bool serve(httplib::Stream& stream) {
        bool closed = false;
        return process_request(stream, false, closed, nullptr) && !closed;
    }
};

/// Connection of the request that this thread answers.
thread_local Connection* current = nullptr;

}  // namespace

struct Server::Impl {
    Impl(Site& s, int port, const GateLimits& limits) : site(s), gate(port, limits), guard(gate.port()) {
        http.set_payload_max_length(kMostBody);
        http.set_default_headers({{"Content-Security-Policy", site.contentSecurityPolicy()},
                                  {"X-Content-Type-Options", "nosniff"},
                                  {"X-Frame-Options", "DENY"},
                                  {"Referrer-Policy", "no-referrer"},
                                  {"Cross-Origin-Opener-Policy", "same-origin"},
                                  {"Cross-Origin-Resource-Policy", "same-origin"},
                                  {"Cache-Control", "no-store"}});
        // The guard decides before the body of a request is read.
        http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            return admit(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                            : httplib::Server::HandlerResponse::Handled;
        });
        const auto handle = [this](const httplib::Request& request, httplib::Response& response) {
            send(requested(requestOf(request)), response);
        };
        http.Get(".*", handle);
        http.Post(".*", handle);
        gate.start([this](Connection& connection) { return serve(connection); });
    }

    bool serve(Connection& connection) {
        connection.known = false;
        current = &connection;
        RequestStream stream(connection);
        const bool stays = http.serve(stream);
        current = nullptr;
        return stays && connection.known && !stream.hasEnded();
    }

    /// False: the response is complete.
    bool admit(const httplib::Request& request, httplib::Response& response) {
        const Decision decision = guard.judge(credentialsOf(request));
        current->known = decision.kind != Decision::Kind::Refuse;
        if (decision.kind == Decision::Kind::Allow) return true;
        if (decision.kind == Decision::Kind::StartSession) {
            response.set_header("Set-Cookie", decision.setCookie);
            response.set_redirect("/", 303);
            return false;
        }
        response.set_header("Connection", "close");
        send(problem(decision.status, decision.reason), response);
        return false;
    }

    static void send(Reply reply, httplib::Response& response) {
        response.status = reply.status;
        response.set_content(std::move(reply.body), reply.type.c_str());
    }

    Reply requested(const Request& request) {
        try {
            return site.answer(request);
        } catch (const std::invalid_argument& error) {
            return problem(400, error.what());
        } catch (const std::exception& error) {
            return problem(500, error.what());
        }
    }

    Site& site;
    Gate gate;
    AuthGuard guard;
    Http http;
};

Server::Server(Site& site, int port, const GateLimits& limits)
    : impl_(std::make_unique<Impl>(site, port, limits)) {}

Server::~Server() {
    impl_->site.close();
    impl_->gate.stop();
}

int Server::port() const {
    return impl_->gate.port();
}

std::string Server::url() const {
    return "http://127.0.0.1:" + std::to_string(port()) + "/?token=" + impl_->guard.token();
}

void Server::renew() {
    impl_->guard.renew();
}

}  // namespace rigor::view
