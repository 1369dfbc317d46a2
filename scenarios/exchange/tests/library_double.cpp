// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A test double of libmujoco's mj_loadXML, put before the library by LD_PRELOAD: it fails as RIGOR_TEST_LIBRARY says.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

extern "C" void* mj_loadXML(const char*, const void*, char*, int) {
    const char* word = std::getenv("RIGOR_TEST_LIBRARY");
    const std::string_view fault = word ? word : "";
    if (fault == "aborts") std::abort();
    if (fault == "crashes") raise(SIGSEGV);
    if (fault == "exits") std::exit(0);
    if (fault == "hangs")
        while (true) sleep(1);
    if (fault == "fills_memory") {
        std::vector<char*> blocks;
        while (true) {
            blocks.push_back(new char[64u << 20]);
            blocks.back()[0] = 1;
        }
    }
    if (fault == "floods") {
        const char line[] = "the library talks and talks and talks and talks\n";
        for (int i = 0; i < 100000; ++i) std::fwrite(line, 1, sizeof line - 1, stderr);
        std::abort();
    }
    return nullptr;
}
