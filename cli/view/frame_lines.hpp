// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames of a live session as lines and points: what `rigor draw` draws, for the engine of each instance. Arrays, after
// the instance's number and a slash:
//   lines/ends     line: its two ends [m], 6 numbers; arrows have 1 m for 1 m/s or 1 N s, normals have 1 m
//   lines/names    line: kind, body (-1: the world)
//   points/at      point: 3 numbers [m]
//   points/names   point: kind, body
// A kind is an index into the packet's `line_kinds`.
#pragma once

#include <set>

#include "engine/embedding/debug_lines.hpp"
#include "scenarios/model/scenario.hpp"
#include "validation/live/packet.hpp"

namespace rigor::view {

/// Adds the lines of one of the packet's frames, `head`, of an instance that runs `scenario`.
void addLines(validation::Packet& packet, const nlohmann::json& head, const scenario::Scenario& scenario,
              const std::set<engine::DebugKind>& kinds);
/// The names of all kinds, by their indices.
nlohmann::json lineKinds();

}  // namespace rigor::view
