// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Leaves something behind when it is loaded that a fork of the process would share or lack; RIGOR_DOUBLE_UNCLEAN says
// what.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cfenv>
#include <cstdlib>
#include <string>
#include <thread>

#include "validation/runner/tests/doubles/free_flight.hpp"

namespace rigor::doubles {
namespace {

const bool kLeft = [] {
    const char* what = std::getenv("RIGOR_DOUBLE_UNCLEAN");
    const std::string left = what == nullptr ? "" : what;
    if (left == "thread") std::thread([] { pause(); }).detach();
    if (left == "rounding") std::fesetround(FE_UPWARD);
    if (left == "file") (void)open("/dev/zero", O_RDONLY | O_CLOEXEC);
    if (left == "memory") mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (left == "child" && fork() == 0) {
        pause();
        _exit(0);
    }
    if (left == "crash") std::abort();
    return true;
}();

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeDouble<rigor::doubles::FreeFlightWorld>)
