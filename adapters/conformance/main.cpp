// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// conformance_test [--engine SPEC] [gtest flags]: one engine in this process, or without --engine every
// engine on the adapter path (RIGOR_ADAPTER_PATH), each in a process of its own.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "adapters/conformance/kit.hpp"
#include "adapters/interface/guest.hpp"

namespace {

using namespace rigor;

constexpr int kSkipped = 77;  ///< exit code for an engine that is not installed

std::vector<std::string> specsOnPath() {
    std::vector<std::string> specs;
    for (const auto& name : adapter::availableEngines()) {
        specs.push_back(name);
        for (const auto& precision : adapter::availablePrecisions(name))
            specs.push_back(name + ":precision=" + precision);
    }
    return specs;
}

/// Exit code of this program for one engine.
int runInChild(const std::string& spec, int argc, char** argv) {
    const pid_t child = fork();
    if (child == 0) {
        std::vector<char*> arguments(argv, argv + argc);
        std::string flag = "--engine", value = spec;
        arguments.push_back(flag.data());
        arguments.push_back(value.data());
        arguments.push_back(nullptr);
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    int status = 1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

int runAll(int argc, char** argv) {
    const auto specs = specsOnPath();
    std::vector<std::string> lines;
    int failed = specs.empty() ? 1 : 0;
    for (const auto& spec : specs) {
        const int code = runInChild(spec, argc, argv);
        if (code != 0) failed = 1;
        lines.push_back(spec + (code == 0 ? ": conforms" : ": FAILED (" + std::to_string(code) + ")"));
    }
    if (specs.empty()) std::puts("no adapter on the path (RIGOR_ADAPTER_PATH)");
    for (const auto& line : lines) std::puts(line.c_str());
    return failed;
}

/// Registered after all other tests, so that it runs last: every known deviation that no check needed is a failure. The
/// tear-down of an environment would do, but a failure there makes GoogleTest's JSON unreadable.
class KnownDeviations : public testing::Test {
    void TestBody() override {
        for (const auto& line : conformance::needlessDeviations()) ADD_FAILURE() << line;
    }
};

}  // namespace

int main(int argc, char** argv) {
    std::string spec;
    std::vector<char*> rest{argv[0]};
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--engine") == 0 && i + 1 < argc)
            spec = argv[++i];
        else
            rest.push_back(argv[i]);
    }
    if (spec.empty()) return runAll(argc, argv);
    const auto absent = adapter::absentGuests();
    for (const auto& guest : absent)
        if (guest.name == adapter::parseSpec(spec).engine) {
            std::fprintf(stderr, "%s is not installed: %s is missing\n", spec.c_str(),
                         guest.missing().c_str());
            return kSkipped;
        }
    try {
        conformance::useEngine(spec);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", spec.c_str(), e.what());
        return 2;
    }
    int count = rest.size();
    rest.push_back(nullptr);
    testing::InitGoogleTest(&count, rest.data());
    testing::RegisterTest("KnownDeviations", "AreNeeded", nullptr, nullptr, __FILE__, __LINE__,
                          [] { return new KnownDeviations; });
    return RUN_ALL_TESTS();
}
