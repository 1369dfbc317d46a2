// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests that outlive a case. Starting one takes longer than many a case, so the processes that run cases borrow
// theirs from here. Only guests whose manifest says `keep_alive` are kept; the conformance kit holds them to it. One
// that ended, grew, or served a case that did not end as it should is replaced by a fresh one.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "adapters/interface/guest_start.hpp"

namespace rigor::validation {

class KeptGuests {
  public:
    /// `memoryMiB`: limit of a guest's memory; 0: none.
    explicit KeptGuests(std::size_t memoryMiB) : memoryMiB_(memoryMiB) {}
    ~KeptGuests();
    KeptGuests(const KeptGuests&) = delete;
    KeptGuests& operator=(const KeptGuests&) = delete;

    struct Loan {
        std::string name;
        adapter::LentGuest guest;
        double processorTime = 0.0;  ///< processor time of the guest when it was lent [s]
    };
    /// A guest for one process. None for a module, for a guest that must not be kept, and for one that cannot be
    /// started: then that process starts its own and reports the problem.
    std::optional<Loan> lend(const std::string& engine);

    /// Processor time that the guest has used since it was lent [s].
    static double used(const Loan& loan);

    /// Takes it back. `isClean`: the process that had it ended by itself and without an error. Returns the
    /// processor time that the guest has used [s].
    double takeBack(Loan loan, bool isClean);

  private:
    const adapter::GuestManifest* manifestOf(const std::string& engine);
    bool mayServeAgain(const Loan& loan) const;

    std::size_t memoryMiB_;
    std::map<std::string, std::optional<adapter::GuestManifest>> manifests_;  ///< none: it is not kept
    std::map<std::string, std::deque<adapter::LentGuest>> idle_;
};

}  // namespace rigor::validation
