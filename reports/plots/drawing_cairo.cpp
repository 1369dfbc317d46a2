// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cairo-pdf.h>
#include <cairo.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "reports/encoding/text.hpp"
#include "reports/plots/drawing.hpp"

namespace rigor::report {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Pen = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

void require(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::invalid_argument(std::string("the picture cannot be drawn: ") +
                                    cairo_status_to_string(status));
}

Surface checked(cairo_surface_t* surface) {
    Surface owner(surface, cairo_surface_destroy);
    require(cairo_surface_status(surface));
    return owner;
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

void setColour(cairo_t* pen, const std::string& colour) {
    const auto part = [&](std::size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16) / 255.0; };
    cairo_set_source_rgb(pen, part(1), part(3), part(5));
}

void strokeWith(cairo_t* pen, const Stroke& stroke) {
    setColour(pen, stroke.colour);
    cairo_set_line_width(pen, stroke.width);
    cairo_set_dash(pen, stroke.dash.data(), static_cast<int>(stroke.dash.size()), 0.0);
    cairo_stroke(pen);
}

void paint(cairo_t* pen, const DrawnLine& line) {
    cairo_move_to(pen, line.x1, line.y1);
    cairo_line_to(pen, line.x2, line.y2);
    strokeWith(pen, line.stroke);
}

void paint(cairo_t* pen, const DrawnPath& path) {
    for (const auto& piece : path.pieces)
        for (std::size_t i = 0; i < piece.size(); ++i)
            (i == 0 ? cairo_move_to : cairo_line_to)(pen, piece[i][0], piece[i][1]);
    cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
    strokeWith(pen, path.stroke);
}

void paint(cairo_t* pen, const DrawnText& text) {
    const std::string shown = validText(text.text);  // cairo refuses other bytes
    cairo_save(pen);
    setColour(pen, kTextColour);
    cairo_select_font_face(pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(pen, text.size);
    cairo_text_extents_t extents;
    cairo_text_extents(pen, shown.c_str(), &extents);
    cairo_translate(pen, text.x, text.y);
    if (text.upward) cairo_rotate(pen, -0.5 * std::numbers::pi);
    cairo_move_to(pen, -0.5 * static_cast<int>(text.anchor) * extents.x_advance, 0.0);
    cairo_show_text(pen, shown.c_str());
    cairo_restore(pen);
}

void paint(cairo_t* pen, const DrawnCircle& circle) {
    setColour(pen, circle.fill);
    cairo_arc(pen, circle.x, circle.y, circle.radius, 0.0, 2.0 * std::numbers::pi);
    cairo_fill(pen);
}

void paint(cairo_t* pen, const DrawnRectangle& box) {
    setColour(pen, box.fill);
    cairo_rectangle(pen, box.x, box.y, box.width, box.height);
    cairo_fill(pen);
}

void paintAll(cairo_surface_t* surface, const Drawing& drawing, double scale) {
    const Pen pen(cairo_create(surface), cairo_destroy);
    cairo_scale(pen.get(), scale, scale);
    cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
    cairo_paint(pen.get());
    for (const Primitive& primitive : drawing.primitives)
        std::visit([&](const auto& mark) { paint(pen.get(), mark); }, primitive);
    require(cairo_status(pen.get()));
}

}  // namespace

std::string pdfOf(const Drawing& drawing) {
    constexpr double kPointsPerPixel = 72.0 / 96.0;
    std::string bytes;
    const Surface surface = checked(cairo_pdf_surface_create_for_stream(
        append, &bytes, kPointsPerPixel * drawing.width, kPointsPerPixel * drawing.height));
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    paintAll(surface.get(), drawing, kPointsPerPixel);
    cairo_surface_finish(surface.get());
    require(cairo_surface_status(surface.get()));
    return bytes;
}

std::string pngOf(const Drawing& drawing) {
    const Surface surface = checked(cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, static_cast<int>(drawing.width), static_cast<int>(std::ceil(drawing.height))));
    paintAll(surface.get(), drawing, 1.0);
    std::string bytes;
    require(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    return bytes;
}

}  // namespace rigor::report
