// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames of the guest protocol (PROTOCOL.md): 16 bytes, a JSON header, and arrays of numbers or bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rigor::guest {

using Json = nlohmann::json;

inline constexpr std::size_t kPrefixBytes = 16;
inline constexpr std::string_view kMagic = "RGF1";
inline constexpr std::size_t kMostHeaderBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMostPayloadBytes = std::size_t{1} << 32;

/// Bytes that are no frame, or a header that lacks something or has something wrong.
class BadFrame : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Rows of numbers of one length.
struct Table {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;  ///< row by row
    double operator()(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

struct Frame {
    Json header = Json::object();
    std::string payload;

    /// Appends an array, and its name and shape to the header.
    void addTable(const std::string& name, const Table& table);
    void addBytes(const std::string& name, const std::vector<unsigned char>& bytes);

    /// The array of a name. Throws BadFrame where it is missing or has not so many columns.
    Table table(const std::string& name, std::size_t columns) const;
    std::vector<unsigned char> bytes(const std::string& name) const;
};

std::string encode(const Frame& frame);

/// Takes bytes as they come and gives the frames that are complete.
class FrameReader {
  public:
    void append(const char* data, std::size_t size) { buffer_.append(data, size); }
    /// The next frame, or nothing while it is incomplete. Throws BadFrame as soon as the bytes can not be one.
    std::optional<Frame> next();
    /// Bytes of a frame that is incomplete.
    std::size_t pending() const { return buffer_.size(); }

  private:
    std::string buffer_;
};

}  // namespace rigor::guest
