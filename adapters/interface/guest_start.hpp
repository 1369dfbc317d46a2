// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Starts the program of a guest. Usually the process that uses a guest starts it. A run of many cases may keep a guest
// for several of them: then the run starts it, and hands its streams to the child of each case in turn.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "adapters/interface/guest.hpp"

namespace rigor::adapter {

/// A guest's process and this side's ends of its streams, which do not block.
struct GuestProcess {
    pid_t pid = -1;
    int input = -1;   ///< requests are written here: a socket
    int output = -1;  ///< answers are read here
    int log = -1;     ///< its standard error is read here
};

/// Settings of the start of a guest that stays for several cases.
struct KeptStart {
    std::size_t memoryMiB =
        0;  ///< limit of addresses, 0: none; not for guests whose resident memory is limited
};

/// Starts the program. It dies with the thread that calls this. Without `kept` it stays in the process group of its
/// parent; with it, it leads one of its own. Throws std::runtime_error.
GuestProcess startGuest(const GuestManifest& manifest, const std::optional<KeptStart>& kept = {});

void closeStreams(GuestProcess& guest);

/// A guest that this process uses and its parent keeps.
struct LentGuest {
    GuestProcess process;
    std::int64_t worldsBefore = 0;  ///< worlds have numbers above this one: others have been used
};

/// Entry for the environment of the child that a guest is lent to.
std::string lentGuestVariable(const std::string& name, const LentGuest& guest);

/// The guest of this name that was lent to this process; the second call finds none.
std::optional<LentGuest> takeLentGuest(const std::string& name);

}  // namespace rigor::adapter
