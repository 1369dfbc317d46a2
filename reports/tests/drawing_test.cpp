// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The writers of drawings: each primitive in SVG, and PDF and PNG files that depend on the drawing alone.
#include "reports/plots/drawing.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "reports/plots/line_plot.hpp"

namespace rigor::report {
namespace {

Drawing drawingOfAllPrimitives() {
    Drawing drawing{200, 100, {}};
    drawing.add(DrawnLine{1, 2, 3, 4, {"#ff0000"}});
    drawing.add(DrawnPath{{{{0, 0}, {10, 5}}, {{20, 5}, {30, 0}}}, {"#00ff00", 1.6, {6, 4}}});
    drawing.add(
        DrawnText{.x = 50, .y = 60, .text = "a < b, Δt", .anchor = Anchor::End, .size = 15, .bold = true});
    drawing.add(DrawnText{.x = 18, .y = 50, .text = "up", .anchor = Anchor::Middle, .upward = true});
    drawing.add(DrawnCircle{5, 6, 2.5, "#0000ff"});
    drawing.add(DrawnRectangle{7, 8, 9, 10, "#123456"});
    return drawing;
}

TEST(Drawing, HasItsPrimitivesInSvg) {
    EXPECT_EQ(
        svgOf(drawingOfAllPrimitives()),
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100.00" width="200" height="100.00")svg"
        R"svg( font-family="system-ui, sans-serif" font-size="12" fill="#22272e">
<rect width="200" height="100.00" fill="#ffffff"/>
<line x1="1.00" y1="2.00" x2="3.00" y2="4.00" stroke="#ff0000"/>
<path d="M0.00 0.00L10.00 5.00M20.00 5.00L30.00 0.00" fill="none" stroke="#00ff00" stroke-width="1.6")svg"
        R"svg( stroke-dasharray="6.00 4.00" stroke-linejoin="round"/>
<text x="50.00" y="60.00" text-anchor="end" font-size="15" font-weight="600">a &lt; b, Δt</text>
<text x="18.00" y="50.00" text-anchor="middle" transform="rotate(-90 18.00 50.00)">up</text>
<circle cx="5.00" cy="6.00" r="2.5" fill="#0000ff"/>
<rect x="7.00" y="8.00" width="9.00" height="10.00" fill="#123456"/>
</svg>
)svg");
}

TEST(Drawing, GivesTheSamePdfAtAnyTime) {
    const std::string pdf = pdfOf(drawingOfAllPrimitives());
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    EXPECT_NE(pdf.find("/MediaBox [ 0 0 150 75 ]"), std::string::npos) << "points";
    EXPECT_NE(pdf.find("/FontFile"), std::string::npos) << "fonts are embedded";
    EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    EXPECT_EQ(pdfOf(drawingOfAllPrimitives()), pdf);
}

/// Texts of a damaged store are drawn like those of the page, with U+FFFD.
TEST(Drawing, ShowsBytesThatAreNoText) {
    const auto drawn = [](const std::string& text) { return Drawing{100, 50, {DrawnText{5, 20, text}}}; };
    EXPECT_EQ(pdfOf(drawn("a\xff\x01z")), pdfOf(drawn("a\xEF\xBF\xBD\xEF\xBF\xBDz")));
    EXPECT_EQ(svgOf(drawn("a\xff\x01z")), svgOf(drawn("a\xEF\xBF\xBD\xEF\xBF\xBDz")));
}

TEST(Drawing, IsRefusedWhereCairoCanNotHoldIt) {
    EXPECT_TRUE(pngOf(drawingOfAllPrimitives()).starts_with("\x89PNG"));
    EXPECT_THROW(pngOf({1e6, 1e6, {}}), std::invalid_argument);
}

/// Neither a long legend nor a long name is cut by the edge of the drawing.
TEST(LinePlot, GrowsWithItsLegend) {
    Plot plot;
    plot.subtitle = "position error of block, time step 1/240 s";
    for (int i = 0; i < 30; ++i)
        plot.lines.push_back(
            {"engine " + std::to_string(i) + std::string(40, 'x'), "#000000", {6, 4}, {0, 1}, {0, 1}});
    const Drawing drawing = drawPlot(plot);
    double lowest = 0.0, legendAt = 0.0;
    int dashed = 0;
    for (const Primitive& primitive : drawing.primitives) {
        if (const auto* text = std::get_if<DrawnText>(&primitive); text && text->text.starts_with("engine")) {
            lowest = std::max(lowest, text->y);
            legendAt = text->x;
        }
        if (const auto* line = std::get_if<DrawnLine>(&primitive))
            dashed += line->stroke.dash.empty() ? 0 : 1;
    }
    EXPECT_LT(lowest, drawing.height);
    EXPECT_GT(drawing.width - legendAt, 6.0 * 49) << "room for the longest name";
    EXPECT_EQ(dashed, 30) << "the legend has the dashes of the lines";
    EXPECT_EQ(drawPlot({}).width, 760.0);
}

}  // namespace
}  // namespace rigor::report
