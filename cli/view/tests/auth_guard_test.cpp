// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/auth_guard.hpp"

#include <gmock/gmock.h>

namespace rigor::view {
namespace {

using Kind = Decision::Kind;

class AuthGuardTest : public testing::Test {
  protected:
    static Credentials get(const std::string& path = "/") {
        Credentials credentials;
        credentials.method = "GET";
        credentials.path = path;
        credentials.host = "127.0.0.1:4711";
        return credentials;
    }
    std::string cookie() {
        Credentials credentials = get();
        credentials.token = guard_.token();
        const std::string all = guard_.judge(credentials).setCookie;
        return all.substr(0, all.find(';'));
    }
    Credentials post(const std::string& cookie) {
        Credentials credentials = get("/api/command");
        credentials.method = "POST";
        credentials.cookie = cookie;
        credentials.origin = "http://127.0.0.1:4711";
        credentials.contentType = "application/json";
        return credentials;
    }
    Kind kind(const Credentials& credentials) { return guard_.judge(credentials).kind; }

    AuthGuard guard_{4711};
};

TEST_F(AuthGuardTest, NoRequestIsAllowedWithoutACookie) {
    for (const char* path : {"/", "/live.js", "/api/frames"}) {
        EXPECT_EQ(kind(get(path)), Kind::Refuse) << path;
        EXPECT_EQ(guard_.judge(get(path)).status, 403);
    }
}

TEST_F(AuthGuardTest, TheTokenIsGoodOnce) {
    Credentials credentials = get();
    credentials.token = guard_.token();
    const Decision welcome = guard_.judge(credentials);
    EXPECT_EQ(welcome.kind, Kind::StartSession);
    EXPECT_THAT(welcome.setCookie, testing::HasSubstr("HttpOnly"));
    EXPECT_THAT(welcome.setCookie, testing::HasSubstr("SameSite=Strict"));
    EXPECT_THAT(welcome.setCookie, testing::Not(testing::HasSubstr(guard_.token())));
    EXPECT_EQ(kind(credentials), Kind::Refuse) << "spent";
}

TEST_F(AuthGuardTest, AWrongTokenSpendsNothing) {
    Credentials credentials = get();
    for (const std::string& token :
         {std::string("0"), guard_.token().substr(1), guard_.token() + "0", std::string(64, '0')}) {
        credentials.token = token;
        EXPECT_EQ(kind(credentials), Kind::Refuse);
    }
    credentials.token = guard_.token();
    credentials.path = "/api/frames";
    EXPECT_EQ(kind(credentials), Kind::Refuse) << "the link leads to the page alone";
    credentials.path = "/";
    credentials.method = "POST";
    EXPECT_EQ(kind(credentials), Kind::Refuse);
    EXPECT_FALSE(cookie().empty());
}

TEST_F(AuthGuardTest, TokensDiffer) {
    EXPECT_NE(AuthGuard(1).token(), AuthGuard(1).token());
    EXPECT_GE(guard_.token().size(), 32u);
}

TEST_F(AuthGuardTest, TheCookieOpensAmongOthers) {
    const std::string own = cookie();
    Credentials credentials = get("/api/frames");
    credentials.cookie = "a=b; " + own + "; c=d";
    EXPECT_EQ(kind(credentials), Kind::Allow);
    for (const std::string& wrong : {own.substr(0, own.size() - 1), own + "0", "x" + own,
                                     own.substr(0, own.find('=') + 1), std::string(";;=; =")}) {
        credentials.cookie = wrong;
        EXPECT_EQ(kind(credentials), Kind::Refuse) << wrong;
    }
}

TEST_F(AuthGuardTest, ForeignNamesAreRefusedWhateverElseIsRight) {
    Credentials credentials = get("/api/frames");
    credentials.cookie = cookie();
    for (const char* host : {"localhost:4711", "LOCALHOST:4711", "127.0.0.1:4711"}) {
        credentials.host = host;
        EXPECT_EQ(kind(credentials), Kind::Allow) << host;
    }
    for (const char* host :
         {"", "127.0.0.1", "127.0.0.1:4712", "evil.example:4711", "127.0.0.1.evil.example:4711", "localhost",
          "0.0.0.0:4711", "[::1]:4711", "127.0.0.1:4711:4711", " 127.0.0.1:4711"}) {
        credentials.host = host;
        EXPECT_EQ(kind(credentials), Kind::Refuse) << host;
    }
    credentials.host = "127.0.0.1:4711";
    credentials.hosts = 2;
    EXPECT_EQ(kind(credentials), Kind::Refuse) << "two of them";
    Credentials first = get();
    first.token = guard_.token();
    first.host = "evil.example:4711";
    EXPECT_EQ(kind(first), Kind::Refuse);
}

TEST_F(AuthGuardTest, WhatChangesComesFromOurPageAlone) {
    const std::string own = cookie();
    EXPECT_EQ(kind(post(own)), Kind::Allow);
    for (const char* origin : {"", "null", "http://evil.example", "http://127.0.0.1:4712",
                               "http://localhost:4711", "https://127.0.0.1:4711"}) {
        Credentials credentials = post(own);
        credentials.origin = origin;
        EXPECT_EQ(kind(credentials), Kind::Refuse) << origin;
    }
    for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "application/jsonp"}) {
        Credentials credentials = post(own);
        credentials.contentType = type;
        EXPECT_EQ(guard_.judge(credentials).status, 415) << type;
    }
    EXPECT_EQ(kind(post("")), Kind::Refuse);
    Credentials put = post(own);
    put.method = "PUT";
    EXPECT_EQ(guard_.judge(put).status, 405);
}

/// Another port of this machine is the same site to a cookie.
TEST_F(AuthGuardTest, RequestsOfOtherSitesAreRefused) {
    Credentials credentials = get("/api/frames");
    credentials.cookie = cookie();
    for (const char* site : {"same-site", "cross-site", "anything"}) {
        credentials.fetchSite = site;
        EXPECT_EQ(kind(credentials), Kind::Refuse) << site;
    }
    for (const char* site : {"same-origin", "none"}) {
        credentials.fetchSite = site;
        EXPECT_EQ(kind(credentials), Kind::Allow) << site;
    }
}

}  // namespace
}  // namespace rigor::view
