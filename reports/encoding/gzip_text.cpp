// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/encoding/gzip_text.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace rigor::report {

struct GzipText::Stream {
    explicit Stream(int level) {
        constexpr int kGzipWindow = 15 + 16;
        if (deflateInit2(&zlib, level, Z_DEFLATED, kGzipWindow, 9, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::runtime_error("report: zlib cannot start");
    }
    ~Stream() { deflateEnd(&zlib); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    z_stream zlib{};
};

GzipText::GzipText(int level) : stream_(std::make_unique<Stream>(level)) {}
GzipText::~GzipText() = default;

void GzipText::run(std::string_view piece, int flush) {
    z_stream& zlib = stream_->zlib;
    zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    zlib.avail_in = static_cast<uInt>(piece.size());
    std::array<char, 1 << 16> buffer;
    do {
        zlib.next_out = reinterpret_cast<Bytef*>(buffer.data());
        zlib.avail_out = static_cast<uInt>(buffer.size());
        if (deflate(&zlib, flush) == Z_STREAM_ERROR)
            throw std::runtime_error("report: zlib cannot compress a text");
        out_.append(buffer.data(), buffer.size() - zlib.avail_out);
    } while (zlib.avail_out == 0);
}

void GzipText::add(std::string_view piece) {
    constexpr std::size_t kMost = std::size_t{1} << 30;  // zlib counts in 32 bits
    for (std::size_t at = 0; at < piece.size(); at += kMost) run(piece.substr(at, kMost), Z_NO_FLUSH);
}

std::string GzipText::finish() {
    run({}, Z_FINISH);
    return std::move(out_);
}

}  // namespace rigor::report
