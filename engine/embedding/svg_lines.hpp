// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lines and points as an SVG picture (a text that browsers and editors show). In 2D x goes right and y up; in 3D
// the picture is an orthographic projection. The frame holds what was drawn, or what keepInFrame() says.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/embedding/debug_lines.hpp"

namespace rigor::engine {

/// Direction that a 3D picture is seen from: turned about y from that of -z, and lifted above the horizon [rad].
struct PictureView {
    double turn = 0.6, lift = 0.35;
};

/// A picture in pixels, from its top left corner.
struct Picture {
    /// A line, or a point at (x0, y0).
    struct Mark {
        double x0, y0, x1, y1;
        DebugKind kind;
        bool isPoint;
    };
    int width = 0;
    double height = 0;
    std::vector<Mark> marks;  ///< in the order in which they were drawn
};

/// "#rrggbb": a colour for each kind; they differ in lightness, too.
const char* debugColour(DebugKind kind);
inline constexpr double kPicturePointRadius = 2.5;  ///< [pixels]

template <class S>
class SvgLines final : public LineSink<S> {
  public:
    using Vec = typename S::Vec;
    explicit SvgLines(const PictureView& view = {}) : view_(view) {}
    void line(const Vec& from, const Vec& to, DebugKind kind, BodyId body) override;
    void point(const Vec& at, DebugKind kind, BodyId body) override;

    /// Whether what is drawn from now on is in the frame as a whole (true at first). The rest is seen as far as it
    /// reaches into the frame: a wide ground under small bodies.
    void keepInFrame(bool keep) { keeps_ = keep; }

    /// Everything drawn so far, `width` pixels wide and at most twice as high. Nothing drawn: an empty picture.
    Picture picture(int width = 800) const;
    /// The same as SVG; a style sheet in it has a class for each kind.
    std::string text(int width = 800) const;
    void clear() { strokes_.clear(); }

  private:
    struct Stroke {
        double x0, y0, x1, y1;
        DebugKind kind;
        bool isPoint, inFrame;
    };
    struct Place {
        double x, y;
    };
    Place project(const Vec& at) const;
    static bool isFinite(const Stroke& s) { return std::isfinite(s.x0 + s.y0 + s.x1 + s.y1); }

    /// Left, right, bottom and top of what the picture shows.
    std::array<double, 4> frame() const;

    PictureView view_;
    bool keeps_ = true;
    std::vector<Stroke> strokes_;
};

}  // namespace rigor::engine
