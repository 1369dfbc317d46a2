// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/png_picture.hpp"

#include <cairo.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace rigor::cli {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Pen = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

void require(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::invalid_argument(std::string("the picture cannot be drawn: ") +
                                    cairo_status_to_string(status));
}

/// Sets the colour "#rrggbb".
void setColour(cairo_t* pen, const std::string& text) {
    const auto part = [&](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0; };
    cairo_set_source_rgb(pen, part(1), part(3), part(5));
}

void draw(cairo_t* pen, const engine::Picture::Mark& mark) {
    setColour(pen, engine::debugColour(mark.kind));
    if (mark.isPoint) {
        cairo_arc(pen, mark.x0, mark.y0, engine::kPicturePointRadius, 0.0, 2.0 * std::numbers::pi);
        cairo_fill(pen);
    } else {
        cairo_move_to(pen, mark.x0, mark.y0);
        cairo_line_to(pen, mark.x1, mark.y1);
        cairo_stroke(pen);
    }
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string pngOf(const engine::Picture& picture) {
    const int height = static_cast<int>(std::ceil(picture.height));
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, height),
                          cairo_surface_destroy);
    require(cairo_surface_status(surface.get()));
    const Pen pen(cairo_create(surface.get()), cairo_destroy);
    cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
    cairo_paint(pen.get());
    cairo_set_line_width(pen.get(), 1.0);
    for (const engine::Picture::Mark& mark : picture.marks) draw(pen.get(), mark);
    require(cairo_status(pen.get()));
    std::string bytes;
    require(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    return bytes;
}

}  // namespace rigor::cli
