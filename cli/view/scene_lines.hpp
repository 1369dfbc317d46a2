// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scene as any engine reports it, as lines and points (engine/embedding/debug_lines.hpp): what `rigor draw` and the live
// view show.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "adapters/interface/staged.hpp"
#include "adapters/interface/types.hpp"
#include "engine/embedding/debug_lines.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::cli {

/// A scene at one time. Indices are those of the scenario.
struct Scene {
    const scenario::Scenario* scenario = nullptr;  ///< has to outlive the scene
    std::vector<adapter::BodyState> states;
    std::vector<adapter::ContactPoint> contacts;  ///< at the places where they are to be drawn
    std::vector<bool> jointHolds;                 ///< joints that hold; empty: all
    std::vector<adapter::ShapeBox>
        boxes;  ///< boxes that the engine compared; empty: the least ones are drawn
    /// Bodies of each island as the engine has them; empty: islands are those of the contacts and joints.
    std::vector<std::vector<int>> islands;
    double time = 0.0;  ///< [s]
};

/// "outline,contact": kinds by their names. Throws std::invalid_argument, with the name `option` before its message.
std::set<engine::DebugKind> kindsOf(const std::string& list, const std::string& option);
/// Options that show these kinds alone.
template <class S>
engine::DebugOptions<S> optionsFor(const std::set<engine::DebugKind>& kinds);
/// Lengths of arrows and of half-spaces in proportion to the scene: the longest velocity and impulse are a tenth of it.
template <class S>
void fitLengths(const Scene& scene, engine::DebugOptions<S>& options);

/// Passes the scene to the sink. A line belongs to the body of its scenario index plus one, as BodyId::index. `before` is
/// called before the lines of each body, with whether it can move, and with true before contacts, joints and islands.
template <class S>
void drawScene(
    const Scene& scene, const engine::DebugOptions<S>& options, engine::LineSink<S>& sink,
    const std::function<void(bool moves)>& before = [](bool) {});

}  // namespace rigor::cli
