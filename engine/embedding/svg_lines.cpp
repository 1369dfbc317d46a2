// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/embedding/svg_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace rigor::engine {
namespace {

constexpr std::array<const char*, kDebugKinds> kColours = {"#33475b", "#b8c4ce", "#d1495b", "#d1495b",
                                                           "#b5179e", "#2a9d8f", "#e9a03b", "#6a78d1"};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

}  // namespace

const char* debugColour(DebugKind kind) {
    return kColours[static_cast<std::size_t>(kind)];
}

template <class S>
typename SvgLines<S>::Place SvgLines<S>::project(const Vec& at) const {
    if constexpr (S::dim == 2) {
        return {static_cast<double>(at[0]), static_cast<double>(at[1])};
    } else {
        const double x = static_cast<double>(at[0]), y = static_cast<double>(at[1]);
        const double z = static_cast<double>(at[2]);
        const double right = std::cos(view_.turn) * x - std::sin(view_.turn) * z;
        const double depth = std::sin(view_.turn) * x + std::cos(view_.turn) * z;
        return {right, std::cos(view_.lift) * y - std::sin(view_.lift) * depth};
    }
}

template <class S>
void SvgLines<S>::line(const Vec& from, const Vec& to, DebugKind kind, BodyId) {
    const Place a = project(from), b = project(to);
    strokes_.push_back({a.x, a.y, b.x, b.y, kind, false, keeps_});
}

template <class S>
void SvgLines<S>::point(const Vec& at, DebugKind kind, BodyId) {
    const Place a = project(at);
    strokes_.push_back({a.x, a.y, a.x, a.y, kind, true, keeps_});
}

template <class S>
std::array<double, 4> SvgLines<S>::frame() const {
    const bool any = std::any_of(strokes_.begin(), strokes_.end(), [](const Stroke& s) { return s.inFrame; });
    double left = 0, right = 1, bottom = 0, top = 1;
    bool first = true;
    for (const Stroke& s : strokes_) {
        if (!isFinite(s) || (any && !s.inFrame)) continue;
        if (std::exchange(first, false)) {
            left = right = s.x0;
            bottom = top = s.y0;
        }
        left = std::min({left, s.x0, s.x1});
        right = std::max({right, s.x0, s.x1});
        bottom = std::min({bottom, s.y0, s.y1});
        top = std::max({top, s.y0, s.y1});
    }
    return {left, right, bottom, top};
}

template <class S>
Picture SvgLines<S>::picture(int width) const {
    const auto [left, right, bottom, top] = frame();
    const double margin = 12,
                 scale = (width - 2 * margin) / std::max({right - left, 0.5 * (top - bottom), 1e-9});
    const double aside =
        0.5 * (width - 2 * margin - scale * (right - left));  // on both sides of what is high
    const auto x = [&, low = left](double value) { return margin + aside + scale * (value - low); };
    const auto y = [&, high = top](double value) { return margin + scale * (high - value); };
    Picture picture{width, 2 * margin + scale * (top - bottom), {}};
    for (const Stroke& s : strokes_)
        if (isFinite(s)) picture.marks.push_back({x(s.x0), y(s.y0), x(s.x1), y(s.y1), s.kind, s.isPoint});
    return picture;
}

template <class S>
std::string SvgLines<S>::text(int width) const {
    const Picture shown = picture(width);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width) +
                      "\" height=\"" + number(shown.height) + "\">\n<style>";
    for (int k = 0; k < kDebugKinds; ++k) {
        const std::string name = debugKindName(static_cast<DebugKind>(k));
        const std::string colour = debugColour(static_cast<DebugKind>(k));
        out += " line." + name + " {stroke: " + colour + "} circle." + name + " {fill: " + colour + "}";
    }
    out += "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    for (const Picture::Mark& m : shown.marks) {
        const std::string kind = std::string(" class=\"") + debugKindName(m.kind) + "\"/>\n";
        if (m.isPoint)
            out += "<circle cx=\"" + number(m.x0) + "\" cy=\"" + number(m.y0) + "\" r=\"" +
                   number(kPicturePointRadius) + "\"" + kind;
        else
            out += "<line x1=\"" + number(m.x0) + "\" y1=\"" + number(m.y0) + "\" x2=\"" + number(m.x1) +
                   "\" y2=\"" + number(m.y1) + "\"" + kind;
    }
    return out + "</svg>\n";
}

RIGOR_INSTANTIATE_CLASS(SvgLines)

}  // namespace rigor::engine
