// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/trajectory_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "validation/results/hdf5_file.hpp"
#include "validation/results/tests/sample_run.hpp"

namespace rigor::results {
namespace {

using sample::TemporaryFolder;
using testing::HasSubstr;

/// Random bit patterns: every kind of double, NaN payloads among them.
std::vector<double> anyDoubles(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> values(count);
    for (double& v : values) v = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
    return values;
}

Channel channel(const char* unit, int columns, std::size_t rows, std::uint64_t seed) {
    return {unit, columns, anyDoubles(rows * columns, seed)};
}

TrajectoryFile sampleFile(std::size_t frames) {
    TrajectoryFile data;
    data.scenario = "slide";
    data.spec = "ode:preset=matched";
    data.caseId = "0123";
    data.dt = 1.0 / 240.0;
    data.stride = 3;
    data.contactStride = 2;
    data.times = anyDoubles(frames, 1);
    for (const char* name : {"floor", "block", "a/b", ".", "_", "50%"})  // order is not alphabetical
        data.bodies.push_back({name, channel("m", 3, frames, 2), channel("1", 4, frames, 3),
                               channel("m/s", 3, frames, 4), channel("rad/s", 3, frames, 5)});
    data.reference.push_back({"block", channel("m", 3, frames, 6), {}, channel("m/s", 3, frames, 7), {}});
    data.series = {{"energy", "", channel("J", 1, frames, 8)},
                   {"energy", "block", channel("J", 1, frames, 9)},
                   {"energy", "_", channel("J", 1, frames, 10)},
                   {"error", "block", channel("m", 1, frames, 11)}};
    for (std::size_t i = 0; i < frames; ++i) {
        ContactSample c;
        c.time = 0.1 * i;
        c.bodyA = static_cast<int>(i % 6);
        c.bodyB = 5;
        c.shapeA = 2;
        c.shapeB = 3;
        c.pointA[1] = 0.5;
        c.pointB[2] = -0.25;
        c.normal[1] = 1.0;
        c.depth = 1e-4;
        c.normalImpulse = std::nan("");
        c.frictionImpulse[0] = -0.0;
        data.contacts.push_back(c);
    }
    return data;
}

void expectSame(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(sample::sameBits(a[i], b[i])) << "value " << i;
}
void expectSame(const Channel& a, const Channel& b) {
    EXPECT_EQ(a.unit, b.unit);
    EXPECT_EQ(a.columns, b.columns);
    expectSame(a.values, b.values);
}
void expectSame(const std::vector<BodyChannels>& a, const std::vector<BodyChannels>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        expectSame(a[i].position, b[i].position);
        expectSame(a[i].orientation, b[i].orientation);
        expectSame(a[i].velocity, b[i].velocity);
        expectSame(a[i].angularVelocity, b[i].angularVelocity);
    }
}

class RoundTrip : public testing::TestWithParam<std::size_t> {};

/// One frame, few frames, and enough to be chunked and compressed.
TEST_P(RoundTrip, IsBitExact) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "case.h5";
    const TrajectoryFile data = sampleFile(GetParam());
    writeTrajectory(file, data);
    const TrajectoryFile read = readTrajectory(file);
    EXPECT_EQ(std::tie(data.scenario, data.spec, data.caseId, data.dt, data.stride, data.contactStride),
              std::tie(read.scenario, read.spec, read.caseId, read.dt, read.stride, read.contactStride));
    expectSame(data.times, read.times);
    expectSame(data.bodies, read.bodies);
    expectSame(data.reference, read.reference);
    ASSERT_EQ(data.series.size(), read.series.size());
    for (std::size_t i = 0; i < data.series.size(); ++i) {
        EXPECT_EQ(data.series[i].name, read.series[i].name);
        EXPECT_EQ(data.series[i].subject, read.series[i].subject);
        expectSame(data.series[i].channel, read.series[i].channel);
    }
    ASSERT_EQ(data.contacts.size(), read.contacts.size());
    for (std::size_t i = 0; i < data.contacts.size(); ++i) {
        const ContactSample &a = data.contacts[i], &b = read.contacts[i];
        EXPECT_EQ(std::tie(a.time, a.bodyA, a.bodyB, a.shapeA, a.shapeB, a.depth),
                  std::tie(b.time, b.bodyA, b.bodyB, b.shapeA, b.shapeB, b.depth));
        EXPECT_THAT(b.pointA, testing::ElementsAreArray(a.pointA));
        EXPECT_THAT(b.pointB, testing::ElementsAreArray(a.pointB));
        EXPECT_THAT(b.normal, testing::ElementsAreArray(a.normal));
        EXPECT_TRUE(std::isnan(b.normalImpulse));
        EXPECT_TRUE(std::signbit(b.frictionImpulse[0]));
    }
    EXPECT_TRUE(read.contactInstantsKnown);
    EXPECT_TRUE(readTrajectory(file, false).contacts.empty());
}
INSTANTIATE_TEST_SUITE_P(Frames, RoundTrip, testing::Values(1u, 7u, 20000u));

/// The last frame begins no step, the first one ends none.
TEST(TrajectoryFile, SaysWhetherContactsStandAtTheEndOfTheirStep) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "case.h5";
    TrajectoryFile data = sampleFile(6);
    data.contactStride = 1;
    for (const bool atEnd : {false, true}) {
        data.contactsAtStepEnd = atEnd;
        writeTrajectory(file, data);
        const TrajectoryFile read = readTrajectory(file);
        EXPECT_EQ(read.contactsAtStepEnd, atEnd);
        EXPECT_EQ(contactsStored(read, 0), !atEnd);
        EXPECT_EQ(contactsStored(read, 5), atEnd);
    }
}

/// Formats before 3 stored contacts at the frame after their step: they are read and marked as of an unknown
/// instant, also after the file was written anew.
TEST(TrajectoryFile, ContactsOfAnOlderFormatAreOfAnUnknownInstant) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "case.h5";
    TrajectoryFile data = sampleFile(6);
    data.contactInstantsKnown = false;
    writeTrajectory(file, data);
    EXPECT_EQ(Hdf5File::open(file).integer("/", "rigor_trajectory"), 2);
    const TrajectoryFile read = readTrajectory(file);
    EXPECT_FALSE(read.contactInstantsKnown);
    EXPECT_EQ(read.contacts.size(), 6u);
    EXPECT_TRUE(contactsStored(read, 4));
    writeTrajectory(file, read);
    EXPECT_FALSE(readTrajectory(file).contactInstantsKnown);
}

/// Every second frame, and never the last one, at which no step begins.
TEST(TrajectoryFile, FramesWhoseContactsAreStored) {
    const TrajectoryFile data = sampleFile(7);
    std::vector<std::size_t> stored;
    for (std::size_t f = 0; f < 9; ++f)
        if (contactsStored(data, f)) stored.push_back(f);
    EXPECT_THAT(stored, testing::ElementsAre(0, 2, 4));
}

TEST(TrajectoryFile, SmoothDataIsCompressed) {
    const TemporaryFolder folder;
    TrajectoryFile data;
    for (int i = 0; i < 100000; ++i) data.times.push_back(i / 1024.0);
    writeTrajectory(folder.path() / "smooth.h5", data);
    EXPECT_LT(std::filesystem::file_size(folder.path() / "smooth.h5"), 100000u * 4u) << "half the plain size";
}

TEST(TrajectoryFile, TheSameDataMakesTheSameFile) {
    const TemporaryFolder folder;
    const auto bytes = [](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    writeTrajectory(folder.path() / "a.h5", sampleFile(50));
    writeTrajectory(folder.path() / "b.h5", sampleFile(50));
    EXPECT_EQ(bytes(folder.path() / "a.h5"), bytes(folder.path() / "b.h5"));
    prepareHdf5File();
    EXPECT_EQ(readTrajectory(folder.path() / "a.h5").caseId, sampleFile(50).caseId);
    writeTrajectory(folder.path() / "c.h5", sampleFile(50));
    EXPECT_EQ(bytes(folder.path() / "a.h5"), bytes(folder.path() / "c.h5"));
}

TEST(TrajectoryFile, DamagedFilesAreNamed) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "case.h5";
    const auto problem = [&] {
        try {
            readTrajectory(file);
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string("nothing was thrown");
    };
    EXPECT_THAT(problem(), HasSubstr("No such file or directory"));
    writeTrajectory(file, sampleFile(20000));
    const auto whole = std::filesystem::file_size(file);
    for (const auto size : {whole - 1, whole / 2, whole / 100, std::uintmax_t{10}, std::uintmax_t{0}}) {
        std::filesystem::resize_file(file, size);
        EXPECT_THAT(problem(), HasSubstr(file.string())) << size << " bytes";
    }
    std::ofstream(file, std::ios::trunc) << "hello";
    EXPECT_THAT(problem(), HasSubstr("cannot be read"));
}

/// A failed write leaves the file that was there, and nothing half-written beside it.
TEST(TrajectoryFile, AFailedWriteChangesNothing) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "case.h5";
    writeTrajectory(file, sampleFile(5));
    TrajectoryFile wrong = sampleFile(6);
    wrong.bodies[3].velocity.values.pop_back();  // no whole number of rows
    EXPECT_THROW(writeTrajectory(file, wrong), std::runtime_error);
    EXPECT_EQ(readTrajectory(file).times.size(), 5u);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    EXPECT_THROW(writeTrajectory(folder.path() / "no" / "folder.h5", sampleFile(1)), std::runtime_error);
}

}  // namespace
}  // namespace rigor::results
