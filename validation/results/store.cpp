// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/store.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "validation/results/bench_rows.hpp"
#include "validation/results/columns.hpp"
#include "validation/results/files.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/schema.hpp"
#include "validation/results/seals.hpp"
#include "validation/results/shared_lists.hpp"

namespace rigor::results {

namespace fs = std::filesystem;

/// One writer per run folder, also across processes; the lock ends with the process, however it ends.
class FolderLock {
  public:
    static constexpr const char* kName = ".lock";

    explicit FolderLock(const fs::path& directory)
        : file_(open((directory / kName).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
        if (file_ < 0) throw EnvironmentError(directory, "cannot write here", errno);
        if (!locked()) {
            close(file_);
            throw std::runtime_error(directory.string() + ": another rigor is writing this run");
        }
    }
    ~FolderLock() { close(file_); }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    /// A writer that was killed keeps its lock for a moment in a child that was just being started.
    bool locked() const {
        for (int attempt = 0; attempt < 50; ++attempt) {
            if (flock(file_, LOCK_EX | LOCK_NB) == 0) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return false;
    }
    int file_;
};

namespace {

fs::path storeFile(const fs::path& directory) {
    return directory / "results.sqlite";
}

SQLite::Database openForWriting(const fs::path& directory, bool resume) {
    const fs::path file = storeFile(directory);
    const bool present = holdsStore(directory);
    if (present && !resume)
        throw std::runtime_error(directory.string() +
                                 ": holds a run already; resume it or choose another folder");
    return present ? openDatabase(file, true) : createDatabase(file);
}

fs::path createdFolder(const fs::path& directory, bool resume) {
    if (resume && !wasBegun(directory))
        throw std::runtime_error(directory.string() + ": holds no run that could be resumed");
    createFolders(directory / "trajectories");
    return directory;
}

/// Writes a description of the folder, for people and for programs that do not read SQLite.
void writeManifest(const fs::path& directory, const Run& run) {
    const nlohmann::ordered_json manifest{
        {"rigor_run", kSchemaVersion},   {"suite", run.suite},
        {"command", run.command},        {"started", run.started},
        {"finished", run.finished},      {"planned_cases", run.plannedCases},
        {"store", "results.sqlite"},     {"trajectories", "trajectories"},
        {"environment", run.environment}};
    replaceFile(directory / "manifest.json",
                manifest.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

/// Error that a new file with some content meets in the folder of the store; 0: none.
int errorOfNewFile(const fs::path& store) {
    fs::path probe = store;
    probe += ".probe";
    const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0) return errno;
    const std::string content(4096, ' ');
    const int code = write(file, content.data(), content.size()) < 0 || fsync(file) != 0 ? errno : 0;
    close(file);
    std::error_code ignored;
    fs::remove(probe, ignored);
    return code;
}

/// An error of SQLite as one of the environment, with the errno of the system call behind it. SQLite does not always know
/// that: if it cannot make its journal it looks for an old one, and reports that there is none; what fails when it takes
/// a transaction back has no errno. Then a file of our own is tried.
EnvironmentError storeError(const fs::path& file, const SQLite::Exception& error, int systemCode) {
    int code = error.getErrorCode() == SQLITE_FULL ? ENOSPC : systemCode;
    if (error.getErrorCode() == SQLITE_CANTOPEN || code == 0)
        if (const int found = errorOfNewFile(file); found != 0) code = found;
    return EnvironmentError(file, std::string("cannot be written: ") + error.what(), code);
}

/// A table that was computed from the cases can be computed again.
bool mayBeLeftOut(const std::string& table) {
    return table == "orders" || table == "fairness" || table == kBenchSummaries || table == kBenchChanges;
}

std::vector<std::string> damageText(const fs::path& file, const Damage& damage) {
    std::vector<std::string> text;
    for (const std::string& id : damage.cases)
        text.push_back(file.string() + ": the rows of case " + id +
                       " do not fit their checksum; it is left out");
    for (const std::string& id : damage.benchCases)
        text.push_back(file.string() + ": the rows of the bench's case " + id +
                       " do not fit their checksum; it is left out");
    if (damage.hits({"orders", "fairness"}))
        text.push_back(file.string() + ": orders and fairness do not fit their checksums; they are left out");
    if (damage.hits({kBenchSummaries, kBenchChanges}))
        text.push_back(file.string() +
                       ": the bench's summaries and changes do not fit their checksums; they are left out");
    return text;
}

/// New checksums would make good what is damaged.
void removeDamagedBench(SQLite::Database& database) {
    const Damage damage = findDamage(database);
    if (damage.hits({kBenchSummaries, kBenchChanges}))
        for (const char* table : {kBenchSummaries, kBenchChanges})
            database.exec(std::string("DELETE FROM ") + table);
    for (const char* where :
         {"bench_values WHERE case_id", "bench_repetitions WHERE case_id", "bench_cases WHERE id"}) {
        SQLite::Statement forget(database, std::string("DELETE FROM ") + where + " = ?");
        for (const std::string& id : damage.benchCases) (Binder(forget) << id).run();
    }
}

}  // namespace

struct RunWriter::Impl {
    Impl(const fs::path& folder, bool resume)
        : directory(createdFolder(folder, resume)), lock(directory), database(opened(directory, resume)) {}

    static SQLite::Database opened(const fs::path& folder, bool resume) {
        try {
            return openForWriting(folder, resume);
        } catch (const SQLite::Exception& error) {
            throw storeError(storeFile(folder), error, errno);
        }
    }

    /// Does `work` in a transaction.
    template <class Work>
    void write(Work work) {
        try {
            SQLite::Transaction transaction(database);
            work();
            transaction.commit();
        } catch (const SQLite::Exception& error) {
            throw storeError(storeFile(directory), error, sqlite3_system_errno(database.getHandle()));
        }
    }

    fs::path directory;
    FolderLock lock;
    SQLite::Database database;
};

RunWriter::RunWriter(const fs::path& directory, bool resume)
    : impl_(std::make_unique<Impl>(directory, resume)) {}
RunWriter::~RunWriter() = default;

void RunWriter::writeHeader(const Run& run) {
    impl_->write([&] {
        writeHeaderRows(impl_->database, run);
        sealHeader(impl_->database);
    });
    writeManifest(impl_->directory, run);
}

std::vector<std::string> RunWriter::finishedCases() const {
    std::vector<std::string> ids;
    SQLite::Statement select(impl_->database, "SELECT id FROM cases ORDER BY position, id");
    while (select.executeStep()) ids.push_back(select.getColumn(0).getString());
    return ids;
}

void RunWriter::keepOnly(const std::vector<std::string>& ids) {
    const std::set<std::string> wanted(ids.begin(), ids.end());
    impl_->write([&] {
        SQLite::Statement forget(impl_->database, "DELETE FROM cases WHERE id = ?");
        for (const std::string& id : finishedCases())
            if (!wanted.contains(id)) (Binder(forget) << id).run();
        removeSealsOfMissingCases(impl_->database);
        removeUnusedLists(impl_->database);
    });
}

void RunWriter::writeCase(const CaseRow& row) {
    impl_->write([&] {
        writeCaseRows(impl_->database, row);
        sealCase(impl_->database, row.id);
    });
}

void RunWriter::writeAnalysis(const Run& run) {
    impl_->write([&] {
        writeAnalysisRows(impl_->database, run);
        sealAnalysis(impl_->database);
    });
}

void RunWriter::writeBenchPlan(const Bench& bench) {
    impl_->write([&] {
        removeDamagedBench(impl_->database);
        results::writeBenchPlan(impl_->database, bench);
        removeSealsOfMissingCases(impl_->database);
        sealBenchPlan(impl_->database);
        sealBenchAnalysis(impl_->database);  // The rows of cases that are gone went with them.
    });
}

void RunWriter::writeBenchRepetition(const std::string& caseId, const BenchRepetition& repetition) {
    impl_->write([&] {
        results::writeBenchRepetition(impl_->database, caseId, repetition);
        sealBenchCase(impl_->database, caseId);
    });
}

void RunWriter::writeBenchAnalysis(const Bench& bench) {
    impl_->write([&] {
        results::writeBenchAnalysis(impl_->database, bench);
        sealBenchAnalysis(impl_->database);
    });
}

void RunWriter::finish(const std::string& isoTime) {
    impl_->write([&] {
        SQLite::Statement update(impl_->database, "UPDATE run SET finished = ?");
        (Binder(update) << isoTime).run();
        sealHeader(impl_->database);
    });
    writeManifest(impl_->directory, readHeaderRows(impl_->database));
}

namespace {

bool isEmpty(const fs::path& file) {
    std::error_code error;
    return fs::file_size(file, error) == 0 || error;
}

/// The first reading plays back what a killed writer has left. A file without tables becomes empty by it.
void playBackJournal(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file.string() + "-journal", ignored)) return;
    try {
        SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
        (void)SQLite::Statement(database, "SELECT name FROM sqlite_master").executeStep();
    } catch (const SQLite::Exception&) {  // reported when the store is opened
    }
}

}  // namespace

bool holdsStore(const fs::path& directory) {
    const fs::path file = storeFile(directory);
    if (isEmpty(file)) return false;
    playBackJournal(file);
    return !isEmpty(file);
}

bool wasBegun(const fs::path& directory) {
    std::error_code ignored;
    return fs::exists(directory / FolderLock::kName, ignored) || holdsStore(directory);
}

namespace {

SQLite::Database openForReading(const fs::path& directory) {
    const fs::path file = storeFile(directory);
    if (!fs::exists(file))
        throw std::runtime_error(directory.string() + ": is no run folder (it has no results.sqlite)");
    return openDatabase(file, false);
}

/// SQLite calls this every so many of its instructions, and gives up where it is not 0.
int isInterrupted(void* flag) {
    return *static_cast<const std::atomic<bool>*>(flag) ? 1 : 0;
}

}  // namespace

Run readRun(const fs::path& directory, const std::atomic<bool>* interrupted) {
    const fs::path file = storeFile(directory);
    SQLite::Database database = openForReading(directory);
    constexpr int kInstructions = 100;
    if (interrupted != nullptr)
        sqlite3_progress_handler(database.getHandle(), kInstructions, isInterrupted,
                                 const_cast<std::atomic<bool>*>(interrupted));
    try {
        SQLite::Transaction transaction(database);  // one consistent view while another process writes
        const Damage damage =
            schemaVersionOf(database) >= kFirstSchemaWithSeals ? findDamage(database) : Damage{};
        for (const std::string& table : damage.tables)
            if (!mayBeLeftOut(table))
                throw EnvironmentError("the table " + table + " is damaged: it does not fit its checksum");
        Run run = readRows(database, damage);
        run.damage = damageText(file, damage);
        run.directory = directory.string();
        run.schemaVersion = schemaVersionOf(database);
        return run;
    } catch (const std::exception& error) {
        if (interrupted != nullptr && *interrupted)
            throw ReadingInterrupted(file.string() + ": reading it was interrupted");
        throw EnvironmentError(file, std::string("cannot be read: ") + error.what(), 0);
    }
}

RunOutline readOutline(const fs::path& directory) {
    SQLite::Database database = openForReading(directory);
    try {
        RunOutline outline;
        SQLite::Statement one(database, "SELECT suite, command FROM run");
        if (one.executeStep()) Taker(one) >> outline.suite >> outline.command;
        SQLite::Statement select(database, "SELECT id, scenario, spec FROM cases ORDER BY position, id");
        while (select.executeStep()) {
            RunOutline::Case& c = outline.cases.emplace_back();
            Taker(select) >> c.id >> c.scenario >> c.spec;
        }
        return outline;
    } catch (const std::exception& error) {
        throw EnvironmentError(storeFile(directory), std::string("cannot be read: ") + error.what(), 0);
    }
}

}  // namespace rigor::results
