// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Processes that are ready to run a case: each has started the program and loaded one module, and forks for every
// child, which then need not start and load again. A fork begins in the state in which the server was found clean
// (serve.cpp): it has made no engine's world. The forked process is a child of this process, not of the server, so that
// limits, signals and waitpid are those of any child.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"

namespace rigor::validation {

inline constexpr const char* kNoModule = "";  ///< module of a server that has loaded none

/// The module that a server may load for a spec. None for guests, which have processes of their own, and for engines
/// that are not installed.
std::optional<std::filesystem::path> servedModule(const adapter::EngineSpec& spec);

class ForkServers {
  public:
    /// `mostSilence`: a fork takes a millisecond; a server that is silent for so long is ended.
    explicit ForkServers(std::chrono::milliseconds mostSilence = std::chrono::seconds(10))
        : mostSilence_(mostSilence) {}
    ~ForkServers();
    ForkServers(const ForkServers&) = delete;
    ForkServers& operator=(const ForkServers&) = delete;

    /// As startProgram, with a fork of the server of `module`. Empty where there is
    /// none: the state of the program with this module could not be shown to be clean, it ended twice, or it has not
    /// loaded the module yet. The program has to be started then.
    std::optional<pid_t> start(const std::filesystem::path& module, const std::vector<std::string>& arguments,
                               int output, std::size_t memoryMiB);

    /// Ends all of them, and forgets which modules cannot be served.
    void endAll();

  private:
    struct Server {
        pid_t pid = -1;
        int socket = -1;
        bool isReady = false;
        int failures = 0;  ///< number of servers of this module that ended or did not answer
    };
    bool makeReady(Server& server, const std::string& binary, const std::filesystem::path& module);
    static void launch(Server& server, const std::string& binary, const std::filesystem::path& module);
    static void end(Server& server);

    std::chrono::milliseconds mostSilence_;
    std::map<std::filesystem::path, Server> servers_;
};

}  // namespace rigor::validation
