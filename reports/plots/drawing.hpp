// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A drawing as a list of primitives in pixels from its top left corner, y down, and its writers: SVG as text; PDF and
// PNG by cairo. All three show the same on white.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace rigor::report {

/// Colours are "#rrggbb".
struct Stroke {
    std::string colour;
    double width = 1.0;
    std::vector<double> dash{};  ///< lengths of strokes and gaps; empty: solid
};

struct DrawnLine {
    double x1, y1, x2, y2;
    Stroke stroke;
};

/// Polylines of one stroke, with round corners.
struct DrawnPath {
    std::vector<std::vector<std::array<double, 2>>> pieces;
    Stroke stroke;
};

enum class Anchor { Start, Middle, End };

struct DrawnText {
    double x, y;  ///< the anchor on the base line
    std::string text;
    Anchor anchor = Anchor::Start;
    double size = 12.0;
    bool bold = false;
    bool upward = false;  ///< turned by a quarter about the anchor, to be read from below
};

struct DrawnCircle {
    double x, y, radius;
    std::string fill;
};

struct DrawnRectangle {
    double x, y, width, height;
    std::string fill;
};

using Primitive = std::variant<DrawnLine, DrawnPath, DrawnText, DrawnCircle, DrawnRectangle>;

struct Drawing {
    double width = 0.0, height = 0.0;
    std::vector<Primitive> primitives;  ///< in the order in which they are painted

    void add(Primitive primitive) { primitives.push_back(std::move(primitive)); }
};

inline constexpr const char* kTextColour = "#22272e";

std::string svgOf(const Drawing& drawing);

/// One page, a pixel as 1/96 inch, with the fonts embedded and without a date: the same bytes of the same drawing on
/// one machine. Throws std::invalid_argument for a drawing that cairo can not write, as of pngOf().
std::string pdfOf(const Drawing& drawing);

/// The drawing with smooth edges, its height rounded up.
std::string pngOf(const Drawing& drawing);

}  // namespace rigor::report
