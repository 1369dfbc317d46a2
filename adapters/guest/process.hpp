// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A guest's process: started from its manifest, spoken to through pipes, and killed when this object goes, or by the
// system when this process ends. One that was lent to this process (guest_start.hpp) goes on after it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "adapters/guest/frame.hpp"
#include "adapters/interface/engine_failure.hpp"
#include "adapters/interface/guest_start.hpp"

namespace rigor::guest {

class Process {
  public:
    /// Throws std::runtime_error where the program can not be started.
    explicit Process(const adapter::GuestManifest& manifest);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Sends one frame and returns the next one that comes. Throws EngineFailure for a process that ends, sends
    /// something else or nothing within the time, or takes more memory than it may; the process is dead then.
    Frame exchange(const Frame& request, double seconds);

    pid_t pid() const { return guest_.pid; }
    /// Numbers up to this one have been given to worlds, by other users of the guest.
    std::int64_t worldsBefore() const { return worldsBefore_; }

  private:
    using Kind = adapter::EngineFailure::Kind;
    [[noreturn]] void fail(Kind kind, const std::string& what);
    [[noreturn]] void failEnded();
    /// Waits until the process has something to say, can be written to, or so many milliseconds have passed.
    void waitForEvents(bool wantsToWrite, int milliseconds);
    void writeSome(const std::string& bytes, std::size_t& sent);
    bool readSome();  ///< false at the end of its output
    void readLog();
    void passOn(const char* text, std::size_t size);
    void checkMemory();
    std::optional<Frame> nextFrame();
    void waitForEnd();
    void kill();

    std::string name_;
    std::size_t mostResidentKiB_ = 0;  ///< 0: its address space is limited instead, or nothing
    adapter::GuestProcess guest_;
    bool isLent_ = false;  ///< another process has started it, and keeps it
    std::int64_t worldsBefore_ = 0;
    std::chrono::steady_clock::time_point memoryCheckAt_;
    FrameReader reader_;
    std::string logTail_;
    std::size_t passedOn_ = 0;  ///< bytes of the log since the last request, passed on or cut
};

}  // namespace rigor::guest
