// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/instance_child.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/live/channel.hpp"
#include "validation/live/instance_frame.hpp"
#include "validation/live/instance_world.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

scenario::Vec3 vectorOf(const json& j) {
    return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

class Worker {
  public:
    Packet answer(const json& request) {
        const std::string command = request.at("command");
        if (command == "load") return load(request);
        if (!instance_) throw std::runtime_error("no scenario is loaded");
        if (command == "now") return now();
        if (command == "advance")
            advance(request.at("steps"), request.at("seconds"));
        else if (command == "stage")
            (void)instance_->stage();
        else if (command == "go_to")
            goTo(request.at("step"));
        else if (command == "drag")
            instance_->drag(Drag{request.at("body"), vectorOf(request.at("point")),
                                 vectorOf(request.at("target")), request.value("stiffness", 0.0)});
        else if (command == "release")
            instance_->drag(std::nullopt);
        else if (command != "state")
            throw std::runtime_error("no command '" + command + "'");
        Packet packet = instanceFrame(*instance_, request.value("stages", false));
        if (stepSeconds_) packet.header["step_seconds"] = *stepSeconds_;
        return packet;
    }

  private:
    void advance(std::size_t steps, double seconds) {
        using Clock = std::chrono::steady_clock;
        const std::size_t before = instance_->steps();
        const auto begin = Clock::now();
        instance_->advance(steps, seconds);
        if (const std::size_t done = instance_->steps() - before; done > 0)
            stepSeconds_ =
                std::chrono::duration<double>(Clock::now() - begin).count() / static_cast<double>(done);
    }
    void goTo(std::size_t step) {
        stepSeconds_.reset();  // the steps on the way there were not timed
        instance_->goTo(step);
    }
    Packet load(const json& request) {
        const scenario::Scenario s =
            scenario::loadScenarioText(request.at("text").get<std::string>(), "scenario").scenario;
        instance_ = std::make_unique<InstanceWorld>(
            s, adapter::parseSpec(request.at("spec").get<std::string>()), request.at("dt").get<double>());
        Packet packet = instanceFrame(*instance_, request.value("stages", false));
        packet.header["instance"] = instanceDescription(*instance_);
        return packet;
    }
    Packet now() {
        const SceneNow seen = instance_->now();
        Packet packet;
        packet.header["text"] = scenario::scenarioText(seen.scenario);
        packet.header["notes"] = seen.notes;
        return packet;
    }

    std::unique_ptr<InstanceWorld> instance_;
    std::optional<double>
        stepSeconds_;  ///< wall time of a step, mean of the last advance; none after a go_to
};

Packet failure(const char* kind, const char* message) {
    Packet packet;
    packet.header["error"] = {{"kind", kind}, {"message", message}};
    return packet;
}

Packet answered(Worker& worker, const json& request) {
    try {
        return worker.answer(request);
    } catch (const adapter::Unsupported& error) {
        return failure("unsupported", error.what());
    } catch (const adapter::BadInput& error) {
        return failure("bad_input", error.what());
    } catch (const scenario::LoadError& error) {
        return failure("bad_input", error.problems().front().text().c_str());
    } catch (const std::exception& error) {
        return failure("error", error.what());
    }
}

}  // namespace

int instanceChild(const std::filesystem::path& fileNumber) {
    Channel channel(std::stoi(fileNumber.string()));
    Worker worker;
    while (const auto request = channel.receive())
        if (!channel.send(answered(worker, request->header))) break;
    return 0;
}

}  // namespace rigor::validation
