// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/live_site.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/view/frame_lines.hpp"
#include "cli/view/scene_lines.hpp"
#include "reports/page/web_assets.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/runner/describe.hpp"

namespace rigor::view {
namespace {

using validation::CommandError;
using Json = nlohmann::json;

constexpr int kMostWaiting = 8;  ///< limit that leaves threads for commands
constexpr double kLongestWait = 20.0;

constexpr const char* kPage =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<title>Rigor: live</title>\n<link rel=\"icon\" href=\"data:,\">\n"
    "<link rel=\"stylesheet\" href=\"/live.css\">\n</head>\n<body>\n"
    "<noscript>The live view needs JavaScript.</noscript>\n"
    "<script src=\"/live.js\"></script>\n</body>\n</html>\n";

Reply scenarios() {
    Json list = Json::array();
    for (const scenario::LibraryEntry& entry : scenario::listScenarios())
        list.push_back({{"name", entry.name}, {"title", entry.title}});
    return json(list.dump());
}

/// Text of a scenario that the library lists; no other file can be read through the page.
std::string libraryText(const std::string& name) {
    const auto all = scenario::listScenarios();
    const auto it = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.name == name; });
    if (it == all.end()) throw CommandError("the library has no scenario '" + name + "'");
    return scenario::loadScenario(it->file).text;
}

}  // namespace

LiveSite::LiveSite(validation::Session& session, std::filesystem::path binary)
    : session_(session), binary_(std::move(binary)) {}

std::string LiveSite::contentSecurityPolicy() const {
    return "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: "
           "blob:; font-src 'self' data:; connect-src 'self'; worker-src blob:; base-uri 'none'; form-action "
           "'none'; frame-ancestors 'none'";
}

Reply LiveSite::answer(const Request& request) {
    const std::string& path = request.path;
    if (request.method == "POST") return path == "/api/command" ? command(request) : notFound();
    if (path == "/") return {200, "text/html; charset=utf-8", kPage};
    if (path == "/live.js")
        return {200, "text/javascript; charset=utf-8", std::string(report::webAsset("live.js"))};
    if (path == "/live.css")
        return {200, "text/css; charset=utf-8", std::string(report::webAsset("live.css"))};
    if (path == "/api/frames") return frames(request);
    if (path == "/api/engines") return engines();
    if (path == "/api/scenarios") return scenarios();
    if (path == "/api/scene") {
        // Version 0.1 called an instance a lane.
        const double oldKey = request.number("lane", -1, -1, 1e9);
        const Json scene = session_.scene(static_cast<int>(request.number("instance", oldKey, -1, 1e9)));
        return scene.is_null() ? notFound() : json(scene.dump());
    }
    return notFound();
}

Reply LiveSite::frames(const Request& request) {
    const auto after = static_cast<std::uint64_t>(request.number("after", 0, 0, 9e15));
    double wait = request.number("wait", 0, 0, kLongestWait);
    if (++waiting_ > kMostWaiting) wait = 0.0;
    validation::Packet packet;
    try {
        packet = session_.frames(after, wait);
    } catch (...) {
        --waiting_;
        throw;
    }
    --waiting_;
    if (const auto lines = request.query.find("lines"); lines != request.query.end())
        addLines(packet, lines->second);
    return {200, "application/octet-stream", packet.encode()};
}

void LiveSite::addLines(validation::Packet& packet, const std::string& list) {
    const std::set<engine::DebugKind> kinds =
        list.empty() ? std::set<engine::DebugKind>{} : cli::kindsOf(list, "lines");
    packet.header["line_kinds"] = lineKinds();
    const std::lock_guard lock(drawing_);
    std::erase_if(scenarios_, [&](const auto& known) {
        return std::none_of(packet.header["session"]["instances"].begin(),
                            packet.header["session"]["instances"].end(),
                            [&](const Json& instance) { return instance["id"] == known.first; });
    });
    for (const Json& head : packet.header["frames"]) {
        const int id = head.at("instance");
        if (!scenarios_.contains(id)) {
            std::optional<scenario::Scenario> runs = session_.scenarioOf(id);
            if (!runs) continue;  // it has just been removed
            scenarios_.emplace(id, std::move(*runs));
        }
        view::addLines(packet, head, scenarios_.at(id), kinds);
    }
}

Reply LiveSite::command(const Request& request) {
    const Json body = Json::parse(request.body, nullptr, false);
    if (!body.is_object()) return problem(400, "a JSON object is needed");
    try {
        if (body.value("command", Json()) == "open") {
            session_.open(libraryText(body.at("scenario").get<std::string>()));
            return json("{}");
        }
        return json(session_.command(body).dump(-1, ' ', false, Json::error_handler_t::replace));
    } catch (const CommandError& error) {
        return problem(422, error.what());
    } catch (const scenario::LoadError& error) {
        return problem(422, error.problems().front().text());
    } catch (const Json::exception& error) {
        return problem(400, error.what());
    }
}

Reply LiveSite::engines() {
    const std::lock_guard lock(describing_);
    if (!engines_.empty()) return json(engines_);
    Json list = Json::array();
    for (const validation::EngineDescription& d :
         validation::describeEngines(adapter::availableEngines(), binary_, 2)) {
        if (!d.capabilities.dynamics || !d.problem.empty()) continue;
        const Json described = Json::parse(validation::capabilitiesText(d));
        list.push_back({{"name", d.info.name},
                        {"title", d.info.title},
                        {"version", d.info.version},
                        {"precisions", d.precisions},
                        {"presets", described.at("presets")},
                        {"options", described.at("options")}});
    }
    engines_ = list.dump();
    return json(engines_);
}

}  // namespace rigor::view
