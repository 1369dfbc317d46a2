// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

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

/// A connection made by hand.
class RawClient {
  public:
    explicit RawClient(int port) : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in server{};
        server.sin_family = AF_INET;
        server.sin_port = htons(static_cast<std::uint16_t>(port));
        inet_pton(AF_INET, "127.0.0.1", &server.sin_addr);
        EXPECT_EQ(connect(file_, reinterpret_cast<sockaddr*>(&server), sizeof server), 0);
    }
    ~RawClient() { close(file_); }
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    bool send(const std::string& bytes) const {
        return ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
    }
    /// Bytes until the server closes, or until `most` seconds have passed.
    std::string readAll(double most) const {
        std::string all;
        const auto end = Clock::now() + std::chrono::duration<double>(most);
        while (Clock::now() < end) {
            pollfd file{file_, POLLIN, 0};
            if (poll(&file, 1, 20) <= 0) continue;
            char bytes[4096];
            const ssize_t n = recv(file_, bytes, sizeof bytes, 0);
            if (n <= 0) return all + "<closed>";
            all.append(bytes, static_cast<std::size_t>(n));
        }
        return all;
    }

    using Clock = std::chrono::steady_clock;

  private:
    int file_;
};

/// A client that sends a request and does not read the response holds up no other client.
TEST_F(Servers, ABrowserThatDoesNotReadIsAlone) {
    Browser browser(server_.url());
    const RawClient client(server_.port());
    ASSERT_TRUE(client.send("GET /large HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.port()) +
                            "\r\nCookie: " + browser.cookie() + "\r\n\r\n"));
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 50; ++i) ASSERT_EQ(browser.get("/a")->status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

/// More clients than the server has threads, each in the middle of its first line or of a body: the browser that has
/// the cookie is served at once, and so is one that comes by the link.
TEST_F(Servers, SlowStrangersHoldUpNobody) {
    std::vector<std::unique_ptr<RawClient>> slow;
    for (int i = 0; i < 200; ++i) {
        slow.push_back(std::make_unique<RawClient>(server_.port()));
        if (i % 2 == 0)
            slow.back()->send("GE");
        else
            slow.back()->send("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 1000000\r\n\r\n");
    }
    const auto begin = std::chrono::steady_clock::now();
    Browser browser(server_.url());
    EXPECT_EQ(browser.status(), 303);
    for (int i = 0; i < 50; ++i) ASSERT_EQ(browser.get("/a")->status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST_F(Servers, AStrangerIsRefusedBeforeItsBody) {
    const RawClient client(server_.port());
    ASSERT_TRUE(client.send("POST /a HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.port()) +
                            "\r\nContent-Length: 1000000\r\n\r\n"));
    const std::string answer = client.readAll(3.0);
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(answer, testing::EndsWith("<closed>")) << "and gets no second request";
}

TEST_F(Servers, ARenewedLinkEndsTheSessionOfTheOld) {
    const std::string old = server_.url();
    Browser first(old);
    EXPECT_EQ(first.get("/a")->status, 200);
    server_.renew();
    EXPECT_NE(server_.url(), old);
    EXPECT_EQ(Browser(old).status(), 403);
    EXPECT_EQ(first.get("/a")->status, 403);
    Browser second(server_.url());
    EXPECT_EQ(second.get("/a")->status, 200);
    EXPECT_EQ(Browser(server_.url()).status(), 403) << "once, as the first";
}

/// A client that goes on sending, but slowly, has the time of a whole request and no more.
TEST(ServerDeadlines, EndSlowRequests) {
    Echo site;
    GateLimits limits;
    limits.head = std::chrono::milliseconds(300);
    limits.request = std::chrono::milliseconds(600);
    Server server(site, 0, limits);
    const auto secondsUntilClosed = [](const RawClient& client) {
        const auto begin = RawClient::Clock::now();
        while (RawClient::Clock::now() - begin < std::chrono::seconds(10)) {
            client.send("x");
            if (client.readAll(0.05).ends_with("<closed>")) break;
        }
        return std::chrono::duration<double>(RawClient::Clock::now() - begin).count();
    };
    const RawClient head(server.port());
    EXPECT_LT(secondsUntilClosed(head), 5.0);
    Browser browser(server.url());
    const RawClient body(server.port());
    const std::string host = "127.0.0.1:" + std::to_string(server.port());
    body.send("POST /b HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host + "\r\nCookie: " +
              browser.cookie() + "\r\nContent-Type: application/json\r\nContent-Length: 1000000\r\n\r\n");
    EXPECT_LT(secondsUntilClosed(body), 5.0);
}

TEST(ServerDeadlines, AHeadHasASize) {
    Echo site;
    Server server(site, 0);
    const RawClient client(server.port());
    client.send("GET /" + std::string(64 << 10, 'x'));
    EXPECT_THAT(client.readAll(2.0), testing::EndsWith("<closed>"));
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
