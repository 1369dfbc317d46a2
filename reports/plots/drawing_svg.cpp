// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cstdio>

#include "reports/encoding/text.hpp"
#include "reports/plots/drawing.hpp"

namespace rigor::report {
namespace {

std::string coordinate(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2f", value);
    return buffer;
}

/// Up to three significant digits: 12, 1.6.
std::string length(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", value);
    return buffer;
}

std::string svgAttribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
}

std::string strokeOf(const Stroke& stroke) {
    std::string out = svgAttribute("stroke", escapeMarkup(stroke.colour)), dash;
    if (stroke.width != 1.0) out += svgAttribute("stroke-width", length(stroke.width));
    for (const double part : stroke.dash) dash += (dash.empty() ? "" : " ") + coordinate(part);
    return dash.empty() ? out : out + svgAttribute("stroke-dasharray", dash);
}

std::string elementOf(const DrawnLine& line) {
    return "<line" + svgAttribute("x1", coordinate(line.x1)) + svgAttribute("y1", coordinate(line.y1)) +
           svgAttribute("x2", coordinate(line.x2)) + svgAttribute("y2", coordinate(line.y2)) +
           strokeOf(line.stroke) + "/>\n";
}

std::string elementOf(const DrawnPath& path) {
    std::string places;
    for (const auto& piece : path.pieces)
        for (std::size_t i = 0; i < piece.size(); ++i)
            places += (i == 0 ? "M" : "L") + coordinate(piece[i][0]) + " " + coordinate(piece[i][1]);
    return "<path" + svgAttribute("d", places) + svgAttribute("fill", "none") + strokeOf(path.stroke) +
           svgAttribute("stroke-linejoin", "round") + "/>\n";
}

std::string elementOf(const DrawnText& text) {
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    const std::string x = coordinate(text.x), y = coordinate(text.y);
    std::string out = "<text" + svgAttribute("x", x) + svgAttribute("y", y) +
                      svgAttribute("text-anchor", kAnchors[static_cast<int>(text.anchor)]);
    if (text.size != DrawnText{}.size) out += svgAttribute("font-size", length(text.size));
    if (text.bold) out += svgAttribute("font-weight", "600");
    if (text.upward) out += svgAttribute("transform", "rotate(-90 " + x + " " + y + ")");
    return out + ">" + escapeMarkup(text.text) + "</text>\n";
}

std::string elementOf(const DrawnCircle& circle) {
    return "<circle" + svgAttribute("cx", coordinate(circle.x)) + svgAttribute("cy", coordinate(circle.y)) +
           svgAttribute("r", length(circle.radius)) + svgAttribute("fill", escapeMarkup(circle.fill)) +
           "/>\n";
}

std::string elementOf(const DrawnRectangle& box) {
    return "<rect" + svgAttribute("x", coordinate(box.x)) + svgAttribute("y", coordinate(box.y)) +
           svgAttribute("width", coordinate(box.width)) + svgAttribute("height", coordinate(box.height)) +
           svgAttribute("fill", escapeMarkup(box.fill)) + "/>\n";
}

}  // namespace

std::string svgOf(const Drawing& drawing) {
    const std::string width = length(drawing.width), height = coordinate(drawing.height);
    const std::string size = svgAttribute("width", width) + svgAttribute("height", height);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\"" +
                      svgAttribute("viewBox", "0 0 " + width + " " + height) + size +
                      " font-family=\"system-ui, sans-serif\" font-size=\"12\"" +
                      svgAttribute("fill", kTextColour) + ">\n<rect" + size + " fill=\"#ffffff\"/>\n";
    for (const Primitive& primitive : drawing.primitives)
        out += std::visit([](const auto& mark) { return elementOf(mark); }, primitive);
    return out + "</svg>\n";
}

}  // namespace rigor::report
