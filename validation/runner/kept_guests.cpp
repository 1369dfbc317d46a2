// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/kept_guests.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>

#include "adapters/interface/registry.hpp"

namespace rigor::validation {
namespace {

/// A process that has one guest gives at most so many numbers to worlds.
constexpr std::int64_t kWorldsOfLoan = 1 << 24;
/// A guest is replaced when it holds this part of the memory that it may have: what it keeps of earlier cases
/// must not end a later one.
constexpr std::size_t kMostMemoryPart = 4;

void end(adapter::LentGuest& guest) {
    kill(guest.process.pid, SIGKILL);
    while (waitpid(guest.process.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    adapter::closeStreams(guest.process);
}

double processorTime(pid_t pid) {
    clockid_t clock = 0;
    timespec t{};
    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0.0;
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::size_t residentMiB(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
    std::size_t size = 0, resident = 0;
    file >> size >> resident;
    return (resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) >> 20;
}

/// True for an answer that was not read, and at the end of its output.
bool hasOutput(int file) {
    pollfd files{file, POLLIN, 0};
    return poll(&files, 1, 0) != 0;
}

}  // namespace

KeptGuests::~KeptGuests() {
    for (auto& [name, guests] : idle_)
        for (adapter::LentGuest& guest : guests) end(guest);
}

const adapter::GuestManifest* KeptGuests::manifestOf(const std::string& engine) {
    const auto known = manifests_.find(engine);
    if (known != manifests_.end()) return known->second ? &*known->second : nullptr;
    auto& entry = manifests_[engine];
    try {
        adapter::EngineSpec spec;
        spec.engine = engine;
        const auto file = adapter::moduleFor(spec);
        if (file.extension() == ".json") entry = adapter::readGuestManifest(file);
    } catch (const std::exception&) {
        return nullptr;  // the process that needs the engine says what is wrong
    }
    if (entry && !entry->keepAlive) entry.reset();
    return entry ? &*entry : nullptr;
}

std::optional<KeptGuests::Loan> KeptGuests::lend(const std::string& engine) {
    const adapter::GuestManifest* manifest = manifestOf(engine);
    if (manifest == nullptr) return std::nullopt;
    auto& guests = idle_[engine];
    if (guests.empty()) {
        try {
            guests.push_back({adapter::startGuest(*manifest, adapter::KeptStart{memoryMiB_}), 0});
        } catch (const std::exception&) {
            return std::nullopt;
        }
    }
    Loan loan{engine, guests.front(), processorTime(guests.front().process.pid)};
    guests.pop_front();
    return loan;
}

bool KeptGuests::mayServeAgain(const Loan& loan) const {
    const adapter::GuestProcess& process = loan.guest.process;
    siginfo_t ended{};
    waitid(P_PID, static_cast<id_t>(process.pid), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == process.pid || hasOutput(process.output)) return false;
    return memoryMiB_ == 0 || residentMiB(process.pid) < memoryMiB_ / kMostMemoryPart;
}

double KeptGuests::used(const Loan& loan) {
    return std::max(0.0, processorTime(loan.guest.process.pid) - loan.processorTime);
}

double KeptGuests::takeBack(Loan loan, bool isClean) {
    const double seconds = used(loan);
    // The log after its last answer belongs to no case.
    char buffer[4096];
    while (read(loan.guest.process.log, buffer, sizeof buffer) > 0) {
    }
    if (isClean && mayServeAgain(loan)) {
        loan.guest.worldsBefore += kWorldsOfLoan;
        idle_[loan.name].push_front(loan.guest);
    } else {
        end(loan.guest);
    }
    return seconds;
}

}  // namespace rigor::validation
