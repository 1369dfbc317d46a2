// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything a program that embeds the engine needs: one include. See README.md for a first world.
#pragma once

#include "engine/pipeline/algorithms.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/pipeline/world.hpp"
#include "engine/state/prefer_speed.hpp"
