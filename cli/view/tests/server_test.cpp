// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "cli/view/tests/http.hpp"

namespace rigor::view {
namespace {

using test::Browser;

/// Returns the request.
class Echo final : public Site {
  public:
    Reply answer(const Request& request) override {
        if (request.path == "/bad") throw std::invalid_argument("bad");
        if (request.path == "/broken") throw std::runtime_error("broken");
        if (request.path == "/large") return {200, "text/plain", std::string(std::size_t{32} << 20, 'x')};
        return {200, "text/plain", request.method + " " + request.path + " " + request.body};
    }
    std::string contentSecurityPolicy() const override { return "default-src 'none'"; }
};

class Servers : public testing::Test {
  protected:
    Echo site_;
    Server server_{site_, 0};
    std::string origin() const { return "http://127.0.0.1:" + std::to_string(server_.port()); }
};

TEST_F(Servers, TheLinkLetsOneBrowserIn) {
    Browser first(server_.url());
    EXPECT_EQ(first.status(), 303);
    EXPECT_EQ(first.get("/a?x=1")->body, "GET /a ");
    EXPECT_EQ(first.post("/b", "{}")->body, "POST /b {}");
    Browser second(server_.url());
    EXPECT_EQ(second.status(), 403);
    EXPECT_EQ(second.get("/a")->status, 403);
    EXPECT_EQ(httplib::Client(origin()).Get("/a")->status, 403);
}

TEST_F(Servers, ForeignHostsAndOriginsAreRefused) {
    Browser browser(server_.url());
    httplib::Client client(origin());
    const std::pair<std::string, std::string> cookie{"Cookie", browser.cookie()};
    EXPECT_EQ(client.Get("/a", {cookie, {"Host", "evil.example"}})->status, 403);
    EXPECT_EQ(client.Get("/a", {cookie, {"Host", "localhost:" + std::to_string(server_.port())}})->status,
              200);
    EXPECT_EQ(
        client.Post("/a", {cookie, {"Origin", "http://evil.example"}}, "{}", "application/json")->status,
        403);
    EXPECT_EQ(client.Post("/a", {cookie}, "{}", "application/json")->status, 403) << "no origin";
    EXPECT_EQ(client.Post("/a", {cookie, {"Origin", origin()}}, "{}", "text/plain")->status, 415);
    for (const auto& answer : {client.Put("/a", {cookie}, "{}", "application/json"),
                               client.Delete("/a", {cookie}), client.Options("/a", {cookie})})
        EXPECT_GE(answer->status, 400);
}

TEST_F(Servers, EveryAnswerCarriesItsRules) {
    Browser browser(server_.url());
    httplib::Client stranger(origin());
    const auto allowed = browser.get("/a"), refused = stranger.Get("/a");
    for (const httplib::Result* answer : {&allowed, &refused}) {
        EXPECT_EQ((*answer)->get_header_value("Content-Security-Policy"), "default-src 'none'");
        EXPECT_EQ((*answer)->get_header_value("Cache-Control"), "no-store");
        EXPECT_EQ((*answer)->get_header_value("X-Content-Type-Options"), "nosniff");
        EXPECT_EQ((*answer)->get_header_value("Cross-Origin-Resource-Policy"), "same-origin");
        EXPECT_FALSE((*answer)->has_header("Access-Control-Allow-Origin"));
    }
}

TEST_F(Servers, ErrorsAreAnswers) {
    Browser browser(server_.url());
    EXPECT_EQ(browser.get("/bad")->status, 400);
    EXPECT_EQ(browser.get("/broken")->status, 500);
    EXPECT_EQ(browser.get("/still")->status, 200);
    const auto large = browser.post("/a", std::string(5 << 20, 'x'));
    EXPECT_TRUE(!large || large->status == 413);
    EXPECT_EQ(Browser(server_.url()).status(), 403) << "and the server goes on";
}

/// Nothing but the loopback interface: the same port of another address of this machine is closed.
TEST_F(Servers, ListensOnLoopbackAlone) {
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in other{};
    other.sin_family = AF_INET;
    other.sin_port = htons(static_cast<std::uint16_t>(server_.port()));
    inet_pton(AF_INET, "127.0.0.2", &other.sin_addr);
    EXPECT_NE(connect(file, reinterpret_cast<sockaddr*>(&other), sizeof other), 0);
    close(file);
    Echo site;
    EXPECT_THROW(Server(site, server_.port()), std::runtime_error) << "and no second server shares the port";
}

/// A client that sends a request and does not read the response holds up no other client.
TEST_F(Servers, ABrowserThatDoesNotReadIsAlone) {
    Browser browser(server_.url());
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in server{};
    server.sin_family = AF_INET;
    server.sin_port = htons(static_cast<std::uint16_t>(server_.port()));
    inet_pton(AF_INET, "127.0.0.1", &server.sin_addr);
    ASSERT_EQ(connect(file, reinterpret_cast<sockaddr*>(&server), sizeof server), 0);
    const std::string request = "GET /large HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.port()) +
                                "\r\nCookie: " + browser.cookie() + "\r\n\r\n";
    ASSERT_EQ(send(file, request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 50; ++i) ASSERT_EQ(browser.get("/a")->status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    close(file);
}

TEST(ServerEnd, DoesNotWaitForIdleBrowsers) {
    Echo site;
    auto server = std::make_unique<Server>(site, 0);
    Browser browser(server->url());
    browser.get("/a");
    const auto begin = std::chrono::steady_clock::now();
    server.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(4));
}

}  // namespace
}  // namespace rigor::view
