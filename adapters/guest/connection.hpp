// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Requests to a guest and its answers, whose errors become the exceptions of the adapters' interface.
#pragma once

#include <cstdint>
#include <mutex>

#include "adapters/guest/process.hpp"

namespace rigor::guest {

class Connection {
  public:
    explicit Connection(adapter::GuestManifest manifest);

    const adapter::GuestManifest& manifest() const { return manifest_; }
    std::int64_t worldsBefore() const { return process_.worldsBefore(); }

    /// Sends a request and returns the answer. Throws Unsupported or BadInput as the guest answers, EngineFailure for
    /// everything else. Threads take turns.
    Frame call(const std::string& request, Frame frame = {});

    /// Runs `read`, which takes an answer apart; what it finds wrong with it is an EngineFailure of the guest.
    template <class Read>
    auto take(const std::string& request, Read&& read) const {
        try {
            return read();
        } catch (const BadFrame& error) {
            failAnswer(request, error.what());
        } catch (const Json::exception& error) {
            failAnswer(request, error.what());
        }
    }

  private:
    [[noreturn]] void failAnswer(const std::string& request, const std::string& what) const;
    [[noreturn]] void throwError(const std::string& request, const Json& error) const;

    adapter::GuestManifest manifest_;
    std::mutex mutex_;
    Process process_;
    std::uint64_t id_ = 0;
};

}  // namespace rigor::guest
