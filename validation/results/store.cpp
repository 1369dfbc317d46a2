// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "validation/results/bench_rows.hpp"
#include "validation/results/columns.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/schema.hpp"

namespace rigor::results {

namespace fs = std::filesystem;

/// One writer per run folder, also across processes; the lock ends with the process, however it ends.
class FolderLock {
  public:
    explicit FolderLock(const fs::path& directory)
        : file_(open((directory / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
        if (file_ < 0)
            throw std::runtime_error(directory.string() + ": cannot write here: " + std::strerror(errno));
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
    const bool present = fs::exists(file);
    if (present && !resume)
        throw std::runtime_error(directory.string() +
                                 ": holds a run already; resume it or choose another folder");
    if (!present && resume)
        throw std::runtime_error(directory.string() + ": holds no run that could be resumed");
    return present ? openDatabase(file, true) : createDatabase(file);
}

fs::path createdFolder(const fs::path& directory) {
    fs::create_directories(directory / "trajectories");
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
    const fs::path file = directory / "manifest.json", part = directory / "manifest.json.part";
    {
        std::ofstream out(part, std::ios::trunc);
        out << manifest.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
        if (!out.flush()) throw std::runtime_error(part.string() + ": cannot be written");
    }
    fs::rename(part, file);
}

}  // namespace

struct RunWriter::Impl {
    Impl(const fs::path& folder, bool resume)
        : directory(createdFolder(folder)), lock(directory), database(openForWriting(directory, resume)) {}

    fs::path directory;
    FolderLock lock;
    SQLite::Database database;
};

RunWriter::RunWriter(const fs::path& directory, bool resume)
    : impl_(std::make_unique<Impl>(directory, resume)) {}
RunWriter::~RunWriter() = default;

void RunWriter::writeHeader(const Run& run) {
    SQLite::Transaction transaction(impl_->database);
    writeHeaderRows(impl_->database, run);
    transaction.commit();
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
    SQLite::Transaction transaction(impl_->database);
    SQLite::Statement forget(impl_->database, "DELETE FROM cases WHERE id = ?");
    for (const std::string& id : finishedCases())
        if (!wanted.contains(id)) (Binder(forget) << id).run();
    transaction.commit();
}

void RunWriter::writeCase(const CaseRow& row) {
    SQLite::Transaction transaction(impl_->database);
    writeCaseRows(impl_->database, row);
    transaction.commit();
}

void RunWriter::writeAnalysis(const Run& run) {
    SQLite::Transaction transaction(impl_->database);
    writeAnalysisRows(impl_->database, run);
    transaction.commit();
}

void RunWriter::writeBenchPlan(const Bench& bench) {
    SQLite::Transaction transaction(impl_->database);
    results::writeBenchPlan(impl_->database, bench);
    transaction.commit();
}

void RunWriter::writeBenchRepetition(const std::string& caseId, const BenchRepetition& repetition) {
    SQLite::Transaction transaction(impl_->database);
    results::writeBenchRepetition(impl_->database, caseId, repetition);
    transaction.commit();
}

void RunWriter::writeBenchAnalysis(const Bench& bench) {
    SQLite::Transaction transaction(impl_->database);
    results::writeBenchAnalysis(impl_->database, bench);
    transaction.commit();
}

void RunWriter::finish(const std::string& isoTime) {
    SQLite::Transaction transaction(impl_->database);
    SQLite::Statement update(impl_->database, "UPDATE run SET finished = ?");
    (Binder(update) << isoTime).run();
    transaction.commit();
    writeManifest(impl_->directory, readRows(impl_->database));
}

Run readRun(const fs::path& directory) {
    const fs::path file = storeFile(directory);
    if (!fs::exists(file))
        throw std::runtime_error(directory.string() + ": is no run folder (it has no results.sqlite)");
    SQLite::Database database = openDatabase(file, false);
    try {
        SQLite::Transaction transaction(database);  // one consistent view while another process writes
        Run run = readRows(database);
        run.directory = directory.string();
        run.schemaVersion = schemaVersionOf(database);
        return run;
    } catch (const std::exception& error) {
        throw std::runtime_error(file.string() + ": cannot be read: " + error.what());
    }
}

}  // namespace rigor::results
