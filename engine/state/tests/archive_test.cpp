// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hash, bytes and reading back walk over the same scalars: each of them counts, and each comes back.
#include "engine/state/archive.hpp"

#include <gtest/gtest.h>

#include "engine/math/tests/random_values.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {
namespace {

template <class T>
std::vector<unsigned char> bytesOf(const T& value) {
    std::vector<unsigned char> bytes;
    ByteWriter writer(bytes);
    visitValue(writer, value);
    return bytes;
}
template <class T>
std::uint64_t hashOf(const T& value) {
    HashArchive hash;
    visitValue(hash, value);
    return hash.value();
}
/// The id of the refusal; empty where the bytes are read.
template <class T>
std::string readInto(T& value, std::span<const unsigned char> bytes) {
    try {
        ByteReader reader(bytes);
        visitValue(reader, value);
        reader.end();
    } catch (const EngineError& error) {
        return error.id();
    }
    return "";
}

/// Writes, reads into `other`, and changes every byte in turn: none is without effect, neither on the value nor on the
/// hash. `size`: of all scalars together, without padding.
template <class T>
void expectEveryByteCounts(const T& value, T other, std::size_t size) {
    const std::vector<unsigned char> bytes = bytesOf(value);
    ASSERT_EQ(bytes.size(), size) << "a field is missing, or is there twice";
    ASSERT_NE(hashOf(other), hashOf(value)) << "nothing to test";
    ASSERT_EQ(readInto(other, bytes), "");
    EXPECT_EQ(hashOf(other), hashOf(value));
    EXPECT_EQ(bytesOf(other), bytes);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<unsigned char> changed = bytes;
        changed[i] ^= 1;
        T read = value;
        if (!readInto(read, changed).empty()) continue;  // the changed byte may be of a length
        EXPECT_EQ(bytesOf(read), changed) << "byte " << i;
        EXPECT_NE(hashOf(read), hashOf(value)) << "byte " << i;
    }
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        T read = value;
        EXPECT_EQ(readInto(read, std::span(bytes).first(length)), "snapshot_corrupt") << length;
    }
    std::vector<unsigned char> longer = bytes;
    longer.push_back(0);
    T read = value;
    EXPECT_EQ(readInto(read, longer), "snapshot_corrupt");
}

template <class S>
class ArchivesOf : public testing::Test, public RandomValues<S> {
  public:
    using Real = typename S::Real;
    static constexpr std::size_t kReal = sizeof(Real);
    static constexpr std::size_t kLinear = S::dim * kReal;
    static constexpr std::size_t kAngular = (S::dim == 3 ? 3 : 1) * kReal;
    static constexpr std::size_t kRotation = (S::dim == 3 ? 4 : 2) * kReal;
};
using Spaces = testing::Types<Space2f, Space2d, Space3f, Space3d>;
TYPED_TEST_SUITE(ArchivesOf, Spaces);

TYPED_TEST(ArchivesOf, KeepPosesVelocitiesAndForces) {
    using S = TypeParam;
    expectEveryByteCounts(this->pose(3), Pose<S>{}, this->kLinear + this->kRotation);
    const Velocity<S> velocity{this->vector(2), this->angular(2)};
    expectEveryByteCounts(velocity, Velocity<S>{}, this->kLinear + this->kAngular);
    expectEveryByteCounts(Wrench<S>{this->vector(2), this->angular(2)}, Wrench<S>{},
                          this->kLinear + this->kAngular);
}

TYPED_TEST(ArchivesOf, KeepIdsCoefficientsAndAxes) {
    using R = typename TestFixture::Real;
    expectEveryByteCounts(BodyId{7, 3}, BodyId{}, 8);
    PairCoefficients<TypeParam> pair;
    pair.friction = R(0.5);
    pair.restitution = R(0.25);
    expectEveryByteCounts(pair, PairCoefficients<TypeParam>{}, 2 * this->kReal);
    const JointAxis<R> axis{AxisMode::Limited, -1, 2, 3, 4, 5, 6, 7, 0, 9};
    expectEveryByteCounts(axis, JointAxis<R>{}, sizeof(AxisMode) + 9 * this->kReal);
}

/// A list is its length and its items. Read into a list of another length it takes that length.
TYPED_TEST(ArchivesOf, KeepListsOfAnyLength) {
    using S = TypeParam;
    std::vector<Pose<S>> poses;
    for (int i = 0; i < 3; ++i) poses.push_back(this->pose(2));
    const std::size_t size = 8 + 3 * (this->kLinear + this->kRotation);
    expectEveryByteCounts(poses, std::vector<Pose<S>>(7), size);
    expectEveryByteCounts(poses, std::vector<Pose<S>>{}, size);
    std::array<typename S::Real, 4> fixed{1, 2, 3, 4}, other{};
    expectEveryByteCounts(fixed, other, 8 + 4 * this->kReal);
    std::vector<unsigned char> huge = bytesOf(poses);
    std::fill_n(huge.begin(), 7, static_cast<unsigned char>(0xff));
    std::vector<Pose<S>> read;
    EXPECT_EQ(readInto(read, huge), "snapshot_corrupt") << "lengths are checked before memory is taken";
}

/// Two lists must not have the bits of one longer list: lengths are hashed.
TEST(Hashes, TellListsOfDifferentLengthsApart) {
    const std::vector<std::vector<int>> one{{1, 2}, {3}}, other{{1}, {2, 3}};
    EXPECT_NE(hashOf(one), hashOf(other));
    EXPECT_NE(hashOf(std::vector<int>{}), hashOf(std::vector<int>{0}));
}

/// FNV-1a, 64 bits: published values of the empty string, "a" and "foobar".
TEST(Hashes, AreFnv1a) {
    const auto hashed = [](const std::string& text) {
        Hasher hash;
        hash.bytes(text.data(), text.size());
        return hash.value();
    };
    EXPECT_EQ(hashed(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(hashed("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_EQ(hashed("foobar"), 0x85944171f73967e8ull);
}

/// The gaps that SIMD needs between the numbers of a velocity are no part of the state.
TYPED_TEST(ArchivesOf, LeaveGapsOut) {
    using S = TypeParam;
    const Velocity<S> velocity{this->vector(2), this->angular(2)};
    Velocity<S> noisy = velocity;
    if constexpr (S::dim == 2)
        noisy.gap = 5;
    else
        noisy.gapV = noisy.gapW = 5;
    EXPECT_EQ(hashOf(noisy), hashOf(velocity));
}

TEST(ByteReader, RefusesTruthValuesThatAreNeither) {
    bool value = true;
    EXPECT_EQ(readInto(value, std::vector<unsigned char>{0}), "");
    EXPECT_FALSE(value);
    EXPECT_EQ(readInto(value, std::vector<unsigned char>{1}), "");
    EXPECT_TRUE(value);
    EXPECT_EQ(readInto(value, std::vector<unsigned char>{2}), "snapshot_corrupt");
}

/// Bodies of a world, each array of the list: one changed item of one body changes the hash, and comes back.
template <class S, class Array>
void expectItemsCount(BodyArrays<S>& bodies, Array& array, const std::string& name) {
    const auto hash = [&] {
        HashArchive archive;
#define BODY_FIELD(member) visitValue(archive, bodies.member);
#include "engine/state/state_fields.def"
        return archive.value();
    };
    const std::uint64_t before = hash();
    const std::vector<unsigned char> bytes = bytesOf(array);
    for (std::size_t i = 8; i < bytes.size(); ++i) {
        std::vector<unsigned char> changed = bytes;
        changed[i] ^= 1;
        ASSERT_EQ(readInto(array, changed), "") << name;
        ASSERT_NE(hash(), before) << name << ", byte " << i;
        ASSERT_EQ(bytesOf(array), changed) << name << ", byte " << i;
    }
    ASSERT_EQ(readInto(array, bytes), "");
    ASSERT_EQ(hash(), before);
}

TYPED_TEST(ArchivesOf, EveryArrayOfTheListCountsForEveryBody) {
    using S = TypeParam;
    BodyArrays<S> bodies;
    for (std::uint32_t i = 0; i < 3; ++i) {
        bodies.pose.push_back(this->pose(2));
        bodies.velocity.emplace_back(this->vector(2), this->angular(2));
        bodies.wrench.push_back({this->vector(2), this->angular(2)});
        bodies.asleep.push_back(0);
        bodies.stillTime.push_back(this->uniform(1));
        bodies.id.push_back({i, 1});
    }
#define BODY_FIELD(member) expectItemsCount(bodies, bodies.member, #member);
#include "engine/state/state_fields.def"
}

}  // namespace
}  // namespace rigor::engine
