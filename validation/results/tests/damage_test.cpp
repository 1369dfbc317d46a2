// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Damaged files: whatever byte of a store or a trajectory is changed, reading either gives what was written or reports
// the damage. It never crashes, and never gives other numbers without a word.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <random>
#include <sstream>

#include "validation/results/fields.hpp"
#include "validation/results/files.hpp"
#include "validation/results/hdf5_file.hpp"
#include "validation/results/seals.hpp"
#include "validation/results/store.hpp"
#include "validation/results/tests/edited_store.hpp"
#include "validation/results/tests/sample_run.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/results/trial.hpp"

namespace rigor::results {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using sample::caseRow;
using sample::header;
using sample::TemporaryFolder;

/// Every field as text, doubles with all bits.
struct Printer {
    std::ostream& out;
    void operator()(const char* column, double value, int = 1, const char* = nullptr) {
        out << column << '=' << std::bit_cast<std::uint64_t>(value) << '\n';
    }
    template <class T>
    void operator()(const char* column, const std::optional<T>& value, int = 1, const char* = nullptr) {
        if (value)
            (*this)(column, *value);
        else
            out << column << " none\n";
    }
    template <class T>
    void operator()(const char* column, const T& value, int = 1, const char* = nullptr) {
        if constexpr (std::is_enum_v<T>)
            out << column << '=' << textOf(value) << '\n';
        else
            out << column << '=' << value << '\n';
    }
};

std::string textOfCase(const CaseRow& row) {
    std::ostringstream out;
    eachField(row, Printer{out});
    for (const auto& [key, value] : row.settings) out << key << '=' << value << '\n';
    eachList(row, [&](const char* table, const auto& rows) {
        for (const auto& entry : rows) {
            out << table << '\n';
            eachField(entry, Printer{out});
        }
    });
    return out.str();
}

void expectAsWritten(const Run& run) {
    for (const CaseRow& row : run.cases)
        EXPECT_EQ(textOfCase(row), textOfCase(caseRow(row.id, std::stoi(row.id))));
}

std::string messageOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

void overwrite(const fs::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary | std::ios::trunc).write(content.data(), content.size());
}

/// `count` changes of a copy of `content`: one to four bytes, most near each other, or the loss of the end.
class Damager {
  public:
    Damager(std::string content, unsigned seed) : content_(std::move(content)), random_(seed) {}
    std::string next() {
        std::string damaged = content_;
        const auto pick = [&](std::size_t n) {
            return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
        };
        if (pick(10) == 0) {
            damaged.resize(pick(damaged.size()));
            return damaged;
        }
        const std::size_t at = pick(damaged.size()), count = 1 + pick(4);
        for (std::size_t i = at; i < std::min(at + count, damaged.size()); ++i)
            damaged[i] = static_cast<char>(damaged[i] ^ (1 + pick(255)));
        return damaged;
    }

  private:
    std::string content_;
    std::mt19937 random_;
};

TEST(Damage, SealsKnowTheirContent) {
    std::string content = sealed("a text");
    EXPECT_EQ(content.size(), 6 + sealLength());
    EXPECT_EQ(removeSeal(content), Seal::Good);
    EXPECT_EQ(content, "a text");
    EXPECT_EQ(removeSeal(content), Seal::Absent);
    const std::string whole = sealed(std::string(1000, 'x'));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] ^= 0x20;
        EXPECT_EQ(removeSeal(damaged), Seal::Bad) << i;
    }
}

/// The checksum is that of other programs: crc32 of all before the line.
TEST(Damage, TheSealIsReadableByOtherPrograms) {
    EXPECT_EQ(sealed("123456789"), "123456789\nrigor-seal crc32=cbf43926 bytes=0000000000000009\n");
}

void writeSampleStore(const fs::path& folder) {
    RunWriter writer(folder, false);
    writer.writeHeader(header());
    for (int i = 0; i < 12; ++i) writer.writeCase(caseRow(std::to_string(i), i));
    writer.finish("2026-01-01T00:01:00Z");
}

TEST(Damage, AStoreGivesWhatWasWrittenOrReportsTheDamage) {
    const TemporaryFolder folder;
    writeSampleStore(folder.path());
    const fs::path file = folder.path() / "results.sqlite";
    const std::string whole = readFile(file);
    Damager damager(whole, 1);
    int refused = 0, reported = 0, unharmed = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        overwrite(file, damager.next());
        // A broken structure may do anything to a reader but crash it.
        results::Run run;
        const std::string failure = messageOf([&] { run = readRun(folder.path()); });
        if (!failure.empty()) {
            EXPECT_THAT(failure, HasSubstr(file.string()));
            ++refused;
            continue;
        }
        reported += run.damage.empty() ? 0 : 1;
        unharmed += run.damage.empty() ? 1 : 0;
        if (run.damage.empty()) {
            ASSERT_EQ(run.cases.size(), 12u) << "trial " << trial;
            EXPECT_EQ(run.finished, "2026-01-01T00:01:00Z") << "trial " << trial;
        }
        expectAsWritten(run);
    }
    EXPECT_GT(refused, 50);
    EXPECT_GT(reported, 30);
    EXPECT_GT(unharmed, 50) << "there are unused bytes in the file";
}

TEST(Damage, OneDamagedCaseCostsItselfAlone) {
    const TemporaryFolder folder;
    writeSampleStore(folder.path());
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE metrics SET value = value + 1 WHERE case_id = '3' AND ordinal = 0");
        database.exec("UPDATE cases SET ledger_list = NULL WHERE id = '5'");
    }
    const auto run = readRun(folder.path());
    ASSERT_THAT(run.damage, SizeIs(2));
    EXPECT_THAT(run.damage[0], HasSubstr("case 3"));
    EXPECT_THAT(run.damage[1], HasSubstr("case 5"));
    ASSERT_EQ(run.cases.size(), 10u);
    expectAsWritten(run);
}

TEST(Damage, ADamagedCaseIsWrittenAgain) {
    const TemporaryFolder folder;
    writeSampleStore(folder.path());
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE metrics SET value = value + 1 WHERE case_id = '3' AND ordinal = 0");
    }
    {
        RunWriter writer(folder.path(), true);
        writer.writeCase(caseRow("3", 3));
    }
    const auto run = readRun(folder.path());
    EXPECT_THAT(run.damage, IsEmpty());
    EXPECT_EQ(run.cases.size(), 12u);
}

/// Cases share their lists: a damaged one costs all of them, and the first that is written again gets a new one.
TEST(Damage, ADamagedListIsNotTakenForAnother) {
    const TemporaryFolder folder;
    writeSampleStore(folder.path());
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE shared_settings SET value = 'other' WHERE ordinal = 0");
    }
    EXPECT_THAT(readRun(folder.path()).damage, SizeIs(12));
    {
        RunWriter writer(folder.path(), true);
        for (const int i : {3, 4}) writer.writeCase(caseRow(std::to_string(i), i));
    }
    const auto run = readRun(folder.path());
    EXPECT_THAT(run.damage, SizeIs(10));
    EXPECT_EQ(run.cases.size(), 2u);
    expectAsWritten(run);
}

/// Bringing a store up to date makes no damaged case a good one.
TEST(Damage, OutlivesTheUpgradeOfAStore) {
    const TemporaryFolder folder;
    writeSampleStore(folder.path());
    {
        SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE metrics SET value = value + 1 WHERE case_id = '3' AND ordinal = 0");
        sample::takeBackSharedLists(database);
        for (const std::string id : {"0", "1", "2", "4", "5", "6", "7", "8", "9", "10", "11"})
            sealCase(database, id);
        database.exec("PRAGMA user_version = 12");
    }
    { RunWriter(folder.path(), true); }
    auto run = readRun(folder.path());
    ASSERT_THAT(run.damage, SizeIs(1));
    EXPECT_THAT(run.damage[0], HasSubstr("case 3"));
    EXPECT_EQ(run.cases.size(), 11u);
    for (CaseRow& c : run.cases) c.metrics.at(0).boundMin = 0.1 + 0.2;  // schema 12 has no lower bounds
    expectAsWritten(run);
}

TEST(Damage, AChangedHeaderIsRefused) {
    for (const char* change :
         {"UPDATE scenarios SET text = 'x'", "UPDATE run SET suite = 'other'", "DELETE FROM environment",
          "DELETE FROM seals", "PRAGMA user_version = 10", "PRAGMA user_version = 12"}) {
        const TemporaryFolder folder;
        writeSampleStore(folder.path());
        {
            SQLite::Database database((folder.path() / "results.sqlite").string(), SQLite::OPEN_READWRITE);
            database.exec(change);
        }
        EXPECT_THAT(messageOf([&] { readRun(folder.path()); }), HasSubstr("damaged")) << change;
    }
}

TrajectoryFile sampleTrajectory() {
    TrajectoryFile file;
    file.scenario = "damaged";
    file.spec = "engine:preset=default";
    file.caseId = "0123";
    file.dt = 0.01;
    for (int i = 0; i < 300; ++i) file.times.push_back(0.01 * i);
    BodyChannels body;
    body.name = "ball";
    body.position = {"m", 3, std::vector<double>(900, 1.5)};
    file.bodies.push_back(body);
    file.series.push_back({"energy", "", {"J", 1, std::vector<double>(300, 2.5)}});
    return file;
}

TEST(Damage, ATrajectoryGivesWhatWasWrittenOrReportsTheDamage) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "case.h5";
    writeTrajectory(file, sampleTrajectory());
    EXPECT_EQ(trajectoryProblem(file), "");
    Damager damager(readFile(file), 2);
    for (int trial = 0; trial < 300; ++trial) {
        overwrite(file, damager.next());
        TrajectoryFile read;
        const std::string failure = messageOf([&] { read = readTrajectory(file); });
        EXPECT_EQ(failure.empty(), trajectoryProblem(file).empty());
        if (!failure.empty()) {
            EXPECT_THAT(failure, HasSubstr(file.string()));
            continue;
        }
        // The seal alone was cut off.
        EXPECT_EQ(read.times, sampleTrajectory().times) << "trial " << trial;
        ASSERT_EQ(read.bodies.size(), 1u) << "trial " << trial;
        EXPECT_EQ(read.bodies[0].position.values, sampleTrajectory().bodies[0].position.values)
            << "trial " << trial;
    }
    fs::remove(file);
    EXPECT_THAT(trajectoryProblem(file), HasSubstr("No such file or directory (ENOENT)"));
}

/// Files of older versions have no checksum: the HDF5 library reads them in a child first.
TEST(Damage, AnOldTrajectoryThatCrashesTheLibraryIsReported) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "case.h5";
    writeTrajectory(file, sampleTrajectory());
    std::string old = readFile(file);
    ASSERT_EQ(removeSeal(old), Seal::Good);
    overwrite(file, old);
    EXPECT_EQ(readTrajectory(file).times.size(), 300u);
    Damager damager(old, 3);
    int failures = 0;
    for (int trial = 0; trial < 300; ++trial) {
        overwrite(file, damager.next());
        failures += messageOf([&] { readTrajectory(file); }).empty() ? 0 : 1;
    }
    EXPECT_GT(failures, 30);
}

TEST(Damage, WorkThatCrashesIsTriedInAChild) {
    EXPECT_EQ(failureInChild([] {}), "");
    EXPECT_EQ(failureInChild([] { throw std::runtime_error("no such dataset"); }), "no such dataset");
    EXPECT_THAT(failureInChild([] { std::abort(); }), HasSubstr("crashes the library: Aborted"));
    EXPECT_THAT(failureInChild([] { _exit(0); }), HasSubstr("ended the process"));
}

}  // namespace
}  // namespace rigor::results
