// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Named arrays of numbers with a JSON head in one piece of memory: how frames reach the 3D view, from a
// report or over a socket. Little-endian:
//   uint32 length of the head | head (UTF-8 JSON) | padding to 8 | arrays, each padded to 8
// The head is {"meta": any, "arrays": [{"name", "type", "offset", "count"}]}; offsets [bytes] count from the
// first array; type is f64, f32, i32, i16 or u8. reports/web/src/common/arrays.ts reads it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rigor::results {

class ArrayBundle {
  public:
    /// Names must differ; the values are copied.
    void add(std::string_view name, std::span<const double> values);
    void add(std::string_view name, std::span<const float> values);
    void add(std::string_view name, std::span<const std::int32_t> values);
    void add(std::string_view name, std::span<const std::int16_t> values);
    void add(std::string_view name, std::span<const std::uint8_t> values);

    /// Takes over the arrays of another bundle, `prefix` before their names.
    void take(std::string_view prefix, const ArrayBundle& other);

    /// The whole bundle; `meta` is any JSON value.
    std::string bytes(const nlohmann::ordered_json& meta) const;
    /// Parses the output of bytes() and returns its meta separately. Throws std::runtime_error for anything
    /// else.
    static ArrayBundle parse(std::string_view bytes, nlohmann::ordered_json& meta);

    bool has(std::string_view name) const { return find(name) != nullptr; }
    /// Throw std::runtime_error where there is no array of this name and type.
    std::vector<double> doubles(std::string_view name) const;
    std::vector<std::int32_t> integers(std::string_view name) const;
    std::size_t size() const { return body_.size(); }  ///< size of all arrays [bytes]

  private:
    struct Entry {
        std::string name, type;
        std::size_t offset, count;
    };
    const Entry* find(std::string_view name) const;
    template <class T>
    std::vector<T> read(std::string_view name, const char* type) const;
    template <class T>
    void append(std::string_view name, const char* type, std::span<const T> values);

    std::vector<Entry> entries_;
    std::string body_;
};

}  // namespace rigor::results
