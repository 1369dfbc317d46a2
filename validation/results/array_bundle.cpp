// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/array_bundle.hpp"

#include <bit>
#include <nlohmann/json.hpp>

namespace rigor::results {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are stored as they are in memory");

void pad(std::string& bytes) {
    bytes.append((8 - bytes.size() % 8) % 8, '\0');
}

}  // namespace

template <class T>
void ArrayBundle::append(std::string_view name, const char* type, std::span<const T> values) {
    entries_.push_back({std::string(name), type, body_.size(), values.size()});
    body_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    pad(body_);
}

void ArrayBundle::add(std::string_view name, std::span<const double> values) {
    append(name, "f64", values);
}
void ArrayBundle::add(std::string_view name, std::span<const float> values) {
    append(name, "f32", values);
}
void ArrayBundle::add(std::string_view name, std::span<const std::int32_t> values) {
    append(name, "i32", values);
}
void ArrayBundle::add(std::string_view name, std::span<const std::int16_t> values) {
    append(name, "i16", values);
}
void ArrayBundle::add(std::string_view name, std::span<const std::uint8_t> values) {
    append(name, "u8", values);
}

std::string ArrayBundle::bytes(const nlohmann::ordered_json& meta) const {
    nlohmann::ordered_json head{{"meta", meta}, {"arrays", nlohmann::ordered_json::array()}};
    for (const auto& entry : entries_)
        head["arrays"].push_back(
            {{"name", entry.name}, {"type", entry.type}, {"offset", entry.offset}, {"count", entry.count}});
    const std::string text = head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const auto length = static_cast<std::uint32_t>(text.size());
    std::string out;
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((length >> shift) & 0xFF);
    out += text;
    pad(out);
    return out + body_;
}

}  // namespace rigor::results
