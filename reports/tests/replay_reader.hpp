// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Replay files read back as the page does it (web/src/replay/replay_file.ts).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace rigor::report::replay_reader {

class Codes {
  public:
    explicit Codes(std::string bytes) : bytes_(std::move(bytes)) {}
    std::vector<double> series(std::size_t samples, double quantum) {
        std::vector<double> out;
        double last = 0, before = 0;
        int known = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            double difference = 0;
            if (!next(difference)) {
                out.push_back(std::numeric_limits<double>::quiet_NaN());
                continue;
            }
            const double value = difference + (known >= 2 ? 2 * last - before : last);
            before = last;
            last = value;
            ++known;
            out.push_back(value * quantum);
        }
        return out;
    }
    std::vector<double> linked(const std::vector<std::int64_t>& previous, double quantum) {
        std::vector<double> kept, out;
        for (const auto link : previous) {
            const double predicted = link < 0 ? 0.0 : kept.at(link);
            double difference = 0;
            const bool finite = next(difference);
            kept.push_back(finite ? predicted + difference : predicted);
            out.push_back(finite ? kept.back() * quantum : std::numeric_limits<double>::quiet_NaN());
        }
        return out;
    }

  private:
    bool next(double& difference) {
        std::uint64_t code = 0;
        for (int shift = 0;; shift += 7) {
            const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
            code |= static_cast<std::uint64_t>(byte & 127) << shift;
            if (byte < 128) break;
        }
        if (code == 0) return false;
        const std::uint64_t z = code - 1;
        difference = static_cast<std::int64_t>(z >> 1) ^ -static_cast<std::int64_t>(z & 1);
        return true;
    }
    std::string bytes_;
    std::size_t at_ = 0;
};

struct Bundle {
    nlohmann::json meta;
    std::map<std::string, std::string> arrays;
    explicit Bundle(const std::string& bytes) {
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data(), 4);
        const nlohmann::json head = nlohmann::json::parse(bytes.substr(4, length));
        meta = head["meta"];
        const std::size_t start = (4 + length + 7) / 8 * 8;
        for (const auto& a : head["arrays"]) {
            const std::size_t width = a["type"] == "f64" ? 8 : 1;
            arrays[a["name"]] =
                bytes.substr(start + a["offset"].get<std::size_t>(), width * a["count"].get<std::size_t>());
        }
    }
    std::vector<double> steps(std::size_t c) {
        return Codes(arrays.at(std::to_string(c) + ".steps")).series(meta["cases"][c]["frames"], 1.0);
    }
};

/// A contact as the page shows it.
struct ShownContact {
    int bodyA = 0, bodyB = 0, shapeA = 0, shapeB = 0;
    double pointA[3] = {}, normal[3] = {}, depth = 0.0;
};

/// Contacts of one case by the step of their frame; frames without stored contacts are left out.
inline std::map<long, std::vector<ShownContact>> shownContacts(Bundle& bundle, std::size_t c) {
    const std::string name = std::to_string(c);
    const auto& head = bundle.meta["cases"][c];
    const auto steps = bundle.steps(c);
    const auto counts = Codes(bundle.arrays.at(name + ".contactCounts")).series(steps.size(), 1.0);
    const auto total = head["contacts"].get<std::size_t>();
    std::vector<std::int64_t> chain(total);
    for (std::size_t i = 0; i < total; ++i) chain[i] = static_cast<std::int64_t>(i) - 1;
    std::map<long, std::vector<ShownContact>> shown;
    if (total == 0) return shown;
    Codes ids(bundle.arrays.at(name + ".contactIds"));
    std::vector<std::vector<double>> id;
    for (int k = 0; k < 4; ++k) id.push_back(ids.linked(chain, 1.0));

    std::vector<std::int64_t> previous;  // the same bodies, and the same place among their contacts
    std::map<std::array<int, 3>, std::int64_t> latest;
    std::vector<long> stepOf;
    for (std::size_t f = 0; f < steps.size(); ++f) {
        if (counts[f] >= 0) shown[std::lround(steps[f])];
        std::map<std::pair<int, int>, int> seen;
        for (int k = 0; k < counts[f]; ++k) {
            const std::size_t i = previous.size();
            const int a = static_cast<int>(id[0][i]), b = static_cast<int>(id[1][i]);
            const auto [it, isNew] = latest.try_emplace({a, b, seen[{a, b}]++}, -1);
            previous.push_back(it->second);
            it->second = i;
            stepOf.push_back(std::lround(steps[f]));
        }
    }
    const auto& q = head["contactQuantum"];
    Codes numbers(bundle.arrays.at(name + ".contactNumbers"));
    std::vector<std::vector<double>> columns;
    for (const char* quantum :
         {"point", "point", "point", "offset", "offset", "offset", "normal", "normal", "normal", "depth"})
        columns.push_back(numbers.linked(previous, q[quantum]));
    for (std::size_t i = 0; i < total; ++i) {
        ShownContact contact{static_cast<int>(id[0][i]), static_cast<int>(id[1][i]),
                             static_cast<int>(id[2][i]), static_cast<int>(id[3][i])};
        for (std::size_t k = 0; k < 3; ++k) {
            contact.pointA[k] = columns[k][i];
            contact.normal[k] = columns[6 + k][i];
        }
        contact.depth = columns[9][i];
        shown[stepOf[i]].push_back(contact);
    }
    return shown;
}

}  // namespace rigor::report::replay_reader
