// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/connection.hpp"

#include <utility>

namespace rigor::guest {

using adapter::EngineFailure;

Connection::Connection(adapter::GuestManifest manifest)
    : manifest_(std::move(manifest)), process_(manifest_) {}

void Connection::failAnswer(const std::string& request, const std::string& what) const {
    throw EngineFailure(EngineFailure::Kind::Protocol,
                        "guest '" + manifest_.name + "', answer to '" + request + "': " + what);
}

void Connection::throwError(const std::string& request, const Json& error) const {
    const auto text = [&](const char* key) -> std::string {
        const auto it = error.find(key);
        return it != error.end() && it->is_string() ? it->get<std::string>() : "";
    };
    const std::string code = text("code"), message = text("message");
    if (code == "bad_input") throw adapter::BadInput(manifest_.name + ": " + message);
    if (code == "unsupported") {
        const std::string lacking = text("lacking").empty() ? message : text("lacking");
        if (text("documentation").empty()) throw adapter::notInAdapter(manifest_.name, lacking, text("user"));
        throw adapter::notInLibrary(manifest_.name, lacking, text("documentation"), text("user"));
    }
    if (code == "failed")
        throw EngineFailure(EngineFailure::Kind::Protocol,
                            "guest '" + manifest_.name + "', request '" + request + "' failed: " + message);
    failAnswer(request, "an error without one of the codes of the protocol: " + error.dump());
}

Frame Connection::call(const std::string& request, Frame frame) {
    const std::lock_guard lock(mutex_);
    frame.header["request"] = request;
    frame.header["id"] = ++id_;
    const bool first = id_ == 1;
    Frame answer = process_.exchange(frame, first ? manifest_.startSeconds : manifest_.replySeconds);
    const auto id = answer.header.find("id");
    if (id == answer.header.end() || *id != id_)
        failAnswer(request, "it has the id " + (id == answer.header.end() ? "of none" : id->dump()) +
                                ", expected " + std::to_string(id_));
    const auto error = answer.header.find("error");
    if (error != answer.header.end()) throwError(request, error->is_object() ? *error : Json::object());
    return answer;
}

}  // namespace rigor::guest
