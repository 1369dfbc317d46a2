// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/array_bundle.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace rigor::results {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are stored as they are in memory");

void pad(std::string& bytes) {
    bytes.append((8 - bytes.size() % 8) % 8, '\0');
}

std::size_t sizeOf(const std::string& type) {
    if (type == "f64") return 8;
    if (type == "f32" || type == "i32") return 4;
    if (type == "i16") return 2;
    return type == "u8" ? 1 : 0;
}

[[noreturn]] void refuse(const char* why) {
    throw std::runtime_error(std::string("not a bundle of arrays: ") + why);
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

void ArrayBundle::take(std::string_view prefix, const ArrayBundle& other) {
    for (const Entry& entry : other.entries_) {
        entries_.push_back(entry);
        entries_.back().name.insert(0, prefix);
        entries_.back().offset += body_.size();
    }
    body_ += other.body_;
}

const ArrayBundle::Entry* ArrayBundle::find(std::string_view name) const {
    const auto it =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
    return it == entries_.end() ? nullptr : &*it;
}

template <class T>
std::vector<T> ArrayBundle::read(std::string_view name, const char* type) const {
    const Entry* entry = find(name);
    if (entry == nullptr || entry->type != type)
        throw std::runtime_error("no array '" + std::string(name) + "' of type " + type);
    std::vector<T> values(entry->count);
    if (entry->count > 0) std::memcpy(values.data(), body_.data() + entry->offset, entry->count * sizeof(T));
    return values;
}
std::vector<double> ArrayBundle::doubles(std::string_view name) const {
    return read<double>(name, "f64");
}
std::vector<std::int32_t> ArrayBundle::integers(std::string_view name) const {
    return read<std::int32_t>(name, "i32");
}

ArrayBundle ArrayBundle::parse(std::string_view bytes, nlohmann::ordered_json& meta) {
    std::uint32_t length = 0;
    if (bytes.size() < 8) refuse("too short");
    std::memcpy(&length, bytes.data(), sizeof length);
    if (length > bytes.size() - 4) refuse("cut short");
    auto head = nlohmann::ordered_json::parse(bytes.substr(4, length), nullptr, false);
    if (!head.is_object() || !head.contains("meta") || !head.contains("arrays")) refuse("no head");
    const std::size_t start = (4 + std::size_t{length} + 7) / 8 * 8;
    ArrayBundle bundle;
    if (start < bytes.size()) bundle.body_ = bytes.substr(start);
    for (const auto& e : head["arrays"]) {
        Entry entry{e.at("name"), e.at("type"), e.at("offset"), e.at("count")};
        const std::size_t size = sizeOf(entry.type), most = bundle.body_.size();
        if (size == 0 || entry.offset > most || entry.count > (most - entry.offset) / size)
            refuse("an array beyond its end");
        bundle.entries_.push_back(std::move(entry));
    }
    meta = std::move(head["meta"]);
    return bundle;
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
