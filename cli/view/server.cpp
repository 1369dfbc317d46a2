// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/server.hpp"

#include <httplib.h>

#include <atomic>
#include <optional>
#include <stdexcept>
#include <thread>

#include "cli/view/auth_guard.hpp"

namespace rigor::view {
namespace {

constexpr std::size_t kThreads = 16;  ///< requests at a time; each that waits for frames takes one
constexpr std::size_t kMostBody = 4 << 20;
constexpr const char* kAddress = "127.0.0.1";

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

}  // namespace

struct Server::Impl {
    explicit Impl(Site& s) : site(s) {
        // The library's SO_REUSEPORT is left out, so that no other process can listen on this port.
        http.set_socket_options([](auto) {});
        http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
        http.set_payload_max_length(kMostBody);
        http.set_keep_alive_timeout(2);
        http.set_read_timeout(5);
        http.set_write_timeout(10);
        http.set_tcp_nodelay(true);
        http.set_default_headers({{"Content-Security-Policy", site.contentSecurityPolicy()},
                                  {"X-Content-Type-Options", "nosniff"},
                                  {"X-Frame-Options", "DENY"},
                                  {"Referrer-Policy", "no-referrer"},
                                  {"Cross-Origin-Opener-Policy", "same-origin"},
                                  {"Cross-Origin-Resource-Policy", "same-origin"},
                                  {"Cache-Control", "no-store"}});
        const auto handle = [this](const httplib::Request& request, httplib::Response& response) {
            answer(request, response);
        };
        http.Get(".*", handle);
        http.Post(".*", handle);
    }

    void answer(const httplib::Request& request, httplib::Response& response) {
        const Decision decision = guard->judge(credentialsOf(request));
        if (decision.kind == Decision::Kind::StartSession) {
            response.set_header("Set-Cookie", decision.setCookie);
            response.set_redirect("/", 303);
            return;
        }
        Reply reply;
        if (decision.kind == Decision::Kind::Refuse)
            reply = problem(decision.status, decision.reason);
        else
            reply = requested(requestOf(request));
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
    httplib::Server http;
    std::optional<AuthGuard> guard;
    int port = 0;
    std::thread listening;
};

Server::Server(Site& site, int port) : impl_(std::make_unique<Impl>(site)) {
    impl_->port = port != 0 ? (impl_->http.bind_to_port(kAddress, port) ? port : -1)
                            : impl_->http.bind_to_any_port(kAddress);
    if (impl_->port <= 0)
        throw std::runtime_error("cannot listen on " + std::string(kAddress) + " port " +
                                 std::to_string(port));
    impl_->guard.emplace(impl_->port);
    impl_->listening = std::thread([this] { impl_->http.listen_after_bind(); });
    while (!impl_->http.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

Server::~Server() {
    impl_->site.close();
    impl_->http.stop();
    impl_->listening.join();
}

int Server::port() const {
    return impl_->port;
}

std::string Server::url() const {
    return "http://" + std::string(kAddress) + ":" + std::to_string(impl_->port) +
           "/?token=" + impl_->guard->token();
}

}  // namespace rigor::view
