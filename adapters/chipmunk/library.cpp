// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/chipmunk/library.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>

#include "adapters/chipmunk/convert.hpp"

namespace rigor::chipmunk {

void useLibrary() {
    static std::once_flag once;
    std::call_once(once, [] {
        std::fflush(stdout);
        const int kept = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
        cpSpaceFree(cpSpaceNew());
        std::fflush(stdout);
        if (kept >= 0) dup2(kept, STDOUT_FILENO);
        for (const int file : {kept, nowhere})
            if (file >= 0) close(file);
    });
}

}  // namespace rigor::chipmunk
