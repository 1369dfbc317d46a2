// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A browser as far as the server knows one.
#pragma once

#include <gtest/gtest.h>
#include <httplib.h>

#include <string>

#include "validation/live/packet.hpp"

namespace rigor::view::test {

class Browser {
  public:
    /// Opens the printed link.
    explicit Browser(const std::string& url) : origin_(url.substr(0, url.find("/?"))), client_(origin_) {
        client_.set_keep_alive(true);
        client_.set_read_timeout(30);
        const auto answer = client_.Get(url.substr(origin_.size()));
        if (!answer) return;
        status_ = answer->status;
        const std::string all = answer->get_header_value("Set-Cookie");
        cookie_ = all.substr(0, all.find(';'));
    }
    int status() const { return status_; }  ///< status of the link itself
    const std::string& origin() const { return origin_; }
    const std::string& cookie() const { return cookie_; }

    httplib::Result get(const std::string& path) { return client_.Get(path, {{"Cookie", cookie_}}); }
    httplib::Result post(const std::string& path, const std::string& body) {
        return client_.Post(path, {{"Cookie", cookie_}, {"Origin", origin_}}, body, "application/json");
    }
    nlohmann::json command(const nlohmann::json& request) {
        const auto answer = post("/api/command", request.dump());
        if (!answer || answer->status != 200) {
            ADD_FAILURE() << request << ": " << (answer ? answer->body : "no answer");
            return nullptr;
        }
        return nlohmann::json::parse(answer->body);
    }
    validation::Packet frames(std::uint64_t after, double wait) {
        const auto answer =
            get("/api/frames?after=" + std::to_string(after) + "&wait=" + std::to_string(wait));
        if (!answer || answer->status != 200) {
            ADD_FAILURE() << (answer ? answer->body : "no answer");
            return {};
        }
        return validation::Packet::decode(answer->body);
    }

  private:
    std::string origin_, cookie_;
    httplib::Client client_;
    int status_ = 0;
};

}  // namespace rigor::view::test
