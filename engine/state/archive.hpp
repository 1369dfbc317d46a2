// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Three readers of one list of fields (state_fields.def): into a hash, into bytes, and back from bytes. Each
// has
//     scalar(value)      an arithmetic or enum value, without padding
//     size(current)      the length of a list: what is stored, or what to resize to
#pragma once

#include <array>
#include <cstring>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/core/hash.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

class HashArchive {
  public:
    template <class T>
    void scalar(const T& value) {
        hash_.add(value);
    }
    std::size_t size(std::size_t current) {
        hash_.add(static_cast<std::uint64_t>(current));
        return current;
    }
    std::uint64_t value() const { return hash_.value(); }

  private:
    Hasher hash_;
};

class ByteWriter {
  public:
    explicit ByteWriter(std::vector<unsigned char>& out) : out_(out) {}
    template <class T>
    void scalar(const T& value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        const auto* p = reinterpret_cast<const unsigned char*>(&value);
        out_.insert(out_.end(), p, p + sizeof value);
    }
    std::size_t size(std::size_t current) {
        scalar(static_cast<std::uint64_t>(current));
        return current;
    }

  private:
    std::vector<unsigned char>& out_;
};

/// Throws EngineError "snapshot_corrupt" where the bytes end early or hold what cannot be.
class ByteReader {
  public:
    explicit ByteReader(std::span<const unsigned char> bytes) : bytes_(bytes) {}
    template <class T>
    void scalar(T& value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        require(bytes_.size() >= sizeof value, "the bytes end early");
        if constexpr (std::is_same_v<T, bool>) {
            require(bytes_[0] <= 1, "a truth value is neither");
            value = bytes_[0] == 1;
        } else {
            std::memcpy(&value, bytes_.data(), sizeof value);
        }
        bytes_ = bytes_.subspan(sizeof value);
    }
    std::size_t size(std::size_t) {
        std::uint64_t stored = 0;
        scalar(stored);
        require(stored <= bytes_.size(), "a list is longer than the bytes");  // an item takes a byte or more
        return static_cast<std::size_t>(stored);
    }
    void end() const { require(bytes_.empty(), "bytes are left over"); }
    static void require(bool ok, const char* message) {
        if (!ok) throw EngineError("snapshot_corrupt", message);
    }

  private:
    std::span<const unsigned char> bytes_;
};

// --- composite values; const or not, so that hashing and writing need no copy ------------------------------
template <class A, class T>
requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void visitValue(A& archive, T& value) {
    archive.scalar(value);
}
template <class A, class M>
requires requires(M& m) {
    m.derived();
    m.coeffRef(0);
    m.size();
}
void visitValue(A& archive, M& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) archive.scalar(m.coeffRef(i));
}
template <class A, class Q>
requires requires(Q& q) {
    q.coeffs();
    q.vec();
}
void visitValue(A& archive, Q& q) {
    visitValue(archive, q.coeffs());
}
/// The fields of a small struct in their order; none of anything else.
template <class X>
constexpr auto fieldsOf(X& x) {
    if constexpr (requires { x.c, x.s; })
        return std::tie(x.c, x.s);
    else if constexpr (requires { x.p, x.q; })
        return std::tie(x.p, x.q);
    else if constexpr (requires { x.v, x.w; })
        return std::tie(x.v, x.w);
    else if constexpr (
        !requires { x.body; } && requires { x.force, x.torque, x.force.size(); })
        return std::tie(x.force, x.torque);
    else if constexpr (requires { x.index, x.generation; })
        return std::tie(x.index, x.generation);
    else if constexpr (requires { x.friction, x.restitution; })
        return std::tie(x.friction, x.restitution);
    else if constexpr (requires { x.motorSpeed, x.motorMaxForce; })
        return std::tie(x.mode, x.lower, x.upper, x.motorSpeed, x.motorMaxForce, x.target, x.frequency,
                        x.dampingRatio, x.stiffness, x.damping);
    else
        return std::tuple<>();
}
template <class X>
concept HasFields = !std::is_same_v<decltype(fieldsOf(std::declval<X&>())), std::tuple<>>;
template <class A, HasFields X>
void visitValue(A& archive, X& x) {
    std::apply([&archive](auto&... field) { (visitValue(archive, field), ...); }, fieldsOf(x));
}
template <class A, class C>
requires requires(C& c) {
    c.count;
    c.points[0].onA;
    c.points[0].name;
}
void visitValue(A& archive, C& cache) {
    archive.scalar(cache.count);
    ByteReader::require(cache.count >= 0 && cache.count <= static_cast<int>(cache.points.size()),
                        "a manifold of too many points");
    for (std::size_t i = 0; i < static_cast<std::size_t>(cache.count); ++i) {
        visitValue(archive, cache.points[i].onA);
        visitValue(archive, cache.points[i].onB);
        archive.scalar(cache.points[i].name);
    }
}
template <class A, class M>
requires requires(M& m) {
    m.axis;
    m.featureA;
    m.featureB;
    m.names;
}
void visitValue(A& archive, M& memory) {
    archive.scalar(memory.axis);
    archive.scalar(memory.featureA);
    archive.scalar(memory.featureB);
    visitValue(archive, memory.normal);
    archive.scalar(memory.count);
    ByteReader::require(memory.count <= memory.names.size(), "a manifold of too many points");
    for (auto& name : memory.names) archive.scalar(name);
}
template <class A, class L>
requires requires(L& l) {
    l.begin();
    l.data();
    l.max_size();
}
void visitValue(A& archive, L& list) {
    if constexpr (requires { list.resize(std::size_t(0)); }) {
        list.resize(archive.size(list.size()));
    } else {
        const std::size_t n = archive.size(list.size());
        ByteReader::require(n == list.size(), "a list of another length");
    }
    for (auto& value : list) visitValue(archive, value);
}

template <class A, class T>
requires requires(const T& table) {
    table.sound();
}
void visitValue(A& archive, T& table) {
    T::visit(archive, table);
    ByteReader::require(table.sound(), "a table of names that cannot be");
}

}  // namespace rigor::engine
