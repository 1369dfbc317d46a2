// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Small pieces of work whose instructions are counted: kernels and steps of small scenes, each the same on
// every run. One thread, no clock, no random numbers but those of a fixed seed.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace rigor::engine::counted {

struct Work {
    std::string name;  ///< "broad_phase/octree/3f", ...
    /// Makes everything that the work needs, runs it until nothing allocates any more, and returns it.
    std::function<std::function<void()>()> prepare;
};

void addBroadPhases(std::vector<Work>& all);
void addNarrowPhases(std::vector<Work>& all);
void addSolvers(std::vector<Work>& all);
void addSteps(std::vector<Work>& all);

inline std::vector<Work> everything() {
    std::vector<Work> all;
    addBroadPhases(all);
    addNarrowPhases(all);
    addSolvers(all);
    addSteps(all);
    return all;
}

}  // namespace rigor::engine::counted
