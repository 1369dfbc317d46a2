// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/gate.hpp"

#include <gmock/gmock.h>

namespace rigor::view {
namespace {

using Kind = Decision::Kind;

class GateTest : public testing::Test {
  protected:
    static Knock get(const std::string& path = "/") {
        Knock knock;
        knock.method = "GET";
        knock.path = path;
        knock.host = "127.0.0.1:4711";
        return knock;
    }
    std::string cookie() {
        Knock knock = get();
        knock.token = gate_.token();
        const std::string all = gate_.judge(knock).setCookie;
        return all.substr(0, all.find(';'));
    }
    Knock post(const std::string& cookie) {
        Knock knock = get("/api/command");
        knock.method = "POST";
        knock.cookie = cookie;
        knock.origin = "http://127.0.0.1:4711";
        knock.contentType = "application/json";
        return knock;
    }
    Kind kind(const Knock& knock) { return gate_.judge(knock).kind; }

    Gate gate_{4711};
};

TEST_F(GateTest, NobodyEntersWithoutACookie) {
    for (const char* path : {"/", "/live.js", "/api/frames"}) {
        EXPECT_EQ(kind(get(path)), Kind::Refuse) << path;
        EXPECT_EQ(gate_.judge(get(path)).status, 403);
    }
}

TEST_F(GateTest, TheTokenIsGoodOnce) {
    Knock knock = get();
    knock.token = gate_.token();
    const Decision welcome = gate_.judge(knock);
    EXPECT_EQ(welcome.kind, Kind::Welcome);
    EXPECT_THAT(welcome.setCookie, testing::HasSubstr("HttpOnly"));
    EXPECT_THAT(welcome.setCookie, testing::HasSubstr("SameSite=Strict"));
    EXPECT_THAT(welcome.setCookie, testing::Not(testing::HasSubstr(gate_.token())));
    EXPECT_EQ(kind(knock), Kind::Refuse) << "spent";
}

TEST_F(GateTest, AWrongTokenSpendsNothing) {
    Knock knock = get();
    for (const std::string& token :
         {std::string("0"), gate_.token().substr(1), gate_.token() + "0", std::string(64, '0')}) {
        knock.token = token;
        EXPECT_EQ(kind(knock), Kind::Refuse);
    }
    knock.token = gate_.token();
    knock.path = "/api/frames";
    EXPECT_EQ(kind(knock), Kind::Refuse) << "the link leads to the page alone";
    knock.path = "/";
    knock.method = "POST";
    EXPECT_EQ(kind(knock), Kind::Refuse);
    EXPECT_FALSE(cookie().empty());
}

TEST_F(GateTest, TokensDiffer) {
    EXPECT_NE(Gate(1).token(), Gate(1).token());
    EXPECT_GE(gate_.token().size(), 32u);
}

TEST_F(GateTest, TheCookieOpensAmongOthers) {
    const std::string own = cookie();
    Knock knock = get("/api/frames");
    knock.cookie = "a=b; " + own + "; c=d";
    EXPECT_EQ(kind(knock), Kind::Enter);
    for (const std::string& wrong : {own.substr(0, own.size() - 1), own + "0", "x" + own,
                                     own.substr(0, own.find('=') + 1), std::string(";;=; =")}) {
        knock.cookie = wrong;
        EXPECT_EQ(kind(knock), Kind::Refuse) << wrong;
    }
}

TEST_F(GateTest, ForeignNamesAreRefusedWhateverElseIsRight) {
    Knock knock = get("/api/frames");
    knock.cookie = cookie();
    for (const char* host : {"localhost:4711", "LOCALHOST:4711", "127.0.0.1:4711"}) {
        knock.host = host;
        EXPECT_EQ(kind(knock), Kind::Enter) << host;
    }
    for (const char* host :
         {"", "127.0.0.1", "127.0.0.1:4712", "evil.example:4711", "127.0.0.1.evil.example:4711", "localhost",
          "0.0.0.0:4711", "[::1]:4711", "127.0.0.1:4711:4711", " 127.0.0.1:4711"}) {
        knock.host = host;
        EXPECT_EQ(kind(knock), Kind::Refuse) << host;
    }
    knock.host = "127.0.0.1:4711";
    knock.hosts = 2;
    EXPECT_EQ(kind(knock), Kind::Refuse) << "two of them";
    Knock first = get();
    first.token = gate_.token();
    first.host = "evil.example:4711";
    EXPECT_EQ(kind(first), Kind::Refuse);
}

TEST_F(GateTest, WhatChangesComesFromOurPageAlone) {
    const std::string own = cookie();
    EXPECT_EQ(kind(post(own)), Kind::Enter);
    for (const char* origin : {"", "null", "http://evil.example", "http://127.0.0.1:4712",
                               "http://localhost:4711", "https://127.0.0.1:4711"}) {
        Knock knock = post(own);
        knock.origin = origin;
        EXPECT_EQ(kind(knock), Kind::Refuse) << origin;
    }
    for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "application/jsonp"}) {
        Knock knock = post(own);
        knock.contentType = type;
        EXPECT_EQ(gate_.judge(knock).status, 415) << type;
    }
    EXPECT_EQ(kind(post("")), Kind::Refuse);
    Knock put = post(own);
    put.method = "PUT";
    EXPECT_EQ(gate_.judge(put).status, 405);
}

/// Another port of this machine is the same site to a cookie.
TEST_F(GateTest, OtherSitesMayNotEvenAsk) {
    Knock knock = get("/api/frames");
    knock.cookie = cookie();
    for (const char* site : {"same-site", "cross-site", "anything"}) {
        knock.fetchSite = site;
        EXPECT_EQ(kind(knock), Kind::Refuse) << site;
    }
    for (const char* site : {"same-origin", "none"}) {
        knock.fetchSite = site;
        EXPECT_EQ(kind(knock), Kind::Enter) << site;
    }
}

}  // namespace
}  // namespace rigor::view
