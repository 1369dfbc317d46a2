// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/frame.hpp"

#include <bit>
#include <cctype>
#include <cstring>

namespace rigor::guest {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they stand in memory");

template <class Integer>
Integer integerAt(const std::string& bytes, std::size_t offset) {
    Integer value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <class Integer>
void appendInteger(std::string& bytes, Integer value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The first bytes of something, so that a message can be printed.
std::string printable(const std::string& bytes) {
    std::string text;
    for (const char c : bytes.substr(0, 40)) text += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
    return text;
}

/// Place of an array in the payload, as its entry in the header gives it.
struct Place {
    std::size_t offset = 0, rows = 0, columns = 1;
    bool isBytes = false;
};

std::size_t extentOf(const Json& value) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMostPayloadBytes)
        throw BadFrame("an array's shape: found " + value.dump() + ", expected a count");
    return value.get<std::size_t>();
}

Place placeOf(const Json& entry, std::size_t offset) {
    if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string() ||
        !entry.contains("shape") || !entry["shape"].is_array() || entry["shape"].empty() ||
        entry["shape"].size() > 2)
        throw BadFrame("an array: found " + entry.dump() + ", expected name and shape");
    const std::string type = entry.value("type", Json("f64")).dump();
    if (type != "\"f64\"" && type != "\"u8\"")
        throw BadFrame("an array's type: found " + type + ", expected f64 or u8");
    Place place{offset, extentOf(entry["shape"][0]), 1, type == "\"u8\""};
    if (entry["shape"].size() == 2) place.columns = extentOf(entry["shape"][1]);
    return place;
}

std::size_t sizeOf(const Place& place) {
    // The limits of both extents keep the products far below 2^64.
    const std::size_t count = place.columns == 0 ? 0 : place.rows * place.columns;
    if (place.rows > kMostPayloadBytes || place.columns > 4096 || count > kMostPayloadBytes)
        throw BadFrame("an array is larger than a frame may be");
    return place.isBytes ? count : count * sizeof(double);
}

std::optional<Place> find(const Frame& frame, const std::string& name) {
    std::size_t offset = 0;
    const auto arrays = frame.header.find("arrays");
    if (arrays == frame.header.end()) return std::nullopt;
    for (const Json& entry : *arrays) {
        const Place place = placeOf(entry, offset);
        if (entry["name"] == name) return place;
        offset += sizeOf(place);
    }
    return std::nullopt;
}

/// The arrays that the header lists fill the payload exactly.
void checkPayload(const Frame& frame) {
    std::size_t expected = 0;
    if (const auto arrays = frame.header.find("arrays"); arrays != frame.header.end()) {
        if (!arrays->is_array())
            throw BadFrame("the key 'arrays': found " + arrays->dump() + ", expected a list");
        for (const Json& entry : *arrays) expected += sizeOf(placeOf(entry, 0));
    }
    if (expected != frame.payload.size())
        throw BadFrame("the arrays of the header have " + std::to_string(expected) +
                       " bytes, the frame has " + std::to_string(frame.payload.size()));
}

}  // namespace

void Frame::addTable(const std::string& name, const Table& table) {
    header["arrays"].push_back({{"name", name}, {"shape", {table.rows, table.columns}}});
    payload.append(reinterpret_cast<const char*>(table.values.data()), table.values.size() * sizeof(double));
}

void Frame::addBytes(const std::string& name, const std::vector<unsigned char>& bytes) {
    header["arrays"].push_back({{"name", name}, {"type", "u8"}, {"shape", {bytes.size()}}});
    payload.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Table Frame::table(const std::string& name, std::size_t columns) const {
    const auto place = find(*this, name);
    if (!place) throw BadFrame("the array '" + name + "' is missing");
    if (place->isBytes) throw BadFrame("the array '" + name + "' has bytes instead of numbers");
    if (place->columns != columns && place->rows > 0)
        throw BadFrame("the array '" + name + "' has " + std::to_string(place->columns) +
                       " columns, expected " + std::to_string(columns));
    Table table{place->rows, columns, std::vector<double>(place->rows * columns)};
    if (!table.values.empty())
        std::memcpy(table.values.data(), payload.data() + place->offset,
                    table.values.size() * sizeof(double));
    return table;
}

std::vector<unsigned char> Frame::bytes(const std::string& name) const {
    const auto place = find(*this, name);
    if (!place || !place->isBytes) throw BadFrame("the bytes '" + name + "' are missing");
    const auto* begin = reinterpret_cast<const unsigned char*>(payload.data()) + place->offset;
    return {begin, begin + sizeOf(*place)};
}

std::string encode(const Frame& frame) {
    const std::string header = frame.header.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string bytes(kMagic);
    bytes.reserve(kPrefixBytes + header.size() + frame.payload.size());
    appendInteger(bytes, static_cast<std::uint32_t>(header.size()));
    appendInteger(bytes, static_cast<std::uint64_t>(frame.payload.size()));
    return bytes + header + frame.payload;
}

std::optional<Frame> FrameReader::next() {
    const std::size_t seen = std::min(buffer_.size(), kMagic.size());
    if (std::string_view(buffer_).substr(0, seen) != kMagic.substr(0, seen))
        throw BadFrame("its output is no frame; it begins with '" + printable(buffer_) + "'");
    if (buffer_.size() < kPrefixBytes) return std::nullopt;
    const std::size_t header = integerAt<std::uint32_t>(buffer_, 4);
    const std::uint64_t payload = integerAt<std::uint64_t>(buffer_, 8);
    if (header > kMostHeaderBytes || payload > kMostPayloadBytes)
        throw BadFrame("a frame of " + std::to_string(header) + " and " + std::to_string(payload) +
                       " bytes, which is more than a frame may have");
    const std::size_t whole = kPrefixBytes + header + payload;
    if (buffer_.size() < whole) return std::nullopt;
    Frame frame;
    frame.header =
        Json::parse(buffer_.begin() + kPrefixBytes, buffer_.begin() + kPrefixBytes + header, nullptr, false);
    if (!frame.header.is_object()) throw BadFrame("a frame's header is no JSON object");
    frame.payload = buffer_.substr(kPrefixBytes + header, payload);
    buffer_.erase(0, whole);
    checkPayload(frame);
    return frame;
}

}  // namespace rigor::guest
