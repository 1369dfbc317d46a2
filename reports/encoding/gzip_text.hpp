// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Compression of a text that is made piece by piece: the whole of it is never in memory.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace rigor::report {

class GzipText {
  public:
    /// `level`: zlib's, 1 (fast) to 9 (small). Throws std::runtime_error.
    explicit GzipText(int level = 6);
    ~GzipText();
    GzipText(const GzipText&) = delete;
    GzipText& operator=(const GzipText&) = delete;

    void add(std::string_view piece);
    /// The file of all pieces in gzip's format; nothing may be added after it.
    std::string finish();

  private:
    struct Stream;
    void run(std::string_view piece, int flush);
    std::unique_ptr<Stream> stream_;
    std::string out_;
};

}  // namespace rigor::report
