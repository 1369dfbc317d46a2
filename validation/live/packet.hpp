// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// JSON with arrays of numbers beside it: the responses of instances, and the data for the browser. Its bytes
// are a bundle of arrays whose meta is the header.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "validation/results/array_bundle.hpp"

namespace rigor::validation {

struct Packet {
    nlohmann::json header = nlohmann::json::object();
    results::ArrayBundle arrays;

    std::string encode() const { return arrays.bytes(header); }
    /// Throws std::runtime_error for bytes that are no packet.
    static Packet decode(std::string_view bytes) {
        nlohmann::ordered_json meta;
        Packet packet;
        packet.arrays = results::ArrayBundle::parse(bytes, meta);
        packet.header = meta;
        return packet;
    }
};

}  // namespace rigor::validation
