// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything a program that embeds the engine needs: one include. See README.md for a first world.
#pragma once

#include "engine/embedding/debug_lines.hpp"
#include "engine/embedding/frame_stepper.hpp"
#include "engine/embedding/handle_keys.hpp"
#include "engine/embedding/solid_body.hpp"
#include "engine/embedding/svg_lines.hpp"
#include "engine/embedding/world_batch.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/choices.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/pipeline/world.hpp"
#include "engine/queries/world_queries.hpp"
#include "engine/shapes/surface.hpp"
#include "engine/state/prefer_speed.hpp"
