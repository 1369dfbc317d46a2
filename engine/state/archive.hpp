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
#include <type_traits>
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
    m.derived(), m.coeffRef(0), m.size();
}
void visitValue(A& archive, M& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) archive.scalar(m.coeffRef(i));
}
template <class A, class Q>
requires requires(Q& q) {
    q.coeffs(), q.vec();
}
void visitValue(A& archive, Q& q) {
    visitValue(archive, q.coeffs());
}
template <class A, class Q>
requires requires(Q& q) {
    q.c, q.s;
}
void visitValue(A& archive, Q& q) {
    archive.scalar(q.c), archive.scalar(q.s);
}
template <class A, class X>
requires requires(X& x) {
    x.p, x.q;
}
void visitValue(A& archive, X& x) {
    visitValue(archive, x.p), visitValue(archive, x.q);
}
template <class A, class V>
requires requires(V& v) {
    v.v, v.w;
}
void visitValue(A& archive, V& v) {
    visitValue(archive, v.v), visitValue(archive, v.w);
}
template <class A, class W>
requires requires(W& w) {
    w.force, w.torque, w.force.size();
} &&(!requires(W & w) { w.body; }) void visitValue(A& archive, W& w) {
    visitValue(archive, w.force), visitValue(archive, w.torque);
}
template <class A, class I>
requires requires(I& id) {
    id.index, id.generation;
}
void visitValue(A& archive, I& id) {
    archive.scalar(id.index), archive.scalar(id.generation);
}
template <class A, class C>
requires requires(C& c) {
    c.friction, c.restitution;
}
void visitValue(A& archive, C& c) {
    archive.scalar(c.friction), archive.scalar(c.restitution);
}
template <class A, class J>
requires requires(J& j) {
    j.motorSpeed, j.motorMaxForce;
}
void visitValue(A& archive, J& axis) {
    archive.scalar(axis.mode), archive.scalar(axis.lower), archive.scalar(axis.upper);
    archive.scalar(axis.motorSpeed), archive.scalar(axis.motorMaxForce), archive.scalar(axis.target);
    archive.scalar(axis.frequency), archive.scalar(axis.dampingRatio);
    archive.scalar(axis.stiffness), archive.scalar(axis.damping);
}
template <class A, class C>
requires requires(C& c) {
    c.count, c.points[0].onA, c.points[0].name;
}
void visitValue(A& archive, C& cache) {
    archive.scalar(cache.count);
    ByteReader::require(cache.count >= 0 && cache.count <= static_cast<int>(cache.points.size()),
                        "a manifold of too many points");
    for (std::size_t i = 0; i < static_cast<std::size_t>(cache.count); ++i) {
        visitValue(archive, cache.points[i].onA), visitValue(archive, cache.points[i].onB);
        archive.scalar(cache.points[i].name);
    }
}
template <class A, class M>
requires requires(M& m) {
    m.axis, m.featureA, m.featureB, m.names;
}
void visitValue(A& archive, M& memory) {
    archive.scalar(memory.axis), archive.scalar(memory.featureA), archive.scalar(memory.featureB);
    visitValue(archive, memory.normal), archive.scalar(memory.count);
    ByteReader::require(memory.count <= memory.names.size(), "a manifold of too many points");
    for (auto& name : memory.names) archive.scalar(name);
}
template <class A, class L>
requires requires(L& l) {
    l.begin(), l.data(), l.max_size();
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
