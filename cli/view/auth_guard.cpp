// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/auth_guard.hpp"

#include <sys/random.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace rigor::view {
namespace {

std::string randomWord() {
    unsigned char bytes[32];
    if (getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes))
        throw std::runtime_error("no random numbers");
    std::string word;
    for (const unsigned char byte : bytes) {
        word += "0123456789abcdef"[byte >> 4];
        word += "0123456789abcdef"[byte & 15];
    }
    return word;
}

/// Takes the same time wherever they differ.
bool same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned char difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
    return difference == 0;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

Decision refuse(int status, const char* reason) {
    return {Decision::Kind::Refuse, status, reason, ""};
}

}  // namespace

// Cookies do not know ports: the name does.
AuthGuard::AuthGuard(int port)
    : port_(std::to_string(port)),
      cookieName_("rigor_view_" + port_),
      token_(randomWord()),
      session_(randomWord()) {}

std::string AuthGuard::token() const {
    const std::lock_guard lock(mutex_);
    return token_;
}

void AuthGuard::renew() {
    const std::lock_guard lock(mutex_);
    token_ = randomWord();
    session_ = randomWord();
    spent_ = false;
}

bool AuthGuard::isOurHost(const std::string& host) const {
    const std::string name = lower(host);
    return name == "127.0.0.1:" + port_ || name == "localhost:" + port_;
}

bool AuthGuard::hasCookie(const std::string& header) const {
    for (std::size_t begin = 0; begin < header.size();) {
        std::size_t end = header.find(';', begin);
        if (end == std::string::npos) end = header.size();
        std::string_view one(header.data() + begin, end - begin);
        while (one.starts_with(' ')) one.remove_prefix(1);
        if (one.starts_with(cookieName_ + "=") && same(one.substr(cookieName_.size() + 1), session_))
            return true;
        begin = end + 1;
    }
    return false;
}

Decision AuthGuard::judge(const Credentials& credentials) {
    const std::lock_guard lock(mutex_);
    if (credentials.hosts != 1 || !isOurHost(credentials.host))
        return refuse(403, "this server has another name");
    const bool reads = credentials.method == "GET" || credentials.method == "HEAD";
    if (!reads && credentials.method != "POST") return refuse(405, "GET and POST");
    if (!credentials.token.empty() && credentials.path == "/" && credentials.method == "GET") {
        if (!same(credentials.token, token_) || spent_)
            return refuse(403, "this link has been used; Enter makes a new one where `rigor view` runs");
        spent_ = true;
        return {Decision::Kind::StartSession, 303, "",
                cookieName_ + "=" + session_ + "; Path=/; HttpOnly; SameSite=Strict"};
    }
    if (!hasCookie(credentials.cookie)) return refuse(403, "open the link that `rigor view` has printed");
    if (!credentials.fetchSite.empty() && credentials.fetchSite != "same-origin" &&
        credentials.fetchSite != "none")
        return refuse(403, "requested by another site");
    if (reads) return {Decision::Kind::Allow, 200, "", ""};
    if (lower(credentials.origin) != "http://" + lower(credentials.host))
        return refuse(403, "sent by another site");
    const std::string type = lower(credentials.contentType);
    if (type != "application/json" && !type.starts_with("application/json;"))
        return refuse(415, "application/json");
    return {Decision::Kind::Allow, 200, "", ""};
}

}  // namespace rigor::view
