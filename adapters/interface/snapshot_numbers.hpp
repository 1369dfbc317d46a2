// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Snapshots whose bytes are numbers in double precision, one behind the other, bit for bit.
#pragma once

#include <cstring>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <vector>

#include "scenarios/model/math.hpp"

namespace rigor::adapter {

class NumberWriter {
  public:
    /// The writer clears the bytes.
    explicit NumberWriter(std::vector<unsigned char>& bytes) : bytes_(bytes) { bytes_.clear(); }
    void put(std::span<const double> numbers) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + numbers.size_bytes());
        if (!numbers.empty()) std::memcpy(bytes_.data() + at, numbers.data(), numbers.size_bytes());
    }
    void put(double number) { put(std::span(&number, 1)); }
    void put(const scenario::Vec3& v) { put(std::initializer_list<double>{v.x, v.y, v.z}); }
    void put(const scenario::Quat& q) { put(std::initializer_list<double>{q.w, q.x, q.y, q.z}); }

  private:
    void put(std::initializer_list<double> numbers) { put(std::span(numbers.begin(), numbers.size())); }

    std::vector<unsigned char>& bytes_;
};

/// Reads in the order of writing. Throws where the bytes are too few.
class NumberReader {
  public:
    explicit NumberReader(std::span<const unsigned char> bytes) : rest_(bytes) {}
    void take(std::span<double> numbers) {
        if (numbers.size_bytes() > rest_.size()) throw std::runtime_error("a snapshot that is too short");
        if (!numbers.empty()) std::memcpy(numbers.data(), rest_.data(), numbers.size_bytes());
        rest_ = rest_.subspan(numbers.size_bytes());
    }
    double take() {
        double number = 0.0;
        take(std::span(&number, 1));
        return number;
    }
    scenario::Vec3 takeVector() {
        double v[3];
        take(v);
        return {v[0], v[1], v[2]};
    }
    scenario::Quat takeQuat() {
        double q[4];
        take(q);
        return {q[0], q[1], q[2], q[3]};
    }

  private:
    std::span<const unsigned char> rest_;
};

}  // namespace rigor::adapter
