// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tasks of users, in their words, and the scenarios for each: chosen by the mechanism that they isolate, and
// by their names if the words are too wide. A scenario may belong to several.
#include <algorithm>
#include <regex>

#include "reports/model/view_model.hpp"

namespace rigor::report {
namespace {

struct Task {
    const char *key, *title, *about;
    std::vector<std::string> isolates;  ///< any of these
    const char* names;                  ///< names of further scenarios; "" none
    const char* except;                 ///< "" none
};

const std::vector<Task>& table() {
    static const std::vector<Task> tasks{
        {"sliding",
         "A sliding box",
         "Dry friction: when a body starts to slide, how far it goes, where it stops.",
         {},
         "slid(e|ing)_|slide|incline_(slip|stick|return)|friction_sweep|push_sweep|cross_slope|wedge_rough|"
         "turntable|conveyor",
         "slider|slip_to_roll|ball|tripod_slide_off"},
        {"rolling",
         "Rolling and spinning on a floor",
         "From sliding to rolling, spin, balls and discs on planes.",
         {"rolling", "rolling friction", "torsional friction", "rim contact"},
         "",
         ""},
        {"bouncing",
         "Bouncing and impact",
         "Restitution, energy and momentum through collisions, the time of impact.",
         {"restitution", "impact", "propagation of impacts", "time of impact", "restitution 0"},
         "",
         ""},
        {"resting",
         "Stacks and things at rest",
         "What should stand still stands still, and what should fall falls.",
         {"resting contact", "manifold", "stability", "many contacts", "contact forces", "piles",
          "mass ratio"},
         "",
         "chain"},
        {"joints",
         "Joints, pendulums, mechanisms",
         "Hinges, sliders, limits, motors, springs, closed loops.",
         {"joints", "hinge", "slider", "motor", "limit", "closed loop", "ball joint", "distance", "chain",
          "joint chain"},
         "",
         ""},
        {"rotation",
         "Free flight and rotation",
         "Integration without contacts: throws, tops, gyroscopes.",
         {"gyroscopic term", "gyroscopic torque", "rotation", "integrator", "integration", "drag", "gravity",
          "damping"},
         "",
         "pendulum|hinge|slider|wheel|joint"},
        {"many",
         "Many bodies",
         "Piles, chains, clouds: momentum kept, no overlap, cost at size.",
         {"many bodies", "many contacts", "piles", "robustness", "stacking"},
         "",
         ""}};
    return tasks;
}

bool found(const std::string& name, const char* pattern) {
    return *pattern != '\0' && std::regex_search(name, std::regex(pattern));
}

bool belongs(const Task& task, const results::ScenarioRow& scenario) {
    if (found(scenario.name, task.except)) return false;
    return found(scenario.name, task.names) ||
           std::any_of(scenario.isolates.begin(), scenario.isolates.end(), [&](const std::string& word) {
               return std::find(task.isolates.begin(), task.isolates.end(), word) != task.isolates.end();
           });
}

}  // namespace

std::vector<Mechanism> ViewModel::tasks() const {
    std::vector<Mechanism> all;
    for (const Task& task : table()) {
        std::vector<std::size_t> scenarios;
        for (std::size_t s = 0; s < run_.scenarios.size(); ++s)
            if (belongs(task, run_.scenarios[s])) scenarios.push_back(s);
        if (scenarios.empty()) continue;
        Mechanism& m = all.emplace_back(rankingsOver(*this, scenarios));
        m.name = task.key;
        m.title = task.title;
        m.about = task.about;
    }
    return all;
}

}  // namespace rigor::report
