// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A picture of lines and points as a PNG file.
#pragma once

#include <string>

#include "engine/embedding/svg_lines.hpp"

namespace rigor::cli {

/// The bytes of the PNG file, drawn by cairo with smooth edges on white. Throws std::invalid_argument for a picture
/// that is too large to be drawn.
std::string pngOf(const engine::Picture& picture);

}  // namespace rigor::cli
