// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The live view: its page, and the page's requests.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "cli/view/site.hpp"
#include "validation/live/session.hpp"

namespace rigor::view {

/// GET  /, /live.js, /live.css   the page
/// GET  /api/frames?after=N&wait=S&lines=LIST   validation/live/README.md; waits for news at most S seconds; with the
///                               lines of these kinds (frame_lines.hpp)
/// GET  /api/scene?instance=N    the scenario of an instance, and how its engine was set up
/// GET  /api/engines             engines with all options and their values
/// GET  /api/scenarios           names and titles of the library
/// POST /api/command             a command of the session, or {"command": "open", "scenario": NAME}
class LiveSite final : public Site {
  public:
    LiveSite(validation::Session& session, std::filesystem::path binary);
    Reply answer(const Request& request) override;
    std::string contentSecurityPolicy() const override;
    void close() override { session_.close(); }

  private:
    Reply frames(const Request& request);
    void addLines(validation::Packet& packet, const std::string& list);
    Reply command(const Request& request);
    Reply engines();

    validation::Session& session_;
    std::filesystem::path binary_;
    std::atomic<int> waiting_{0};
    std::mutex drawing_;
    std::map<int, scenario::Scenario> scenarios_;  ///< scenarios of instances whose lines have been drawn
    std::mutex describing_;
    std::string engines_;  ///< once they have been queried
};

}  // namespace rigor::view
